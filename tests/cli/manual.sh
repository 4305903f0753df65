#!/bin/sh
# manual.sh CLRT REPO: what the manual of the language and the scenes beside it promise.
# - every ```scene block of REPO/scenes/README.md is a whole scene without errors;
# - every scene in REPO/scenes is one without errors;
# - every scene has its row in the manual's table.
# A block marked ```scene NAME is kept as NAME, so that blocks after it can include it; one marked
# ```file NAME is kept for them and is no scene. Blocks find the folders of files that the scenes share.
set -u

if [ $# -ne 2 ]; then
    echo "usage: $0 CLRT REPO" >&2
    exit 2
fi
clrt=$1
case $clrt in */*) clrt=$(cd "$(dirname "$clrt")" && pwd)/$(basename "$clrt") ;; esac
scenes=$(cd "$2" && pwd)/scenes || exit 2
manual=$scenes/README.md

folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
trap 'exit 130' INT TERM

failures=0
fail() {
    echo "FAIL $1" >&2
    failures=$((failures + 1))
}

for shared in textures meshes; do
    ln -s "$scenes/$shared" "$folder/$shared" || exit 2
done

# Writes each block to a file of its own; the list says kind, line in the manual and file.
awk -v folder="$folder" '
    block == "" && /^```/ {
        kind = substr($1, 4)
        block = (kind == "scene" || kind == "file") ? "kept" : "other"
        start = NR
        if (block == "kept") {
            file = folder "/" (NF > 1 ? $2 : "line_" NR ".txt")
            printf "" > file
            if (kind != "file")
                print kind, NR, file
        }
        next
    }
    block != "" && /^```[ \t]*$/ {
        if (block == "kept")
            close(file)
        block = ""
        next
    }
    block == "kept" { print > file }
    END { if (block != "") print "unclosed", start, "-" }
' "$manual" > "$folder/list"

# expect_clean NAME FILE: --check accepts FILE without a word of error.
expect_clean() {
    (cd "$folder" && "$clrt" --check "$2") > "$folder/output" 2>&1
    status=$?
    if [ $status -ne 0 ]; then
        fail "$1: exit status $status, expected 0"
        sed 's/^/    /' "$folder/output" >&2
    fi
}

clean=0
while read -r kind line file; do
    case $kind in
        scene)
            clean=$((clean + 1))
            expect_clean "manual, line $line" "$file" ;;
        *)
            fail "manual, line $line: the block is not closed" ;;
    esac
done < "$folder/list"

# The manual has at least an example for each statement and shape.
[ "$clean" -ge 25 ] || fail "only $clean scene blocks found in $manual"

files=0
for file in "$scenes"/*.txt; do
    name=$(basename "$file")
    files=$((files + 1))
    expect_clean "scenes/$name" "$file"
    grep -q "^| \[$name\]($name) |" "$manual" || fail "scenes/$name: not in the manual's table of scenes"
done
[ "$files" -ge 11 ] || fail "only $files scenes found in $scenes"

echo "manual: $clean examples, $files scenes, $failures failures"
[ "$failures" -eq 0 ]
