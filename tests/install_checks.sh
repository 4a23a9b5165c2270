#!/usr/bin/env bash
# Tests an installation: installs glint, renders, then replaces and removes the codec.
# install_checks.sh BUILD
set -eu
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$1" --prefix "$prefix" >/dev/null
render() { # render FILE
    "$prefix/bin/glint" render scenes/mirror_sphere.gltf --size 16x9 -o "$prefix/$1" \
        --progress none
}
cd "$(dirname "$0")/.."
# ./glint builds only the target of the program.
[ ! -f "$1/build.ninja" ] ||
    [ "$(ninja -C "$1" -t inputs glint | grep -cxE 'glint-(codec|decoder)')" = 2 ]
# Only the codec links OpenImageIO and its hundreds of libraries.
for program in bin/glint "$(cd "$prefix" && find . -name glint-decoder)"; do
    [ "$(ldd "$prefix/$program" | grep -c OpenImageIO)" = 0 ]
done
"$prefix/bin/glint" info scenes/axes.gltf --env scenes/axes.hdr >/dev/null
render x.exr
[ -s "$prefix/x.exr" ]
rm "$prefix/x.exr"

# With a codec that does not run, or without one, glint must fail to read and to write images, and
# say so.
# refused STATUS COMMAND…: the command ends with STATUS and one line, which names the codec.
refused() {
    local status=0 message
    message=$("${@:2}" 2>&1) || status=$?
    [ "$status" = "$1" ]
    [ "$(wc -l <<<"$message")" = 1 ]
    grep -q "^glint: glint-codec: .*(install glint anew)$" <<<"$message"
    [ ! -e "$prefix/x.exr" ]
}
read_image() {
    "$prefix/bin/glint" info scenes/axes.gltf --env scenes/axes.hdr
}
codec=$(find "$prefix" -name glint-codec)
rm "$codec" # it may still run
printf '#!/bin/sh\nexit 9\n' >"$codec"
chmod +x "$codec"
refused 3 read_image
refused 5 render x.exr
rm "$codec"
refused 3 read_image
refused 5 render x.exr
"$prefix/bin/glint" info scenes/mirror_sphere.gltf >/dev/null
# glint encodes PNG itself.
render x.png
[ -s "$prefix/x.png" ]
