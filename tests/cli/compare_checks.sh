#!/usr/bin/env bash
# Tests the command line of glint compare. compare_checks.sh GLINT JSON_GET MAKE_EXR
make_exr=$(readlink -f -- "$3")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# ---- inputs -------------------------------------------------------------------------------------

# exr NAME CHANNELS VALUES [X Y VALUE]…: writes 8 × 4 constant pixels, except for the given pixels.
exr() {
    local name=$1 channels=$2 values=$3
    shift 3
    "$make_exr" "in/$name.exr" "$channels" "$values" 0,0,7,3 0,0,7,3 "$@"
}
exr half B,G,R 0.5,0.5,0.5
exr same B,G,R 0.5,0.5,0.5
exr brighter B,G,R 0.75,0.75,0.75
exr one_off B,G,R 0.5,0.5,0.5 5 2 0.75
exr nan B,G,R 0.5,0.5,0.5 5 2 nan 6 2 nan
exr infinite B,G,R 0.5,0.5,0.5 0 3 inf
exr all_nan B,G,R nan,nan,nan
exr black B,G,R 0,0,0
exr grey Y 0.5
exr alpha A,B,G,R 0.75,0.5,0.5,0.5
exr grey_alpha A,Y 1,0.5
exr layer beauty.B,beauty.G,beauty.R 0.5,0.5,0.5
exr layers a.B,a.G,a.R,b.B,b.G,b.R 1,1,1,1,1,1
exr parts depth=Z/rgba=B,G,R 7,0.5,0.5,0.5
exr two_parts left=B,G,R/right=B,G,R 1,1,1,0.5,0.5,0.5
exr depth Z,ZBack 1,1
"$make_exr" in/wide.exr B,G,R 0.5,0.5,0.5 0,0,8,3 0,0,8,3
# The data window covers the right half; pixels outside it are 0.
"$make_exr" in/cropped.exr B,G,R 0.5,0.5,0.5 4,0,7,3 0,0,7,3
# The data window exceeds the display window on all sides; only the display window counts.
"$make_exr" in/overscan.exr B,G,R 0.5,0.5,0.5 -2,-1,9,4 0,0,7,3 -2 -1 100 9 4 100
"$make_exr" in/moved.exr B,G,R 0.5,0.5,0.5 10,20,17,23 10,20,17,23
printf 'not an image' >in/text.png
head -c 300 in/half.exr >in/short.exr

# ---- help and mistakes --------------------------------------------------------------------------

check 'compare --help tells every option' help_mentions compare allow-large-images fail-above fail-below output heat \
    json help
for metric in rmse relative-rmse mae p99 max differing nan infinite alpha psnr; do
    check "and $metric" grep -qw -- "$metric" help.txt
done
run --help
check 'glint --help lists it' grep -q '^  compare ' stdout

ok=(in/half.exr in/brighter.exr)
refuses 2 'IMAGE is missing' compare
refuses 2 'REFERENCE is missing' compare in/half.exr
refuses 2 'IMAGE is missing' compare '' in/half.exr
refuses 2 'REFERENCE is missing' compare in/half.exr ''
refuses 2 "unexpected argument 'in/same.exr'" compare "${ok[@]}" in/same.exr
for bound in rmse =1 '' rmse= rmse=x rmse=-1 rmse=nan rmse=inf rmse=1x; do
    refuses 2 '--fail-above' compare "${ok[@]}" --fail-above "$bound"
    refuses 2 '--fail-below' compare "${ok[@]}" --fail-below "${bound/rmse/psnr}"
