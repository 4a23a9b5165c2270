#!/usr/bin/env bash
# Tests which kernels run: general kernels that glint warm compiled, special ones, or what there is.
# kernel_checks.sh GLINT JSON_GET SCENES
# shellcheck source-path=SCRIPTDIR source=common.sh
. "$(dirname -- "$0")/common.sh"
scene=$3/mirror_sphere.gltf
export POCL_CACHE_DIR=$work/cache
picture=("$scene" --size 16x9 -o out/x.exr --stats out/stats.json --progress none)

check 'warm --help tells every option' help_mentions warm device precision lists build-options help
lists_it() { "$glint" --help | grep -q '^ *warm '; }
check 'glint --help lists it' lists_it
refuses 2 'unknown option' warm --nonsense
refuses 2 'float' warm --precision half
refuses 4 'nothing' warm --device nothing
refuses 2 'leave out --precision' warm --build-options '-DGLINT_WIDTH=8' --precision float
refuses 2 'leave out --precision' warm --build-options '-DGLINT_WIDTH=8' --lists

# A cache that keeps nothing: there is nothing to warm.
mkdir tmp
echo x >in/file
TMPDIR=$work/tmp POCL_CACHE_DIR=$work/in/file refuses 5 'in/file: the kernel cache cannot be used: ' warm
check 'a cache that cannot be used: nothing is left' test -z "$(ls -A tmp)"
POCL_KERNEL_CACHE=0 refuses 5 'POCL_KERNEL_CACHE=0' warm

# An empty cache: no general kernel delays the first picture.
run render "${picture[@]}"
check 'an empty cache: special kernels' stat_is special kernels
run render "${picture[@]}" --kernels general
check 'asked for: general kernels' stat_is 'general (mirrors)' kernels
cp out/x.exr general.exr
run render "${picture[@]}"
check 'both are compiled: special kernels' stat_is special kernels
run compare out/x.exr general.exr --fail-above max=0
check 'both show the same' test "$status" -eq 0

# A cache that holds general kernels alone.
rm -rf cache
run warm
check 'warm compiles three kernels' test "$status" -eq 0 -a "$(grep -c compiled stdout)" -eq 3
run warm
check 'warm keeps them' test "$status" -eq 0 -a "$(grep -c cached stdout)" -eq 3
run render "${picture[@]}"
check 'warm: general kernels' stat_is 'general (mirrors)' kernels
run render "$3/glass_sphere.gltf" "${picture[@]:1}"
check 'warm: general kernels for paths' stat_is 'general (paths)' kernels
run render "${picture[@]}" --shading vertex-color
check 'warm: special kernels where no general one serves' stat_is special kernels
run render "${picture[@]}" --kernels special
check 'warm: special kernels, asked for' stat_is special kernels

# Lights that only lobes of metal show.
lit=("$3/lights.gltf" --material '*=metallic=1,roughness=0.4' --size 16x9 --progress none)
run render "${lit[@]}" --kernels special -o out/special.exr
check 'lights without paint: special kernels' test "$status" -eq 0
run render "${lit[@]}" --kernels general -o out/general.exr
run compare out/special.exr out/general.exr --fail-above max=0
check 'lights without paint: the same picture' test "$status" -eq 0

# A long sequence begins with general kernels; special ones are compiled meanwhile.
clean
refuses 2 'GLINT_WIDTH' warm --build-options '-w'
stamps() { find cache/glint -type f | wc -l; }
before=$(stamps)
"$glint" render "$3/glass_sphere.gltf" --turntable 9999 --samples 4 -o out/f.####.png --progress none 2>stderr &
for _ in $(seq 900); do
    [ "$(stamps)" -eq "$before" ] || break
    sleep 0.1
done
check 'a long sequence: special kernels are compiled meanwhile' test "$(stamps)" -gt "$before"
kill -INT $!
wait $!
check 'a long sequence: stopped' test $? -eq 130
rm -rf out/*
"$glint" render "$3/glass_sphere.gltf" --turntable 9999 --samples 4 -o out/f.####.png --progress none 2>stderr &
sleep 1
check 'a long sequence: one process is enough' test -z "$(pgrep -P $!)"
kill -INT $!
wait $!
rm -rf out/*

# Stamps that are wrong, or that PoCL does not stand behind, cost time alone.
mv cache/glint stamps
rm -rf cache
mkdir cache
mv stamps cache/glint
run render "${picture[@]}"
check 'stamps without kernels: rendered' test "$status" -eq 0 -a -s out/x.exr
POCL_KERNEL_CACHE=0 run render "${picture[@]}"
check 'PoCL keeps nothing: special kernels' stat_is special kernels

# Eight processes and one cache: two warm it, six render.
rm -rf cache
for i in 1 2; do "$glint" warm >"warm$i.txt" 2>&1 & done
for i in 1 2 3 4 5 6; do
    "$glint" render "$scene" --size 16x9 -o "out/p$i.exr" --progress none 2>"p$i.txt" &
done
wait
check 'eight processes: six pictures' test "$(find out -name 'p?.exr' | wc -l)" -eq 6
for i in 2 3 4 5 6; do
    run compare "out/p$i.exr" out/p1.exr --fail-above max=0
    check "eight processes: picture $i is picture 1" test "$status" -eq 0
done
check 'eight processes: all warm' test "$(cat warm?.txt | grep -cE ' (compiled|cached) ')" -eq 6
rm -rf out/*

# A process that is killed while it compiles.
rm -rf cache
"$glint" warm >/dev/null 2>&1 &
sleep 1
pkill -KILL -P $! 2>/dev/null
kill -KILL $! 2>/dev/null
{ wait; } 2>/dev/null
run render "${picture[@]}"
check 'killed while it compiled: the next run renders' test "$status" -eq 0 -a -s out/x.exr
finish
