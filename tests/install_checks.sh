#!/usr/bin/env bash
# Installs glint, renders with it, and takes the codec away. install_checks.sh BUILD
set -eu
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$1" --prefix "$prefix" >/dev/null
render() {
    "$prefix/bin/glint" render scenes/mirror_sphere.gltf --size 16x9 -o "$prefix/x.png" \
        --progress none
}
cd "$(dirname "$0")/.."
# ./glint builds the program's target alone.
[ ! -f "$1/build.ninja" ] || ninja -C "$1" -t inputs glint | grep -q libglint_codec.so
render
[ -s "$prefix/x.png" ]
rm "$prefix/x.png"

# Without the codec glint only lacks images, and says so.
rm -f "$prefix"/lib*/glint/libglint_codec.so "$prefix"/lib*/*/glint/libglint_codec.so
"$prefix/bin/glint" info scenes/mirror_sphere.gltf >/dev/null
status=0
message=$(render 2>&1) || status=$?
[ "$status" = 5 ]
[ "$(wc -l <<<"$message")" = 1 ]
grep -q '^glint: libglint_codec.so: .*(install glint anew)$' <<<"$message"
[ ! -e "$prefix/x.png" ]
