#!/usr/bin/env bash
# The kinds of arithmetic, as a user meets them.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device
small_scene >scene.txt

expect 0 '' "$clrt" scene.txt plain.pfm
expect 0 '' "$clrt" --math exact scene.txt exact.pfm
cmp plain.pfm exact.pfm || fail "exact is not the default"
expect 0 '' "$clrt" --math=fast scene.txt fast.pfm
[ "$(wc -c <fast.pfm)" -eq "$(wc -c <plain.pfm)" ] || fail "a picture of another size"

if "$clrt" --list-devices --json | grep -q '"fp64": 1\|"fp64": true'; then
    expect 0 '' "$clrt" --math double scene.txt double.pfm
    cmp -s plain.pfm double.pfm && fail "doubles give the very bytes of floats"
else
    expect 3 'has no 64-bit floating point' "$clrt" --math double scene.txt double.pfm
    [ ! -e double.pfm ] || fail "a picture in spite of the error"
fi
expect 2 "--math 'quad': must be exact, fast or double" "$clrt" --math quad scene.txt out.pfm
expect 2 '--math needs a value' "$clrt" scene.txt out.pfm --math
finish