done
refuses 2 '--fail-above' compare "${ok[@]}" --fail-above
refuses 2 'unknown metric rsme (did you mean rmse?)' compare "${ok[@]}" --fail-above rsme=1
refuses 2 'unknown metric psrn (did you mean psnr?)' compare "${ok[@]}" --fail-below psrn=1
refuses 2 'unknown metric loudness' compare "${ok[@]}" --fail-above loudness=1
refuses 2 'give --fail-below psnr=40' compare "${ok[@]}" --fail-above psnr=40
refuses 2 'give --fail-above max=1' compare "${ok[@]}" --fail-below max=1
refuses 2 '--heat' compare "${ok[@]}" --heat relative
refuses 2 '--heat warm' compare "${ok[@]}" -o out/x.png --heat warm
refuses 2 '--json' compare "${ok[@]}" --json ''
refuses 2 'out/x.gif' compare "${ok[@]}" -o out/x.gif
cp in/half.exr in/before.exr
refuses 2 'is an input' compare "${ok[@]}" -o in/half.exr
refuses 2 'is an input' compare "${ok[@]}" -o "$work/in/brighter.exr"
refuses 2 'is an input' compare "${ok[@]}" --json in/half.exr
refuses 2 'is the heat map' compare "${ok[@]}" -o out/x.png --json out/x.png
check 'inputs are whole after that' cmp -s in/half.exr in/before.exr

# ---- bad input and output -----------------------------------------------------------------------

refuses 3 'in/missing.exr: ' compare in/missing.exr in/half.exr
refuses 3 'in/missing.exr: ' compare in/half.exr in/missing.exr -o out/x.png --json out/x.json
refuses 3 'in/text.png: ' compare in/half.exr in/text.png --json -
refuses 3 'in/short.exr: ' compare in/short.exr in/half.exr
refuses 3 'several pictures: a, b' compare in/layers.exr in/half.exr
refuses 3 'several pictures: left, right' compare in/half.exr in/two_parts.exr
refuses 3 'no channels R, G, B or Y' compare in/half.exr in/depth.exr
refuses 3 'in/half.exr: it is 8x4 pixels and in/wide.exr 9x4 (' compare in/half.exr in/wide.exr \
    -o out/x.png --json out/x.json --fail-above rmse=1
refuses 5 'out/missing' compare "${ok[@]}" -o out/missing/x.png
refuses 5 'out/missing' compare "${ok[@]}" --json out/missing/x.json
mkdir in/folder.png
refuses 5 'in/folder.png' compare "${ok[@]}" -o in/folder.png
"$glint" compare "${ok[@]}" >/dev/full 2>stderr
check 'results onto a full device: exit status 5' test $? -eq 5

# ---- figures ------------------------------------------------------------------------------------

# compares NAME IMAGE REFERENCE [ARGUMENT…]: must succeed quietly, with JSON in out/stats.json.
compares() {
    local name=$1
    shift
    run compare "$@" --json out/stats.json
    check "$name" test "$status" -eq 0 -a ! -s stderr
}

# are FIGURE… VALUE: checks figures of the JSON.
are() {
    local value=${*: -1} figure
    for figure in "${@:1:$#-1}"; do
        check "JSON: $figure" stat_is "$value" error "$figure"
    done
}

compares 'a constant difference' in/brighter.exr in/half.exr
are rmse mae p99 largest 0.25
are relative_rmse reference_mean 0.5
check 'JSON: psnr' grep -q '"psnr": 12.0411998' out/stats.json
are compared_pixels differing_pixels 32
are nan_pixels infinite_pixels nonfinite_pixels 0
check 'JSON: format' stat_is 'glint compare' format
check 'JSON: schema' stat_is 1 schema
check 'JSON: size' stat_is 8 width
check 'JSON: the image' stat_is in/brighter.exr image file
check 'JSON: the reference' stat_is in/half.exr reference file
check 'JSON: no bounds' stat_is '[]' bounds
for metric in rmse relative-rmse mae p99 max psnr differing nan infinite alpha; do
    check "the table has $metric" grep -qE "^  $metric +[0-9.]+ +[^ ]" stdout
