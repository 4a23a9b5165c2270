#!/usr/bin/env bash
# Tests sequences on the command line: glint render --frames, --turntable, --shard, --skip-existing.
# sequence_checks.sh GLINT JSON_GET SCENES [KILLS]
# KILLS is the number of runs killed at a random moment (3).
scenes=$(readlink -f -- "$3")
kills=${4:-3}
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

scene=in/scene.gltf
cp "$scenes/mirror_sphere.gltf" in/scene.gltf
cp "$scenes/mirror_sphere.bin" in/
small=(--size 48x32 --progress none)

# sequence ARGUMENT…: renders a turntable of 8.
sequence() {
    run render "$scene" --turntable 8 "${small[@]}" "$@"
}

files() { # FOLDER: its files on one line
    (cd "$1" && find . -mindepth 1 -printf '%P\n' | sort | tr '\n' ' ')
}

eight='f.0001.exr f.0002.exr f.0003.exr f.0004.exr f.0005.exr f.0006.exr f.0007.exr f.0008.exr '

# ---- mistakes -----------------------------------------------------------------------------------

refuses 2 'which frames?' render "$scene" -o out/f.####.exr
refuses 2 '# stands for the frame'"'"'s number' render "$scene" -o 'out/ring #1.png'
refuses 2 'or write \# for the sign itself' render "$scene" -o 'out/ring #1.png'
refuses 2 '%02d stands for the frame'"'"'s number' render "$scene" -o 'out/ring %02d.png'
refuses 2 'or write \% for the sign itself' render "$scene" -o 'out/ring %02d.png'
refuses 2 '\# and \% are the signs themselves' render "$scene" --turntable 2 -o 'out/ring #1.##.png'
refuses 2 "need a place for their number" render "$scene" --frames 1-3 -o out/f.exr
refuses 2 "two places" render "$scene" --frames 1-3 -o out/f.##.##.exr
refuses 2 "frames '1-'" render "$scene" --frames 1- -o out/f.##.exr
refuses 2 "never come to" render "$scene" --frames 1-9x-2 -o out/f.##.exr
refuses 2 "leads nowhere" render "$scene" --frames 1-9x0 -o out/f.##.exr
refuses 2 "shard '3/2'" render "$scene" --frames 1-9 --shard 3/2 -o out/f.##.exr
refuses 2 'one frame alone' render "$scene" --shard 1/2 -o out/f.exr
refuses 2 '--turntable' render "$scene" --turntable 0 -o out/f.##.exr
refuses 2 'does not say how it was made' render "$scene" --skip-existing -o out/f.hdr
refuses 5 'out/none' render "$scene" --turntable 2 -o out/none/none/f.####.exr
refuses 3 'in/none.exr' render "$scene" --turntable 2 --env in/none.exr -o out/new/f.####.exr
refuses 2 'it is for --progress json' render "$scene" --progress-fd 3 -o out/f.exr
refuses 2 '--progress-fd 77: ' render "$scene" --progress json --progress-fd 77 -o out/f.exr
cp "$scenes/axes.hdr" in/env.0003.hdr
refuses 2 'this is an input' render "$scene" --env in/env.0003.hdr --frames 1-9 -o in/env.####.hdr
run render "$scene" --env in/env.0003.hdr --frames 4-5 "${small[@]}" -o in/env.####.hdr
check 'an input between frames is none of them' test "$status" -eq 0 -a -s in/env.0005.hdr

# ---- frames -------------------------------------------------------------------------------------

mkdir whole
sequence -o whole/f.####.exr --stats whole.jsonl
check 'a turntable: exit status 0, nothing on stdout' test "$status" -eq 0 -a ! -s stdout
check 'a turntable: its files' test "$(files whole)" = "$eight"
check 'statistics: a line for the run, the frames, the total' test "$(wc -l <whole.jsonl)" -eq 10
sed -n 1p whole.jsonl >out/stats.json
check 'statistics: the run' stat_is 8 frames
sed -n 4p whole.jsonl >out/stats.json
check 'statistics: a frame' stat_is_positive rays primary
check 'statistics: its outcome' stat_is rendered outcome
trees() { grep -o '"tree": "[a-z]*"' "$1" | sort | uniq -c | tr -s ' \n' '  '; }
check 'statistics: a tree for all frames' \
    test "$(trees whole.jsonl)" = ' 1 "tree": "built" 7 "tree": "kept" '
