#!/usr/bin/env bash
# Tests the command line: every option, every mistake. run_cli.sh GLINT JSON_GET
# A mistake must give its exit status, one line on stderr that begins with "glint: ", nothing on
# stdout and no file. Prints TAP; exit status 1 if a test failed.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# renders NAME FILE ARGUMENT…: must write a frame to FILE, with empty stdout.
renders() {
    local name=$1 file=$2
    shift 2
    run render in/mirror.gltf --size 24x16 -o "$file" "$@"
    local why=
    [ "$status" -eq 0 ] || why="exit status $status"
    [ -s "$file" ] || why="$why; no file"
    [ ! -s stdout ] || why="$why; stdout is not empty"
    [ "$(ls -A out)" = "${file#out/}" ] || why="$why; in the folder: $(echo out/* out/.*)"
    if [ -z "$why" ]; then
        verdict ok "$name"
    else
        verdict 'not ok' "$name" "$why"
    fi
}

# ---- inputs -------------------------------------------------------------------------------------

# A mirror triangle in the plane z = 0, with two cameras. The buffer holds three positions.
buffer=$(printf '\0\0\200\277\0\0\200\277\0\0\0\0\0\0\200\077\0\0\200\277\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0' |
    base64 -w 0)
cat >in/mirror.gltf <<JSON
{"asset": {"version": "2.0"}, "scene": 0,
 "scenes": [{"name": "main", "nodes": [0, 1, 2]}, {"name": "empty", "nodes": [1]}],
 "nodes": [{"mesh": 0, "name": "triangle"},
           {"camera": 0, "name": "front", "translation": [0, 0, 3]},
           {"camera": 1, "name": "flat", "translation": [0, 0, 3]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
             {"type": "orthographic", "orthographic": {"xmag": 1.5, "ymag": 1.5, "zfar": 9, "znear": 0}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "materials": [{"name": "chrome", "pbrMetallicRoughness":
   {"metallicFactor": 1, "roughnessFactor": 0, "baseColorFactor": [0.9, 0.9, 0.9, 1]}}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [-1, -1, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,$buffer"}]}
JSON
# The same with a rough mirror, and with an unsupported coat, which glint must report once.
sed 's/"roughnessFactor": 0/"roughnessFactor": 0.5/' in/mirror.gltf >in/rough.gltf
sed 's/"name": "chrome",/& "extensions": {"KHR_materials_volume_scatter": {}},/' \
    in/mirror.gltf >in/coated.gltf
# Constant radiance: 8 × 4 pixels of (1, 1, 1), and of 2¹⁷, which half cannot hold.
{
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'
    for _ in $(seq 32); do printf '\200\200\200\201'; done
} >in/sky.hdr
sed 's/\o201/\o222/g' in/sky.hdr >in/sun.hdr
head -c 60 in/sky.hdr >in/short.hdr
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 40000\n' >in/huge.hdr
printf 'not an image' >in/text.png
printf '{"asset": ' >in/broken.gltf
mkdir in/folder.gltf in/empty

# ---- usage --------------------------------------------------------------------------------------

ok=(in/mirror.gltf -o out/x.png)
refuses 2 "did you mean render?" rendr
refuses 2 "unknown command 'frobnicate'" frobnicate
refuses 2 'unknown option --verbose' --verbose
refuses 2 'did you mean devices?' help device
refuses 2 'SCENE is missing' render
refuses 2 'SCENE is missing' render -o out/x.png
refuses 2 'SCENE is missing' info
refuses 2 'SCENE is missing' render '' -o out/x.png
refuses 2 'no output' render in/mirror.gltf
refuses 2 "unexpected argument 'in/rough.gltf'" render "${ok[@]}" in/rough.gltf
refuses 2 "unexpected argument '--depth'" render -o out/x.png -- in/rough.gltf --depth
refuses 2 "unexpected argument" devices extra
refuses 2 'unknown option --fraems' render "${ok[@]}" --fraems 3
refuses 2 '--mend: --precision double has nothing to mend' \
    render "${ok[@]}" --mend 0.3 --precision double
refuses 2 '--mend' render "${ok[@]}" --mend -1
refuses 2 '--mend' render "${ok[@]}" --mend inf
refuses 2 'did you mean --depth?' render "${ok[@]}" --dept 3
refuses 2 'did you mean --samples?' render "${ok[@]}" --sample=4
refuses 2 'unknown option -x' render "${ok[@]}" -x
refuses 2 '--json takes no value' info in/mirror.gltf --json=yes
refuses 2 '--help takes no value' info in/mirror.gltf --help=x
refuses 2 'did you mean --help?' info in/mirror.gltf --hel
refuses 2 '--output' render in/mirror.gltf -o
refuses 2 '--output' render in/mirror.gltf -o ''
for option in env env-layout ball-circle ball-distance ball-fov env-flip camera scene device exposure \
    compression exr-type stats progress kernel-dir $(settings_of environment size frame device layers); do
    refuses 2 "--$option" render "${ok[@]}" "--$option"
done
for size in 0x10 10x0 -4x4 10 x10 10x 10x10x10 1.5x2 axb 100000x10 99999999999999999999x1 '10 x10'; do
    refuses 2 '--size' render "${ok[@]}" --size "$size"
done
for depth in 0 -1 1.5 x 99999999999 ''; do
    refuses 2 '--depth' render "${ok[@]}" --depth "$depth"
done
for samples in 0 2 3 5 -4 x 4x 10000000000; do
    refuses 2 '--samples' render "${ok[@]}" --samples "$samples"
done
for value in x 1x nan inf -inf 1e9 1e999 0x10 ' 1' '1 ' 0,5 ''; do
    refuses 2 '--exposure' render "${ok[@]}" --exposure "$value"
    refuses 2 '--env-rotate' render "${ok[@]}" --env-rotate "$value"
    refuses 2 '--min-weight' render "${ok[@]}" --min-weight "$value"
done
refuses 2 '--min-weight' render "${ok[@]}" --min-weight -0.1
refuses 2 '--tone filmic: one of none|pbr-neutral|agx' render "${ok[@]}" --tone filmic
refuses 2 '--precision half' render "${ok[@]}" --precision half
refuses 2 '--texels double' render "${ok[@]}" --texels double
refuses 2 '--filter sharp' render "${ok[@]}" --filter sharp
refuses 2 '--anisotropy 17' render "${ok[@]}" --anisotropy 17
refuses 3 'plate.png' render "${ok[@]}" --background plate.png
refuses 2 '--progress loud' render "${ok[@]}" --progress loud
refuses 2 '--exr-type double' render "${ok[@]}" --exr-type double
refuses 2 '--exr-type' render "${ok[@]}" --exr-type float
refuses 2 'did you mean surfaces?' render in/mirror.gltf -o out/x.exr --aov tir,surface
refuses 2 "no layer 'frobnicate' (there are all, surfaces" render in/mirror.gltf -o out/x.exr --aov frobnicate
for list in '' ',' 'tir,' ',tir' 'tir,,face' 'tir face' none; do
    refuses 2 '--aov: there is no layer' render in/mirror.gltf -o out/x.exr --aov "$list"
done
refuses 2 '--aov: out/x.png is no EXR' render "${ok[@]}" --aov tir
refuses 2 '--kernel-width 4' render "${ok[@]}" --kernel-width 4
refuses 2 '--kernel-tile 4' render "${ok[@]}" --kernel-tile 4
refuses 2 '--shading vertex' render "${ok[@]}" --shading vertex
refuses 2 '--shading vertex-color: surfaces see' render "${ok[@]}" --shading vertex-color --depth 3
refuses 2 '--filter mip: --shading vertex-direction shades vertices' render "${ok[@]}" --shading vertex-direction --filter mip
refuses 2 '--aov tir: --shading vertex-direction shades vertices' render in/mirror.gltf -o out/x.exr --shading vertex-direction --aov tir
refuses 2 '--fresnel schlick' render "${ok[@]}" --fresnel schlick
refuses 2 'latlong' render "${ok[@]}" --env in/sky.hdr --env-layout mercator
refuses 2 '--env-layout' render "${ok[@]}" --env-layout latlong
refuses 2 'out/x.gif' render in/mirror.gltf -o out/x.gif
refuses 2 'out/x' render in/mirror.gltf -o out/x
refuses 2 'out/x.png' render "${ok[@]}" --compression zip
refuses 2 'out/x.exr' render in/mirror.gltf -o out/x.exr --compression lzw
refuses 2 'is an input' render "${ok[@]}" --stats in/mirror.gltf
refuses 2 'is an input' render in/mirror.gltf --env in/sky.hdr -o "$work/in/sky.hdr"
refuses 2 'is the image' render "${ok[@]}" --stats out/x.png
check 'inputs are whole after that' cmp -s in/mirror.gltf <(sed 's/"roughnessFactor": 0.5/"roughnessFactor": 0/' in/rough.gltf)

# ---- bad input ----------------------------------------------------------------------------------

refuses 3 'in/missing.gltf: ' render in/missing.gltf -o out/x.png
refuses 2 'is 131072, and half holds 65504' render "${ok[@]}" --env in/sun.hdr --texels half
refuses 3 'in/missing.gltf: ' info in/missing.gltf
refuses 3 'in/broken.gltf: ' render in/broken.gltf -o out/x.png
refuses 3 'in/folder.gltf: ' render in/folder.gltf -o out/x.png
refuses 3 '/dev/null: ' render /dev/null -o out/x.png
refuses 3 'in/missing.hdr: ' render "${ok[@]}" --env in/missing.hdr
refuses 3 'in/missing.hdr: ' info in/mirror.gltf --env in/missing.hdr
refuses 3 'in/short.hdr: ' render "${ok[@]}" --env in/short.hdr
refuses 3 'in/huge.hdr: ' render "${ok[@]}" --env in/huge.hdr
refuses 3 'in/text.png: ' render "${ok[@]}" --env in/text.png
refuses 3 'in/empty' render "${ok[@]}" --env in/empty
refuses 3 'in/none_%s.png' render "${ok[@]}" --env 'in/none_%s.png'
refuses 3 'in/mirror.gltf' render "${ok[@]}" --env in/mirror.gltf
refuses 3 'front' render "${ok[@]}" --camera nobody
refuses 3 '7' render "${ok[@]}" --camera 7
refuses 3 'nowhere' render "${ok[@]}" --scene nowhere
refuses 3 'in/missing' render "${ok[@]}" --kernel-dir in/missing
refuses 3 'in/sky.hdr' render "${ok[@]}" --kernel-dir in/sky.hdr
run render "${ok[@]}" --kernel-dir in/empty
check 'a folder without kernels fails' test "$status" -ne 0
check 'and leaves no file' test -z "$(ls -A out)"
clean
refuses 4 'nonsense' render "${ok[@]}" --device nonsense
refuses 4 'nonsense' info in/mirror.gltf --device nonsense
refuses 4 '99' render "${ok[@]}" --device 99
refuses 9 'the frame needs 65536 MiB in one buffer and the device allows' render "${ok[@]}" --size 65536x65536 --progress none
refuses 9 'the frame needs 65536 MiB in one buffer and the device allows' \
    render in/mirror.gltf -o out/x.#.png --size 65536x65536 --frames 1-9 --progress none

# ---- write errors -------------------------------------------------------------------------------

refuses 5 'out/missing' render in/mirror.gltf -o out/missing/x.png
refuses 5 'in/mirror.gltf' render in/mirror.gltf -o in/mirror.gltf/x.png
refuses 5 'out/missing' render "${ok[@]}" --stats out/missing/stats.json
mkdir in/folder.png
refuses 5 'in/folder.png' render in/mirror.gltf -o in/folder.png
mkfifo in/pipe.png
refuses 5 'in/pipe.png' render in/mirror.gltf -o in/pipe.png
mkdir sealed
chmod 555 sealed
chmod 755 "$work"
if [ "$(id -u)" -ne 0 ]; then
    refuses 5 'sealed' render in/mirror.gltf -o sealed/x.png
elif command -v setpriv >/dev/null && setpriv --reuid 65534 --clear-groups test -x "$glint"; then
    setpriv --reuid 65534 --clear-groups "$glint" render in/mirror.gltf -o sealed/x.png \
        >stdout 2>stderr
    check 'a folder without permission: exit status 5' test $? -eq 5
    check 'a folder without permission: one line' test "$(wc -l <stderr)" -eq 1
else
    skip 'a folder without permission' 'nobody here to try it as'
fi
mkdir disk
if [ "$(id -u)" -eq 0 ] && mount -t tmpfs -o size=16k tmpfs disk 2>/dev/null; then
    run render in/mirror.gltf -o disk/x.exr --exr-type float --compression none --size 96x64 \
        --progress none
    check 'a full disk: exit status 5' test "$status" -eq 5
    check 'a full disk: nothing left behind' test -z "$(ls -A disk)"
    check 'a full disk: one line' test "$(grep -c '^glint: ' stderr)" -eq 1 -a "$(wc -l <stderr)" -eq 1
    umount disk
else
    skip 'a full disk' 'no small file system can be mounted'
fi
"$glint" info in/mirror.gltf >/dev/full 2>stderr
check 'results onto a full device: exit status 5' test $? -eq 5
"$glint" info in/mirror.gltf >&- 2>stderr
check 'results onto a closed stdout: exit status 5' test $? -eq 5
"$glint" render in/mirror.gltf --size 8x8 -o out/x.png --progress none >&-
check 'what writes a file needs no stdout' test $? -eq 0
rm -f out/x.png

# Names with terminal control characters: ESC, BEL, newline, CSI (U+009B), right-to-left (U+202E).
evil='\\u001b[31m\\u0007\\n\\u009b1m\\u202e'
sed "s/\"name\": \"[a-z]*/&$evil/g" in/mirror.gltf >in/evil.gltf
cp in/evil.gltf "in/e"$'\e[31m\a\u009b1m\u202e'vil.gltf
has_escapes() { LC_ALL=C grep -qP '[\x00-\x09\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\x8e\x8f\xa8-\xae]' "$@"; }
for words in 'info' 'info --json -' 'info --camera none' 'bench --rounds 1 --no-check --size 8x8'; do
    # shellcheck disable=SC2086 # a list of words
    run $words in/e*vil.gltf
    cat stdout stderr >both
    check "$words: names cannot drive a terminal" eval '[ -s both ] && ! has_escapes both'
done
"$glint" info in/mirror.gltf 2>stderr | head -n 1 >/dev/null
check 'a reader that leaves is no error' test "${PIPESTATUS[0]}" -eq 0 -a ! -s stderr

# ---- memory ------------------------------------------------------------------------------------

# A triangle, and 300 buffers of 10 MB in the same file; and 60 million triangles by 60,000 nodes.
{ printf %s "$buffer" | base64 -d && head -c 10000000 /dev/zero; } >in/big.bin
repeat() { # COUNT TEXT: with commas between
    printf "%.0s$2," $(seq "$1") | sed 's/,$//'
}
sed "s#\"buffers\": .*#\"buffers\": [$(repeat 300 '{\"byteLength\": 10000000, \"uri\": \"big.bin\"}')]}#" \
    in/mirror.gltf >in/shared.gltf
cat >in/instanced.gltf <<JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [$(seq -s, 0 59999)]}],
 "nodes": [$(repeat 60000 '{\"mesh\": 0}')],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [-1, -1, 0], "max": [1, 1, 0]},
               {"bufferView": 1, "componentType": 5121, "count": 3000, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 1, "byteLength": 3000}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,$buffer"},
             {"byteLength": 3000, "uri": "indices.bin"}]}
JSON
printf '\0\1\2%.0s' $(seq 1000) >in/indices.bin
if [ -z "${ASAN_OPTIONS-}" ]; then
    (ulimit -v 1000000 && "$glint" info in/shared.gltf >stdout 2>stderr)
    check 'buffers of one file are read once' test $? -eq 0 -a ! -s stderr
    (ulimit -v 800000 && "$glint" info in/instanced.gltf >stdout 2>stderr)
    check 'too many triangles: exit status 8' test $? -eq 8 -a "$(wc -l <stderr)" -eq 1
    check 'too many triangles: a number' grep -q '60000000 triangles take 0.9 GiB, and 0' stderr
else
    skip 'memory' 'AddressSanitizer knows no limit'
fi

# ---- output files -------------------------------------------------------------------------------

renders 'EXR' out/x.exr && check 'EXR: signature' begins_with out/x.exr 762f3101
clean
renders 'PNG' out/x.png && check 'PNG: signature' begins_with out/x.png 89504e470d0a1a0a
clean
renders 'HDR' out/x.hdr && check 'HDR: signature' begins_with out/x.hdr 233f5241444941
clean
renders 'JPEG' out/x.jpg && check 'JPEG: signature' begins_with out/x.jpg ffd8ff
clean
renders 'TIFF' out/x.tiff && check 'TIFF: signature' begins_with out/x.tiff 49492a00
clean
renders 'an upper-case extension' out/X.PNG
clean
printf 'old' >out/x.png
renders 'an existing file is replaced' out/x.png
check 'replaced: signature' begins_with out/x.png 89504e47
clean
for name in none rle zip zips piz pxr24 b44 b44a dwaa dwab; do
    renders "EXR, compression $name" out/x.exr --compression "$name"
    clean
done
for attribute in worldToCamera worldToNDC capDate imageCounter glint:scene glint:environment \
    glint:plan glint:device; do
    [ -f out/x.exr ] || renders 'EXR with metadata' out/x.exr
    check "EXR: $attribute" grep -qa "$attribute" out/x.exr
done
clean
renders 'float channels' out/x.exr --exr-type float
clean

# ---- every option -------------------------------------------------------------------------------

renders '--env' out/x.png --env in/sky.hdr
clean
renders '--env-layout' out/x.png --env in/sky.hdr --env-layout latlong
clean
renders '--env-rotate' out/x.png --env-rotate -90.5
clean
renders '--camera by name, orthographic' out/x.png --camera flat
clean
renders '--camera by index' out/x.png --camera 1
clean
renders '--scene by name, without triangles' out/x.png --scene empty
clean
renders '--depth' out/x.png --depth 2
clean
renders '--depth auto' out/x.png --depth auto
clean
renders '--samples' out/x.png --samples 9
clean
renders '--background transparent' out/x.png --background transparent
clean
renders '--min-weight 0' out/x.png --min-weight 0 --depth 4
clean
renders '--exposure' out/x.png --exposure -2
clean
renders '--device cpu' out/x.png --device 0
clean
for width in 1 8 16; do
    renders "--kernel-width $width" out/x.png --kernel-width "$width"
    clean
done
for texels in auto half float; do
    renders "--texels $texels" out/x.png --texels $texels
    clean
done
renders '--filter mip' out/x.png --filter mip --texels float
clean
renders '--anisotropy 1' out/x.png --anisotropy 1
clean
run devices --json
if grep -q '"fp64": true' stdout; then
    renders '--precision double' out/x.exr --precision double --exr-type float
    clean
fi
run render -o out/x.png --size 8x8 -- in/mirror.gltf
check 'options before the scene, and --' test "$status" -eq 0 -a -s out/x.png
clean
run render in/mirror.gltf --size 4x4 --size 8x8 -o out/y.png --output=out/x.png --stats out/stats.json
check 'the last value of an option counts' stat_is 8 settings width
check 'also across its two names' test -s out/x.png -a ! -e out/y.png
clean
run render in/coated.gltf --size 8x8 -o out/x.png --progress none
check 'a warning is said once' test "$(grep -c '^glint: warning: .*volume_scatter' stderr)" -eq 1
check 'with its share of the picture' grep -q 'volume_scatter.* ([1-9][0-9]*% of the picture)$' stderr
run render in/coated.gltf --eye 0,0,9 --look-at 0,0,99 --size 8x8 -o out/x.png --progress none
check 'also where that is nothing' grep -q 'volume_scatter.* (not in view)$' stderr
clean
run render in/coated.gltf --strict --size 8x8 -o out/x.png --progress none
check '--strict: a warning is an error' test "$status" -eq 3 -a ! -e out/x.png
check '--strict: and says so' grep -q '^glint: in/coated.gltf: 1 warning, and --strict wants none' stderr
run render in/mirror.gltf --strict --size 8x8 -o out/x.png --progress none
check '--strict: nothing to warn of' test "$status" -eq 0 -a -s out/x.png
clean
run render in/mirror.gltf --size 8x8 -o out/x.exr --exposure 1 --progress none
check 'an exposure that is left out is said' grep -q 'warning: .*exposure' stderr
clean
run render in/mirror.gltf --size 8x8 -o out/x.exr --tone agx --progress none
check 'a tone curve that is left out is said' grep -q 'warning: out/x.exr: --tone is left out' stderr
clean
run render in/mirror.gltf --size 8x8 -o out/x.exr --tone agx --preview --progress none
check 'a tone curve of the preview is not' test "$status" -eq 0 -a ! -s stderr
clean
for tone in none pbr-neutral agx; do
    run render "${ok[@]}" --size 8x8 --exposure 3 --tone $tone --stats out/stats.json
    check "--tone $tone in --stats" stat_is $tone settings tone
    mv out/x.png in/tone-$tone.png
done
run render "${ok[@]}" --size 8x8 --exposure 3
check '--tone none is the default' same_pixels out/x.png in/tone-none.png
check '--tone pbr-neutral is another picture' apart 0.01 in/tone-pbr-neutral.png in/tone-none.png
check '--tone agx is a third' apart 0.01 in/tone-agx.png in/tone-pbr-neutral.png
"$glint" render "${ok[@]}" --size 8x8 --exposure 3 --tone agx --progress none --compression 0
check '--tone agx: the file says so' grep -qaF 'glint:tone: agx' out/x.png
"$glint" render "${ok[@]}" --size 8x8 --progress none --compression 0
check '--tone none: the file says nothing' test "$(grep -caF glint:tone out/x.png)" -eq 0
clean
run render in/mirror.gltf --size 8x8 -o out/x.jpg --background transparent --progress none
check 'an alpha that is not kept is said' grep -q 'warning: .*alpha' stderr
clean
(exec 2>&- && "$glint" render in/mirror.gltf --size 8x8 -o out/x.png)
check 'stderr closed: the image is whole' begins_with out/x.png 89504e470d0a1a0a
clean

# ---- layers -------------------------------------------------------------------------------------

# has_channels NAME…: the EXR's header has exactly these channels beside R, G, B and A.
has_channels() {
    local name
    for name in "$@"; do grep -qaF "$name" out/x.exr || return 1; done
    [ "$(head -c 900 out/x.exr | tr '\0' '\n' |
        grep -caxE '[a-z]+\.(surfaces|count|weight|index|[XYZRGB])|Z')" -eq $# ]
}
renders '--aov all' out/x.exr --aov all --compression none --depth 1
check '--aov all: every layer' has_channels surfaces.count tir.count truncated.weight triangle.index \
    material.index object.index face.index Z normal.X normal.Y normal.Z albedo.R albedo.G albedo.B
cp out/x.exr in/layers.exr
clean
renders 'without them' out/x.exr --depth 1
check 'readers find the picture' same_pixels in/layers.exr out/x.exr
clean
renders '--aov tir,surfaces,tir' out/x.exr --aov tir,surfaces,tir --exr-type float
check '--aov tir,surfaces,tir: two layers' has_channels tir.count surfaces.count
clean
renders '--aov object,material' out/x.exr --aov object,material
check 'the names of objects' grep -qaF '{"0":"triangle"}' out/x.exr
check 'the names of materials' grep -qaF '{"0":"chrome"}' out/x.exr
clean
run render in/mirror.gltf --size 8x8 -o out/x.exr --aov depth
check 'the old name of a layer: its old channel' has_channels depth.surfaces
check 'the old name of a layer: said once' test "$(grep -c "is called 'surfaces' now" stderr)" -eq 1
clean
run render in/mirror.gltf --size 8x8 -o out/x.exr --aov normal --compression dwaa
check 'a compression that loses digits of a layer is said' grep -q 'dwaa loses digits of the layers' stderr
clean
run render in/mirror.gltf --size 8x8 -o out/x.exr --aov all --aov face --stats out/stats.json
check 'the last list counts' has_channels face.index
check '--aov: the feature is compiled' stat_is true plan features DIAGNOSTICS compiled
clean
renders 'a frame without layers' out/x.exr
check 'has none' has_channels
clean

# ---- progress -----------------------------------------------------------------------------------

run render "${ok[@]}" --size 8x8 --progress none
check '--progress none is silent' test "$status" -eq 0 -a ! -s stderr
clean
run render "${ok[@]}" --size 8x8
check 'plain lines where stderr is no terminal' test "$(grep -vc '^glint: ' stderr)" -eq 0
check 'and a summary' grep -q '^glint: out/x.png: 8x8, ' stderr
clean
run render "${ok[@]}" --size 8x8 --progress json
cp stderr progress.jsonl
check '--progress json: an object a line' test "$(grep -vc '^{"event": ".*}$' progress.jsonl)" -eq 0
while IFS= read -r line; do
    printf '%s\n' "$line" >line.json
    "$json_get" line.json event || echo bad
