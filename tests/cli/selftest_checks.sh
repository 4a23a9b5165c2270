#!/usr/bin/env bash
# Tests the command line of glint selftest. selftest_checks.sh GLINT JSON_GET KERNELS
kernels=$(readlink -f -- "$3")
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# Fast cases.
quick=equal_indices,metal_at_its_ends

# ---- help and mistakes --------------------------------------------------------------------------

check 'selftest --help tells every option' help_mentions selftest list quick jobs case precision kernel-width kernels \
    rays seed case-timeout fail-fast device kernel-dir expect junit json help
run --help
check 'glint --help lists it' grep -q '^  selftest ' stdout
refuses 2 'unknown case' selftest --case nonsense
refuses 2 'did you mean slivers?' selftest --case slivres
refuses 2 'unknown case' selftest --case "$quick,"
refuses 2 '--kernel-width' selftest --kernel-width 4
refuses 2 '--precision' selftest --precision half
refuses 2 '--rays' selftest --rays 0
refuses 2 '--rays' selftest --rays many
refuses 2 '--seed' selftest --seed -1
refuses 2 '--jobs' selftest --jobs 0
refuses 2 '--jobs' selftest --jobs 17
refuses 2 'unexpected' selftest something
refuses 2 '--junit writes there' selftest --case $quick --junit out/x --json out/x
refuses 3 'in/missing' selftest --kernel-dir in/missing
refuses 3 'no readable render.cl' selftest --case $quick --kernel-dir in
printf '# known\n\nslivers float\nslivres double\n' >in/typo.txt
refuses 3 "in/typo.txt: line 4: 'slivres' is no case" selftest --case $quick --expect in/typo.txt
printf 'slivers 16 4\n' >in/width.txt
refuses 3 "line 1: '4' does not belong there" selftest --case $quick --expect in/width.txt
printf 'slivers float double\n' >in/twice.txt
refuses 3 "line 1: 'double' does not belong there" selftest --case $quick --expect in/twice.txt
refuses 3 'in/missing' selftest --case $quick --expect in/missing
refuses 4 'nonsense' selftest --device nonsense
refuses 5 'out/missing' selftest --case $quick --junit out/missing/x.xml
refuses 5 'out/missing' selftest --case $quick --json out/missing/x.json

# ---- results ------------------------------------------------------------------------------------

run selftest --list
check '--list: a line each' test "$status" -eq 0 -a "$(wc -l <stdout)" -ge 40
"$glint" selftest --list --quick >quick.txt
check '--list --quick: some of them' test -s quick.txt -a "$(wc -l <quick.txt)" -lt "$(wc -l <stdout)"
check '--list --quick: as --list has them' test -z "$(grep -vxFf stdout quick.txt)"
check '--list --case: these' test "$("$glint" selftest --list --case prism,slab | cut -d ' ' -f 1 | tr '\n' ' ')" = 'slab prism '
check '--list runs nothing' test "$(grep -c bound stdout)" -eq 0
run selftest --case equal_indices --case metal_at_its_ends --precision float
check 'cases by name: passed' test "$status" -eq 0 -a ! -s stderr
check 'cases by name: these' grep -q '^2 cases, all of them within their bounds$' stdout
check 'a measure a line' grep -qE '^metal_at_its_ends .* ok$' stdout
run selftest --case $quick --precision float --kernel-width all --seed 7 --junit out/x.xml --json out/x.json
check 'every width' test "$(grep -c '^float, packets of' stdout)" -eq 3
cp out/x.json out/stats.json
check 'JSON: the device' "$json_get" out/x.json device name
check 'JSON: a verdict' stat_is passed results 0 verdict
check 'JSON: a bound' stat_is 8.0 results 5 measures 0 bound
check 'JSON: it holds' stat_is true results 5 measures 0 holds
check 'JSON: widths' stat_is 16 results 5 width
check 'JSON: the seed' stat_is 7 seed
check 'JUnit: the seed' grep -q '<property name="seed" value="7"' out/x.xml
check 'JUnit: a suite for each width' test "$(grep -c '<testsuite name="glint.selftest.float.width' out/x.xml)" -eq 3
check 'JUnit: the cases' grep -q '<testsuites name="glint selftest" tests="6" failures="0" errors="0" skipped="0"' out/x.xml
if command -v xmllint >/dev/null; then
    check 'JUnit: it is XML' xmllint --noout out/x.xml
