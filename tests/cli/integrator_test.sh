#!/usr/bin/env bash
# --integrator and --sampling in place of what the scene says; what is said of paths beside the picture.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device

scene() {
    cat <<END
image { size 32 24 samples 4 }
render { max_depth 2 $1 }
ambient 0
light rectangle { corner -1 3 -5 edge1 2 0 0 edge2 0 0 2 radiance 4 }
material gloss phong { diffuse 0.5 specular 0.25 shininess 8 }
sphere { center 0 0 -4 radius 1 material gloss }
plane { point 0 -1 0 normal 0 1 0 }
END
}
scene '' >whitted.txt
scene 'integrator path' >path.txt
scene 'ambient_occlusion 4 1 integrator path' >idle.txt

expect 0 '' "$clrt" -q --stats=whitted.json whitted.txt whitted.pfm
expect 0 '' "$clrt" -q --stats=path.json path.txt path.pfm
cmp -s whitted.pfm path.pfm && fail "one picture of both integrators"
expect 0 '' "$clrt" -q --integrator path whitted.txt again.pfm
cmp path.pfm again.pfm || fail "--integrator path is not what the scene's is"
expect 0 '' "$clrt" -q --integrator=whitted path.txt again.pfm
cmp whitted.pfm again.pfm || fail "--integrator whitted is not what the scene's is"

# Shadow rays to lights, or none but those of paths.
expect 0 '' "$clrt" -q --sampling both path.txt again.pfm
cmp path.pfm again.pfm || fail "both is not the default"
for how in lights surfaces; do
    expect 0 '' "$clrt" -q --sampling $how --stats=$how.json path.txt $how.pfm
    cmp -s path.pfm $how.pfm && fail "--sampling $how changes nothing"
done
cmp -s lights.pfm surfaces.pfm && fail "lights and surfaces make one picture"
# number KEY FILE
number() { grep -o "\"$1\": [0-9.e-]*" "$2" | head -n 1 | sed 's/.*: //'; }
[ "$(number shadow surfaces.json)" = 0 ] || fail "shadow rays where surfaces alone look for lights"
[ "$(number shadow lights.json)" -gt 0 ] || fail "no shadow rays where lights are looked for"
expect 0 '' "$clrt" -q --sampling surfaces whitted.txt again.pfm
cmp whitted.pfm again.pfm || fail "--sampling changes a picture without paths"

# Lanes that no path had.
[ "$(number scattered path.json)" -gt 0 ] || fail "no scattered rays"
awk -v idle="$(number idle_lanes path.json)" 'BEGIN { exit !(idle != "" && idle >= 0 && idle < 1) }' ||
    fail "idle lanes: '$(number idle_lanes path.json)'"
grep -q '"idle_lanes": null' whitted.json || fail "idle lanes without paths"
grep -q '"mirrored"' whitted.json || fail "no mirrored rays without paths"
expect 0 'idle lanes ' "$clrt" --stats path.txt out.pfm
grep -q 'scattered [1-9]' stderr || fail "scattered rays are not named: $(cat stderr)"
grep -q 'PATH' stderr || fail "the feature is not named"
expect 0 'mirrored ' "$clrt" --stats whitted.txt out.pfm
grep -q 'idle' stderr && fail "idle lanes without paths: $(cat stderr)"

# From its own metadata.
for how in "path.txt --integrator whitted" "whitted.txt --integrator path --sampling lights"; do
    # shellcheck disable=SC2086 # words
    set -- $how
    expect 0 '' "$clrt" -q "$@" first.png
    options=$(tr '\0' '\n' <first.png | grep -aom 1 -- '^--size .* --math exact')
    # shellcheck disable=SC2086
    expect 0 '' "$clrt" -q $options "$1" second.png
    cmp first.png second.png || fail "another file from its own options: $options"
done

# What has no effect is a warning where it has none.
expect 0 "idle.txt:2:22: warning: 'ambient_occlusion' has no effect" "$clrt" --check idle.txt
expect 0 '' "$clrt" --check --integrator whitted idle.txt
expect 0 '' "$clrt" -q --check idle.txt
finish