done
check 'the table says the size' grep -q '^8x4 pixels, 32 compared' stdout
compares 'one pixel that is off' in/one_off.exr in/half.exr
are largest 0.25
are differing_pixels 1
check 'JSON: its column' stat_is 5 error worst_pixel x
check 'JSON: its row' stat_is 2 error worst_pixel y
check 'JSON: what it is' stat_is '[0.75,0.75,0.75]' error worst_pixel image
check 'JSON: what it should be' stat_is '[0.5,0.5,0.5]' error worst_pixel reference
check 'the table says where' grep -q 'at 5,2: 0.75 0.75 0.75, reference 0.5 0.5 0.5$' stdout
compares 'equal pictures' in/same.exr in/half.exr
are rmse relative_rmse mae p99 largest alpha 0.0
are psnr worst_pixel null
check 'the table says identical' grep -q '^  psnr .*identical' stdout
compares 'a picture and itself' in/half.exr in/half.exr
compares 'a black reference' in/half.exr in/black.exr
are relative_rmse null
check 'infinity in the table' grep -qE '^  relative-rmse +inf ' stdout
compares 'NaN' in/nan.exr in/half.exr
are nan_pixels nonfinite_pixels 2
are compared_pixels 30
check 'JSON: NaN of the image' stat_is 2 image nan_pixels
check 'JSON: NaN of the reference' stat_is 0 reference nan_pixels
check 'NaN in the table' grep -q '^  nan  *2  *.*2 in the image, 0 in the reference' stdout
compares 'infinities' in/half.exr in/infinite.exr
are infinite_pixels 1
check 'JSON: infinities of the reference' stat_is 1 reference infinite_pixels
compares 'nothing that could be compared' in/all_nan.exr in/half.exr
are rmse psnr largest alpha null
are compared_pixels 0
check 'and no figure in the table' grep -qxE '  rmse +-' stdout
run compare in/brighter.exr in/half.exr --json -
cp stdout out/stats.json
check '--json - prints JSON and nothing else' stat_is 0.25 error rmse
clean

# ---- channels and windows -----------------------------------------------------------------------

for other in grey grey_alpha layer parts overscan moved; do
    compares "$other is the same picture" "in/$other.exr" in/half.exr
    are largest alpha 0.0
done
compares 'alpha against none' in/alpha.exr in/half.exr
are largest 0.0
are alpha 0.25
check 'JSON: the image has alpha' stat_is true image alpha
check 'JSON: the reference has none' stat_is false reference alpha
check 'it is said that 1 is taken' grep -q '^  alpha .*in/half.exr has none: 1 is taken' stdout
compares 'none against alpha' in/half.exr in/alpha.exr
check 'the same the other way round' grep -q 'in/half.exr has none: 1 is taken' stdout
compares 'what a data window leaves out is 0' in/cropped.exr in/half.exr
are largest 0.5
are mae 0.25
are differing_pixels 16
clean

# ---- bounds -------------------------------------------------------------------------------------

# fails TEXT ARGUMENT…: expects exit status 7, one line with TEXT, and still the table.
fails() {
    local text=$1
    shift
    run compare "$@"
    check "exit status 7: compare $*" test "$status" -eq 7
    check 'one line' test "$(wc -l <stderr)" -eq 1
    check "that says: $text" grep -qF -- "$text" stderr
    check 'and the table' grep -q '^  rmse ' stdout
}
passes() {
    run compare "$@"
    check "exit status 0: compare $*" test "$status" -eq 0 -a ! -s stderr
}
for metric in rmse mae p99 max; do
    fails "in/half.exr: $metric 0.25 is above 0.2 (in/brighter.exr)" "${ok[@]}" \
        --fail-above "$metric=0.2"
    passes "${ok[@]}" --fail-above "$metric=0.25"
done
fails 'differing 1 is above 0.5' "${ok[@]}" --fail-above differing=0.5
fails 'relative-rmse 0.5 is above 0.4999' in/brighter.exr in/half.exr --fail-above relative-rmse=0.4999
fails 'relative-rmse inf is above 1e+300' in/half.exr in/black.exr --fail-above relative-rmse=1e300
fails 'alpha 0.25 is above 0.1' in/alpha.exr in/half.exr --fail-above alpha=0.1
fails 'psnr 12.0412 is below 13' "${ok[@]}" --fail-below psnr=13
passes "${ok[@]}" --fail-below psnr=12
passes in/half.exr in/same.exr --fail-below psnr=1000 --fail-above max=0
fails 'rmse 0.25 is above 0.1, max 0.25 is above 0.2 (' "${ok[@]}" --fail-above max=0.2 \
    --fail-above rmse=0.1 --fail-above mae=1
