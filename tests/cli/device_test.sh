#!/usr/bin/env bash
# The choice of a device.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device
small_scene >scene.txt

expect 0 '' "$clrt" --list-devices
grep -qE '^0  0:0  (CPU|GPU|other)  .' stdout || fail "the list begins with: $(head -n 1 stdout)"
expect 0 '' "$clrt" --list-devices --json
grep -q '"devices": \[' stdout || fail "no devices in the JSON"
index=$(sed -n 's/^ *"index": \([0-9]*\).*/\1/p' stdout | tail -n 1)
name=$(sed -n 's/^ *"name": "\(.*\)",$/\1/p' stdout | head -n 1)

# Every place that the list names, and the name, is taken.
for spec in "$index" 0 0:0; do
    expect 0 "clrt: device " "$clrt" -v --device "$spec" scene.txt out.png
done
if [ "$index" -eq 0 ]; then
    expect 0 "clrt: device $name" "$clrt" -v --device "$name" scene.txt out.png
    expect 0 "clrt: device $name" "$clrt" -v -d "$(tr '[:lower:]' '[:upper:]' <<<"${name:0:6}")" scene.txt out.png
else
    expect 2 "is ambiguous" "$clrt" --device ' ' scene.txt out.png # in the name of every device
fi
rm -f out.png

expect 3 "there is no device 'no such name'" "$clrt" --device 'no such name' scene.txt out.png
grep -qF "$name" stderr || fail "what there is is not listed: $(cat stderr)"
expect 3 "there is no device '$((index + 1))'" "$clrt" --device $((index + 1)) scene.txt out.png
expect 3 "there is no device '99:0'" "$clrt" --device 99:0 scene.txt out.png
expect 2 "not supported yet" "$clrt" --device all scene.txt out.png
expect 2 "is empty" "$clrt" --device= scene.txt out.png
CLRT_DEVICE='no such name' expect 3 "CLRT_DEVICE: there is no device" "$clrt" scene.txt out.png
[ ! -e out.png ] || fail "a picture from a device that is not there"
CLRT_DEVICE='no such name' expect 0 '' "$clrt" --device 0 scene.txt out.png
CLRT_DEVICE=0 expect 0 '' "$clrt" scene.txt out.png
CLRT_DEVICE= expect 0 '' "$clrt" scene.txt out.png
if ! "$clrt" --list-devices | grep -qE '^[0-9]+  [0-9:]+  GPU'; then
    expect 3 "there is no device 'gpu'" "$clrt" --device gpu scene.txt out.png
fi
if "$clrt" --list-devices | grep -qE '^[0-9]+  [0-9:]+  CPU'; then
    cp out.png all.png
    expect 0 '' "$clrt" --device cpu --threads 1 scene.txt out.png
    expect 0 '' "$clrt" --device cpu scene.txt all.png
    cmp out.png all.png || fail "another picture with one thread"
fi
finish
