#!/usr/bin/env bash
# --clamp: what it does to a picture and says of it; refused with words.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
for limit in 0 -1 nan inf 1e39 2x; do
    expect 2 "--clamp '$limit': must be a radiance above 0" "$clrt" --clamp "$limit" scene.txt out.pfm
done
expect 2 '--clamp needs a value: X' "$clrt" scene.txt out.pfm --clamp
need_device
cat >scene.txt <<'END'
image { size 60 45 samples 5 seed 3 } camera { position 0 1 6 look_at 0 0.7 0 fov 40 }
light point { position -2 4 4 intensity 30 20 15 }
material shiny blinn_phong { diffuse 0.02 specular 0.9 shininess 2000 }
plane { point 0 0 0 normal 0 1 0 material shiny }
sphere { center -1 0.8 0 radius 0.8 material shiny }
END

# number FILE KEY: of the statistics.
number() { sed -n "s/.*\"$2\": \([-+0-9.e]*\).*/\1/p" "$1" | head -n 1; }

expect 0 '' "$clrt" --stats=plain.json scene.txt plain.pfm
expect 0 '' "$clrt" --clamp 0.5 --stats=clamped.json scene.txt clamped.pfm
cmp -s plain.pfm clamped.pfm && fail "the limit does nothing"
grep -q '"clamp": null' plain.json || fail "a limit that was not asked for"
grep -q '"CLAMP"' plain.json && fail "a program with a limit that was not asked for"
grep -q '"CLAMP"' clamped.json || fail "no CLAMP among the features"
awk -v plain="$(number plain.json mean)" -v clamped="$(number clamped.json mean)" \
    -v bias="$(number clamped.json bias_of_mean)" -v count="$(number clamped.json clamped_samples)" 'BEGIN {
    off = clamped - bias - plain
    exit !(bias < -0.02 * plain && off * off < 1e-12 * plain * plain && count > 100 && count < 5000) }' ||
    fail "bias and mean are not the mean without a limit: $(cat plain.json clamped.json)"
expect 0 '' "$clrt" --clamp 0.5 --memory 1 --stats=bands.json scene.txt bands.pfm
cmp clamped.pfm bands.pfm || fail "another picture with less memory"
for key in bias_of_mean e_clamp clamped_samples samples; do
    [ "$(number clamped.json $key)" = "$(number bands.json $key)" ] || fail "another $key with less memory"
done

# The file says it, and can be made again.
expect 0 'clamp         0.5: bias of the mean -' "$clrt" --clamp=0.5 --crop 7,5,40,30 --stats scene.txt out.png
options=$(tr '\0' '\n' <out.png | grep -aom 1 '^--size .* --math [a-z]*')
case $options in *' --clamp 0.5 '*) ;; *) fail "no limit in the options: $options" ;; esac
grep -aq 'clamp 0.5: bias of the mean -.* of 6000 samples' out.png || fail "no bias in the file"
# shellcheck disable=SC2086 # options are words
expect 0 '' "$clrt" $options scene.txt again.png
cmp out.png again.png || fail "another file from its own options: $options"
expect 0 '' "$clrt" --clamp 0.5 scene.txt out.exr
grep -aq -e '--clamp 0.5 ' out.exr || fail "no limit in an EXR"

# Properties of first hits have no limit.
expect 0 '' "$clrt" --aov depth scene.txt plain.pfm
expect 0 '' "$clrt" --clamp 0.5 --aov depth scene.txt clamped.pfm
cmp plain.depth.pfm clamped.depth.pfm || fail "a limit of depths"
finish
