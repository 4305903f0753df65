#!/usr/bin/env bash
# tools/mesh: every shape is a mesh that clrt reads without a word, of about as many triangles as asked for,
# the same from run to run; what it says about wrong options. No device is needed.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
command -v python3 >/dev/null || skip "no python3"
mesh=$source/tools/mesh
export OCL_ICD_VENDORS=$work

echo 'mesh { file "shape.obj" }' >scene.txt
# shape NAME [OPTION...]: with some 4000 triangles, or what the shape has at least.
shape() {
    expect 0 'tools/mesh: ' "$mesh" "$@" --triangles 4000
    local count
    count=$(sed -n 's/^tools\/mesh: \([0-9]*\) triangles.*/\1/p' stderr)
    [ "${count:-0}" -gt 3000 ] && [ "$count" -lt 5600 ] || fail "$*: $count triangles"
    mv stdout shape.obj
    "$mesh" "$@" --triangles 4000 2>/dev/null | cmp -s - shape.obj || fail "$*: another mesh, run again"
    expect 0 '' "$clrt" --check scene.txt
}
for name in knot ball gear pot vase tumbler goblet bloom stalk; do
    shape $name --normals --uvs
    grep -q '^f [0-9]*/[0-9]*/[0-9]* ' shape.obj || fail "$name: corners without uvs or normals"
done
shape island
shape pot --normals
grep -q '^f [0-9]*//[0-9]* ' shape.obj || fail "pot: corners without normals"
shape vase --uvs --digits 2
grep -q '^v -*0\.[0-9]\{1,2\} ' shape.obj || fail "vase: not two digits"
printf 'newmtl glaze\nKd 0 0 1\nnewmtl foot\nKd 1 1 1\n' >pot.mtl
shape pot --library pot.mtl
grep -q '^usemtl glaze' shape.obj || fail "pot: no material"

expect 2 'invalid choice' "$mesh" teapot
expect 2 'from 4 to' "$mesh" knot --triangles 3
expect 2 'from 0 to 9' "$mesh" knot --digits 10
expect 2 'neither normals' "$mesh" island --normals
finish
