#!/usr/bin/env bash
# What needs no device, and what is said where there is none: a loader that finds no driver.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
mkdir none
export OCL_ICD_VENDORS=$work/none OCL_ICD_FILENAMES=
small_scene >scene.txt

expect 0 '' "$clrt" --help
grep -q '^Usage: clrt \[options\] SCENE OUT' stdout || fail "no usage text"
for option in device list-devices json memory threads size samples seed depth crop math bits exposure tone-map check \
    stats quiet verbose help version clamp environment-lighting integrator sampling; do
    grep -q -e "--$option" stdout || fail "--help says nothing of --$option"
done
expect 0 '' "$clrt" --version
grep -qE '^clrt [0-9]+\.[0-9]+\.[0-9]+$' stdout || fail "no version"

expect 0 '' "$clrt" --check scene.txt
expect 0 '' "$clrt" --check - <scene.txt
expect 0 '' "$clrt" --check --device nonsense scene.txt out.png
for bad in 'sphere { radus 1 }' 'sphere' '}'; do
    echo "$bad" >bad.txt
    expect 1 'bad.txt:' "$clrt" --check bad.txt
    [ ! -s stdout ] || fail "diagnostics on standard output"
    expect 1 'error:' "$clrt" --check -q bad.txt
done
expect 4 'none.txt' "$clrt" --check none.txt
expect 4 '*' "$clrt" --check .

expect 3 'no OpenCL platform found' "$clrt" scene.txt out.png
grep -q 'pocl-opencl-icd' stderr || fail "no advice what to install"
expect 3 'no OpenCL platform found' "$clrt" --list-devices
expect 3 'no OpenCL platform found' "$clrt" --device cpu scene.txt out.png
expect 3 'no OpenCL platform found' "$clrt" --device cpu bad.txt out.png # the device goes first
[ ! -e out.png ] || fail "a picture without a device"

expect 2 'SCENE and OUT are missing' "$clrt"
expect 2 'OUT is missing' "$clrt" scene.txt
expect 2 "did you mean '--samples'" "$clrt" --sampels 4 scene.txt out.png
expect 2 '--size' "$clrt" --size 0x0 scene.txt out.png
expect 2 'not supported yet' "$clrt" --part 1/2 scene.txt out.png
expect 2 "--math 'exakt': must be exact, fast or double" "$clrt" --math exakt scene.txt out.png
expect 2 '--math needs a value' "$clrt" scene.txt out.png --math
expect 2 '--help' "$clrt" scene.txt out.png more
if [ -e /dev/full ]; then
    "$clrt" --help >/dev/full 2>stderr
    [ $? -eq 4 ] || fail "--help to a full disk"
    grep -q 'standard output' stderr || fail "--help to a full disk says: $(cat stderr)"
fi
finish
