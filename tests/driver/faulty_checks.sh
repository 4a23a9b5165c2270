#!/usr/bin/env bash
# Tests the self-test on a faulty driver that aborts, crashes, exits, hangs, refuses, computes
# nothing or does not compile. The self-test must report the fault, continue, and report the other
# cases.
# driver/faulty_checks.sh GLINT FAULTY_DRIVER SCENE
set -eu
glint=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
FAULTY_REAL=$(cat /etc/OpenCL/vendors/pocl.icd)
export FAULTY_REAL
mkdir "$folder/vendors"
echo "$2" >"$folder/vendors/faulty.icd"
export OCL_ICD_VENDORS=$folder/vendors
export POCL_CACHE_DIR=$folder/cache # a crash removes its entries, also those of other runs
cases=fresnel_at_its_ends,metal_at_its_ends,cube_ties
failed=0

# run WAY KERNEL: records the table, the messages, JUnit's report, and the status.
run() {
    status=0
    FAULTY_WAY=$1 FAULTY_KERNEL=$2 "$glint" selftest --precision float --case $cases --case-timeout 40 \
        --junit "$folder/$1.xml" >"$folder/$1.table" 2>"$folder/$1.said" || status=$?
}

# expect WAY TEXT: checks that the table contains TEXT.
expect() {
    if [ "$status" != 7 ]; then
        echo "$1: exit status $status, not 7"
        failed=1
    fi
    if ! grep -qF -- "$2" "$folder/$1.table"; then
        echo "$1: no '$2' in the table:"
        cat "$folder/$1.table" "$folder/$1.said"
        failed=1
    fi
}

run none none
[ "$status" = 0 ] || { echo "the driver that is not at fault: status $status"; cat "$folder/none.said"; exit 1; }

for way in abort crash exit hang garbage refuse; do
    run $way probe_metal
    case $way in
    abort) expect $way 'ended the process: Aborted (it said: faulty driver: probe_metal is too much' ;;
    crash) expect $way 'ended the process: Segmentation fault (it said: faulty driver' ;;
    exit) expect $way 'ended the process with status 5 (it said: faulty driver' ;;
    hang) expect $way 'did not come back within 40 s (it said: faulty driver' ;;
    garbage) expect $way 'FAILED' ;;
    refuse) expect $way 'CL_OUT_OF_RESOURCES' ;;
    esac
    if [ "$(grep -c ' ok$' "$folder/$way.table")" -lt 5 ]; then
        echo "$way: the other cases do not pass:"
        cat "$folder/$way.table"
        failed=1
    fi
    if [ "$(grep -c '<testcase' "$folder/$way.xml")" != 3 ]; then
        echo "$way: JUnit's report does not have all three cases"
        failed=1
    fi
done

run compile none
expect compile 'BROKEN'
[ "$(grep -c '<testcase' "$folder/compile.xml")" = 3 ] || { echo "compile: JUnit lacks cases"; failed=1; }
# render must print one line that names the device, with exit status 4, also while kernels run.
for after in 0 1; do
    status=0
    FAULTY_WAY=abort FAULTY_KERNEL=render_tiles FAULTY_AFTER=$after \
        "$glint" render "$3" --size 64x48 -o "$folder/frame.png" 2>"$folder/render.said" || status=$?
    said="^glint: device '.*: the driver died while it compiled"
    [ $after = 0 ] || said="^glint: device '.*': the process died while the driver ran kernels"
    if [ $status != 4 ] || ! grep -q "$said" "$folder/render.said" || [ -e "$folder/frame.png" ]; then
        echo "render, after $after launches: status $status, and:"
        cat "$folder/render.said"
        failed=1
    fi
done
exit $failed