passes "${ok[@]}" --fail-above rmse=0.1 --fail-above rmse=0.3
fails 'nan 2 is above 0' in/nan.exr in/half.exr --fail-above rmse=1
fails 'nan 2 is above 0' in/half.exr in/nan.exr --fail-above nan=0
fails 'nan 2 is above 1' in/nan.exr in/half.exr --fail-above nan=1
passes in/nan.exr in/half.exr --fail-above nan=2 --fail-above rmse=0
fails 'infinite 1 is above 0' in/infinite.exr in/half.exr --fail-below psnr=1
passes in/infinite.exr in/half.exr --fail-above infinite=1
fails 'no pixel is finite in both' in/all_nan.exr in/half.exr --fail-above nan=1000
passes in/all_nan.exr in/half.exr
run compare "${ok[@]}" --fail-above rmse=0.125 --fail-below psnr=1 --json out/stats.json -o out/x.png
check 'JSON and heat map are written all the same' test "$status" -eq 7 -a -s out/x.png
check 'JSON: the bound' stat_is rmse bounds 0 metric
check 'JSON: its limit' stat_is 0.125 bounds 0 limit
check 'JSON: its value' stat_is 0.25 bounds 0 value
check 'JSON: it is broken' stat_is false bounds 0 kept
check 'JSON: psnr is kept' stat_is true bounds 1 kept
check 'JSON: and fails below' stat_is below bounds 1 fails
check 'JSON: nan is bounded too' stat_is nan bounds 2 metric
clean

# ---- heat maps ----------------------------------------------------------------------------------

# paints FILE HEX ARGUMENT…: the heat map must be the only file, and begin with these bytes.
paints() {
    local file=$1 hex=$2
    shift 2
    run compare in/nan.exr in/half.exr -o "$file" "$@"
    check "heat map $file $*" test "$status" -eq 0 -a ! -s stderr -a "$(ls -A out)" = "${file#out/}"
    check "$file: signature" begins_with "$file" "$hex"
}
paints out/x.png 89504e470d0a1a0a
cp out/x.png in/map.png
clean
paints out/x.png 89504e470d0a1a0a --heat relative
check 'relative is the default' cmp -s out/x.png in/map.png
clean
paints out/x.png 89504e470d0a1a0a --heat absolute
check 'absolute is another map' test "$(cmp -s out/x.png in/map.png; echo $?)" -eq 1
clean
paints out/x.tiff 49492a00
clean
paints out/x.jpg ffd8ff
clean
paints out/x.hdr 233f5241444941
clean
paints out/x.exr 762f3101
clean
printf 'old' >out/x.png
paints out/x.png 89504e470d0a1a0a
clean
# The EXR must hold the pictures' own differences: compares them with the expected values.
run compare in/brighter.exr in/half.exr -o out/difference.exr --heat absolute
exr quarter B,G,R 0.25,0.25,0.25
compares 'an EXR holds the differences' out/difference.exr in/quarter.exr
are largest 0.0
run compare in/half.exr in/brighter.exr -o out/difference.exr --heat absolute
exr minus_quarter B,G,R -0.25,-0.25,-0.25
compares 'with their sign' out/difference.exr in/minus_quarter.exr
are largest 0.0
run compare in/brighter.exr in/half.exr -o out/difference.exr
compares 'relative as default' out/difference.exr in/half.exr
are largest 0.0
clean
run compare in/half.exr in/half.exr -o out/x.png
compares 'a map can be read again' out/x.png out/x.png
check 'it is as wide as its scale' stat_is 312 width
clean

finish