fi
clean
run selftest --case equal_indices --precision float --json -
cp stdout out/stats.json
check '--json -: JSON alone' stat_is equal_indices results 0 case
clean

# ---- a mistake in the kernels -------------------------------------------------------------------

mkdir broken
cp "$kernels"/* broken
sed -i 's/m2 \* m2 \* m;/m2 * m2;/' broken/optics.cl
run selftest --case metal_at_its_ends,equal_indices --precision float --kernel-dir broken \
    --junit out/x.xml
check 'a wrong formula: exit status 7' test "$status" -eq 7
check 'a wrong formula: one line, which names the case' \
    grep -qE '^glint: 1 of 2 cases failed on .*: metal_at_its_ends$' stderr
check 'a wrong formula: what was expected, and got' \
    grep -qE '^ +F0 .*: expected .*, got .* ulp\)$' stdout
check 'JUnit: the failure' grep -q '<failure message="F0 + (1 − F0)(1 − cos θ)⁵: ' out/x.xml
clean
printf 'metal_at_its_ends # Schlick\nequal_indices float 16\nequal_indices float 1\n' >in/known.txt
run selftest --case metal_at_its_ends,equal_indices --precision float --kernel-width 16 --fail-fast \
    --kernel-dir broken --expect in/known.txt --junit out/x.xml --json out/x.json
cp out/x.json out/stats.json
check '--expect: exit status 0' test "$status" -eq 0
check '--expect: said in the table' grep -qE '^metal_at_its_ends .* failed, as expected$' stdout
check '--expect: the last line' \
    grep -q '^2 cases: 1 failed as expected, the others are within their bounds$' stdout
check '--expect: what passes all the same' test "$(cat stderr)" = \
    'glint: warning: in/known.txt: line 2: equal_indices passes, float, packets of 16 (take the line out)'
check '--expect: JSON' stat_is failed results 1 verdict
check '--expect: JSON, expected' stat_is true results 1 expected
check '--expect: JUnit' grep -q ' tests="2" failures="0" errors="0" skipped="1"' out/x.xml
check '--expect: JUnit, why' grep -q '<skipped message="failed, as expected: F0 ' out/x.xml
clean
printf 'metal_at_its_ends float 8\n' >in/known.txt
run selftest --case metal_at_its_ends --precision float --kernel-width 16 --kernel-dir broken \
    --expect in/known.txt
check '--expect: elsewhere' test "$status" -eq 7
run selftest --case metal_at_its_ends,odd_sizes --precision all --kernel-dir broken --fail-fast
check '--fail-fast: one case' test "$(grep -c FAILED stdout)" -eq 1
run selftest --case equal_indices,metal_at_its_ends,critical_angle
cp stdout one_at_a_time
run selftest --case equal_indices,metal_at_its_ends,critical_angle --jobs 3
check '--jobs: the same table' cmp stdout one_at_a_time
run selftest --quick --case $quick --json out/x.json
cp out/x.json out/stats.json
check '--quick: in float alone' test "$(grep -c '^float' stdout)-$(grep -c '^double' stdout)" = 1-0
check '--quick: with few rays' stat_is 16384 rays
run selftest --quick --precision double --rays 9 --case $quick --json out/x.json
cp out/x.json out/stats.json
check '--quick: unless otherwise said' test "$(grep -c '^float' stdout)-$(grep -c '^double' stdout)" = 0-1
check '--quick: rays as said' stat_is 9 rays
printf 'this is no kernel\n' >>broken/optics.cl
run selftest --case $quick --precision float --kernel-dir broken --junit out/x.xml
check 'kernels that do not compile: exit status 7' test "$status" -eq 7
check 'kernels that do not compile: the log, once' test "$(grep -c 'the log follows' stderr)" -eq 1 -a "$(grep -c 'optics.cl' stderr)" -ge 1
check 'JUnit: the error' test "$(grep -c '<error message="device ' out/x.xml)" -eq 2
clean

finish
