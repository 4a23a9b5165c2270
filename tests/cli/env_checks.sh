#!/usr/bin/env bash
# Tests the command line of glint env, and environments in every layout.
# env_checks.sh GLINT JSON_GET MAKE_EXR SCENES
make_exr=$(readlink -f -- "$3")
scenes=$(readlink -f -- "$4")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

single='cube hcross vcross vstrip hstrip latlong ball angular' # layouts that are one file
cp "$scenes"/mirror_sphere.* in/

# ---- help and mistakes --------------------------------------------------------------------------

check 'env --help tells every option' help_mentions env allow-large-images env-layout ball-circle ball-distance \
    ball-fov probe studio to size env-rotate flip exposure compression help
for layout in $single faces; do
    check "and $layout" grep -qw -- "$layout" help.txt
done
run --help
check 'glint --help lists it' grep -q '^  env ' stdout

"$glint" env --probe in/map.exr --to latlong --size 64 2>/dev/null
refuses 2 'input' env
refuses 2 'input' env in/map.exr
refuses 2 'input' env in/map.exr out/a.exr out/b.exr
refuses 2 "the output's name alone is" env --probe in/map.exr out/a.exr
refuses 2 'give one' env --probe --studio out/a.exr
refuses 2 'use --to' env --probe --env-layout ball out/a.exr
refuses 2 'this is the input' env in/map.exr in/../in/map.exr
refuses 2 'one of cube, faces, hcross, vcross, vstrip, hstrip, latlong, ball, angular is expected' \
    env in/map.exr out/a.exr --to cross
refuses 2 'axes are expected' env in/map.exr out/a.exr --flip left
refuses 2 '--size' env in/map.exr out/a.exr --size 0
refuses 2 '--size 65536: 1 to 4096' env in/map.exr out/a.hdr --to hstrip --size 65536
refuses 2 '--size 1: 2 to' env in/map.exr out/a.exr --to latlong --size 1
refuses 2 '.txt' env in/map.exr out/a.txt
refuses 2 'is no compression of this format' env in/map.exr out/a.png --compression zip
refuses 5 'out/none' env in/map.exr out/none/a.exr
refuses 5 'out/none/faces' env in/map.exr out/none/faces --to faces
refuses 3 'No such file' env in/none.exr out/faces --to faces
printf 'a file' >in/file
refuses 5 'in/file: no folder could be made there' env in/map.exr in/file --to faces
mkdir out/there
run env in/map.exr out/there --to latlong
check 'a folder is for six faces: exit status 2' test "$status" -eq 2
check 'a folder is for six faces: said' grep -q 'a folder is for six faces' stderr
clean
refuses 2 'a pattern holds %s once' env in/map.exr 'out/%s_%s.exr' --to faces
refuses 2 'one file'"'"'s name, where six are written' env in/map.exr out/a.exr --to faces
refuses 2 'a pattern is for six faces' env in/map.exr 'out/%s.exr' --to hcross
refuses 2 'with --env-layout ball' env in/map.exr out/a.exr --ball-fov 30
refuses 2 'with --env-layout ball' env in/map.exr out/a.exr --env-layout angular --ball-distance 3
refuses 2 'with --env-layout ball or angular' env in/map.exr out/a.exr --ball-circle 32,32,30
refuses 2 'give one' env in/map.exr out/a.exr --env-layout ball --ball-fov 30 --ball-distance 3
for circle in 1,2 1,2,3,4 1,2,0 1,2,0.9 1,2,-3 nan,1,1 1,1,inf x; do
    refuses 2 'x,y,r in pixels is expected' env in/map.exr out/a.exr --env-layout ball \
        --ball-circle "$circle"
done
for distance in 1 0 -3 nan inf x; do
    refuses 2 'above 1' env in/map.exr out/a.exr --env-layout ball --ball-distance "$distance"
done
refuses 3 'leaves the picture' env in/map.exr out/a.exr --env-layout ball --ball-circle 32,32,33
refuses 3 'No such file' env in/none.exr out/a.exr
refuses 2 'with --env-layout ball' render in/mirror_sphere.gltf --env in/map.exr --ball-fov 30 -o out/a.png

# ---- shapes -------------------------------------------------------------------------------------

