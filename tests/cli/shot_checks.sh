#!/usr/bin/env bash
# Tests the command line of glint capture, and the other steps of shots: parts of scenes, plates,
# the file's lights, an environment for each frame.
# shot_checks.sh GLINT JSON_GET MAKE_EXR SCENES
make_exr=$(readlink -f -- "$3")
scenes=$(readlink -f -- "$4")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

cp "$scenes"/mirror_sphere.* "$scenes"/clockwork.* in/
"$glint" env --studio in/studio.exr --to latlong --size 128 2>/dev/null
"$glint" env --probe in/axes.exr --to latlong --size 256 2>/dev/null

# ---- capture ------------------------------------------------------------------------------------

# shellcheck disable=SC2046 # lists of words
check 'capture --help tells every option' help_mentions capture allow-large-images at around to size exposure \
    compression frames fps progress env env-layout ball-circle ball-distance ball-fov env-flip \
    animation variant material texture-size only without scene $(settings_of environment frame device) device kernel-dir help
run --help
check 'glint --help lists it' grep -q '^  capture ' stdout
cp "$scenes"/lecture_example_2.* in/
spheres=in/lecture_example_2.gltf
refuses 2 'from where?' capture "$spheres" out/a.exr
refuses 2 'give one' capture "$spheres" out/a.exr --at 0,0,0 --around mirror
for at in 1,2 1,2,3,4 nan,0,0 x; do
    refuses 2 'x,y,z in metres (1e9 at most) is expected' capture "$spheres" out/a.exr --at "$at"
done
refuses 2 'an environment has no holes' capture "$spheres" out/a.exr --at 0,0,0 --background transparent
refuses 3 'no node "jewel" has triangles (there is 1 "mirror", 2 "red", 3 "green", 4 "blue", 5 "yellow")' \
    capture "$spheres" out/a.exr --around jewel
refuses 2 'a capture shows what surfaces see' capture "$spheres" out/a.exr --at 0,0,0 --shading vertex-color
refuses 3 'no node "none" has triangles' capture "$spheres" out/a.exr --at 0,0,0 --without red,none
refuses 3 'no node "9" has triangles' capture "$spheres" out/a.exr --around 9
refuses 3 'no node "" has triangles' capture "$spheres" out/a.exr --at 0,0,0 --without red,
refuses 2 '--size 1: 2 to' capture "$spheres" out/a.exr --at 0,0,0 --size 1
refuses 2 '--size 5000: 1 to 4096' capture "$spheres" out/a.exr --at 0,0,0 --size 5000 --to cube
refuses 5 'out/none' capture "$spheres" out/none/a.exr --around mirror
# Without its only object a scene is just its environment.
run capture in/mirror_sphere.gltf out/all.exr --around 'mirror sphere' --env in/axes.exr --size 256 \
    --samples 4
check 'the environment around the only object' within 0.1 out/all.exr in/axes.exr
check 'said: how large, and from where' \
    grep -q 'out/all.exr: latlong 512x256, six views from (0, 0, 0), ' stderr
run capture in/mirror_sphere.gltf out/index.exr --around 1 --env in/axes.exr --size 256 --samples 4
check 'the node by its index' same_pixels out/index.exr out/all.exr
# A mirror rendered under its captured surroundings: distant objects must be in their places.
small=(--size 96x96 --samples 4)
run capture "$spheres" out/around.exr --around mirror --samples 4
run render in/mirror_sphere.gltf "${small[@]}" --env out/around.exr -o out/mapped.exr
run capture "$spheres" out/bare.exr --around mirror --without red,green,4,yellow --samples 4
run render in/mirror_sphere.gltf "${small[@]}" --env out/bare.exr -o out/bare_mapped.exr
run render in/mirror_sphere.gltf "${small[@]}" -o out/studio.exr
check 'without anything else it is the studio' within 0.05 out/bare_mapped.exr out/studio.exr
check 'with the others it is not' test "$(within 0.05 out/mapped.exr out/studio.exr >/dev/null; echo $?)" -eq 7
run capture "$spheres" out/faces --around mirror --to faces --size 32
check 'six files' test "$(find out/faces -name '*.exr' | wc -l)" -eq 6
run capture "$spheres" out/cross.png --around mirror --to hcross --size 32
check 'a cross' begins_with out/cross.png 89504e47
clean

