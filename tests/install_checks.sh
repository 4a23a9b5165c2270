#!/usr/bin/env bash
# Tests an installation: installs glint, renders, then removes the decoder and the codec.
# install_checks.sh BUILD
set -eu
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$1" --prefix "$prefix" >/dev/null
render() {
    "$prefix/bin/glint" render scenes/mirror_sphere.gltf --size 16x9 -o "$prefix/x.png" \
        --progress none
}
cd "$(dirname "$0")/.."
# ./glint builds only the target of the program.
[ ! -f "$1/build.ninja" ] ||
    [ "$(ninja -C "$1" -t inputs glint | grep -cE '^(libglint_codec\.so|glint-decoder)$')" = 2 ]
"$prefix/bin/glint" info scenes/axes.gltf --env scenes/axes.hdr >/dev/null
render
[ -s "$prefix/x.png" ]
rm "$prefix/x.png"

# Without the decoder glint must fail to read images, and say so.
# refused STATUS FILE: the message of the last command line names the missing file.
refused() {
    [ "$status" = "$1" ]
    [ "$(wc -l <<<"$message")" = 1 ]
    grep -q "^glint: $2: .*(install glint anew)$" <<<"$message"
    [ ! -e "$prefix/x.png" ]
}
rm -f "$prefix"/lib*/glint/glint-decoder "$prefix"/lib*/*/glint/glint-decoder
render
rm "$prefix/x.png"
status=0
message=$("$prefix/bin/glint" info scenes/axes.gltf --env scenes/axes.hdr 2>&1) || status=$?
refused 3 glint-decoder

# Without the codec glint cannot write images.
rm -f "$prefix"/lib*/glint/libglint_codec.so "$prefix"/lib*/*/glint/libglint_codec.so
"$prefix/bin/glint" info scenes/mirror_sphere.gltf >/dev/null
status=0
message=$(render 2>&1) || status=$?
refused 5 libglint_codec.so
