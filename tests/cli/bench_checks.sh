#!/usr/bin/env bash
# Tests the command line of glint bench. bench_checks.sh GLINT JSON_GET
# Each run compiles the kernels from nothing, so one run serves many checks. No check depends on
# time.
root=$(readlink -f -- "$(dirname "$0")/../..")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"
scene=$root/scenes/mirror_sphere.gltf
mkdir tmp
export TMPDIR=$work/tmp

no_temporaries() {
    [ -z "$(ls -A tmp)" ]
}

# ---- help and mistakes --------------------------------------------------------------------------

# shellcheck disable=SC2046 # lists of words
check 'bench --help tells every option' help_mentions bench allow-large-images seconds rounds no-check error no-sampling \
    list html json baseline margin env env-layout ball-circle ball-distance ball-fov env-flip camera eye look-at up fov elevation fit \
    animation variant material texture-size only without scene $(settings_of environment size frame device) device kernel-dir help
check 'and its own default size' grep -q '\[1920x1080;' help.txt
run --help
check 'glint --help lists it' grep -q '^  bench ' stdout
run bench --list
check '--list names the built-in scenes' test "$(cut -d ' ' -f 1 stdout | tr '\n' ' ')" = 'mirror glass mixed '

refuses 2 'exclude each other' bench mirror --rounds 3 --seconds 2
refuses 2 '--rounds' bench mirror --rounds 0
refuses 2 '--rounds' bench mirror --rounds x
refuses 2 '--seconds' bench mirror --seconds 0
refuses 2 '--seconds' bench mirror --seconds nan
refuses 2 '--margin' bench mirror --margin 5
refuses 2 '--margin' bench mirror --margin -5 --baseline x.json
refuses 2 '--json' bench mirror --json
refuses 2 'SCENE is missing' bench ''
refuses 2 'named twice' bench mirror glass mirror
refuses 2 'built in' bench mirror --scene 0
refuses 2 'did you mean --rounds?' bench --round=3
refuses 2 'is an input' bench mirror --json in/b.json --baseline in/b.json
refuses 3 'no built-in scene' bench miror
refuses 3 'no built-in scene' bench mirror in/missing.gltf
refuses 3 'not a folder' bench mirror --kernel-dir in/missing
refuses 3 'in/missing.hdr: ' bench mirror --env in/missing.hdr
refuses 5 'out/missing' bench mirror --json out/missing/x.json
refuses 3 'in/missing.json' bench mirror --baseline in/missing.json
mkfifo in/pipe.json
refuses 3 'no regular file' bench mirror --baseline in/pipe.json
printf '{"format": "glint be' >in/short.json
refuses 3 'in/short.json: line 1' bench mirror --baseline in/short.json
printf '{"scenes": []}' >in/other.json
refuses 3 'not a result of glint bench' bench mirror --baseline in/other.json
run bench mirror --kernel-dir "$root/tests/broken_kernels"
check 'kernels that do not compile: exit status 4' test "$status" -eq 4
check 'and the log' grep -q 'undeclared_name' stderr
check 'and no temporary folder' no_temporaries
OCL_ICD_VENDORS=$work/in "$glint" bench mirror >stdout 2>stderr
check 'no device: exit status 4' test $? -eq 4 -a "$(wc -l <stderr)" -eq 1

# ---- a run --------------------------------------------------------------------------------------

run bench "$scene" --size 64x48 --rounds 3 --json out/stats.json
check 'a run succeeds quietly' test "$status" -eq 0 -a ! -s stderr
check 'and leaves no temporary folder' no_temporaries
for text in 'relative RMSE' 'well-conditioned' 'frames/s' 'Mrays/s' 'primary' 'kernels, cold' \
    'kernels, warm' 'MiB on the device' '3 frames, after the first'; do
    check "the table says: $text" grep -qF "$text" stdout
done
check 'JSON: format' stat_is 'glint bench' format
check 'JSON: schema' stat_is 1 schema
check 'JSON: date' grep -qE '"date": "[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z"' out/stats.json
check 'JSON: cores' stat_is_positive host cores
check 'JSON: processor' "$json_get" out/stats.json host cpu
check 'JSON: load' "$json_get" out/stats.json host load_average
check 'JSON: rounds' stat_is 3 options rounds
check 'JSON: no seconds' stat_is null options seconds
check 'JSON: the scene' stat_is "$scene" scenes 0 name
check 'JSON: its triangles' stat_is 20480 scenes 0 scene triangle_count
check 'JSON: the check' stat_is passed scenes 0 check outcome
check 'JSON: complete' stat_is true complete
check 'JSON: its error' stat_is_positive scenes 0 check error relative_rmse
check 'JSON: nothing is not finite' stat_is 0 scenes 0 check nonfinite_pixels
check 'JSON: every frame is the same' stat_is 0 scenes 0 check unsteady_frames
check 'JSON: size' stat_is 64 scenes 0 settings width
check 'JSON: three frames' stat_is 3 scenes 0 frames kernel count
for part in median lower_quartile upper_quartile minimum maximum; do
    check "JSON: $part" stat_is_positive scenes 0 frames kernel_and_readback "$part"