# Captures a moving scene at the times of frames. A lone clockwork sees its environment; otherwise
# each part sees the static objects from its place.
refuses 2 'need a place for their number' capture in/clockwork.gltf out/a.exr --at 0,0,0 --frames 1-2
refuses 2 'which frames?' capture in/clockwork.gltf out/a.####.exr --at 0,0,0
refuses 2 'or write \# for the sign itself' capture in/clockwork.gltf 'out/ball #1.exr' --at 0,0,0
run capture in/clockwork.gltf 'out/ball \#1.exr' --at 0,0,0 --to ball --size 8
check 'an escaped # is no place' test "$status" -eq 0 -a -s 'out/ball #1.exr'
run capture in/clockwork.gltf 'out/ball \#1.##.exr' --at 0,0,0 --to ball --size 8 --frames 1-2
check 'an escaped # beside a place' test "$status" -eq 0 -a -s 'out/ball #1.01.exr' -a -s 'out/ball #1.02.exr'
mkdir 'out/faces #1'
run capture in/clockwork.gltf 'out/faces \#1' --at 0,0,0 --size 8
check 'an escaped # in a folder for faces' test "$status" -eq 0 -a -s 'out/faces #1/posx.exr'
clean
refuses 2 "a number from" capture in/clockwork.gltf out/a.####.exr --at 0,0,0 --frames x
moving=$("$glint" info in/clockwork.gltf | sed -n 's/^  \(.*\) (node [0-9]*): .*/\1/p' | head -n 1)
run capture in/clockwork.gltf out/ball.####.exr --around "$moving" --to ball --size 32 --frames 1,13
check 'a ball for each frame' test -s out/ball.0001.exr -a -s out/ball.0013.exr
check 'which show other times' apart 0.01 out/ball.0001.exr out/ball.0013.exr
run capture in/clockwork.gltf out/one.exr --around "$moving" --to ball --size 32 --frames 13
check 'a frame alone is the same' same_pixels out/one.exr out/ball.0013.exr
run capture in/clockwork.gltf out/zero.exr --around "$moving" --to ball --size 32
check 'without frames it is the first' same_pixels out/zero.exr out/ball.0001.exr
mkdir out/bad.0002.exr
run capture in/clockwork.gltf out/bad.####.exr --at 0,0,0 --size 16 --frames 1-3
check 'one that cannot be written fails alone: exit status 6' test "$status" -eq 6
check 'the others are there' test -s out/bad.0001.exr -a -s out/bad.0003.exr
clean
run capture in/mirror_sphere.gltf out/same.#.exr --at 0,2,0 --size 16 --frames 1-2
check 'nothing moves: said' grep -q 'nothing moves: all 2 frames are the same' stderr
clean
cp in/studio.exr in/w.0002.exr
refuses 2 'this is an input' capture in/mirror_sphere.gltf in/w.####.exr --at 0,0,0 --frames 1-2 \
    --env in/w.0002.exr
# An object that is hidden at first appears later: the growing ball.
run capture in/clockwork.gltf out/late.####.exr --around 'growing ball' --size 16 --frames 1,24
check 'hidden at frame 1: that one fails' test "$status" -eq 6 -a -s out/late.0024.exr
check 'why' grep -q 'has no triangles at this time' stderr
clean

# ---- parts of scenes ----------------------------------------------------------------------------

refuses 3 'no node "jewel" has triangles (there is 1 "mirror"' \
    render "$spheres" -o out/a.exr --only jewel
refuses 3 'no node "jewel" has triangles' render "$spheres" -o out/a.exr --without red,jewel
refuses 3 'no node "red" has triangles' render "$spheres" -o out/a.exr --only red --without red
run info "$spheres" --only mirror --json
check 'a part: its triangles' test "$("$json_get" stdout scene triangle_count)" = 720
check 'a part: its material alone' test "$("$json_get" stdout scene material_count)" = 1
run render "$spheres" -o out/all.exr "${small[@]}"
run render "$spheres" -o out/named.exr "${small[@]}" --only mirror,red,3,4,yellow
check 'all parts are the whole' same_pixels out/all.exr out/named.exr
run render "$spheres" -o out/left.exr "${small[@]}" --only 1,red --turntable 7 --frames 3
run render "$spheres" -o out/right.exr "${small[@]}" --without green,blue,yellow --turntable 7 --frames 3
check 'a part by what it is or by what it is not' same_pixels out/left.exr out/right.exr
clean

