#!/usr/bin/env bash
# Tests the command-line options --material and --variant. material_checks.sh GLINT JSON_GET SCENES
scenes=$(readlink -f -- "$3")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

cp "$scenes"/{glass_sphere,clockwork}.{gltf,bin} in/
glass=in/glass_sphere.gltf
small=(--size 48x36 --depth 2 --progress none)
name=$("$glint" info "$glass" | sed -n 's/^  0 \(.*\): solid glass.*/\1/p')

# A triangle of grey paint, with two variants. The buffer holds three positions.
buffer=$(printf '\0\0\200\277\0\0\200\277\0\0\0\0\0\0\200\077\0\0\200\277\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0' |
    base64 -w 0)
cat >in/variants.gltf <<JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0,
   "extensions": {"KHR_materials_variants": {"mappings": [
     {"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}]}}}]}],
 "extensionsUsed": ["KHR_materials_variants"], "extensionsRequired": ["KHR_materials_variants"],
 "extensions": {"KHR_materials_variants": {"variants": [{"name": "hard"}, {"name": "soft"}]}},
 "materials": [
   {"name": "grey", "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0.2, 0.2, 0.2, 1]}},
   {"name": "steel", "pbrMetallicRoughness": {"roughnessFactor": 0, "baseColorFactor": [0.5, 0.5, 0.5, 1]}},
   {"name": "clay", "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0.5, 0.4, 0.3, 1]}}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [-1, -1, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,$buffer"}]}
JSON

# ---- mistakes -----------------------------------------------------------------------------------

refuses 2 'a material and what it becomes' render "$glass" -o out/a.exr --material glass
refuses 2 'did you mean glass?' render "$glass" -o out/a.exr --material "$name=glas"
refuses 2 'ior: an index of refraction' render "$glass" -o out/a.exr --material "$name=glass,ior=0"
refuses 3 "in/glass_sphere.gltf: there is no material \"ruby\" (there is 0 \"$name\"" \
    render "$glass" -o out/a.exr --material ruby=glass
refuses 3 'in/glass_sphere.gltf: --material *=mirror,ior=2: ior changes nothing there' \
    render "$glass" -o out/a.exr --material '*=mirror,ior=2'
refuses 3 'there is no material "ruby"' info "$glass" --material ruby=glass
refuses 3 'there is no material "ruby"' capture "$glass" out/a.exr --at 0,3,0 --material ruby=glass
refuses 3 'mirror: there is no material "ruby" (there is 0 "silver")' bench mirror --material ruby=glass
refuses 3 'mirror: there is no material variant "a"' bench mirror --variant a
refuses 3 'in/glass_sphere.gltf: there is no material variant "a" (the file has none)' \
    render "$glass" -o out/a.exr --variant a
refuses 3 'there is no material variant "Hard" (there is 0 "hard", 1 "soft")' \
    render in/variants.gltf -o out/a.exr --variant Hard

# ---- effects ------------------------------------------------------------------------------------

sed 's/"ior": *[0-9.]*/"ior": 1.75/' "$glass" >in/dense.gltf
run render in/dense.gltf -o out/file.exr "${small[@]}"
run render "$glass" -o out/option.exr "${small[@]}" --material "$name=ior=1.75" --stats out/stats.json
check 'an override gives the bits of a file that says so' same_pixels out/file.exr out/option.exr
check '--stats lists it' stat_is "$name=ior=1.75" scene material_overrides 0
run render "$glass" -o out/plain.exr "${small[@]}"
check 'it changes the picture' apart 0.001 out/plain.exr out/option.exr
run render "$glass" -o out/plain.exr "${small[@]}" --frames 1 --skip-existing --material 0=ior=1.75
check 'another override is another fingerprint' same_pixels out/plain.exr out/option.exr
run render in/variants.gltf -o out/variant.exr "${small[@]}" --variant hard
run render in/variants.gltf -o out/metal.exr "${small[@]}" --material '*=metal,color=0.5,0.5,0.5'
check 'a variant gives the bits of its material' same_pixels out/variant.exr out/metal.exr
run render in/variants.gltf -o out/grey.exr "${small[@]}" --stats out/stats.json
run render in/variants.gltf -o out/paint.exr "${small[@]}" --variant soft --material '*=color=0.2,0.2,0.2'
check 'without one the plain materials are there' same_pixels out/grey.exr out/paint.exr
check '--stats: no variant' stat_is null scene variant
clean
run render in/clockwork.gltf -o out/a.##.exr --size 32x24 --frames 1,12 --material '*=unlit,color=1,0,1' \
    --depth 1 --progress none
check 'every frame is overridden' test "$status" -eq 0
run render in/clockwork.gltf -o out/b.exr --size 32x24 --frames 12 --material '*=unlit,color=1,0,1' \
    --depth 1 --progress none
check 'whatever frame it is' same_pixels out/a.12.exr out/b.exr
clean

# ---- info ---------------------------------------------------------------------------------------

run info in/variants.gltf
check 'info lists variants' grep -q '^  1 soft$' stdout
check 'info says that none is shown' grep -q 'the plain materials are shown' stdout
run info in/variants.gltf --variant 1 --material clay=mirror
check 'info says which is shown' grep -q '^  1 soft (shown)$' stdout
check 'info shows what an override made' grep -q '^  2 clay: metal.*colour (1, 1, 1)' stdout
run info in/variants.gltf --variant soft --json
cp stdout out/stats.json
check 'info --json: the variant' stat_is soft scene variant
check 'info --json: all of them' stat_is hard scene variants 0
check 'info --json: the index in the file' stat_is 2 scene materials 0 index
run info in/variants.gltf --material steel=glass
check 'info warns of what no triangle has' grep -q 'steel=glass: no triangle has this material' stdout
clean
finish
