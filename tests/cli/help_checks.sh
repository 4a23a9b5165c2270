#!/usr/bin/env bash
# Tests what glint says to users who come from other programs: help, files in place of commands, other
# renderers' options, other formats. help_checks.sh GLINT JSON_GET SCENES
scenes=$(readlink -f -- "$3")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"
cp "$scenes/mirror_sphere.gltf" in/scene.gltf
cp "$scenes/mirror_sphere.bin" in/
cp "$scenes/axes.hdr" in/sky.hdr
ok=(in/scene.gltf -o out/x.png)

# ---- help ---------------------------------------------------------------------------------------

for command in render info bench; do
    "$glint" "$command" --help >help.txt
    for words in "--help $command" "-h $command" "help $command" "$command -h" "$command -help"; do
        # shellcheck disable=SC2086 # a list of words
        run $words
        check "glint $words is the help of $command" cmp stdout help.txt
    done
done
inputs='env env-layout ball-circle ball-distance ball-fov env-flip camera eye look-at up fov elevation fit animation variant material texture-size only without scene allow-large-images device help'
# shellcheck disable=SC2046,SC2086 # lists of words
{
    check 'render --help tells every option' help_mentions render $inputs output exposure tone compression \
        exr-type preview stats progress progress-fd frames turntable fps strict skip-existing shard max-error surroundings \
        capture-size proxy env-at kernel-dir $(settings_of environment size frame device layers)
    check 'info --help tells every option' help_mentions info $inputs json \
        $(settings_of environment size frame device)
}
run render --help
check 'the help of --max-error names the settings that it chooses' \
    grep -q ' In place of --depth, --min-weight, .*--shading\. ' <(tr -s '\n ' ' ' <stdout)
check 'devices --help tells every option' help_mentions devices json help
for words in '' '--help' '-h' 'help'; do
    # shellcheck disable=SC2086 # none or one word
    run $words
    check "glint $words lists the commands" grep -q '^  render ' stdout
    check "glint $words succeeds quietly" test "$status" -eq 0 -a ! -s stderr
done
run --version
check '--version prints one version' grep -qxE 'glint [0-9]+\.[0-9]+\.[0-9]+.*' stdout
run render --help in/missing.gltf --depth 3
check 'help is given before anything is looked at' test "$status" -eq 0
run help --help
check 'glint help --help lists the commands' grep -q '^  render ' stdout

# ---- commands -----------------------------------------------------------------------------------

refuses 2 'did you mean render?' --help rendr
refuses 2 'in/scene.gltf is a file, no command (did you mean glint render in/scene.gltf -o OUT?)' in/scene.gltf
refuses 2 'did you mean glint render car.GLB -o OUT?' car.GLB --size 64x64
refuses 2 'did you mean glint render in/missing -o OUT?' in/missing
refuses 2 'in/sky.hdr is a picture, no command (did you mean glint compare' in/sky.hdr

# ---- options ------------------------------------------------------------------------------------

refuses 2 'unknown option --dof (glint has no depth of field)' render "${ok[@]}" --dof
refuses 2 'unknown option --threads (glint takes the cores' render "${ok[@]}" --threads 4
refuses 2 'unknown option --resolution (did you mean --size WxH?)' render "${ok[@]}" --resolution 64x64
refuses 2 'unknown option --spp (did you mean --samples 16?)' render "${ok[@]}" --spp=16
refuses 2 'unknown option --width (did you mean --size WxH?)' render "${ok[@]}" --width 64 --height 64
refuses 2 'unknown option --gpu (did you mean --device gpu?)' render "${ok[@]}" --gpu
refuses 2 'unknown option -spp (did you mean --samples 16?)' render "${ok[@]}" -spp 16
refuses 2 'unknown option -size (did you mean --size?)' render "${ok[@]}" -size 64x64
refuses 2 'unknown option -output (did you mean --output?)' render in/scene.gltf -output out/x.png
refuses 2 'OUT stands without an option: glint env IN OUT' env in/sky.hdr --output out/x.exr
refuses 2 'unknown option --output (did you mean --json?)' info in/scene.gltf --output x

# ---- formats ------------------------------------------------------------------------------------

printf '# exported\nv 0 0 0\n' >in/car.obj
printf 'PK\3\4\12\0\0\0' >in/car.usdz
gzip -c in/scene.gltf >in/packed.gltf
tar -cf in/car.glb in/scene.gltf
for command in 'render -o out/x.png' info 'capture out/x.exr --at 0,0,0' 'bench --rounds 1'; do
    # shellcheck disable=SC2086 # a list of words
    refuses 3 'in/car.obj: it is a Wavefront OBJ file, not glTF (import it in Blender, then File > Export' \
        ${command%% *} in/car.obj ${command#"${command%% *}"}
done
refuses 3 'in/car.usdz: it is a USD file, not glTF (' info in/car.usdz
refuses 3 'in/packed.gltf: it is packed by gzip, not glTF (unpack it' info in/packed.gltf
refuses 3 'in/car.glb: it is an archive, not glTF (unpack it' info in/car.glb
refuses 3 'in/sky.hdr: it is a picture, not glTF (give a scene; a picture can light it' render in/sky.hdr -o out/x.png

finish