# A node that is empty at some time can still be left out or kept.
clock=(in/clockwork.gltf --size 48x36)
run render "${clock[@]}" -o out/a.####.exr --frames 1,24
run render "${clock[@]}" -o out/b.####.exr --frames 1,24 --without 'growing ball'
check 'hidden at frame 1: leaving it out changes nothing' same_pixels out/a.0001.exr out/b.0001.exr
check 'seen at frame 24: it does' apart 0 out/a.0024.exr out/b.0024.exr
run render "${clock[@]}" -o out/c.####.exr --frames 1,24 --only 'growing ball' --background transparent
check 'and alone it is nothing, or seen' test "$status" -eq 0
# A name takes precedence over an index, whether visible or not.
sed 's/"growing ball"/"3"/' in/clockwork.gltf >in/numbered.gltf
run render in/numbered.gltf --size 48x36 -o out/d.####.exr --frames 1,24 --without 3
check 'a name that is a number: frame 1' same_pixels out/b.0001.exr out/d.0001.exr
check 'a name that is a number: frame 24' same_pixels out/b.0024.exr out/d.0024.exr
clean
refuses 3 'no node "front" has triangles' render "$spheres" -o out/a.exr --only front

# ---- plates -------------------------------------------------------------------------------------

# Not at depth 1, which is exact here: a transparent background cannot take its short way, which
# rounds otherwise.
shot=(in/mirror_sphere.gltf --size 64x48 --env in/studio.exr --depth 2)
exact=(--exr-type float)
run render "${shot[@]}" "${exact[@]}" -o in/plate.exr --without 1
run render "${shot[@]}" "${exact[@]}" -o out/whole.exr
run render "${shot[@]}" "${exact[@]}" -o out/composited.exr --background in/plate.exr
check 'in front of its own background: the whole, but for rounding' within 1e-7 out/composited.exr out/whole.exr
run render "${shot[@]}" "${exact[@]}" -o out/whole.exr --samples 16
run render "${shot[@]}" "${exact[@]}" -o out/composited.exr --samples 16 --background in/plate.exr
check 'but for what its edges hide of it' within 1e-3 out/composited.exr out/whole.exr
check 'alpha is 1' "$glint" compare out/composited.exr out/whole.exr --fail-above alpha=0
run render "${shot[@]}" -o out/preview.exr --background in/plate.exr --preview --stats out/a.json
check 'the background is told' test "$("$json_get" out/a.json settings background)" = in/plate.exr
run render "${shot[@]}" -o out/direct.png --background in/plate.exr
check 'the preview has the plate, too' same_pixels out/preview.png out/direct.png
# Eight bits and back: decoding undoes the curve.
run render "${shot[@]}" -o in/plate.png --without 1
run render "${shot[@]}" -o out/empty.png --without 1 --background in/plate.png
check 'a PNG comes out as it went in' same_pixels out/empty.png in/plate.png
# As a plate it may have 8 bits. As an environment it lacks highlights.
run render "${shot[@]}" -o out/empty.png --without 1 --background in/plate.png --strict
check 'a plate of 8 bits is no reason for a warning' test "$status" -eq 0
run render "${shot[@]}" -o out/dim.png --env in/plate.png
check 'an environment of 8 bits: said in one line' \
    test "$status" -eq 0 -a "$(grep -c 'warning: in/plate.png: .* no highlights above white' stderr)" -eq 1
