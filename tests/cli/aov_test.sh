#!/usr/bin/env bash
# Properties of first hits in files of their own, against closed forms.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device

# The left half of the picture meets a wall 7 units away, the right half nothing.
cat >scene.txt <<'END'
image { size 4 2 samples 4 }
camera { position 1 2 3 look_at 1 2 0 orthographic 2 }
material unused phong { }
material wall phong { diffuse 0.25 0.5 0.75 }
object nothing { sphere { center 0 0 0 radius 1 } }
sphere { center 1 2 9 radius 1 }
box { min -9 -9 -9 max 1 9 -4 material wall }
END

# values NAME: the distinct pixels of out.NAME.pfm and how many there are of each.
values() {
    tail -c 96 "out.$1.pfm" | od -A n -v -t f4 -w12 | tr -s ' ' | sort | uniq -c | tr -s ' ' | tr '\n' ';'
}

# gives NAME TEXT
gives() {
    local got
    got=$(values "$1")
    [ "$got" = "$2" ] || fail "$1 is '$got', not '$2'"
}

expect 0 '' "$clrt" -q --aov depth,normal,position,albedo,id scene.txt out.png
gives depth ' 4 7 7 7; 4 inf inf inf;'
gives normal ' 4 0 0 0; 4 0 0 1;'
gives position ' 1 -0.5 1.5 -4; 1 -0.5 2.5 -4; 1 0.5 1.5 -4; 1 0.5 2.5 -4; 4 inf inf inf;'
gives albedo ' 4 0 0 0; 4 0.25 0.5 0.75;'
values id | grep -q '^ 4 -1 -1 -1; 4 [0-9]* 0 [0-9]*;$' || fail "id is '$(values id)'"
rm -f stdout stderr
for name in albedo depth id normal position; do
    [ -f "out.$name.pfm" ] || fail "no $name"
done

# The numbers do not depend on the device's shape, and a shape before another does not change its number.
cp out.id.pfm first.id.pfm
CLRT_SHAPE=1,1,16 expect 0 '' "$clrt" -q --aov id scene.txt out.png
cmp out.id.pfm first.id.pfm || fail "another id with one lane"

# First hits are those of any integrator.
for name in albedo depth id normal position; do
    cp out.$name.pfm first.$name.pfm
done
expect 0 '' "$clrt" -q --integrator path --aov depth,normal,position,albedo,id scene.txt out.png
for name in albedo depth id normal position; do
    cmp out.$name.pfm first.$name.pfm || fail "another $name with paths"
done

mkdir taken.depth.pfm
expect 4 'taken.depth.pfm' "$clrt" -q --aov depth scene.txt taken.png
finish
