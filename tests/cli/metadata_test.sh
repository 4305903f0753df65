#!/usr/bin/env bash
# A PNG says what made it, and can be made again from what it says; the statistics say the same.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device

mkdir folder again
echo 'sphere { center 0 0 -4 radius 1 }' >folder/part.txt
cat >"folder/scène.txt" <<'END'
image { size 64 48 } render { max_depth 2 } output { exposure 0.1 tone_map reinhard_extended 3 }
include "part.txt"
light directional { direction 0 -1 -1 } plane { point 0 -1 0 normal 0 1 0 }
END

# text FILE PATTERN: what matches it at the beginning of a text of the file, whose chunks are not compressed.
text() { tr '\0' '\n' <"$1" | grep -aom 1 "^$2"; }
hash='[0-9a-f]\{16\}'

expect 0 '' "$clrt" -q --size 30x20 -n 5 --seed 7 --crop 2,3,20,11 --bits 16 "folder/scène.txt" out.png
options=$(text out.png '--size .* --math [a-z]*')
cp folder/* again
# shellcheck disable=SC2086 # options are words
expect 0 '' "$clrt" -q $options "again/scène.txt" again.png
cmp out.png again.png || fail "another file from its own options: $options"
grep -aq 'folder' out.png && fail "a folder in the file"
grep -aq 'scène.txt' out.png || fail "no name of the scene in the file"
text out.png 'sampling rmse<=.* bounded); max_depth<=0; .*nan 0, infinite 0, negative 0' >/dev/null ||
    fail "no error budget in the file"
text out.png "$hash" >hash || fail "no hash in the file"
echo '# more' >>again/part.txt
expect 0 '' "$clrt" -q "again/scène.txt" again.png
text again.png "$hash" | cmp -s - hash && fail "the hash does not see what is included"

expect 0 'error budget' "$clrt" --stats "folder/scène.txt" out.pfm
grep -q 'sampling *none: pixel centres' stderr || fail "pixel centres are not named: $(cat stderr)"
grep -q 'quantisation *<= 0 ' stderr || fail "floats are rounded to levels: $(cat stderr)"
expect 0 '' "$clrt" -q --stats=stats.json -n 4 "folder/scène.txt" out.png
for key in scene_hash clrt_version platform driver math kernel_hash spp seed depth crop e_sampling e_depth \
    e_min_weight e_arith e_quant e_total assumption nan infinite negative; do
    grep -q "\"$key\"" stats.json || fail "no $key in the statistics"
done
grep -q '"e_arith": null' stats.json || fail "arithmetic that was not measured"
grep -q "\"scene_hash\": \"$(cat hash)\"" stats.json || fail "another hash in the statistics"
finish
