#!/usr/bin/env bash
# Tests the command line of glint bench --error. error_checks.sh GLINT JSON_GET
# No check depends on time. glint compare on rendered files gives the expected errors.
root=$(readlink -f -- "$(dirname "$0")/../..")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"
scene=$root/scenes/mirror_sphere.gltf
mkdir tmp
export TMPDIR=$work/tmp

# ---- mistakes -----------------------------------------------------------------------------------

refuses 2 '--html: it belongs to --error' bench mirror --html out/a.html
refuses 2 '--no-sampling: it belongs to --error' bench mirror --no-sampling
refuses 2 '--baseline: it does not go with --error' bench mirror --error --baseline in/b.json
refuses 2 '--no-check: it does not go with --error' bench mirror --error --no-check
refuses 2 'is an input' bench "$scene" --error --html "$scene"
refuses 5 'out/missing' bench mirror --error --html out/missing/a.html
touch in/a
refuses 2 '--json goes there, too' bench mirror --error --html in/a --json in/a
for own in '--depth 2' '--min-weight 0.5' '--precision double' '--fresnel none' '--texels half' \
    '--filter mip' '--irradiance sh' '--shading vertex-color'; do
    # shellcheck disable=SC2086 # an option and its value
    refuses 2 "${own%% *}: --error tries them" bench mirror --error $own
done
OCL_ICD_VENDORS=$work/in "$glint" bench mirror --error >stdout 2>stderr
check 'no device: exit status 4' test $? -eq 4 -a "$(wc -l <stderr)" -eq 1

# ---- a run --------------------------------------------------------------------------------------

size=(--size 48x32)
run bench "$scene" --error "${size[@]}" --rounds 2 --env-rotate 20 --html out/page.html --json out/stats.json
check 'a run succeeds quietly' test "$status" -eq 0 -a ! -s stderr
check 'and leaves no temporary file' test -z "$(ls -A tmp)"
for text in 'reference --precision double' 'colours at vertices' 'depth 1' 'double precision' \
    'error of sampling' 'filter mip'; do
    check "the table says: $text" grep -qF -- "$text" stdout
done
check 'JSON: format' stat_is 'glint bench --error' format
check 'JSON: the command' stat_is "glint bench --error --size 48x32 --rounds 2 --env-rotate 20 --html out/page.html \
--json out/stats.json $scene" command
check 'JSON: fingerprints' test "$("$json_get" out/stats.json scenes 0 scene fingerprint | wc -c)" -eq 33
rungs=0
while "$json_get" out/stats.json scenes 0 rungs "$rungs" name >/dev/null 2>&1; do
    check "JSON: rung $rungs was timed twice" stat_is 2 scenes 0 rungs "$rungs" milliseconds count
    check "JSON: rung $rungs has nothing that is not finite" stat_is 0 scenes 0 rungs "$rungs" error nonfinite_pixels
    rungs=$((rungs + 1))
done
check 'JSON: the rungs of a convex mirror' test "$rungs" -eq 5
last=$((rungs - 1))
is_tiny() { # KEY…
    "$json_get" out/stats.json "$@" | awk '{ exit !($1 >= 0 && $1 < 1e-6) }'
}
check 'double precision is the reference, where no path splits' \
    is_tiny scenes 0 rungs "$last" error relative_rmse
check 'with the same directions' is_tiny scenes 0 rungs "$last" directions largest_degrees
check 'and nothing beats it' stat_is true scenes 0 rungs "$last" is_pareto_optimal
check 'vertices have no directions' stat_is null scenes 0 rungs 0 directions
check 'JSON: no pictures' test "$("$json_get" out/stats.json scenes 0 rungs 0 picture 2>/dev/null | wc -c)" -le 5
check 'JSON: sampling' stat_is 64 scenes 0 sampling reference_samples
for row in 0 1 2 3; do
    check "JSON: sampling, row $row" stat_is_positive scenes 0 sampling rows "$row" error relative_rmse
done

# The error must equal the comparison of files rendered with the rung's options.
render() { # OUT OPTION…
    local out=$1
    shift
    "$glint" render "$scene" -o "$out" "${size[@]}" --env-rotate 20 --exr-type float --progress none "$@"
}
options_of() { # KEY…
    "$json_get" out/stats.json scenes 0 "$@" options
}
# shellcheck disable=SC2046 # a list of options
check 'the reference is rendered' render out/reference.exr $(options_of reference)
for rung in 0 1 2 3; do
    # shellcheck disable=SC2046
    check "rung $rung is rendered" render out/rung.exr $(options_of rungs "$rung")
    "$glint" compare out/rung.exr out/reference.exr --json out/compare.json >/dev/null
    want=$("$json_get" out/compare.json error relative_rmse 2>/dev/null)
    got=$("$json_get" out/stats.json scenes 0 rungs "$rung" error relative_rmse)
    check "its error is that of the files: $got, $want" test -n "$want" -a "$got" = "$want"
done

check 'JSON: complete' stat_is true complete
printf '{"asset": ' >in/broken.gltf
run bench "$scene" in/broken.gltf --error --no-sampling "${size[@]}" --rounds 1 --html out/other.html --json out/other.json
check 'a second scene that fails: its exit status' test "$status" -eq 3
check 'a second scene that fails: the first is there' test "$("$json_get" out/other.json scenes 0 name)" = "$scene"
check 'a second scene that fails: marked as incomplete' test "$("$json_get" out/other.json complete)" = false
check 'a second scene that fails: no pictures, no page' \
    test ! -e out/other.html -a "$(grep -c '"picture"' out/other.json)" -eq 0
check 'the page is HTML' grep -q '^<!DOCTYPE html>' out/page.html
check 'and asks for nothing from elsewhere' test "$(grep -cE '(src|href)="?[a-z]+://|@import|url\(' out/page.html)" -eq 0
check 'a picture and a map of each rung' test "$(grep -o '<img' out/page.html | wc -l)" -eq $((2 * rungs))
check 'a point of each rung' test "$(grep -o '<circle' out/page.html | wc -l)" -eq "$rungs"
if command -v tidy >/dev/null; then
    check 'and is valid' tidy -q -e --warn-proprietary-attributes no out/page.html
else
    skip 'and is valid' 'tidy is not installed'
fi
clean
finish