done
check 'JSON: primary rays' stat_is $((64 * 48)) scenes 0 rays primary
check 'JSON: their rate' stat_is_positive scenes 0 mrays_per_second primary
check 'JSON: rate of reflected rays' stat_is_positive scenes 0 mrays_per_second reflected
check 'JSON: frames a second' stat_is_positive scenes 0 frames frames_per_second
for phase in load_scene load_environment analysis bvh irradiance cells upload kernel_build_cold \
    kernel_build_warm first_frame; do
    check "JSON: milliseconds of $phase" "$json_get" out/stats.json scenes 0 milliseconds "$phase"
done
for part in device_scene_bytes device_tree_bytes device_environment_bytes peak_resident_bytes; do
    check "JSON: $part" stat_is_positive scenes 0 memory "$part"
done
check 'JSON: the frame on the device' stat_is $((64 * 48 * 16)) scenes 0 memory device_frame_bytes
check 'JSON: device' "$json_get" out/stats.json scenes 0 device name
check 'JSON: plan' "$json_get" out/stats.json scenes 0 plan text
check 'JSON: tree' stat_is_positive scenes 0 bvh nodes
cp out/stats.json in/before.json
clean

# ---- baselines ----------------------------------------------------------------------------------

# Multiplies the launch times of a frame in a report by a factor.
scale_times() { # FACTOR FROM TO
    awk -v factor="$1" '/"kernel": \{/ { inside = 1 } /\}/ { inside = 0 }
        inside && /"median"|quartile/ { match($0, /[0-9.e+-]+,$/)
            $0 = substr($0, 1, RSTART - 1) sprintf("%.9f,", factor * substr($0, RSTART)) }
        { print }' "$2" >"$3"
}
scale_times 0.001 in/before.json in/faster.json
scale_times 1000 in/before.json in/slower.json
sed 's/"name": ".*mirror_sphere.gltf"/"name": "another"/' in/before.json >in/another.json

run bench "$scene" --size 64x48 --rounds 2 --baseline in/faster.json --json out/stats.json
check 'slower than the baseline: exit status 7' test "$status" -eq 7
check 'a line for the scene, and one for all' test "$(grep -c slower stderr)" -eq 2 -a "$(wc -l <stderr)" -eq 2
check 'the table says so too' grep -q 'mirror_sphere.gltf *slower: ' stdout
check 'the JSON is written all the same' stat_is slower baseline scenes 0 verdict
check 'with the margin' grep -q '"margin_percent": 10' out/stats.json
clean
run bench "$scene" --size 64x48 --rounds 2 --baseline in/slower.json --json -
check 'faster than the baseline: exit status 0' test "$status" -eq 0 -a ! -s stderr
mkdir -p out && cp stdout out/stats.json
check '--json - prints JSON and nothing else' stat_is faster baseline scenes 0 verdict
clean
run bench "$scene" --size 64x48 --rounds 1 --no-check --baseline in/another.json --json out/stats.json
check 'a baseline of other scenes: exit status 3' test "$status" -eq 3
check 'and it is said which' grep -q 'warning: .*no scene' stderr
check '--no-check is on record' stat_is 'left out' scenes 0 check outcome
check 'and in the table' grep -q 'not checked' stdout
clean
run bench "$scene" --size 64x50 --rounds 1 --no-check --baseline in/before.json --json out/stats.json
check 'a baseline of another size: exit status 3' test "$status" -eq 3
check 'and it is said how' grep -q 'settings.height is 48 there and 50 here' stderr
check 'and nothing is written' test -z "$(ls -A out)"
check 'and no report is spoken of' test "$(wc -l <stderr)" -eq 1
clean

# ---- wrong pictures -----------------------------------------------------------------------------

# breaks FOLDER WEIGHT: copies the kernels with another start weight of paths.
breaks() {
    cp -r "$root/kernels" "$1"
    sed -i "s/weight, ALWAYS, 1, 1,/weight, ALWAYS, 1, $2,/" "$1/path_state.h"
    ! diff -qr "$root/kernels" "$1" >/dev/null
}
check 'kernels that make pictures two per cent too bright' breaks too_bright 1.02f
check 'kernels that make pictures of NaN' breaks not_finite NAN

# no_throughput: checks that neither the table nor the report has a throughput.
no_throughput() {
    ! grep -qE 'Mrays|frames/s' stdout &&
        ! "$json_get" out/stats.json scenes 0 mrays_per_second &&
        ! "$json_get" out/stats.json scenes 0 frames &&
        stat_is null scenes 0 milliseconds first_frame
}
run bench "$scene" --size 64x48 --rounds 1 --depth 2 --kernel-dir too_bright --json out/stats.json
check 'a picture that is too bright: exit status 7' test "$status" -eq 7
check 'it is said what is wrong' grep -q 'the picture is wrong: .*% of the well-conditioned' stderr
check 'no speed is given' no_throughput
check 'the check is on record' stat_is failed scenes 0 check outcome
clean
run bench "$scene" --size 64x48 --rounds 1 --depth 2 --no-check --kernel-dir not_finite --json out/stats.json
check 'NaN is refused without a check, too: exit status 7' test "$status" -eq 7
check 'it is said what is wrong' grep -q '[0-9] pixels are not finite' stderr
check 'no speed is given' no_throughput
clean