run render "${shot[@]}" -o out/strict.png --env in/plate.png --strict
check 'and refused by --strict' test "$status" -eq 3 -a ! -e out/strict.png
# Of an EXR's parts, the colour is the plate and the environment.
"$make_exr" in/flat.exr B,G,R 0.1,0.2,0.3 0,0,63,47 0,0,63,47
"$make_exr" in/parts.exr depth=Z/rgba=B,G,R 7,0.1,0.2,0.3 0,0,63,47 0,0,63,47
"$make_exr" in/lights.exr a=B,G,R/b=B,G,R 1,1,1,2,2,2 0,0,63,47 0,0,63,47
run render "${shot[@]}" -o out/flat.exr --background in/flat.exr
run render "${shot[@]}" -o out/parts.exr --background in/parts.exr
check 'the colour part is the plate' same_pixels out/parts.exr out/flat.exr
run render "${shot[@]}" -o out/flat.exr --env in/flat.exr
run render "${shot[@]}" -o out/parts.exr --env in/parts.exr
check 'the colour part is the environment' same_pixels out/parts.exr out/flat.exr
clean
refuses 3 'several pictures: a, b' render "${shot[@]}" -o out/a.exr --background in/lights.exr
refuses 3 'several pictures: a, b' render "${shot[@]}" -o out/a.exr --env in/lights.exr
refuses 2 'did you mean transparent?' render "${shot[@]}" -o out/a.exr --background trasnparent
refuses 2 'env or transparent, or an image' render "${shot[@]}" -o out/a.exr --background wall
refuses 2 'pictures are for render alone' info in/mirror_sphere.gltf --background in/plate.exr
refuses 3 'in/none.exr' render "${shot[@]}" -o out/a.exr --background in/none.exr
refuses 3 'the plate has 64x48 pixels, the frame 32x32 (give --size 64x48' \
    render in/mirror_sphere.gltf --size 32x32 -o out/a.exr --background in/plate.exr
printf 'no picture' >in/bad.exr
refuses 3 'in/bad.exr' render "${shot[@]}" -o out/a.exr --background in/bad.exr
refuses 2 'this is an input' render "${shot[@]}" -o in/plate.exr --background in/plate.exr
refuses 2 'this is an input' render "${shot[@]}" -o in/p.####.exr --background in/p.#.exr --frames 1000-1003
refuses 2 'this is an input' render "${shot[@]}" -o in/p.#.exr --background in/p.####.exr --frames 998-1001
refuses 2 'this is an input' render "${shot[@]}" -o in/y.001#.exr --background in/y.####.exr --frames 1,11
refuses 2 'this is an input' render "${shot[@]}" -o out/r.####.exr --background in/r.####.exr --frames 1-2 \
    --stats in/r.0002.exr

# One plate for each frame; a missing plate fails only its frame.
run render "${shot[@]}" "${exact[@]}" -o in/p.####.exr --without 1 --turntable 5
rm in/p.0004.exr
cp in/bad.exr in/p.0002.exr
turn=("${shot[@]}" "${exact[@]}" --turntable 5)
run render "${turn[@]}" -o out/whole.####.exr
run render "${turn[@]}" -o out/f.####.exr --background in/p.####.exr
check 'frames with bad plates fail alone: exit status 6' test "$status" -eq 6
check 'and are named' grep -q '2 of 5 frames failed: 2,4' stderr
for frame in 1 3 5; do
    check "frame $frame has its plate" within 1e-7 "out/f.000$frame.exr" "out/whole.000$frame.exr"
done
check 'the others are not there' test ! -e out/f.0002.exr -a ! -e out/f.0004.exr
run render "${shot[@]}" "${exact[@]}" -o in/p.####.exr --without 1 --turntable 5 --frames 2,4
run render "${turn[@]}" -o out/f.####.exr --background in/p.####.exr --skip-existing
check 'a restart renders those that failed' grep -q '2 rendered, 3 skipped, 0 failed' stderr
run render "${shot[@]}" "${exact[@]}" -o in/p.####.exr --without 1 --turntable 5 --frames 3 --exposure 1 \
    --env in/axes.exr
run render "${turn[@]}" -o out/f.####.exr --background in/p.####.exr --skip-existing
check 'and those whose plate has changed' grep -q '1 rendered, 4 skipped, 0 failed' stderr
clean

# ---- an environment for each frame ---------------------------------------------------------------

for frame in 1 2 3; do
    "$glint" env in/axes.exr "in/turned.000$frame.exr" --env-rotate "$((frame * 40))" --to ball \
        --size 64 2>/dev/null