tail -n 1 whole.jsonl >out/stats.json
check 'statistics: the total' stat_is 8 rendered
check 'statistics: not stopped' stat_is false stopped
check 'the turntable turns' test "$(same_pixels whole/f.0001.exr whole/f.0002.exr >/dev/null; echo $?)" -eq 7
run render "$scene" "${small[@]}" -o out/one.exr
check 'frame 1 is the camera as it stands' same_pixels out/one.exr whole/f.0001.exr
sequence --frames 6 -o out/six.exr
check 'a frame by itself has the same pixels' same_pixels out/six.exr whole/f.0006.exr
clean
sequence --frames 0,9,-7,8 -o out/f.%02d.exr
check 'frames outside the turn: their files' test "$(files out)" = 'f.-07.exr f.00.exr f.08.exr f.09.exr '
check 'frame 9 of 8 is frame 1' same_pixels out/f.09.exr whole/f.0001.exr
check 'frame 0 of 8 is frame 8' same_pixels out/f.00.exr whole/f.0008.exr
check 'frame -7 of 8 is frame 1' same_pixels out/f.-07.exr whole/f.0001.exr
clean
run render "$scene" "${small[@]}" --frames 3-1,2-5x3 -o out/f.#.hdr
check 'each frame once' test "$(files out)" = 'f.1.hdr f.2.hdr f.3.hdr f.5.hdr '
check 'without a motion frames are alike' cmp out/f.1.hdr out/f.5.hdr
clean

# Names with a # or a %d that is none.
run render "$scene" "${small[@]}" --preview -o 'out/ring \#1.exr' --stats out/s.json
check 'an escaped #: one frame' test "$status" -eq 0 -a "$(files out)" = 'ring #1.exr ring #1.png s.json '
check 'an escaped #: the statistics say so' test "$("$json_get" out/s.json output)" = 'out/ring #1.exr'
run render "$scene" "${small[@]}" -o 'out/ring \#1.exr' --skip-existing
check 'an escaped #: skipped' test "$status" -eq 0 -a "$(find out -newer out/s.json -name '*.exr' | wc -l)" -eq 0
clean
sequence --frames 1-2 -o 'out/ring \#1.##.exr'
check 'an escaped # in a sequence' test "$(files out)" = 'ring #1.01.exr ring #1.02.exr '
check 'an escaped # in a sequence: the pixels of the other names' same_pixels 'out/ring #1.02.exr' whole/f.0002.exr
sequence --frames 1-2 -o 'out/ring \#1.##.exr' --skip-existing --stats s.jsonl
tail -n 1 s.jsonl >stats.json
check 'an escaped # in a sequence: skipped' test "$("$json_get" stats.json skipped)" -eq 2
clean
run render "$scene" "${small[@]}" -o 'out/100\%d\\%03d.png' --frames 7
check 'an escaped %d, and a backslash before the number' test "$(files out)" = '100%d\007.png '
clean
cp "$scenes/axes.hdr" 'in/axes #1.hdr'
cp "$scenes/axes.hdr" 'in/axes.hdr'
run render "$scene" "${small[@]}" --env in/axes.hdr -o out/a.hdr
run render "$scene" "${small[@]}" --env 'in/axes #1.hdr' -o out/b.hdr
check 'an environment whose name holds a #: as it is' cmp out/a.hdr out/b.hdr
run render "$scene" "${small[@]}" --env 'in/axes \#1.hdr' -o out/c.hdr
check 'an environment whose name holds a #: escaped' cmp out/a.hdr out/c.hdr
run render "$scene" "${small[@]}" -o in/plate.png
cp in/plate.png 'in/plate #1.png'
run render "$scene" "${small[@]}" --background in/plate.png -o out/a.hdr
run render "$scene" "${small[@]}" --background 'in/plate #1.png' -o out/b.hdr
check 'a plate whose name holds a #: as it is' cmp out/a.hdr out/b.hdr
run render "$scene" "${small[@]}" --background 'in/plate \#1.png' -o out/c.hdr
check 'a plate whose name holds a #: escaped' cmp out/a.hdr out/c.hdr
clean

