#!/usr/bin/env bash
# Scene in, picture out: streams, broken paths, what stands at OUT before and after.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device
small_scene >scene.txt

is_png() { [ "$(head -c 4 "$1" | tail -c 3)" = PNG ]; }

# left NAME...: nothing but these stands in the folder.
left() {
    rm -f stdout stderr
    [ "$(ls -A | tr '\n' ' ')" = "$* " ] || fail "left in the folder: $(ls -A | tr '\n' ' ')"
}

expect 0 '' "$clrt" scene.txt out.png
is_png out.png || fail "no PNG"
[ ! -s stdout ] || fail "talk on standard output"
expect 0 '' "$clrt" -q scene.txt out.png
cp out.png first.png
expect 0 '' "$clrt" - out.png <scene.txt
expect 0 '' "$clrt" - - <scene.txt
cmp stdout out.png || fail "another file through a stream"
expect 0 '' "$clrt" - stream.pfm <scene.txt
expect 0 '' "$clrt" scene.txt out.pfm
cmp stream.pfm out.pfm || fail "another picture through streams"
rm -f stream.pfm
expect 0 '' "$clrt" -- scene.txt out.png
expect 0 '' "$clrt" scene.txt out.pfm
[ "$(head -c 8 out.pfm | tr '\n' ' ')" = "PF 32 24" ] || fail "no PFM"
expect 0 'take' "$clrt" --exposure 1 scene.txt out.pfm
expect 0 '' "$clrt" --size 20x10 --crop 3,2,7,5 scene.txt out.pfm
[ "$(head -c 6 out.pfm | tr '\n' ' ')" = "PF 7 5" ] || fail "no crop of 7 x 5"
expect 0 'rays' "$clrt" --stats scene.txt out.png
expect 0 '' "$clrt" --stats=stats.json scene.txt out.png
grep -q '"rays_per_second"' stats.json || fail "no statistics in the file"
cmp out.png first.png || fail "another picture with statistics"
rm -f stats.json out.pfm
left first.png out.png scene.txt

echo old >out.png
echo 'sphere { radus 1 }' >bad.txt
expect 1 'bad.txt:1:10: error:' "$clrt" bad.txt out.png
[ "$(cat out.png)" = old ] || fail "the old picture went with a broken scene"
expect 2 'is not within the image' "$clrt" --crop 0,0,33,24 scene.txt out.png
expect 2 'suffix' "$clrt" scene.txt out.jpg
expect 2 'suffix' "$clrt" scene.txt out
expect 4 'none.txt' "$clrt" none.txt out.png
expect 4 'none/out.png' "$clrt" scene.txt none/out.png
mkdir folder.png
expect 4 'folder.png' "$clrt" scene.txt folder.png
rmdir folder.png
[ "$(cat out.png)" = old ] || fail "the old picture went with a failure"
if [ -e /dev/full ]; then
    "$clrt" scene.txt - >/dev/full 2>stderr
    [ $? -eq 4 ] || fail "status of a picture to a full disk"
fi
"$clrt" scene.txt - 2>stderr | true
[ "${PIPESTATUS[0]}" -eq 4 ] || [ "${PIPESTATUS[0]}" -eq 0 ] || fail "a closed pipe: ${PIPESTATUS[0]}"
expect 4 'none/stats.json' "$clrt" --stats=none/stats.json scene.txt kept.png
is_png kept.png || fail "no picture where only the statistics cannot be written"
rm -f kept.png
left bad.txt first.png out.png scene.txt

# More primitives than a MiB holds.
small_scene >many.txt
awk 'BEGIN { for (i = 0; i < 30000; i++) printf "sphere { center %d %d -50 radius 0.3 }\n", i % 200, i / 200 }' \
    >>many.txt
expect 6 'MiB' "$clrt" --memory 1 many.txt out.png
[ "$(cat out.png)" = old ] || fail "the old picture went where memory ended"
expect 0 '' "$clrt" --memory 64 scene.txt out.png
cmp out.png first.png || fail "another picture with less memory"
rm -f many.txt
left bad.txt first.png out.png scene.txt
finish