done
ball=(in/mirror_sphere.gltf --size 64x48 --env-layout ball --exr-type float)
run render "${ball[@]}" --env in/turned.####.exr -o out/f.####.exr --frames 1-4
check 'a missing one is one bad frame: exit status 6' test "$status" -eq 6
check 'said' grep -q 'frame 4: .*in/turned.0004.exr' stderr
for frame in 1 2 3; do
    run render "${ball[@]}" --env "in/turned.000$frame.exr" -o out/alone.exr
    check "frame $frame has its own" same_pixels out/alone.exr "out/f.000$frame.exr"
done
check 'its metadata says so' grep -aq 'in/turned.0002.exr' out/f.0002.exr
run render "${ball[@]}" --env in/turned.####.exr -o out/f.####.exr --frames 1-3 --skip-existing
check 'they are known again' grep -q '0 rendered, 3 skipped' stderr
cp in/turned.0003.exr in/turned.0002.exr
run render "${ball[@]}" --env in/turned.####.exr -o out/f.####.exr --frames 1-3 --skip-existing
check 'and one that changed' grep -q '1 rendered, 2 skipped' stderr
run render "${ball[@]}" --env in/turned.####.exr -o out/x.exr
check 'one frame has the first' same_pixels out/x.exr out/f.0001.exr
clean
refuses 2 'this is an input' render "${ball[@]}" --env in/turned.####.exr -o in/turned.#.exr \
    --frames 1001-1002
# Environments that half cannot hold change the kernels from frame to frame, and back.
"$glint" env in/studio.exr in/e.0001.exr --size 64 2>/dev/null
"$glint" env in/studio.exr in/e.0003.exr --size 64 2>/dev/null
"$glint" env in/studio.exr in/e.0002.hdr --size 128 --env-rotate 30 2>/dev/null
mv in/e.0002.hdr in/e.0002.exr
run render in/clockwork.gltf --size 48x48 --env in/e.####.exr -o out/m.####.exr --frames 1-3
check 'scene and environment change together' test "$status" -eq 0
for frame in 1 2 3; do
    run render in/clockwork.gltf --size 48x48 --env "in/e.000$frame.exr" -o out/m.exr --frames "$frame"
    check "frame $frame of both" same_pixels out/m.exr "out/m.000$frame.exr"
done
clean

# An impossible environment fails only its frame, wherever it is in the sequence.
"$glint" env in/studio.exr in/b.0001.exr --size 16 2>/dev/null
"$make_exr" in/b.0002.exr B,G,R 1,1,200000 0,0,63,31 0,0,63,31
for frames in 1-2 2,1; do
    run render in/mirror_sphere.gltf --size 16x16 --env in/b.####.exr --texels half -o out/h.####.exr \
        --frames "$frames"
    check "frames $frames, too bright for half: exit status 6" test "$status" -eq 6
    check "frames $frames: the other is there" test "$(ls out)" = h.0001.exr
    clean
done

# ---- render --env capture:NODE -------------------------------------------------------------------

refuses 2 'around which node?' render "$spheres" -o out/a.exr --env capture:
refuses 3 'no node "jewel" has triangles' render "$spheres" -o out/a.exr --env capture:jewel
refuses 2 '--surroundings: it is about what is captured' render "$spheres" -o out/a.exr --surroundings in/axes.exr
refuses 3 'in/none.exr' render "$spheres" -o out/a.exr --env capture:mirror --surroundings in/none.exr
refuses 2 '--capture-size' render "$spheres" -o out/a.exr --env capture:mirror --capture-size 0
refuses 2 '--capture-size: it is about what is captured' render "$spheres" -o out/a.exr --capture-size 64
for proxy in '' box sphere sphere:0 sphere:-1 sphere:nan sphere:1e20 sphere:1x 0,0,0 0,0,0,1,1 0,0,0,1,1,0 0,0,0,1,1,inf 0,0,0,1,1,1,1; do
    refuses 2 '--proxy' render "$spheres" -o out/a.exr --proxy "$proxy"
done
refuses 2 '--proxy bounds: they are those of what is captured' render "$spheres" -o out/a.exr --proxy bounds
refuses 2 '--env-at: it is where a proxy is seen from' render "$spheres" -o out/a.exr --env-at 0,0,0
refuses 2 '--env-at: a capture has a place of its own' render "$spheres" -o out/a.exr --env capture:mirror \
    --proxy sphere:9 --env-at 0,0,0