sequence --frames 1-2 -o out/new/f.####.exr --stats out/new/s.jsonl
check 'a folder is made' test "$(files out/new)" = 'f.0001.exr f.0002.exr s.jsonl '
clean
sequence --frames 1-2 -o out/f.####.exr --stats -
check 'statistics on stdout' test "$(wc -l <stdout)" -eq 4 -a ! -e ./-
run render "$scene" "${small[@]}" -o out/f.exr --stats -
check 'statistics of one frame on stdout' test "$("$json_get" stdout rays primary)" = 1536 -a ! -e ./-
clean

# ---- parts --------------------------------------------------------------------------------------

for part in 1 2 3; do
    sequence --shard $part/3 -o out/f.####.exr
    check "part $part of 3: exit status 0" test "$status" -eq 0
    [ $part != 2 ] || check 'parts 1 and 2: their frames' \
        test "$(files out)" = 'f.0001.exr f.0002.exr f.0004.exr f.0005.exr f.0007.exr f.0008.exr '
done
check 'all parts: every frame' test "$(files out)" = "$eight"
for k in 1 2 3 4 5 6 7 8; do
    check "parts: frame $k has the same pixels" same_pixels "out/f.000$k.exr" "whole/f.000$k.exr"
done
clean
run render "$scene" --frames 1-3 --shard 5/8 -o out/f.#.exr
check 'a part without frames: said, exit status 0' \
    test "$status" -eq 0 -a "$(cat stderr)" = 'glint: --shard: none of the 3 frames is in part 5 of 8'
run render "$scene" "${small[@]}" --frames 1-1000000 --shard 77/1000000 -o out/f.#######.hdr
check 'one of a million frames' test "$status" -eq 0 -a "$(files out)" = 'f.0000077.hdr '
clean

# ---- restart ------------------------------------------------------------------------------------

sequence --frames 1 -o out/f.####.exr
sequence --frames 1 --tone agx -o out/f.####.exr --skip-existing
check 'a tone curve that decides no pixel is no reason to render again' \
    test "$(grep -c 'rendered again' stderr)" -eq 0
clean
cp whole/* out/
rm out/f.0002.exr
head -c 3000 whole/f.0003.exr >out/f.0003.exr
printf 'no image' >out/f.0004.exr
sequence -o out/f.0005.exr --frames 5 --env-rotate 90
touch -d 2020-01-01 out/*.exr
sequence -o out/f.####.exr --skip-existing --stats restart.jsonl
check 'a restart: exit status 0' test "$status" -eq 0
check 'a restart: a damaged frame' grep -q '^glint: out/f.0003.exr: rendered again: it is damaged$' stderr
check 'a restart: what is no frame' grep -q '^glint: out/f.0004.exr: rendered again: it does not say' stderr
check 'a restart: a stale frame' grep -q '^glint: out/f.0005.exr: rendered again: made from another' stderr
check 'a restart: the damaged one comes last' test "$(grep '"outcome": "rendered"' restart.jsonl |
    sed -n '$s/.*"frame": \([0-9]*\),.*/\1/p')" = 3
check 'a restart: nothing else is said' test "$(wc -l <stderr)" -eq 3
tail -n 1 restart.jsonl >stats.json
check 'a restart: four rendered' test "$("$json_get" stats.json rendered)" -eq 4
check 'a restart: four skipped' test "$("$json_get" stats.json skipped)" -eq 4
check 'a restart: what was whole was not touched' \
    test "$(find out -name '*.exr' ! -newermt 2021-01-01 | wc -l)" -eq 4
