#!/bin/sh
# run.sh CLRT COMPARE CASE_DIR OUT_DIR: renders a case and compares it with its golden (README.md).
# Exit status: 0 same, 1 different or failed, 77 there is no device to render on.
set -u
if [ $# -ne 4 ]; then
    echo "usage: run.sh CLRT COMPARE CASE_DIR OUT_DIR" >&2
    exit 2
fi
clrt=$1 compare=$2 case_dir=$3 out_dir=$4
name=$(basename "$case_dir")

# The words after a key of case.txt.
value() {
    sed -n "s/^$1[[:space:]]*//p" "$case_dir/case.txt"
}

mkdir -p "$out_dir" || exit 1
out=$out_dir/$name.png
rm -f "$out"
# The options are words without quotes by the format of case.txt.
# shellcheck disable=SC2046
"$clrt" -q $(value options) "$case_dir/scene.txt" "$out"
status=$?
if [ $status -eq 3 ] && [ -z "$("$clrt" --list-devices 2>/dev/null)" ]; then
    echo "$name: skipped, there is no OpenCL device"
    exit 77
fi
if [ $status -ne 0 ] || [ ! -f "$out" ]; then
    echo "$name: clrt ended with status $status"
    exit 1
fi

# shellcheck disable=SC2046
set -- $(value tolerance)
set -- --fail "$1" --fail-percent "$2" --hard-fail "$3" --map "$out_dir/$name-map.png"
if [ -f "$case_dir/unstable.png" ]; then
    set -- "$@" --mask "$case_dir/unstable.png"
fi
if "$compare" "$@" "$out" "$case_dir/golden.png"; then
    exit 0
fi
echo "$name differs: $(value reason)"
echo "  rendered  $out"
echo "  golden    $case_dir/golden.png"
echo "  heat map  $out_dir/$name-map.png"
exit 1