refuses 2 '--env-at 1,2: x,y,z in metres' render "$spheres" -o out/a.exr --proxy sphere:9 --env-at 1,2
refuses 2 'which is not inside the box from (1, 1, 1) to (2, 2, 2)' render "$spheres" -o out/a.exr --proxy 1,1,1,2,2,2
refuses 2 '--proxy: --filter mip takes more than points' render in/mirror_sphere.gltf -o out/a.exr --proxy sphere:9 --filter mip
refuses 2 'no --surroundings are given' render "$spheres" -o out/a.exr --env capture:mirror --env-layout ball
refuses 2 'only render captures' info "$spheres" --env capture:mirror
refuses 2 'no --env is given' render "$spheres" -o out/a.exr --env-layout ball
around=("${small[@]}" --exr-type float --surroundings in/axes.exr --capture-size 64)
run capture "$spheres" out/map --around mirror --to faces --size 64 --samples 4 --env in/axes.exr
run render "$spheres" -o out/two.exr "${small[@]}" --exr-type float --env out/map --only mirror
run render "$spheres" -o out/one.exr "${around[@]}" --env capture:mirror
check 'in one go as in two, whose file is of half floats' within 0.001 out/one.exr out/two.exr
run render "$spheres" -o out/turned.exr "${around[@]}" --env capture:mirror --env-rotate 90
check 'the surroundings turn' apart 0.1 out/one.exr out/turned.exr
run render "$spheres" -o out/f.####.exr "${around[@]}" --env capture:mirror --turntable 3
check 'frames from one capture' same_pixels out/one.exr out/f.0001.exr
run render "$spheres" -o out/f.####.exr "${around[@]}" --env capture:mirror --turntable 3 --skip-existing
check 'are known again' grep -q '0 rendered, 3 skipped' stderr
run render "$spheres" -o out/f.####.exr "${around[@]}" --env capture:mirror --turntable 3 \
    --skip-existing --capture-size 32
check 'another capture is another frame' grep -q '3 rendered, 0 skipped' stderr
run render "$spheres" -o out/f.####.exr "${around[@]}" --env capture:mirror --turntable 3 \
    --skip-existing --capture-size 32 --proxy sphere:1e6
check 'a proxy makes another frame' grep -q '3 rendered, 0 skipped' stderr
run render "$spheres" -o out/a.exr "${around[@]}" --env capture:mirror --proxy sphere:1e6
check 'what is very far away is infinitely far away' within 0.001 out/one.exr out/a.exr
run render "$spheres" -o out/a.exr "${around[@]}" --env capture:mirror --proxy bounds --stats out/a.json
check 'what is near is not' apart 0.1 out/one.exr out/a.exr
check 'the file tells it' grep -qa 'box .* seen from' out/a.exr
check 'the proxy is told' test "$("$json_get" out/a.json environment proxy)" = box
run render "$spheres" -o out/b.exr --exr-type float --size 64x48 --progress none --only mirror \
    --env in/axes.exr --env-at 0,0.5,0 --proxy -3,-3,-3,3,3,3
run render "$spheres" -o out/c.exr --exr-type float --size 64x48 --progress none --only mirror \
    --env in/axes.exr --proxy -3,-3,-3,3,3,3
check 'and where it was seen from' apart 0.1 out/b.exr out/c.exr
run render in/clockwork.gltf -o out/c.####.exr "${small[@]}" --env "capture:$moving" --capture-size 32 \
    --frames 1,13 --background transparent
run render in/clockwork.gltf -o out/c.exr "${small[@]}" --env "capture:$moving" --capture-size 32 \
    --frames 13 --background transparent
check 'each frame of a scene that moves from its own' same_pixels out/c.exr out/c.0013.exr
clean

# ---- lights of the file -------------------------------------------------------------------------

cp "$scenes"/lights.* in/
lit=(in/lights.gltf --size 48x30 --depth 4)
for kind in file none; do
    run render "${lit[@]}" --lights $kind -o out/$kind.exr --stats out/$kind.json
    check "--lights $kind" test "$status" -eq 0
