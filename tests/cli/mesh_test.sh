#!/usr/bin/env bash
# Scenes whose meshes are bad end with status 1 and a message that says where, and leave an older picture as
# it was; what is only missing is a warning. No device is needed.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
export OCL_ICD_VENDORS=$work
unset LC_ALL LANG
echo old >out.png

square='v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0'

# mesh FILE: a scene with that mesh.
mesh() { printf '# a mesh\nsphere { center 0 0 -5 radius 1 }\nmesh { file "%s" }\n' "$1" >scene.txt; }

# bad FILE TEXT: the scene with that mesh is an error that says TEXT.
bad() {
    mesh "$1"
    expect 1 "$2" "$clrt" --check scene.txt out.png
    [ ! -s stdout ] || fail "$1: diagnostics on standard output"
}

# fine FILE TEXT: the scene with that mesh has no error and says TEXT.
fine() {
    mesh "$1"
    expect 0 "$2" "$clrt" --check scene.txt out.png
}

bad away.obj "scene.txt:3:8: error: cannot read 'away.obj': No such file or directory"
bad . "scene.txt:3:8: error: cannot read '.': Is a directory"
mkfifo pipe.obj
bad pipe.obj "scene.txt:3:8: error: cannot read 'pipe.obj': not a regular file"
: >empty.obj
bad empty.obj "scene.txt:3:8: error: cannot use 'empty.obj': it has no faces"
echo "$square" >points.obj
bad points.obj "scene.txt:3:8: error: cannot use 'points.obj': it has no faces"
printf '%s\nv 2 0 0\nf 1 2 5\nf 1 2 2\n' "$square" >line.obj
bad line.obj "scene.txt:3:8: error: cannot use 'line.obj': none of its faces has an area"
printf '%s\nf 1 2 5\n' "$square" >index.obj
bad index.obj 'index.obj:5:'
printf '%s\nf 1 2 0\n' "$square" >zero.obj
bad zero.obj 'zero.obj:5:'
printf 'v 0 0 nan\n%s\nf 1 2 3\n' "$square" >nan.obj
bad nan.obj 'nan.obj:1:'
head -c 3000 "$clrt" >junk.obj
bad junk.obj 'junk.obj'
head -c 3000 "$clrt" >junk.xyzzy
bad junk.xyzzy "scene.txt:3:8: error: cannot read 'junk.xyzzy': "
for format in ply stl glb gltf; do
    head -c 3000 "$clrt" >"junk.$format"
    bad "junk.$format" "scene.txt:3:8: error: cannot "
    : >"empty.$format"
    bad "empty.$format" "scene.txt:3:8: error: cannot "
done

# An unreadable file, unless the system lets this user read everything.
printf '%s\nf 1 2 3 4\n' "$square" >secret.obj
chmod 000 secret.obj
[ -r secret.obj ] || bad secret.obj "scene.txt:3:8: error: cannot read 'secret.obj': Permission denied"

printf '%s\nf 1 2 3 4\n' "$square" >square.obj
fine square.obj ''
mkdir folder
mv square.obj folder
fine folder/square.obj ''
mesh square.obj
mv scene.txt folder
expect 0 '' "$clrt" --check folder/scene.txt out.png # beside the scene that names it

printf 'mtllib away.mtl\n%s\nusemtl a\nf 1 2 3 4\n' "$square" >library.obj
fine library.obj "library.obj:1:1: warning: cannot read 'away.mtl': No such file or directory"
printf '%s\nusemtl a\nf 1 2 3 4\n' "$square" >name.obj
fine name.obj "name.obj:5:1: warning: no mtllib of the file has a material 'a'"
mesh name.obj
expect 0 '' "$clrt" --check --quiet scene.txt out.png
printf 'newmtl a\nKd 1 what 0\n' >bad.mtl
printf 'mtllib bad.mtl\n%s\nusemtl a\nf 1 2 3 4\n' "$square" >bad_library.obj
bad bad_library.obj 'bad.mtl:2:'

# Errors of several files are told together.
printf 'mesh { file "index.obj" }\nmesh { file "away.obj" }\n' >scene.txt
expect 1 'index.obj:5:' "$clrt" --check scene.txt out.png
grep -qF "scene.txt:2:8: error: cannot read 'away.obj'" stderr || fail "only the first bad mesh is told"

[ "$(cat out.png)" = old ] || fail "a picture from a broken mesh"
finish
