#!/usr/bin/env bash
# Tests what glint does if glint-decoder is missing, is of another version, dies, hangs or lies, and
# that none is left.
# decoder_checks.sh GLINT JSON_GET OTHER_DECODER SCENES
# shellcheck source-path=SCRIPTDIR source=common.sh
. "$(dirname -- "$0")/common.sh"
built=$(dirname "$glint")/glint-decoder
other_decoder=$(readlink -f -- "$3")

# A glint with a decoder of its own, which can be replaced; and a scene beside what it must not read.
mkdir bin scene scene/folder
cp "$glint" bin/glint
cp "$4/mirror_sphere.gltf" scene/it.gltf
cp "$4"/*.bin scene 2>/dev/null || true
echo secret >in/secret
mkfifo scene/pipe
glint=$work/bin/glint
decoder=$work/bin/glint-decoder

refuses 3 'scene/it.gltf: glint-decoder: the program that reads scenes is not there' info scene/it.gltf
cp "$other_decoder" "$decoder"
refuses 3 'glint-decoder: it is of glint 0.0.0, not of' info scene/it.gltf
export OTHER_DECODER=packet
refuses 3 'scene/it.gltf: the decoder failed on it' info scene/it.gltf
OTHER_DECODER=dies
refuses 3 'xxx: the decoder failed on it: it is damaged or unusual' info scene/it.gltf
OTHER_DECODER=hangs
refuses 3 'scene/it.gltf: the decoder failed on it' info scene/it.gltf
OTHER_DECODER=empty
refuses 3 'glint-decoder gave a damaged document' info scene/it.gltf
OTHER_DECODER=asks
outside="0 lies outside the scene's folder (put the file beside the scene, or below); "
refuses 3 "it.gltf: ${outside}${outside}0 it is no regular file; 0 it is a folder, not a file; $outside" \
    info scene/it.gltf
unset OTHER_DECODER
rm "$decoder"
printf '#!/bin/sh\nexit 9\n' >"$decoder"
chmod +x "$decoder"
refuses 3 'glint-decoder: it does not run (status 9) (install glint anew)' info scene/it.gltf
rm "$decoder"
cp "$built" "$decoder"
run info scene/it.gltf
check 'with its decoder glint reads the scene' test "$status" -eq 0 -a -s stdout

check 'no decoder of this test is left' test -z "$(
    for program in /proc/[0-9]*/exe; do
        [ "$(readlink "$program")" != "$decoder" ] || echo "$program"
    done
)"

finish