done
check '--lights none is darker' apart 0.2 out/file.exr out/none.exr
check 'shadow rays are counted' test "$("$json_get" out/file.json rays shadow)" -gt 1000 \
    -a "$("$json_get" out/none.json rays shadow)" -eq 0
run render "${lit[@]}" -o out/none.exr --skip-existing
check '--skip-existing sees the difference' same_pixels out/file.exr out/none.exr
run info in/lights.gltf
for light in 'warm lamp (node 7): point, (26, 16.12, 7.8) cd, range 6 m' \
    'blue spot (node 8): spot, (27, 45, 90) cd, cone 9 to 14 degrees' \
    'sun (node 9): directional, (2, 1.9, 1.7) lx'; do
    check "info tells: $light" grep -qxF "  $light" stdout
done
clean
sed 's/"point"/"area"/' in/lights.gltf >in/bad_lights.gltf
run render in/bad_lights.gltf --size 64x36 -o out/a.exr
check "a light of an unknown type is left out" test "$status" -eq 0
check "and named" grep -qF 'lights[0]: type "area" is none' stderr
run render in/bad_lights.gltf --size 64x36 -o out/b.exr --strict
check "--strict refuses it" test "$status" -eq 3
clean
refuses 2 "--lights" render in/lights.gltf -o out/a.exr --lights some

# ---- relight -------------------------------------------------------------------------------------

# shellcheck disable=SC2046 # a list of words
check 'relight --help tells every option' help_mentions relight allow-large-images env env-layout ball-circle \
    ball-distance ball-fov env-flip $(settings_of environment) output exposure tone compression exr-type progress help
run --help
check 'glint --help lists it' grep -q '^  relight ' stdout
kept=("$spheres" --size 64x48 --exr-type float --texels float --roughness smooth)
run render "${kept[@]}" -o in/kept.exr --directions 16
run render "${kept[@]}" -o out/wanted.exr --env in/axes.exr --env-rotate 40
run relight in/kept.exr --env in/axes.exr --env-rotate 40 -o out/lit.exr --exr-type float
check 'lit anew: as rendered' within 1e-5 out/lit.exr out/wanted.exr
check 'said' grep -q 'out/lit.exr: 64x48, 16 directions a pixel' stderr
run render "${kept[@]}" -o out/studio.exr
run relight in/kept.exr -o out/same.exr --exr-type float
check 'the studio, where nothing is said' within 1e-5 out/same.exr out/studio.exr
run render "${kept[@]}" -o in/few.exr --directions 1 --samples 4
run relight in/few.exr -o out/few.png
check 'what is missing: said' grep -q 'warning: in/few.exr: .*% of the weight found no room in 1' stderr
check 'a PNG' begins_with out/few.png 89504e47
clean
refuses 2 'no output' relight in/kept.exr
refuses 2 'DIRECTIONS is missing' relight -o out/a.exr
refuses 2 'this is an input' relight in/kept.exr -o in/kept.exr
refuses 2 'this is an input' relight in/kept.exr --env in/axes.exr -o in/../in/axes.exr
refuses 2 'is no EXR' relight in/kept.exr -o out/a.png --exr-type float
refuses 2 'no --env is given' relight in/kept.exr -o out/a.exr --env-layout ball
refuses 2 'with --env-layout ball' relight in/kept.exr -o out/a.exr --env in/axes.exr --ball-fov 30
refuses 3 'it holds no directions' relight in/axes.exr -o out/a.exr
refuses 3 'is no EXR' relight in/plate.png -o out/a.exr
refuses 3 'No such file' relight in/none.exr -o out/a.exr
refuses 3 'in/none.exr' relight in/kept.exr --env in/none.exr -o out/a.exr
head -c 3000 in/kept.exr >in/cut.exr
refuses 3 'in/cut.exr' relight in/cut.exr -o out/a.exr
refuses 5 'out/none' relight in/kept.exr -o out/none/a.exr
refuses 2 '--directions: out/a.png is no EXR' render "${kept[@]:0:3}" -o out/a.png --directions 4
refuses 2 '--directions' render "${kept[@]}" -o out/a.exr --directions 33
refuses 2 '--filter mip' render in/mirror_sphere.gltf --size 64x48 -o out/a.exr --directions 4 --filter mip

finish
