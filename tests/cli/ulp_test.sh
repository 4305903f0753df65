#!/usr/bin/env bash
# clrt-ulp: every shape within what it allows itself, its table and JSON, and what it says about wrong options.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device
ulp=$(dirname "$clrt")/clrt-ulp
[ -x "$ulp" ] || skip "no clrt-ulp"

# Exit status 5 if a hit is beyond what an ulp of the inputs explains.
expect 0 '*' "$ulp" --rays 16384 --json all.json
[ "$(grep -c '^[a-z ]*  *32768 ' stdout)" = 13 ] || fail "not all 13 kinds of shapes are in the table"
grep -q '^mesh triangle  *16384 ' stdout || fail "no faces of meshes in the table"
grep -q '"schema": "clrt-ulp/1"' all.json || fail "no schema in the JSON"
[ "$(grep -c '"wrong_verdicts": 0' all.json)" = 14 ] || fail "not all 14 have the right verdicts"
! grep -q '"hits": 0' all.json || fail "a shape is never hit"

# The same rays again.
expect 0 '*' "$ulp" --rays 1 --shape torus --json once.json
expect 0 '*' "$ulp" --rays 1 --shape torus --json twice.json
cmp -s once.json twice.json || fail "other figures in a second run"

expect 2 '--shape: there is no "teapot"; there are sphere, giant sphere, ' "$ulp" --shape teapot
expect 2 'clrt-ulp: --rays: "0" is not a whole number from 1 to 10^12' "$ulp" --rays 0
expect 2 'clrt-ulp: --json: an argument is missing' "$ulp" --json
expect 4 'nowhere/all.json' "$ulp" --rays 1 --shape disk --json nowhere/all.json
finish