done <progress.jsonl >events
check '--progress json: valid, done at the end' test "$(tail -n 1 events)" = 'done'
check '--progress json: phases in order' test "$(grep -c phase events)" -ge 4
check '--progress json: all valid' test "$(grep -c bad events)" -eq 0
clean
run render "${ok[@]}" --size 8x8 --progress bar
check '--progress bar is erased before the summary' grep -qE $'\033\\[Kglint: out/x.png: 8x8' stderr
clean

# ---- statistics ---------------------------------------------------------------------------------

run render in/mirror.gltf --env in/sky.hdr --size 24x16 --samples 4 -o out/x.png \
    --stats out/stats.json --exposure 1.5
check '--stats: the frame' stat_is 24 settings width
check '--stats: samples' stat_is 4 settings samples
check '--stats: exposure' stat_is 1.5 settings exposure
check '--stats: depth' stat_is auto settings depth
check '--stats: primary rays' stat_is $((24 * 16 * 4)) rays primary
check '--stats: reflected rays' stat_is_positive rays reflected
check '--stats: no refracted rays' stat_is 0 rays refracted_in
check '--stats: no NaN' stat_is 0 nonfinite_pixels
check '--stats: one surface' stat_is 1 deepest_path
check '--stats: the scene' stat_is in/mirror.gltf scene name
check '--stats: its triangles' stat_is 1 scene triangle_count
check '--stats: the environment' stat_is in/sky.hdr environment name
check '--stats: its layout' stat_is latlong environment layout
check '--stats: the output' stat_is out/x.png output
check '--stats: metal is compiled' stat_is true plan features MIRROR compiled
check '--stats: glass is left out' stat_is false plan features GLASS compiled
for phase in load_scene load_environment analysis bvh irradiance cells kernel_build upload kernel \
    readback encode total; do
    check "--stats: milliseconds of $phase" "$json_get" out/stats.json milliseconds "$phase"