# ---- built-in scenes and settings ---------------------------------------------------------------

run bench glass mirror --size 32x18 --rounds 1 --depth 2 --kernel-width 8 --json out/stats.json
check 'two built-in scenes' stat_is mirror scenes 1 name
check 'two built-in scenes: complete' stat_is true complete
check 'glass refracts' stat_is_positive scenes 0 mrays_per_second refracted_in
check 'a mirror does not' stat_is 0 scenes 1 rays refracted_in
check 'the depth' stat_is 2 scenes 1 settings depth
check 'the width' stat_is 8 scenes 0 plan kernel_width
clean
cp "$scene" "$(dirname "$scene")/mirror_sphere.bin" .
mv mirror_sphere.gltf mirror
run bench mirror --size 16x16 --rounds 1 --no-check
check 'a file named like a built-in scene is meant' test "$status" -ne 2
rm -f mirror mirror_sphere.bin

# ---- runs that end early ------------------------------------------------------------------------

# cut_off SIGNAL STATUS: ends a run after its first scene. On a busy machine the second may have ended,
# too. Sets `scenes_there`, the number of scenes in the report.
tiny=(--size 16x16 --rounds 1 --no-check --depth 1)
cut_off() {
    "$glint" bench mirror glass mixed "${tiny[@]}" --json out/stats.json >stdout 2>stderr &
    local process=$! waited=0
    until [ -s out/stats.json ] || [ "$waited" -ge 1200 ] || ! kill -0 "$process" 2>/dev/null; do
        sleep 0.05
        waited=$((waited + 1))
    done
    kill "-$1" "$process"
    wait "$process"
    check "$1 after a scene: exit status $2" test $? -eq "$2"
    check "$1 after a scene: its JSON is there" stat_is mirror scenes 0 name
    check "$1 after a scene: with its times" stat_is 1 scenes 0 frames kernel count
    scenes_there=$(grep -c '"check": {' out/stats.json)
    check "$1 after a scene: and not all" test "$scenes_there" -lt 3
    check "$1 after a scene: marked as incomplete" stat_is false complete
    check "$1 after a scene: what is missing" stat_is mixed asked 2
    check "$1 after a scene: no temporary" test "$(ls -A out)" = stats.json
}
cut_off KILL 137
for _ in {1..200}; do # until its child has noticed
    no_temporaries && break
    sleep 0.1
done
check 'KILL after a scene: its child cleans up' no_temporaries
clean
cut_off INT 130
check 'INT after a scene: said' grep -q "^glint: out/stats.json: it holds $scenes_there of 3 scenes, and is marked" stderr
run bench mirror "${tiny[@]}" --baseline out/stats.json --margin 1000000
check 'a baseline that ended early serves for its scenes' test "$status" -eq 0
check 'a baseline that ended early: said' \
    grep -q "^glint: warning: out/stats.json: its run ended early: it holds $scenes_there of 3 scenes" stderr
clean
printf '{"asset": ' >in/broken.gltf
run bench mirror in/broken.gltf "${tiny[@]}" --json -
check 'a second scene that fails: its exit status' test "$status" -eq 3
mkdir -p out && cp stdout out/stats.json
check 'a second scene that fails: the first is on stdout' stat_is mirror scenes 0 name
check 'a second scene that fails: marked as incomplete' stat_is false complete
check 'a second scene that fails: said' grep -q '^glint: the report: it holds 1 of 2 scenes' stderr
clean

# ---- signals ------------------------------------------------------------------------------------

# stops SIGNAL STATUS DELAY: runs the program in a session of its own, to find processes that it
# leaves running.
stops() {
    setsid "$glint" bench mirror --size 1920x1080 --samples 16 --seconds 60 --json out/x.json >stdout 2>stderr &
    local process=$!
    sleep "$3"
    kill "-$1" "$process"
    local begun=$SECONDS
    wait "$process"
    status=$?
    check "$1 after $3 s: exit status $2" test "$status" -eq "$2"
    check "$1 after $3 s: promptly" test $((SECONDS - begun)) -le 5
    check "$1 after $3 s: nothing half-written" test -z "$(ls -A out)"
    check "$1 after $3 s: no temporary folder" no_temporaries
    check "$1 after $3 s: no process goes on" test -z "$(pgrep -s "$process")"
    clean
}
stops TERM 143 0.05
stops INT 130 1.5
stops TERM 143 6
stops INT 130 12

finish
