#!/usr/bin/env bash
# --self-test: every case passes on this device, one that computes wrongly is found out and refused.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device
small_scene >scene.txt

expect 0 '' "$clrt" --self-test
grep -q '^clrt .* self-test on ' stdout || fail "no heading: $(head -n 1 stdout)"
grep -qE '^[0-9]+ cases, 0 failed; ' stdout || fail "no summary: $(tail -n 1 stdout)"
for case in C1 C2 C3 C13 C14 C15 C18 C35 C44 C47 C48 C64; do
    grep -qE "^$case .* pass$" stdout || fail "no case $case"
done
if grep -q 'FAIL' stdout; then fail "$(grep FAIL stdout)"; fi
expect 0 '' "$clrt" -q --self-test
[ ! -s stdout ] || fail "-q said: $(cat stdout)"
expect 0 '' "$clrt" --self-test=report.json
grep -q '"schema": "clrt-self-test/1"' report.json || fail "no JSON: $(head report.json)"
expect 4 'No such file' "$clrt" --self-test=no/such/folder
expect 2 'takes no SCENE' "$clrt" --self-test scene.txt out.png
expect 3 'there is no device' "$clrt" --self-test --device 'no such name'

# The first render asks the device and remembers it; where nothing can be remembered it renders all the same.
export POCL_CACHE_DIR=${POCL_CACHE_DIR:-${XDG_CACHE_HOME:-$HOME/.cache}/pocl/kcache}
export XDG_CACHE_HOME=$PWD/cache
mkdir cache
expect 0 'first use of this device' "$clrt" -v scene.txt out.png
[ "$(wc -l <cache/clrt/devices)" -eq 1 ] || fail "not remembered: $(cat cache/clrt/devices)"
"$clrt" -v scene.txt out.png 2>stderr || fail "the second render ended with $?"
if grep -q 'first use' stderr; then fail "asked again"; fi
XDG_CACHE_HOME=/dev/null expect 0 '' "$clrt" scene.txt out.png

# Only PoCL can be told to break the rules.
"$clrt" --list-devices | grep -q 'Portable Computing Language' || finish
rm -r cache/clrt out.png
export POCL_EXTRA_BUILD_FLAGS=-cl-unsafe-math-optimizations
expect 5 'the self-test failed in ' "$clrt" --self-test
grep -qE '^C48 .* FAIL$' stdout || fail "unsafe optimisations pass"
expect 5 'gives wrong answers' "$clrt" scene.txt out.png
[ ! -e out.png ] || fail "a picture from a device that computes wrongly"
[ ! -e cache/clrt/devices ] || fail "a device that computes wrongly is remembered"
expect 0 '' "$clrt" --force-device scene.txt out.png
[ -e out.png ] || fail "--force-device made no picture"
finish
