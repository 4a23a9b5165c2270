#!/usr/bin/env bash
# Tests what glint does if glint-codec is missing, is of another version, or dies, and that no codec
# outlives glint.
# codec_checks.sh GLINT JSON_GET OTHER_CODEC SCENES
# shellcheck source-path=SCRIPTDIR source=common.sh
. "$(dirname -- "$0")/common.sh"
built=$(dirname "$glint")/glint-codec
other_codec=$(readlink -f -- "$3")
scene=$(readlink -f -- "$4")/mirror_sphere.gltf
export POCL_CACHE_DIR=$work/cache

# A glint with a codec of its own, which can be replaced.
mkdir bin
cp "$glint" bin/glint
cp "$(dirname "$glint")/glint-decoder" bin/
glint=$work/bin/glint
codec=$work/bin/glint-codec
picture=("$scene" --size 16x9 --progress none)

# ---- No codec, or another one -------------------------------------------------------------------

refuses 5 'glint-codec: the program that decodes and encodes images is not there' \
    render "${picture[@]}" -o out/x.exr
refuses 3 'glint-codec: the program that decodes and encodes images is not there' \
    info "$scene" --env "$(dirname "$scene")/axes.hdr"
run render "${picture[@]}" -o out/x.png
check 'PNG needs no codec' test "$status" -eq 0 -a -s out/x.png -a ! -s stderr
clean
cp "$other_codec" "$codec"
refuses 5 'glint-codec: it is of glint 0.0.0' render "${picture[@]}" -o out/x.exr
refuses 3 'glint-codec: it is of glint 0.0.0' info "$scene" --env "$(dirname "$scene")/axes.hdr"
export OTHER_CODEC=packet
refuses 5 'glint-codec: it is of glint of an unknown version, not' render "${picture[@]}" -o out/x.exr
OTHER_CODEC=halfs
printf '\x76\x2f\x31\x01\x02\0\0\0' >in/layers.exr
refuses 3 'in/layers.exr: the decoder failed on it' \
    relight in/layers.exr --env "$(dirname "$scene")/axes.hdr" -o out/x.png
unset OTHER_CODEC
rm "$codec"
# shellcheck disable=SC2016 # the codec's own $$
printf '#!/bin/sh\nkill -9 $$\n' >"$codec"
chmod +x "$codec"
refuses 5 'glint-codec: it was ended by signal 9' render "${picture[@]}" -o out/x.exr
rm "$codec"
cp "$built" "$codec"
run render "${picture[@]}" -o out/x.exr
check 'with its codec glint writes an EXR' test "$status" -eq 0 -a -s out/x.exr -a ! -s stderr
clean

# ---- A codec that dies, and a glint that dies ----------------------------------------------------

children() { # PID
    cat "/proc/$1/task/"*/children 2>/dev/null
}
# first_child PID: waits for it.
first_child() {
    local found=
    until [ -n "$found" ] || ! kill -0 "$1" 2>/dev/null; do
        found=$(children "$1" | awk '{ print $1 }')
        [ -n "$found" ] || sleep 0.01
    done
    echo "$found"
}
is_gone() { # PID: it ends within ten seconds; a zombie has ended
    for _ in {1..1000}; do
        case $(sed -n 's/^State:[^A-Z]*\([A-Z]\).*/\1/p' "/proc/$1/status" 2>/dev/null) in
        '' | Z) return 0 ;;
        esac
        sleep 0.01
    done
    return 1
}

# begin: renders a sequence whose encoder stands still, so that requests wait. Sets `process`,
# `decoder` (the codec) and `encoder`.
begin() {
    rm -rf out/seq
    "$glint" render "${picture[@]}" --turntable 200 -o out/seq/f.####.exr >stdout 2>stderr &
    process=$!
    decoder=$(first_child "$process")
    encoder=$(first_child "$decoder")
    kill -STOP "$encoder"
    sleep 0.3 # the writers ask for more frames
}
ends_well() { # WHAT
    wait "$process"
    status=$?
    check "$1: exit status 5" test "$status" -eq 5
    check "$1: one line of error" test "$(grep -c '^glint: .*could not be encoded' stderr)" -eq 1
    check "$1: no line but glint's" test -z "$(grep -v '^glint: ' stderr)"
    check "$1: nothing half-written" test -z "$(find out/seq -type f ! -name 'f.*.exr')"
    check "$1: no encoder is left" is_gone "$encoder"
    check "$1: no codec is left" is_gone "$decoder"
}

begin
kill -KILL "$encoder"
ends_well 'the encoder is killed'
begin
kill -KILL "$decoder"
ends_well 'the codec is killed'

for signal in INT TERM KILL; do
    begin
    kill "-$signal" "$process"
    wait "$process"
    check "SIG$signal: no encoder is left" is_gone "$encoder"
    check "SIG$signal: no codec is left" is_gone "$decoder"
    rm -rf out/seq
done

# A glint that ends before its codec is ready takes it along.
"$glint" render missing.gltf -o out/x.exr >stdout 2>stderr
check 'a mistake: exit status 3' test $? -eq 3
check 'no codec of this test is left' test -z "$(
    for program in /proc/[0-9]*/exe; do
        sleep 0.001
        [ "$(readlink "$program")" != "$codec" ] || is_gone "$(basename "$(dirname "$program")")" ||
            echo "$program"
    done
)"

finish
