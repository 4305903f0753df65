#!/bin/sh
# kernels.sh BUNDLE SOURCE_DIR: compiles the flattened kernels with clang, warnings as errors, with all
# features off, all on, all but those of paths on, and each alone, as a CPU and as a GPU take them, and each with paths;
# those of the self-test with all on but those of paths.
# Double and fast arithmetic with all off and all on.
# BUNDLE is the clrt-bundle program.
# Exit status: 0 clean, 1 complaints, 77 skipped because something is missing.
set -u
bundle=$1
source=$2

clang=$(command -v clang || ls /usr/bin/clang-[0-9]* 2>/dev/null | sort -V | tail -n 1)
if [ -z "$clang" ]; then
    echo "skipped: no clang"
    exit 77
fi
if [ ! -f "$source/kernels/program.cl" ]; then
    echo "skipped: no kernels/program.cl"
    exit 77
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
"$bundle" "$source/kernels" program.cl "$work/program.cl" || exit 1
"$bundle" "$source/kernels" selftest/self_test.cl "$work/self_test.cl" || exit 1

# All, and all but those of paths.
features=$(sed -n 's/^ *FEATURE(\([A-Z0-9_]*\),.*/\1/p' "$source/kernels/shared/features.def")
if [ -z "$features" ]; then
    echo "error: no FEATURE(NAME, \"meaning\") lines in kernels/shared/features.def"
    exit 1
fi

whitted=$(echo "$features" | grep -vxE 'PATH|MANY_LIGHTS')

# definitions NAME...: -D text of all features, on for those named.
definitions() {
    for feature in $features; do
        case " $* " in
            *" $feature "*) printf ' -DHAS_%s=1' "$feature" ;;
            *) printf ' -DHAS_%s=0' "$feature" ;;
        esac
    done
}

# Functions and parameters that only some features use are no fault.
# A line is the name of a program and its options.
check='program=${3%% *}; options=${3#* }
    "$1" -x cl -cl-std=CL1.2 -fsyntax-only -Xclang -finclude-default-header -Wall -Wextra -Wundef -Werror \
    -Wno-unused-function -Wno-unused-parameter $options "$2/$program" 2>"$2/$$.log" ||
    { echo "$program with $options"; cat "$2/$$.log"; exit 1; }'
exact="-DMATH_FAST=0 -DMATH_DOUBLE=0"
for machine in "-DLANES=8 -DBATCH=32 -DGROUP=1 $exact" "-DLANES=1 -DBATCH=1 -DGROUP=64 $exact" \
    "-DLANES=8 -DBATCH=32 -DGROUP=1 -DMATH_FAST=1 -DMATH_DOUBLE=0" \
    "-DLANES=1 -DBATCH=1 -DGROUP=64 -DMATH_FAST=0 -DMATH_DOUBLE=1"; do
    echo "program.cl $machine$(definitions)"
    echo "program.cl $machine$(definitions $features)"
    echo "program.cl $machine$(definitions $whitted)"
    echo "self_test.cl $machine$(definitions $whitted)"
    case $machine in *"$exact") ;; *) continue ;; esac
    for feature in $features; do
        echo "program.cl $machine$(definitions "$feature")"
        case $machine in
            -DLANES=8*) [ "$feature" = PATH ] || echo "program.cl $machine$(definitions "$feature" PATH)" ;;
        esac
    done
done >"$work/configurations"
tr '\n' '\0' <"$work/configurations" |
    xargs -0 -n 1 -P "$(nproc 2>/dev/null || echo 1)" \
        sh -c "$check" check "$clang" "$work" >"$work/log"
status=$?
head -n 100 "$work/log"
echo "$(wc -l <"$work/configurations") configurations compiled by $clang"
[ "$status" -eq 0 ]
