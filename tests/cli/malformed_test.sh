#!/usr/bin/env bash
# Every scene of malformed/ ends with status 1 and its message, and leaves an older picture as it was.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
export OCL_ICD_VENDORS=$work # no device is needed
count=0
echo old >out.png
for scene in "$source"/tests/cli/malformed/*.txt; do
    name=$(basename "$scene" .txt)
    expect 1 "$(head -n 1 "${scene%.txt}.expected")" "$clrt" --check "$scene" out.png
    [ ! -s stdout ] || fail "$name: diagnostics on standard output"
    count=$((count + 1))
done
[ "$(cat out.png)" = old ] || fail "a picture from a broken scene"
[ "$count" -ge 40 ] || fail "only $count scenes"
echo "$count malformed scenes"
finish
