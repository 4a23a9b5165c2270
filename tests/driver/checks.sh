#!/usr/bin/env bash
# Checks that tests run on ctest's driver (OCL_ICD_VENDORS), whatever other drivers are installed.
# driver/checks.sh GLINT OTHER_DRIVER
set -eu
glint=$1
[ -n "${OCL_ICD_VENDORS-}" ] || { echo "no driver is chosen: PoCL is not installed"; exit 1; }

vendors=$(mktemp -d)
trap 'rm -rf "$vendors"' EXIT
cp "/etc/OpenCL/vendors/$OCL_ICD_VENDORS" "$vendors/"
echo "$2" >"$vendors/other.icd"
export OPENCL_VENDOR_PATH=$vendors

if (unset OCL_ICD_VENDORS && "$glint" devices); then
    echo "the other driver was not loaded: this test shows nothing"
    exit 1
fi
"$glint" devices