done
check '--stats: kernel time' stat_is_positive milliseconds kernel
check '--stats: rate' stat_is_positive mrays_per_second all
check '--stats: memory' stat_is_positive memory peak_resident_bytes
check '--stats: truncated weight' "$json_get" out/stats.json truncated_weight total
check '--stats: device' "$json_get" out/stats.json device name
check '--stats: no warnings' stat_is '[]' warnings
clean

# ---- info and devices ---------------------------------------------------------------------------

run info in/rough.gltf --env in/sky.hdr
check 'info succeeds' test "$status" -eq 0 -a ! -s stderr
for text in 'Scene in/rough.gltf' '1 triangles' 'chrome: metal' 'front: perspective' \
    'field of view 45.84° (vertical)' 'flat: orthographic' 'Environment in/sky.hdr' 'layout latlong' 'MIRROR' 'GLASS' 'left out' \
    'MiB on the device' 'tree: 1 nodes, 1 clusters' 'bytes a triangle' 'rough'; do
    check "info says: $text" grep -qF "$text" stdout
done
run info in/rough.gltf --depth 2 --size 64x64 --samples 4 --json
cp stdout out/stats.json
check 'info --json: triangles' stat_is 1 scene triangle_count
check 'info --json: material' stat_is metal scene materials 0 kind
check 'info --json: depth' stat_is 2 settings depth
check 'info --json: texels' stat_is auto settings texels
check 'info --json: they are half' stat_is half plan texels
check 'info --json: filter' stat_is bilinear settings filter
check 'info --json: secondary rays' "$json_get" out/stats.json plan secondary_rays
check 'info --json: and why' "$json_get" out/stats.json plan texels_reason
check 'info --json: what that adds' stat_is_positive plan texels_relative_rmse
check 'info --json: features' stat_is true plan features SUPERSAMPLING compiled
check 'info --json: memory' stat_is_positive device_bytes
check 'info --json: clusters' stat_is 1 bvh clusters
check 'info --json: fill' stat_is 0.0625 bvh fill
check 'info --json: bytes per triangle' stat_is_positive bvh bytes_per_triangle
run info in/coated.gltf --json
cp stdout out/coated.json
check 'info --json: the warning' "$json_get" out/coated.json warnings 0
wine=${BASH_SOURCE[0]%/*}/../../scenes/wine.gltf
run info "$wine"
check 'info names solids that touch' grep -q '"goblet" (node 1, glass) touches "wine" (node 2, wine)' stdout
check 'and that overlap' grep -q '"wine" (node 2, wine) overlaps "ice" (node 3, ice): where .* it is ice' stdout
run info "$wine" --json
cp stdout out/stats.json
check 'info --json: contacts' stat_is overlap scene contacts 1 kind
check 'info --json: which is there' stat_is 2 scene contacts 1 there
check 'info --json: by its volume' stat_is true scene contacts 1 is_guess
run render "$wine" --strict --size 8x8 --depth 1 -o out/x.png --progress none
check '--strict: solids that touch' test "$status" -eq 3 -a ! -e out/x.png
check '--strict: which' grep -q '"goblet" .* touches "wine" .*, and 2 more pairs: where both are' stderr
# One triangle of glass with a volume: a solid that is open.
glass='"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 1}'
sed -e 's/"metallicFactor": 1/"metallicFactor": 0/' -e "s/\"name\": \"chrome\",/& \"extensions\": {$glass},/" \
    in/mirror.gltf >in/pane.gltf
run info in/pane.gltf
check 'info says that a solid is open' \
    grep -q 'pane.gltf: "triangle" (node 0, chrome) is open: light .* (close the mesh, ' stdout
run render in/pane.gltf --strict --size 8x8 --depth 1 -o out/x.png --progress none
check '--strict: a solid is open' test "$status" -eq 3 -a ! -e out/x.png
check '--strict: it is named' grep -q '"triangle" (node 0, chrome) is open: ' stderr
run info in/mirror.gltf --env in/sun.hdr
check 'info says why texels are float' grep -q 'float texels: .* 131072' stdout
clean
OCL_ICD_VENDORS=$work/in/empty "$glint" info in/mirror.gltf >stdout 2>stderr
check 'info works without a device' test $? -eq 0
check 'and says that there is no plan' grep -q '  none: ' stdout
OCL_ICD_VENDORS=$work/in/empty "$glint" devices >stdout 2>stderr
check 'devices without a device: exit status 4' test $? -eq 4
OCL_ICD_VENDORS=$work/in/empty "$glint" render in/mirror.gltf -o out/x.png >stdout 2>stderr
check 'render without a device: exit status 4' test $? -eq 4 -a "$(wc -l <stderr)" -eq 1
check 'and no file' test -z "$(ls -A out)"
run devices
check 'devices prints a table' grep -q '^ *0  ' stdout
run devices --json
cp stdout out/stats.json
check 'devices --json: an index' stat_is 0 0 index
clean

# ---- signals ------------------------------------------------------------------------------------

# stops SIGNAL STATUS: sends a signal in the middle of a frame.
stops() {
    "$glint" render in/mirror.gltf --size 8192x4096 --samples 256 -o out/x.png --stats out/x.json \
        --progress plain >stdout 2>stderr &
    local process=$! waited=0
    until grep -q 'rendering' stderr || [ "$waited" -ge 600 ]; do
        sleep 0.1
        waited=$((waited + 1))
    done
    sleep 0.3
    kill "-$1" "$process"
    local begun=$SECONDS
    wait "$process"
    status=$?
    check "$1 in the middle of a frame: exit status $2" test "$status" -eq "$2"
    check "$1: promptly" test $((SECONDS - begun)) -le 5
    check "$1: nothing left behind" test -z "$(ls -A out)"
    clean
}
stops INT 130
stops TERM 143
for delay in 0.01 0.05 0.2; do
    "$glint" render in/mirror.gltf --size 4096x4096 --samples 64 -o out/x.png >stdout 2>stderr &
    process=$!
    sleep "$delay"
    kill -TERM "$process"
    wait "$process"
    check "TERM after $delay s: exit status 143" test $? -eq 143
    check "TERM after $delay s: nothing left behind" test -z "$(ls -A out)"
    clean
done

finish
