#!/usr/bin/env bash
# Tests a damaged or unreachable kernel cache: glint must print one clear line and go on.
# cache_checks.sh GLINT JSON_GET SCENES
# shellcheck source-path=SCRIPTDIR source=common.sh
. "$(dirname -- "$0")/common.sh"
scene=$3/mirror_sphere.gltf
export POCL_CACHE_DIR=$work/cache
picture=("$scene" --size 16x9 -o out/x.png --progress none)

# A cache with the kernel, and PoCL's files for it.
mkdir cache
run render "${picture[@]}"
check 'the cache is filled' test "$status" -eq 0 -a -n "$(find cache -name program.bc)"
cp -r cache good

# Runs a command on each file of this name, to damage it.
damage() { # NAME COMMAND…
    local name=$1
    shift
    rm -rf cache out/x.png
    cp -r good cache
    find cache -name "$name" -print0 | while read -rd '' file; do "$@" "$file"; done
}
empty() { : >"$1"; }
shorten() { head -c 1000 "$1" >"$1.short" && mv "$1.short" "$1"; }
# Prints glint's own messages, without those of PoCL and LLVM.
says() { grep -q "^glint: .*$work/cache: .*$1" stderr; }

damage program.bc empty
run render "${picture[@]}"
check 'an empty program: compiled anew' test "$status" -eq 0 -a -s out/x.png
check 'an empty program: a warning names the cache' says 'damaged'
run render "${picture[@]}"
check 'an empty program: once' test "$status" -eq 0 -a ! -s stderr

# dies NAME WHAT COMMAND: the driver dies in the first run, and the second run repairs the cache.
dies() {
    damage "$2" "$3"
    run render "${picture[@]}"
    check "$1: exit status 4" test "$status" -eq 4 -a ! -e out/x.png
    check "$1: a line names the cache" says 'run glint again'
    run render "${picture[@]}"
    check "$1: the next run mends it" test "$status" -eq 0 -a -s out/x.png
    check "$1: and says so" says 'compiled anew'
    run render "${picture[@]}"
    check "$1: once" test "$status" -eq 0 -a ! -s stderr
}
dies 'an empty kernel' '*.so' empty
if [ -z "${ASAN_OPTIONS-}" ]; then
    dies 'a short kernel' '*.so' shorten
else
    skip 'a short kernel' 'AddressSanitizer takes SIGBUS'
fi

# An unreachable cache: kernels go to a folder that is removed afterwards.
out_of_reach() { # NAME
    rm -f out/x.png
    mkdir -p tmp
    TMPDIR=$work/tmp run render "${picture[@]}"
    check "$1: rendered" test "$status" -eq 0 -a -s out/x.png
    check "$1: a warning names the cache" grep -q 'the kernel cache cannot be used' stderr
    check "$1: nothing is left behind" test -z "$(ls -A tmp)"
}
rm -rf cache
: >cache
out_of_reach 'a file in its place'
rm cache
POCL_CACHE_DIR=/proc/none/cache out_of_reach 'no folder'
# Names that PoCL cannot use: it holds paths of 1023 bytes, and puts its own folders below.
long_name() { # LENGTH
    local path=$work/long
    while [ ${#path} -lt "$1" ]; do path=$path/$(printf 'n%.0s' {1..99}); done
    path=${path:0:$1}
    printf %s "${path/%\//n}"
}
for length in 950 1020 1030 5000; do
    POCL_CACHE_DIR=$(long_name $length) out_of_reach "a name of $length bytes"
    check "a name of $length bytes: said" grep -q ': its name is too long for PoCL; ' stderr
done
rm -rf long tmp
# A TMPDIR that is no help leaves /tmp.
rm -f out/x.png
POCL_CACHE_DIR=/proc/none TMPDIR=/proc/none run render "${picture[@]}"
check 'a useless TMPDIR: rendered' test "$status" -eq 0 -a -s out/x.png -a "$(wc -l <stderr)" -eq 1
# shellcheck disable=SC2016 # for the other shell
if unshare -m mount --bind "$work" /mnt 2>mount.log; then
    unshare -m bash -c 'mount --bind "$1" /mnt && mount -t tmpfs -o ro none /tmp &&
        POCL_CACHE_DIR=/proc/none TMPDIR=/proc/none exec "/mnt/${2##*/}" devices' \
        _ "$(dirname "$glint")" "$glint" >stdout 2>stderr
    check 'no folder at all: exit status 4' test $? -eq 4 -a "$(wc -l <stderr)" -eq 1
    check 'no folder at all: said' \
        grep -q '^glint: /proc/none: the kernel cache cannot be used: .* (let POCL_CACHE_DIR name a' stderr
else
    skip 'no folder at all' 'nothing can be mounted'
fi
mkdir cache
if mount -t tmpfs -o size=20m none cache 2>mount.log; then
    head -c 12m /dev/zero >cache/fill
    out_of_reach 'a full disk'
    umount cache
else
    skip 'a full disk' 'no small file system can be mounted'
fi

# Variables that are set and empty are as if unset.
for variable in POCL_CACHE_DIR POCL_DEVICES POCL_MAX_WORK_GROUP_SIZE; do
    rm -rf home out/x.png
    mkdir home
    HOME=$work/home env -u POCL_CACHE_DIR -u XDG_CACHE_HOME "$variable=" "$glint" render "${picture[@]}" \
        >stdout 2>stderr
    check "$variable is empty: rendered quietly" test $? -eq 0 -a -s out/x.png -a ! -s stderr
    check "$variable is empty: the cache is where it always is" \
        test -n "$(find home/.cache/pocl/kcache -name program.bc)"
done
# Names that PoCL or its linker would misread.
mkdir names
cd names || exit 1
for name in -cache =cache . c/../d; do
    for round in 1 2; do
        POCL_CACHE_DIR=$name "$glint" render "$scene" --size 16x9 -o "$work/out/x.png" --progress none \
            >../stdout 2>../stderr
        check "a cache called $name, run $round" test $? -eq 0 -a ! -s ../stderr
    done
    check "a cache called $name: it keeps kernels" test -n "$(find "./$name" -name program.bc)"
    find . -mindepth 1 -delete
done
cd ..

# Another process's death must not mark the cache.
rm -rf cache
cp -r good cache
"$glint" render "$scene" --turntable 9999 --size 64x64 -o out/f.####.png --progress none 2>/dev/null &
for _ in $(seq 600); do # until the kernels are there
    [ ! -e out/f.0002.png ] || break
    sleep 0.1
done
kill -ABRT $! && wait $!
check 'a signal from outside: its own status' test $? -eq 134
check 'a signal from outside: no mark' test ! -e cache/glint-died
finish