for k in 2 3 4 5; do
    check "a restart: frame $k has the same pixels" same_pixels "out/f.000$k.exr" "whole/f.000$k.exr"
done
touch -d 2020-01-01 out/*.exr
sequence -o out/f.####.exr --skip-existing --size 32x32
check 'other settings: all again' test "$(find out -name '*.exr' -newermt 2021-01-01 | wc -l)" -eq 8
sed 's/0\.972,/0.5,/' in/scene.gltf >in/other.gltf
sequence --frames 1 -o out/f.####.exr
run render in/other.gltf --turntable 8 --frames 1 "${small[@]}" -o out/f.####.exr --skip-existing
check 'another material: again' grep -q 'made from another scene' stderr
clean
for extension in png tif jpg; do
    sequence --frames 1-2 -o "out/f.#.$extension"
    sequence --frames 1-2 -o "out/f.#.$extension" --skip-existing --stats out/s.jsonl
    tail -n 1 out/s.jsonl >stats.json
    check "$extension: skipped" test "$("$json_get" stats.json skipped)" -eq 2
    clean
done

# ---- previews -----------------------------------------------------------------------------------

refuses 2 'is no EXR' render "$scene" --preview -o out/f.png
sequence --frames 2 -o in/f.####.png
refuses 2 'this is an input' render "$scene" --env in/f.0002.png --preview --frames 1-3 -o in/f.####.exr
sequence --frames 1-2 --preview --exposure 1 -o out/f.####.exr
check 'previews: beside the frames' \
    test "$(files out)" = 'f.0001.exr f.0001.png f.0002.exr f.0002.png '
check 'previews: exposure is theirs' test "$status" -eq 0 -a ! -s stderr
mv out/f.0002.png preview.png
sequence --frames 2 --exposure 1 -o out/f.####.png
check 'previews: what a PNG of the frame is' same_pixels out/f.0002.png preview.png
rm out/f.0002.png
sequence --frames 1-2 --preview --exposure 1 -o out/f.####.exr --skip-existing
check 'previews: a missing one is made again' \
    test "$(grep -c 'rendered again: its preview is missing' stderr)" -eq 1 -a -s out/f.0002.png
sequence --frames 1-2 --preview --exposure 1 --tone agx -o out/f.####.exr --skip-existing
check 'previews: another tone curve: again' test "$(grep -c 'made from another' stderr)" -eq 2
rm out/*.png
mkdir out/f.0001.png
sequence --frames 1-2 --preview -o out/f.####.exr
check 'previews: a name that is taken is one bad frame' test "$status" -eq 6 -a -s out/f.0002.png
clean

# A run killed at any moment must leave only whole frames, and the next run must complete them.
large=(--turntable 8 --size 400x300 -o)
mkdir undisturbed
run render "$scene" "${large[@]}" undisturbed/f.####.exr --progress none
caught=0 # in the middle
for ((k = 0; k < kills; k++)); do
    "$glint" render "$scene" "${large[@]}" out/f.####.exr --skip-existing --progress plain \
        >stdout 2>stderr &
    process=$!
    until grep -q rendering stderr || ! kill -0 "$process" 2>/dev/null; do
        sleep 0.02
    done
    sleep "$(awk -v seed="$RANDOM" 'BEGIN { srand(seed); printf "%.3f", 0.2 * rand() }')"
    kill -9 "$process" 2>/dev/null
    wait "$process" 2>/dev/null
    find out -name 'f.*.exr' | sort >standing
    while read -r file; do
        check "killed: $file is whole" same_pixels "$file" "undisturbed/${file#out/}"
    done <standing
    standing=$(wc -l <standing)
    [ "$standing" -eq 0 ] || [ "$standing" -eq 8 ] || caught=$((caught + 1))
    find out -name 'f.*.exr' -exec touch -d 2020-01-01 {} +
    run render "$scene" "${large[@]}" out/f.####.exr --skip-existing --progress none
    check 'restarted: every frame, no temporaries' test "$(files out)" = "$eight"
    check 'restarted: none was rendered twice' \
        test "$(find out -name '*.exr' ! -newermt 2021-01-01 | wc -l)" -eq "$standing"
    for file in out/f.*.exr; do
        check "restarted: $file" same_pixels "$file" "undisturbed/${file#out/}"
    done
    clean
done
echo "# $caught of $kills were killed with some frames written and some not"

# ---- motion -------------------------------------------------------------------------------------

cp "$scenes/clockwork.gltf" "$scenes/clockwork.bin" in/
moving=(in/clockwork.gltf "${small[@]}")
run render "${moving[@]}" --fps 4 -o out/m.##.hdr --stats moving.jsonl
check 'an animation: as long as it is' \
    test "$(files out)" = 'm.01.hdr m.02.hdr m.03.hdr m.04.hdr m.05.hdr m.06.hdr m.07.hdr m.08.hdr m.09.hdr '
check 'an animation: trees of all frames, one or another built' \
    test "$(grep -c '"tree": "built"' moving.jsonl)" -ge 1 -a "$(trees moving.jsonl | tr -cd '0-9 ' |
        awk '{ print $1 + $2 + $3 }')" -eq 9
tail -n 1 moving.jsonl >stats.json
check 'an animation: what building took' \
    awk -v ms="$("$json_get" stats.json milliseconds build)" 'BEGIN { exit !(ms > 0) }'
mkdir moved
mv out/* moved/
run render "${moving[@]}" -o out/one.hdr
check 'without frames: its beginning' cmp out/one.hdr moved/m.01.hdr
run render "${moving[@]}" --fps 4 --frames 6,2 --shard 1/2 -o out/m.##.hdr
check 'a frame of an animation by itself' cmp out/m.06.hdr moved/m.06.hdr
run render "${moving[@]}" --fps 8 --frames 3 -o out/m.##.hdr
check 'twice the rate: half the time' cmp out/m.03.hdr moved/m.02.hdr
run render "${moving[@]}" --fps 4 --frames 0,9-11 -o out/m.##.hdr
check 'before its beginning it stands' cmp out/m.00.hdr moved/m.01.hdr
check 'after its end it stands' cmp out/m.11.hdr moved/m.09.hdr
check 'after its end: a warning' grep -q 'warning: in/clockwork.gltf: the animation ends at frame 9 (2 s)' stderr
clean
run render "${moving[@]}" --animation none -o out/rest.hdr
check 'at rest: as its nodes say' test "$status" -eq 0 -a -s out/rest.hdr
clean
refuses 2 'nothing moves in the scene' render "${moving[@]}" --animation none -o out/m.##.hdr
refuses 3 'there is no animation "walk" (there is 0 "clockwork")' render "${moving[@]}" \
    --animation walk -o out/m.hdr
refuses 2 '--fps' render "${moving[@]}" --fps 0 -o out/m.##.hdr
run render "${moving[@]}" --camera still --fps 4 --frames 1-9x4 -o out/m.##.hdr
check 'a camera that stands still' test "$status" -eq 0
check 'a camera that stands still: the scene moves' test "$(cmp -s out/m.01.hdr out/m.05.hdr; echo $?)" -eq 1
clean
run render "${moving[@]}" --fps 4 -o out/m.##.exr
touch -d 2020-01-01 out/*.exr
rm out/m.04.exr
run render "${moving[@]}" --fps 4 -o out/m.##.exr --skip-existing
check 'a moving scene is completed' test "$(find out -name '*.exr' -newermt 2021-01-01)" = out/m.04.exr
run render "${moving[@]}" --fps 5 --frames 1-2 -o out/m.##.exr --skip-existing
check 'another rate: frame 1 is the same, frame 2 is not' \
    test "$(find out -name '*.exr' -newermt 2021-01-01 | sort | tr '\n' ' ')" = 'out/m.02.exr out/m.04.exr '
clean
clean

# A triangle before a camera. At frame 3 of 24 a second, a STEP moves one of them, or shrinks it to
# nothing. The float of the key is slightly later than the frame.
stepping() { # NODE PATH BYTES: of the second key, the first being 0 0 0 or 1 1 1
    local data
    data=$({
        printf '\0\0\200\277\0\0\200\277\0\0\0\0\0\0\200\077\0\0\200\277\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0'
        printf '\0\0\0\0\253\252\252\075%b' "$3"
    } | base64 -w 0)
    cat <<JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 3]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "animations": [{"channels": [{"sampler": 0, "target": {"node": $1, "path": "$2"}}],
   "samplers": [{"input": 1, "output": 2, "interpolation": "STEP"}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR"},
               {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                 {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
 "buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,$data"}]}
JSON
}
nothing='\0\0\0\0\0\0\0\0\0\0\0\0' one='\0\0\0200\0077\0\0\0200\0077\0\0\0200\0077'
stepping 0 translation "$nothing$one" >in/step.gltf
run render in/step.gltf "${small[@]}" -o out/s.#.hdr
check 'a clip of two frames and one' test "$(files out)" = 's.1.hdr s.2.hdr s.3.hdr '
check 'a step is not early' cmp out/s.1.hdr out/s.2.hdr
check 'a step is not late' test "$(cmp -s out/s.2.hdr out/s.3.hdr; echo $?)" -eq 1
clean
# From near enough the triangle fills the picture.
sed 's/"yfov": 0.8/"yfov": 0.1/' in/step.gltf >in/near.gltf
run render in/near.gltf --size 8x8 --progress none --depth 1 --aov surfaces --animation none \
    --roughness smooth -o out/near.exr
check 'a share of 100%' grep -q 'warning: 100% of the light took the environment' stderr
clean
# At frame 3, which comes first, the camera has no direction.
stepping 1 scale "$one$nothing" >in/lost.gltf
run render in/lost.gltf "${small[@]}" --frames 3,1-2 -o out/s.#.hdr
check 'one frame that cannot be seen: exit status 6' test "$status" -eq 6
check 'one frame that cannot be seen: why' grep -q '^glint: frame 3: .* camera 0 has no direction' stderr
check 'one frame that cannot be seen: the others are there' test "$(files out)" = 's.1.hdr s.2.hdr '
clean
# At the beginning, which need not be requested, the camera has no direction.
stepping 1 scale "$nothing$one" >in/late.gltf
run render in/late.gltf "${small[@]}" --frames 3 -o out/s.#.exr
check 'a camera that is there later: exit status 0' test "$status" -eq 0
run render in/late.gltf "${small[@]}" --frames 1-3 -o out/s.#.exr
check 'and before: exit status 6' test "$status" -eq 6
check 'the frame that it sees' test "$(files out)" = 's.3.exr '
run render in/late.gltf "${small[@]}" -o out/s.exr
check 'one frame alone, at the beginning: exit status 3' test "$status" -eq 3
check 'why' grep -q 'camera 0 has no direction at this time' stderr
run info in/late.gltf
check 'info tells of the beginning, and refuses it' test "$status" -eq 3
run capture in/late.gltf out/around.exr --at 0,0,1 --size 16
check 'what nothing is seen through may be so' test "$status" -eq 0
clean

# ---- signals ------------------------------------------------------------------------------------

for pair in INT:130 TERM:143; do
    "$glint" render "$scene" --turntable 100000 --size 480x320 --progress plain -o out/f.######.exr \
        --stats sequence.jsonl >stdout 2>stderr &
    process=$!
    for _ in $(seq 300); do
        [ ! -e out/f.000003.exr ] || break
        sleep 0.1
    done
    # SIGINT is 2 and SIGTERM is 15: bits of 4002.
    check 'one thread alone takes signals' test "$(sed -n 's/^SigBlk:.*\(....\)$/0x\1/p' \
        /proc/"$process"/task/*/status | while read -r mask; do echo $((mask & 0x4002)); done |
        grep -vcx $((0x4002)))" -eq 1
    kill "-${pair%:*}" "$process"
    wait "$process"
    check "SIG${pair%:*}: exit status ${pair#*:}" test $? -eq "${pair#*:}"
    check "SIG${pair%:*}: no temporaries" test -z "$(find out -name '.*.tmp.*')"
    for file in out/*.exr; do
        check "SIG${pair%:*}: $file is whole" "$glint" compare "$file" "$file"
    done
    tail -n 1 sequence.jsonl >stats.json
    check "SIG${pair%:*}: the total says so" test "$("$json_get" stats.json stopped)" = true
    clean
done

# ---- write errors -------------------------------------------------------------------------------

mkdir out/f.0003.exr out/f.0005.exr
sequence -o out/f.####.exr --stats failed.jsonl
check 'frames whose names are taken: exit status 6' test "$status" -eq 6
check 'frames whose names are taken: each is named' test "$(grep -c 'is a folder' stderr)" -eq 2
check 'frames whose names are taken: listed' grep -q '2 of 8 frames failed: 3,5 ' stderr
check 'frames whose names are taken: the others are there' test "$(files out)" = "$eight"
check 'frames whose names are taken: statistics' test "$(grep -c '"outcome": "failed"' failed.jsonl)" -eq 2
clean
(
    ulimit -f 6000 # KiB: more than compiled kernels take
    exec "$glint" render "$scene" --turntable 8 --size 1024x512 --exr-type float --compression none \
        --progress none -o out/f.####.exr
) >stdout 2>stderr
check 'files that grow past a limit: exit status 5' test $? -eq 5
check 'files that grow past a limit: one line' test "$(wc -l <stderr)" -eq 1
check 'files that grow past a limit: nothing half-written' test -z "$(ls -A out)"
mkdir disk
if [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o size=64k tmpfs disk 2>/dev/null; then
    run render "$scene" --turntable 80 --size 96x64 --exr-type float --compression none \
        --progress none -o disk/f.####.exr
    check 'a disk that fills up: exit status 5' test "$status" -eq 5
    check 'a disk that fills up: said once' test "$(wc -l <stderr)" -eq 1
    check 'a disk that fills up: no temporaries' test -z "$(find disk -name '.*.tmp.*')"
    for file in disk/*.exr; do
        [ -e "$file" ] || continue
        check "a disk that fills up: $file is whole" "$glint" compare "$file" "$file"
    done
    umount disk
else
    skip 'a disk that fills up' 'no small file system can be mounted'
fi
mkdir sealed
chmod 555 sealed
chmod 755 "$work"
if [ "$(id -u)" -ne 0 ]; then
    refuses 5 'its folder is not writable' render "$scene" --frames 1-3 -o sealed/f.#.exr
elif command -v setpriv >/dev/null && setpriv --reuid 65534 --clear-groups test -x "$glint"; then
    setpriv --reuid 65534 --clear-groups "$glint" render "$scene" --frames 1-3 -o sealed/f.#.exr \
        >stdout 2>stderr
    check 'a folder without permission: exit status 5' test $? -eq 5
    check 'a folder without permission: one line, why' \
        test "$(wc -l <stderr)" -eq 1 -a "$(grep -c 'its folder is not writable' stderr)" -eq 1
else
    skip 'a folder without permission' 'nobody here to try it as'
fi
mkdir out/gone
"$glint" render "$scene" --turntable 100000 --size 480x320 --progress none -o out/gone/f.######.exr \
    >stdout 2>stderr &
process=$!
for _ in $(seq 300); do
    [ ! -e out/gone/f.000003.exr ] || break
    sleep 0.1
done
mv out/gone vanished
wait "$process"
check 'a folder that vanishes: exit status 5' test $? -eq 5
check 'a folder that vanishes: said once' test "$(wc -l <stderr)" -eq 1
check 'a folder that vanishes: no temporaries' test -z "$(find vanished -name '.*.tmp.*')"
clean

# ---- two at once --------------------------------------------------------------------------------

for k in 1 2; do
    "$glint" render "$scene" --turntable 8 "${small[@]}" -o out/f.####.exr --skip-existing \
        >stdout.$k 2>stderr.$k &
    pids[k]=$!
done
for k in 1 2; do
    wait "${pids[k]}"
    check "two at once: number $k ends well" test $? -eq 0
done
check 'two at once: every frame, no temporaries' test "$(files out)" = "$eight"
for k in 1 2 3 4 5 6 7 8; do
    check "two at once: frame $k" same_pixels "out/f.000$k.exr" "whole/f.000$k.exr"
done
clean

# ---- display ------------------------------------------------------------------------------------

run render "$scene" --turntable 3 --size 48x32 -o out/f.#.exr --progress plain
check 'plain: a line a frame' test "$(grep -c '^glint: frame [123] rendered, traced in .* ms, written in .* ms: out/f.[123].exr (. of 3, .*left)$' stderr)" -eq 3
check 'plain: a summary' grep -q '3 frames: 3 rendered, 0 skipped, 0 failed' stderr
sequence --frames 1-4 -o out/f.#.exr
run render "$scene" --turntable 8 --size 48x32 -o out/f.#.exr --skip-existing --frames 5,1-4 \
    --progress json
check 'files that are there are no time left' grep -q '"frame": 5, .*"seconds_left": 0.0}' stderr
run render "$scene" --size 48x32 -o out/f.exr
check 'the summary: irradiance, and primary rays as in the bar' \
    grep -q ', irradiance [0-9]*, .* primary Mrays/s' stderr
clean
run render "$scene" --turntable 3 --size 48x32 -o out/f.#.exr --progress json --progress-fd 3 3>events
check 'json on a descriptor: nothing on stderr' test ! -s stderr -a "$(grep -c '"event": "frame"' events)" -eq 3
run render "$scene" --turntable 3 --size 48x32 -o out/f.#.exr --progress json
check 'json: an object a line' test "$(grep -vc '^{"event": ".*}$' stderr)" -eq 0
check 'json: a frame' grep -q '"event": "frame", "frame": 2, "file": "out/f.2.exr", "outcome": "rendered"' stderr
check 'json: done' grep -q '"event": "done", .*"rendered": 3, "skipped": 0, "failed": 0' stderr
clean

# ---- contact sheets -----------------------------------------------------------------------------

check 'contact --help tells every option' help_mentions contact output columns width exposure tone allow-large-images help
refuses 2 'no output' contact whole/f.0001.exr
refuses 2 'no images' contact -o out/sheet.png
refuses 2 'one of the images' contact whole/*.exr -o whole/f.0002.exr
refuses 2 '--columns' contact whole/*.exr --columns 0 -o out/sheet.png
refuses 2 'more than 32768 on a side' contact whole/*.exr --columns 8 --width 4096 -o out/sheet.png
refuses 5 'out/none' contact whole/*.exr -o out/none/sheet.png
run contact whole/*.exr -o out/sheet.png
check 'a contact sheet' test "$status" -eq 0 -a -s out/sheet.png -a ! -s stdout -a ! -s stderr
run contact whole/*.exr -o out/toned.png --tone agx
check 'a contact sheet with a tone curve' apart 0.01 out/toned.png out/sheet.png
run contact whole/*.exr -o out/sheet.exr --tone agx
check 'a contact sheet: a tone curve that is left out is said' grep -q 'warning: .*--tone' stderr
# A number in a name that is no frame's: the label is the name.
cp whole/f.0001.exr in/8.exr
cp whole/f.0001.exr in/ball_8k.exr
run contact in/8.exr -o out/number.png
run contact in/ball_8k.exr -o out/name.png
check 'a contact sheet: ball_8k is not frame 8' apart 0 out/name.png out/number.png
run contact whole/f.0001.exr in/scene.bin whole/f.0002.exr -o out/part.png
check 'a contact sheet: one is missing: exit status 6' test "$status" -eq 6 -a -s out/part.png
check 'a contact sheet: it is named' grep -q 'in/scene.bin: ' stderr
check 'a contact sheet: how many' grep -q 'out/part.png: 1 of 3 images are missing' stderr
clean
run contact in/scene.bin in/scene.gltf -o out/none.png
check 'a contact sheet of nothing: exit status 3' test "$status" -eq 3 -a -z "$(ls -A out)"

finish
