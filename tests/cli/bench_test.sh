#!/usr/bin/env bash
# clrt-bench: hits that a search of all primitives confirms, its tables, and what it says about wrong options.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device
bench=$(dirname "$clrt")/clrt-bench
[ -x "$bench" ] || skip "no clrt-bench"
tiny=(--no-embree --size 16 --rounds 1 --turn 0 --builds 1)

# Exit status 5 if a hit is wrong.
expect 0 '*' "$bench" "${tiny[@]}" --scene blob,needles --triangles 500 --check --json all.json
grep -q 'blob camera  *256!' stdout || fail "no line for the camera rays of blob"
grep -q 'needles sun .* 0 of ' stdout || fail "no checked rays towards the sun"
[ "$(grep -c '"wrong": 0' all.json)" = 14 ] || fail "not all 14 sets are checked and right"
grep -q '"schema": "clrt-bench/1"' all.json || fail "no schema in the JSON"
expect 0 '*' "$bench" "${tiny[@]}" --no-visits --scene instances --triangles 24000 --rays diffuse,sun --check
grep -q 'instances diffuse .* 0 of ' stdout || fail "no checked rays of instances"
expect 0 '*' "$bench" "${tiny[@]}" --no-visits --scene sphereflake --triangles 91 --rays mirror --check
grep -q 'sphereflake mirror .* 0 of ' stdout || fail "no checked rays of spheres"

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >corner.obj
expect 0 '*' "$bench" "${tiny[@]}" --no-visits --scene corner.obj --rays camera --check --markdown
grep -q '^| corner.obj camera *| *256! |' stdout || fail "no Markdown for the mesh of a file"
expect 0 '*' "$bench" "${tiny[@]}" --no-visits --scaling --rays camera --triangles 20000
[ "$(wc -l <stdout)" = 3 ] || fail "not a heading and two sizes"
head -n 1 stdout | grep -q '^triangles,build_seconds,.*,camera_mrays' || fail "no heading of the CSV"

expect 0 '' "$bench" --help
grep -q '^usage: clrt-bench' stdout || fail "no usage"
expect 2 "'nothing' is neither a scene nor the path" "$bench" --scene nothing
expect 2 "there is no 'moon'" "$bench" --rays moon
expect 2 'not an option of clrt-bench' "$bench" --fast
expect 2 'not an option of clrt-bench' "$bench" blob
expect 2 'whole number from 1 to' "$bench" --rounds 0
expect 2 'an argument is missing' "$bench" --size
expect 3 'there is no device' "$bench" --device 'no such device'
expect 1 'none.obj' "$bench" "${tiny[@]}" --scene none.obj
expect 4 'none/out.json' "$bench" "${tiny[@]}" --no-visits --scene blob --triangles 20 --rays camera --json none/out.json
finish
