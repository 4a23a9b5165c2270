#!/usr/bin/env bash
# Tests cameras from the command line: --eye with its companions, --fit, --elevation. Prints TAP.
#
#   camera_checks.sh GLINT JSON_GET SCENES

scenes=$(readlink -f -- "$3")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# A triangle that spans x and y from -1 to 1 at z = 0, with a perspective and an orthographic
# camera; the same without cameras; the same with a node that moves from x = 0 to 4 in a second.
buffer=$(printf '\0\0\200\277\0\0\200\277\0\0\0\0\0\0\200\077\0\0\200\277\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\100\0\0\0\0\0\0\0\0' |
    base64 -w 0)
write_scene() { # NODES ANIMATIONS
    cat <<JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": $1}],
 "nodes": [{"mesh": 0, "name": "triangle"},
           {"camera": 0, "name": "front", "translation": [0, 0, 3]},
           {"camera": 1, "name": "flat", "translation": [0, 0, 3]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
             {"type": "orthographic", "orthographic": {"xmag": 1.5, "ymag": 1.5, "zfar": 9, "znear": 0}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "materials": [{"name": "chrome", "pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 0}}],
 $2
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [-1, -1, 0], "max": [1, 1, 0]},
               {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
               {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                 {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
 "buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,$buffer"}]}
JSON
}
write_scene '[0, 1, 2]' '' >in/seen.gltf
write_scene '[0]' '' >in/unseen.gltf
write_scene '[0]' '"animations": [{"samplers": [{"input": 1, "output": 2}],
   "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],' >in/moving.gltf
# Only the camera moves.
write_scene '[0, 1, 2]' '"animations": [{"samplers": [{"input": 1, "output": 2}],
   "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],' >in/panned.gltf

# Checks numbers of the camera in glint info, to 1e-6.
camera_is() { # WANTED KEY[,KEY] ARGUMENT…
    local wanted=$1 keys=${2//,/ } got
    shift 2
    "$glint" info --size 160x90 "$@" --json >info.json || return 1
    # shellcheck disable=SC2086 # a list of keys
    got=$("$json_get" info.json camera $keys) || return 1
    awk -v got="$got" -v wanted="$wanted" \
        'BEGIN { off = got - wanted; exit !(off < 1e-6 && off > -1e-6) }' || { echo "$keys is $got"; return 1; }
}

# Checks the eye's distance relative to --fit, along z.
eye_is_further() { # LEAST MOST ARGUMENT…
    local least=$1 most=$2 own fitted
    shift 2
    "$glint" info "$@" --json >info.json && own=$("$json_get" info.json camera eye 2) || return 1
    "$glint" info "$@" --fit --json >info.json && fitted=$("$json_get" info.json camera eye 2) || return 1
    echo "$own, $fitted with --fit"
    awk -v own="$own" -v fitted="$fitted" -v least="$least" -v most="$most" \
        'BEGIN { exit !(own > least * fitted && own < most * fitted) }'
}

# Prints the bytes of worldToCamera in an EXR's header.
matrix_of() {
    grep -aoP 'worldToCamera\0m44f\0\x40\0\0\0\K[\s\S]{64}' "$1" | od -An -tf4
}

# ---- mistakes -----------------------------------------------------------------------------------

ok=(in/seen.gltf -o out/x.png)
for option in eye look-at up fov elevation; do
    refuses 2 "--$option" render "${ok[@]}" "--$option"
    for value in '' x nan inf 1e999 1,2 1,2,3,4 ',,' '1, 2,3'; do
        refuses 2 "--$option" render "${ok[@]}" "--$option" "$value"
    done
done
refuses 2 '1e9 at most' render "${ok[@]}" --eye 1,1,2e9
refuses 2 'with --eye' render "${ok[@]}" --look-at 0,0,0
refuses 2 'with --eye' render "${ok[@]}" --up 0,1,0
refuses 2 '--camera (leave one out)' render "${ok[@]}" --eye 0,0,5 --camera flat
refuses 2 '--elevation (leave one out)' render "${ok[@]}" --eye 0,0,5 --elevation 5
refuses 2 'not all of them 0' render "${ok[@]}" --eye 0,0,5 --up 0,0,0
refuses 2 'looks along it' render "${ok[@]}" --eye 0,0,5 --up 0,0,-2
refuses 2 'name two places' render "${ok[@]}" --eye 1,2,3 --look-at 1,2,3
refuses 2 'name another with --look-at' render "${ok[@]}" --eye 0,0,0
refuses 2 'has no angle of view' render "${ok[@]}" --camera flat --fov 30
for fov in 0 -1 180 360; do
    refuses 2 '--fov' render "${ok[@]}" --fov $fov
done
for elevation in 90.1 -91 1e9; do
    refuses 2 'from -90 to 90' render "${ok[@]}" --elevation $elevation
done
refuses 2 '--eye' info in/seen.gltf --eye 0,0,0
refuses 2 'did you mean --eye?' render "${ok[@]}" --eyes 0,0,5

# ---- a camera of one's own ----------------------------------------------------------------------

check '--eye: the place' camera_is 5 eye,2 in/seen.gltf --eye 0,0,5
check '--eye looks at the middle' camera_is 0.6 back,0 in/seen.gltf --eye 3,0,4
check '--eye: 40 degrees' camera_is 40 yfov_degrees in/seen.gltf --eye 3,0,4
check '--look-at' camera_is 1 back,0 in/seen.gltf --eye 3,0,4 --look-at 2,0,4
check '--up' camera_is 1 up,0 in/seen.gltf --eye 0,0,5 --up 7,0,-3
check '--fov' camera_is 12.5 yfov_degrees in/seen.gltf --eye 0,0,5 --fov 12.5
check '--fov of the file'"'"'s camera' camera_is 25 yfov_degrees in/seen.gltf --fov 25
check '--fov keeps its place' camera_is 3 eye,2 in/seen.gltf --fov 25
check 'straight down: the far side is up' camera_is -1 up,2 in/seen.gltf --eye 0,5,0
check 'straight up: the near side is up' camera_is 1 up,2 in/seen.gltf --eye 0,-5,0
# The file's camera in words must give the same picture.
run render in/seen.gltf --size 16x16 -o in/file.exr
run render in/seen.gltf --size 16x16 -o in/own.exr --eye 0,0,3 --look-at 0,0,0 --fov 45.8366236104659
check 'as the same camera of a file' within 1e-5 in/own.exr in/file.exr
run render in/seen.gltf --frames 1 --size 16x16 -o out/own.#.exr --eye 0,0,3
run render in/seen.gltf --frames 1 --size 16x16 -o out/own.#.exr --eye 0,0,3.5 --skip-existing
check 'another eye is another frame' grep -q 'rendered again: made from another' stderr
run render in/seen.gltf --frames 1 --size 16x16 -o out/own.#.exr --eye 0,0,3.5 --skip-existing \
    --stats out/stats.json --progress none
check 'and the same is not' test ! -s stderr
clean
run render "${ok[@]}" --size 16x16 --eye 0,0,4 --fov 30 --stats out/stats.json
check '--stats: the eye' stat_is 4.0 camera eye 2
check '--stats: the angle' stat_is 30.0 camera yfov_degrees
clean
run bench in/seen.gltf --size 16x16 --rounds 1 --no-check --eye 0,0,4 --fit --json bench.json
check 'bench takes them' test "$status" -eq 0

# ---- fit ----------------------------------------------------------------------------------------

# Half of the height, over the tangent of half the angle.
check '--fit: the triangle fills the height' camera_is 2.3652224 eye,2 in/seen.gltf --fit
check '--fit: a tall frame is filled in its width' camera_is 4.2048398 eye,2 in/seen.gltf --fit --size 90x160
check '--fit centres' camera_is 0 eye,1 in/seen.gltf --eye 0,3,3 --look-at 0,3,0 --fit
check '--fit turns nothing' camera_is 1 back,2 in/seen.gltf --eye 0,3,3 --look-at 0,3,0 --fit
check '--fit: an orthographic camera' camera_is 1 ymag in/seen.gltf --camera flat --fit
check '--fit: its width' camera_is 1.7777778 ymag in/seen.gltf --camera flat --fit --size 90x160
check '--fit with --fov' camera_is 1 eye,2 in/seen.gltf --fov 90 --fit
check '--fit: what moves fits all the time' camera_is 2 eye,0 in/moving.gltf --eye 0,0,9 --look-at 0,0,0 --fit
check '--fit: and its width' camera_is 1.6875 eye,2 in/moving.gltf --eye 0,0,9 --look-at 0,0,0 --fov 90 --fit
"$glint" info in/seen.gltf --size 160x90 --eye 3,3,3 --look-at 0,0,0 --fit --json >info.json
check '--fit: by its shape where only the camera moves' camera_is "$("$json_get" info.json camera eye 2)" eye,2 \
    in/panned.gltf --eye 3,3,3 --look-at 0,0,0 --fit
# In front of the triangle, from the direction (0.4, 0.3, 1); slightly farther than with --fit.
check 'a file without cameras: its direction' camera_is 0.8944272 back,2 in/unseen.gltf
check 'a file without cameras: fitted, with a margin' eye_is_further 1.02 1.08 in/unseen.gltf --size 160x90
check 'a file without cameras: in a tall frame, too' eye_is_further 1.02 1.08 in/unseen.gltf --size 90x160
check 'a file without cameras: --fov' eye_is_further 1.02 1.08 in/unseen.gltf --fov 10
check 'a file without cameras: --elevation' eye_is_further 1.02 1.08 in/unseen.gltf --elevation 60
run info in/seen.gltf --fit
check 'info says it' grep -q 'used, fitted: perspective' stdout
run render in/moving.gltf --size 32x18 -o out/m.#.exr --frames 1,25 --fps 24 --eye 0,0,9 --look-at 0,0,0 --fit \
    --stats out/stats.jsonl
check 'a moving scene: rendered' test "$status" -eq 0 -a -s out/m.1.exr -a -s out/m.25.exr
check 'a moving scene: the camera stands still' test "$(matrix_of out/m.1.exr)" = "$(matrix_of out/m.25.exr)"
check 'a moving scene: the triangle does not' apart 0.1 out/m.1.exr out/m.25.exr
clean
run render "$scenes/mirror_sphere.gltf" --size 64x36 --fit --background transparent -o in/still.exr
run render "$scenes/mirror_sphere.gltf" --size 64x36 --fit --background transparent --turntable 4 --frames 1 -o out/t.#.exr
check 'a turntable of a sphere is fitted like the sphere' within 0.1 out/t.1.exr in/still.exr
clean

# ---- elevation ----------------------------------------------------------------------------------

check '--elevation 90: above' camera_is 3 eye,1 in/seen.gltf --elevation 90
check '--elevation 90: looks down' camera_is 1 back,1 in/seen.gltf --elevation 90
check '--elevation 30: height' camera_is 1.5 eye,1 in/seen.gltf --elevation 30
check '--elevation -30: below' camera_is -1.5 eye,1 in/seen.gltf --elevation -30
check '--elevation: the same distance' camera_is 2.5980762 eye,2 in/seen.gltf --elevation 30
check '--elevation of an orthographic camera' camera_is 0.5 back,1 in/seen.gltf --camera flat --elevation 30
run render in/seen.gltf --turntable 4 --elevation 30 --size 16x9 --frames 2 -o out/t.#.exr --stats out/stats.jsonl
check 'a turntable with an elevation' test "$status" -eq 0 -a -s out/t.2.exr
clean

# ---- all cameras --------------------------------------------------------------------------------

refuses 3 'the scene has no camera' render in/unseen.gltf --camera all -o out/x.png
refuses 2 'no output' render in/seen.gltf --camera all
refuses 2 'camera 1 is orthographic' render in/seen.gltf --camera all --fov 30 -o out/x.png
refuses 2 '--camera (leave one out)' render in/seen.gltf --camera all --eye 0,0,5 -o out/x.png
refuses 2 'frames need a place' render in/seen.gltf --camera all --frames 1-3 -o out/x.png
refuses 3 'no camera "all"' info in/seen.gltf --camera all
refuses 5 'out/none' render in/seen.gltf --camera all -o out/none/x.png
small=(--size 16x9 --progress none)
run render in/seen.gltf --camera all "${small[@]}" -o out/x.exr --preview --stats out/s.json
check '--camera all: exit status 0' test "$status" -eq 0 -a ! -s stderr
check '--camera all: a file for each' test "$(echo out/*)" = \
    'out/s.flat.json out/s.front.json out/x.flat.exr out/x.flat.png out/x.front.exr out/x.front.png'
mv out/s.flat.json out/stats.json
check '--camera all: --stats of each' stat_is orthographic camera type
for camera in front flat; do
    run render in/seen.gltf --camera $camera "${small[@]}" -o in/one.exr
    check "--camera all: as --camera $camera" same_pixels in/one.exr out/x.$camera.exr
done
clean
run render in/seen.gltf --camera all "${small[@]}" -o out/x.##.exr --frames 1-2
check '--camera all: frames of each' test "$(echo out/*)" = \
    'out/x.flat.01.exr out/x.flat.02.exr out/x.front.01.exr out/x.front.02.exr'
rm out/x.flat.01.exr
run render in/seen.gltf --camera all --size 16x9 -o out/x.##.exr --frames 1-2 --skip-existing --stats -
check '--camera all: --skip-existing' test "$(grep -c '"outcome": "rendered"' stdout)" -eq 1
check '--camera all: a log of each on stdout' test "$(grep -c '"event": "total"' stdout)" -eq 2
clean
run render in/seen.gltf --camera all "${small[@]}" -o out/x.#.exr --turntable 4 --shard 1/2 --fit
check '--camera all: a part of a turntable of each' test "$(echo out/*)" = \
    'out/x.flat.1.exr out/x.flat.3.exr out/x.front.1.exr out/x.front.3.exr'
clean
run render in/seen.gltf --camera all "${small[@]}" -o 'out/x \#1.##.exr' --frames 7
check '--camera all: an escaped # beside the place of the number' test "$(echo out/*)" = \
    'out/x #1.flat.07.exr out/x #1.front.07.exr'
clean
sed 's#"name": "flat"#"name": "../fl at"#; s#"name": "front", ##' in/seen.gltf >in/names.gltf
run render in/names.gltf --camera all "${small[@]}" -o out/x.png
check '--camera all: names that files can have' test -s out/x.0.png -a -s out/x..._fl_at.png
clean
sed 's#"name": "flat", #"name": "flat", "scale": [0, 0, 0], #' in/seen.gltf >in/lost.gltf
run render in/lost.gltf --camera all "${small[@]}" -o out/x.png
check '--camera all: one without a direction is left out' test "$status" -eq 0 -a "$(echo out/*)" = out/x.front.png
check '--camera all: which' grep -q 'nodes\[2\] "flat": the camera has no direction' stderr
clean
write_scene '[0, 2, 1]' '"animations": [{"samplers": [{"input": 1, "output": 2}],
   "channels": [{"sampler": 0, "target": {"node": 2, "path": "scale"}}]}],' >in/never.gltf
run render in/never.gltf --camera all "${small[@]}" -o out/x.png
check '--camera all: one that never has a direction: exit status 6' test "$status" -eq 6
check '--camera all: which' grep -q 'camera 0 has no direction' stderr
check '--camera all: how many' grep -q 'in/never.gltf: 1 of 2 cameras failed' stderr
check '--camera all: the others are there' test "$(echo out/*)" = out/x.front.png
clean
run render in/seen.gltf --camera all "${small[@]}" -o in/seen.png
cp in/seen.gltf in/x.front.png
refuses 2 'this is an input' render in/x.front.png --camera all -o in/x.png
check '--camera all: nothing is rendered before that' test ! -e in/x.flat.png

# ---- other commands -----------------------------------------------------------------------------

refuses 2 'unknown option --eye' capture in/seen.gltf out/c.exr --at 0,0,1 --eye 0,0,1
refuses 2 'a job has the frames of one camera' farm slurm -- in/seen.gltf -o out/f.####.exr --turntable 4 --camera all
run farm slurm --parts 2 --dry-run -- in/seen.gltf -o out/f.####.exr --turntable 4 --eye 0,0,5 --fit --elevation
check 'farm looks at them' test "$status" -eq 2
run farm slurm --parts 2 --dry-run -- in/seen.gltf -o out/f.####.exr --turntable 4 --eye 0,0,5 --fit
check 'farm passes them on' grep -q -- '--eye 0,0,5 --fit' stdout
clean

finish