exr() { # NAME WIDTH HEIGHT [VALUES]: flat
    "$make_exr" "in/$1.exr" B,G,R "${4-0.5,0.5,0.5}" "0,0,$(($2 - 1)),$(($3 - 1))" \
        "0,0,$(($2 - 1)),$(($3 - 1))"
}
exr square 32 32
exr strip 8 48
exr odd 33 20
exr cross 31 24
refuses 3 'give --env-layout ball or angular' env in/square.exr out/a.exr
refuses 3 'give --env-layout cube for the first, vstrip for the other' env in/strip.exr out/a.exr
refuses 3 'the shape of no layout' env in/odd.exr out/a.exr
refuses 3 'the shape of no layout' env in/cross.exr out/a.exr
refuses 3 'not 4 × 3 squares' env in/cross.exr out/a.exr --env-layout hcross
refuses 3 'takes six' env in/odd.exr out/a.exr --env-layout faces
refuses 3 'give --env-layout ball or angular' render in/mirror_sphere.gltf --env in/square.exr -o out/a.png
"$make_exr" in/grey.exr Y 0.25 0,0,15,7 0,0,15,7
run env in/grey.exr out/a.exr --to hcross
check 'one channel: repeated' test "$status" -eq 0
"$make_exr" in/bad.exr B,G,R 0.5,0.5,0.5 0,0,15,7 0,0,15,7 3 3 nan 4 4 -1 5 5 inf
run env in/bad.exr out/a.exr --to hcross
check 'NaN, negative and infinite: mended, with a warning' grep -q 'warning: in/bad.exr: 3 texels are NaN' stderr
run env in/odd.exr out/b.exr --env-layout latlong
check 'an odd lat-long map: stretched, with a warning' grep -q 'warning: in/odd.exr: 33 × 20' stderr
clean

# ---- every layout, and back ---------------------------------------------------------------------

"$glint" env --probe in/axes.exr --to latlong --size 256 2>/dev/null
"$glint" env --studio in/studio.exr --to latlong --size 256 2>/dev/null
run render in/mirror_sphere.gltf --size 64x64 --samples 16 --env in/axes.exr -o in/sphere.exr
for layout in $single; do
    # Sharp labels lose their edges in layouts that hold them in fewer pixels; a mistaken direction
    # gives 0.5 and more.
    limit=0.1
    [ "$layout" != ball ] || limit=0.16 # its picture has few pixels for the side behind it
    for map in axes studio; do
        run env "in/$map.exr" "out/$map.exr" --to "$layout"
        check "$map as $layout: exit status 0, nothing on stdout" test "$status" -eq 0 -a ! -s stdout
        run env "out/$map.exr" "out/${map}_back.exr" --env-layout "$layout" --to latlong --size 256
        check "$map as $layout, and back" within "$limit" "out/${map}_back.exr" "in/$map.exr"
    done
    run render in/mirror_sphere.gltf --size 64x64 --samples 16 --env out/axes.exr \
        --env-layout "$layout" -o "out/sphere_$layout.exr"
    check "render, of $layout" within "$limit" "out/sphere_$layout.exr" in/sphere.exr
done
run env in/axes.exr out/set/ --to faces
check 'faces: six files in a folder, which is made' test "$(cd out/set && echo *)" = \
    'negx.exr negy.exr negz.exr posx.exr posy.exr posz.exr'
for output in out/set 'out/set/%s.exr'; do
    for input in out/set 'out/set/%s.exr' out/set/negz.exr; do
        run env "$input" "$output" --size 8 --to faces
        check "not over what is read: $input to $output" grep -q 'this is the input' stderr
    done
done
run env out/set out/back.exr --to latlong --size 256
check 'faces, and back' within 0.1 out/back.exr in/axes.exr
run env out/set 'out/sky_%s.hdr' --size 32 --to faces
check 'faces by a pattern' test "$(cd out && echo sky*)" = \
    'sky_negx.hdr sky_negy.hdr sky_negz.hdr sky_posx.hdr sky_posy.hdr sky_posz.hdr'
run render in/mirror_sphere.gltf --size 64x64 --samples 16 --env out/set -o out/sphere_faces.exr
check 'render, of faces' within 0.1 out/sphere_faces.exr in/sphere.exr
run env out/set out/again
check 'without --to: the layout of the input' test -s out/again/negz.exr
"$glint" env --probe out/again/posy.exr --to cube --size 8 2>/dev/null
run env out/again out/c.exr --to cube
check 'a face that is not square' grep -q 'posy.exr: 8 × 48 pixels, where a face is square' stderr
"$glint" env --probe out/small --to faces --size 8 2>/dev/null
cp out/small/posy.exr out/again/posy.exr
run env out/again out/c.exr --to cube
check 'a face of another size' grep -q 'posy.exr: 8 pixels an edge, where out/again/posx.exr has' stderr
rm out/again/posy.exr
run env out/again out/c.exr --to cube
check 'a face that is missing' grep -q '5 of six faces are there, the first that is missing is posy' stderr
check 'nothing came of them' test ! -e out/c.exr
clean

# ---- exactness ----------------------------------------------------------------------------------

run env in/studio.exr out/same.exr
check 'to its own layout and size: the same picture' same_pixels out/same.exr in/studio.exr
check 'said: what was read, and how it was known' \
    grep -q 'out/same.exr: latlong 512x256 from latlong 512x256 (envmap attribute)' stderr
