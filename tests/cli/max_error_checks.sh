#!/usr/bin/env bash
# Tests the command line of glint render --max-error. max_error_checks.sh GLINT JSON_GET SCENES
# glint compare on files gives the errors, with a rendered reference.
scenes=$(readlink -f -- "$3")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"
cp "$scenes"/prism.* "$scenes"/mirror_sphere.* "$scenes"/clockwork.* "$scenes"/axes.hdr in/
scene=in/prism.gltf
size=(--size 96x54)
ok=("$scene" -o out/a.exr "${size[@]}")

# ---- mistakes -----------------------------------------------------------------------------------

for value in 0 -0.1 nan inf 11 1e-10 x ''; do
    refuses 2 '--max-error' render "${ok[@]}" --max-error "$value"
done
for own in '--depth 2' '--min-weight 0.5' '--precision double' '--mend 0.3' '--fresnel none' '--texels half' \
    '--irradiance sh' '--shading vertex-color'; do
    # shellcheck disable=SC2086 # an option and its value
    refuses 2 "--max-error: it chooses what ${own%% *} says" render "${ok[@]}" --max-error 0.1 $own
done
OCL_ICD_VENDORS=$work/in "$glint" render "${ok[@]}" --max-error 0.1 >stdout 2>stderr
check 'no device: exit status 4' test $? -eq 4 -a "$(wc -l <stderr)" -eq 1 -a -z "$(ls -A out)"

# ---- one frame ----------------------------------------------------------------------------------

exact=(--progress none --exr-type float "${size[@]}")
run render "$scene" -o reference.exr "${exact[@]}" --precision double --depth 64 --min-weight 0.0000152587890625
check 'the reference is rendered' test "$status" -eq 0
sizes=
for bound in 0.1 0.01 0.001 0.0001; do
    run render "$scene" -o out/a.exr "${exact[@]}" --max-error $bound --stats out/stats.json
    check "$bound: exit status 0, nothing said" test "$status" -eq 0 -a ! -s stdout -a ! -s stderr
    check "$bound: kept" within $bound out/a.exr reference.exr
    "$glint" compare out/a.exr reference.exr --json out/compare.json >/dev/null
    is=$("$json_get" out/compare.json error relative_rmse)
    said=$("$json_get" out/stats.json max_error error)
    # The grid is the frame, and its reference ends within a 256th of the bound; files hold floats.
    check "$bound: what is said of it, $said, is so: $is" \
        awk -v a="$is" -v b="$said" -v e=$bound 'BEGIN { exit !(a <= b + 0.05 * e && b <= a + 0.05 * e) }'
    check "$bound: the grid is the frame" stat_is true max_error grid_is_frame
    check "$bound: its pixels" stat_is 5184 max_error grid_pixels
    for key in max_error settings; do
        what=bound
        [ $key = max_error ] || what=max_error
        check "$bound: $key, $what" awk -v a="$("$json_get" out/stats.json $key $what)" -v b=$bound 'BEGIN { exit a != b }'
    done
    # shellcheck disable=SC2046 # a list of options
    run render "$scene" -o out/b.exr "${exact[@]}" $("$json_get" out/stats.json max_error options)
    check "$bound: the options that are said make the same picture" same_pixels out/a.exr out/b.exr
    sizes+="$("$json_get" out/stats.json rays all) "
done
check 'a smaller bound never costs fewer rays' test "$(tr ' ' '\n' <<<"${sizes% }" | sort -n | tr '\n' ' ')" = "$sizes"

run render "$scene" -o out/a.exr "${size[@]}" --max-error 0.01
check 'a frame is told of' grep -qE '^glint:   error 0\.00[0-9]+ of 0\.01 allowed, by --min-weight 0\.[0-9]+ \(chosen on 5184 of its pixels' stderr
if command -v exrheader >/dev/null; then
    exrheader out/a.exr >header.txt
    for name in max_error error options; do
        check "the file says glint:$name" grep -q "^glint:$name " header.txt
    done
else
    skip 'what the file says' 'exrheader is not installed'
fi
run render "$scene" -o out/a.exr "${exact[@]}" --max-error 0.01
check 'layers beside it' "$glint" render "$scene" -o out/layers.exr "${exact[@]}" --max-error 0.01 --aov all
check 'change no pixel' same_pixels out/a.exr out/layers.exr
run render in/mirror_sphere.gltf -o out/b.exr "${exact[@]}" --max-error 0.01 --stats out/stats.json
check 'what is proved exact is taken' stat_is '--depth auto' max_error options
run render "$scene" -o out/a.png --max-error 5 --size 8x8
check 'a PNG, too' test "$status" -eq 0 -a -s out/a.png
clean

# ---- sequences ----------------------------------------------------------------------------------

turn=(render "$scene" --turntable 4 --progress none "${size[@]}" --max-error 0.02)
run "${turn[@]}" -o out/f.#.exr --stats out/stats.jsonl
check 'a sequence: exit status 0' test "$status" -eq 0
tail -n 1 out/stats.jsonl >out/stats.json
check 'all rendered' stat_is 4 rendered
sed -n 3p out/stats.jsonl >out/stats.json
check 'the choice of each frame' stat_is_positive max_error choosing_rays
mkdir parts
for part in 1 2; do
    run "${turn[@]}" -o parts/f.#.exr --shard $part/2
done
for k in 1 2 3 4; do
    check "parts: frame $k has the same pixels" same_pixels "out/f.$k.exr" "parts/f.$k.exr"
done
rm out/f.2.exr
touch -d 2020-01-01 out/*.exr
run "${turn[@]}" -o out/f.#.exr --skip-existing
check 'a restart renders what is missing alone' \
    test "$status" -eq 0 -a "$(find out -name '*.exr' -newermt 2021-01-01)" = out/f.2.exr
check 'and the same' same_pixels out/f.2.exr parts/f.2.exr
touch -d 2020-01-01 out/*.exr
run "${turn[@]}" -o out/f.#.exr --skip-existing --max-error 0.03
check 'another bound: all again' test "$(find out -name '*.exr' -newermt 2021-01-01 | wc -l)" -eq 4
run render "$scene" --turntable 4 --progress none "${size[@]}" -o out/f.#.exr --skip-existing
check 'none: all again' test "$(grep -c 'made from other settings\|made from another' stderr)" -eq 4
clean

# Moving objects under changing light: each frame of a sequence must equal the single frame.
for k in 1 2 3; do
    "$glint" env in/axes.hdr in/light.$k.exr --env-rotate $((k * 50)) --to latlong --size 128 2>/dev/null
done
moving=(render in/clockwork.gltf --fps 1 --env in/light.#.exr --progress none "${size[@]}" --exr-type float)
run "${moving[@]}" --frames 1-3 --max-error 0.02 -o out/m.#.exr
check 'moving, the light too: exit status 0' test "$status" -eq 0
for k in 1 2 3; do
    run "${moving[@]}" --frames $k --max-error 0.02 -o parts/m.#.exr
    check "frame $k: by itself it is the same" same_pixels out/m.$k.exr parts/m.$k.exr
    run "${moving[@]}" --frames $k --precision double --depth 64 --min-weight 0.0000152587890625 -o parts/r.#.exr
    check "frame $k: within the bound" within 0.02 out/m.$k.exr parts/r.$k.exr
done
check 'and they are three pictures' apart 0.01 out/m.1.exr out/m.2.exr
check 'all of them' apart 0.01 out/m.2.exr out/m.3.exr
clean
finish