run env in/studio.exr out/turned.exr --env-rotate 90
run render in/mirror_sphere.gltf --size 64x64 --env out/turned.exr -o out/a.exr
run render in/mirror_sphere.gltf --size 64x64 --env in/studio.exr --env-rotate 90 -o out/b.exr
check 'turned as render turns it' within 0.02 out/a.exr out/b.exr
run env in/studio.exr out/mirrored.exr --flip xy
run render in/mirror_sphere.gltf --size 64x64 --env out/mirrored.exr -o out/a.exr
run render in/mirror_sphere.gltf --size 64x64 --env in/studio.exr --env-flip xy -o out/b.exr
check 'render mirrors as env does' within 0.02 out/a.exr out/b.exr
run render in/mirror_sphere.gltf --size 64x64 --env in/studio.exr -o out/c.exr
check 'which is another picture' apart 0.1 out/b.exr out/c.exr
run env out/turned.exr out/back.exr --env-rotate -90
check 'turned back' within 0.02 out/back.exr in/studio.exr
for axis in x y z; do
    run env in/axes.exr "out/$axis.exr" --flip "$axis"
    check "mirrored along $axis: another" apart 0.2 "out/$axis.exr" in/axes.exr
    run env "out/$axis.exr" out/back.exr --flip "$axis"
    # Half a turn is no whole number of pixels between edges, so z blurs a little.
    check "mirrored along $axis twice: the same" within "$([ $axis = z ] && echo 0.05 || echo 0.001)" \
        out/back.exr in/axes.exr
done
"$make_exr" in/sun.exr B,G,R 0.5,0.5,0.5 0,0,15,7 0,0,15,7 5 3 1e6
run env in/sun.exr out/sun.exr --to hcross --size 64
run env in/sun.exr out/sun.hdr --to hcross --size 64
check 'above what half holds: kept' within 0.05 out/sun.exr out/sun.hdr
run env in/studio.exr out/s.png
check 'a PNG' begins_with out/s.png 89504e47
clean

# A ball seen from nearby: the distance and the angle of view must give the same environment.
run env in/axes.exr out/ball.exr --to ball --size 256
run env out/ball.exr out/near.exr --env-layout ball --ball-distance 4 --to latlong --size 256
run env out/ball.exr out/fov.exr --env-layout ball --ball-fov 28.955024 --to latlong --size 256
check 'a ball: its distance from the angle of view' within 0.002 out/near.exr out/fov.exr
check 'a ball: near is not far' test "$(within 0.2 out/near.exr in/axes.exr >/dev/null; echo $?)" -eq 7
clean

# ---- a rendered ball ----------------------------------------------------------------------------

# The picture of a mirror sphere by an orthographic camera is the disk map. By a camera 5 radii away
# it is the map of this distance.
sed 's/0\.972,/1,/; s/0\.96,/1,/; s/0\.915,/1,/' in/mirror_sphere.gltf >in/mirror.gltf
sed 's/"type": "perspective"/"type": "orthographic"/; s/"perspective": {/"orthographic": {/
    s/"aspectRatio": [0-9.]*/"xmag": 1, "ymag": 1/; s/"yfov": [0-9.]*/"zfar": 100/' in/mirror.gltf >in/flat.gltf
ball=(--size 256x256 --samples 16 --fresnel none --background transparent --env in/axes.exr)
run render in/flat.gltf "${ball[@]}" -o out/flat.exr
run env in/axes.exr out/disk.exr --to ball --size 256
check 'a sphere seen from far away is the disk map' within 0.1 out/flat.exr out/disk.exr
run env out/flat.exr out/back.exr --env-layout ball --to latlong --size 256
check 'and the environment can be had back from it' within 0.16 out/back.exr in/axes.exr
run render in/mirror.gltf "${ball[@]}" -o out/near.exr
# asin(1/5) of 30 degrees: the sphere covers tan 11.537 / tan 15 of half the picture.
for how in '--ball-distance 5' '--ball-fov 30'; do
    # shellcheck disable=SC2086 # two words
    run env out/near.exr out/back.exr --env-layout ball --ball-circle 128,128,97.51 $how \
        --to latlong --size 256
    check "likewise from a sphere nearby: $how" within 0.2 out/back.exr in/axes.exr
done
clean

# ---- OpenEXR's own tool -------------------------------------------------------------------------

if command -v exrenvmap >/dev/null; then
    # Its filter is set to a pixel's own square.
    exrenvmap -c -w 128 -f 0.5 5 in/studio.exr out/theirs.exr
    run env in/studio.exr out/ours.exr --to cube --size 128
    check 'a cube as exrenvmap makes it' within 0.005 out/ours.exr out/theirs.exr
    run env out/theirs.exr out/a.exr --to latlong
    # It copies the note of what its input was, which is then wrong.
    check 'its envmap attribute is read' grep -q 'from cube 128x768 (envmap attribute)' stderr
    exrenvmap -l -w 512 -f 0.5 5 out/ours.exr out/theirs_l.exr
    check 'ours is read by it: a lat-long map' test -s out/theirs_l.exr
    run env out/ours.exr out/ours_l.exr --to latlong --size 256
    check 'a lat-long map as exrenvmap makes it' within 0.005 out/ours_l.exr out/theirs_l.exr
    clean
else
    skip 'agreement with exrenvmap' 'the package openexr is not installed'
fi

finish
