#!/bin/sh
# layers.sh SOURCE_DIR: modules include only themselves and those before them; `kernel void` stands in
# stages/ only, and in selftest/, which is a program of its own; only main.c and what stands beside it ends
# the program or handles signals.
# Exit status: 0 clean, 1 complaints.
set -u
cd "$1" || exit 1
status=0

complain() {
    echo "$1"
    status=1
}

# includes FOLDER: lines "file:line:folder" of the quoted includes below FOLDER.
includes() {
    grep -rnE --include='*.[ch]' --include='*.cl' '^ *# *include *"' "$1" 2>/dev/null |
        sed -E 's|^([^:]*:[0-9]*):.*"([^/"]*)/?[^"]*".*|\1:\2|'
}

# check_order ROOT ALSO FOLDER...: each folder of ROOT includes those before it, itself, and those in ALSO.
check_order() {
    root=$1
    allowed=" $2 "
    shift 2
    for folder in "$@"; do
        allowed="$allowed$folder "
        for found in $(includes "$root/$folder"); do
            case "$allowed" in
                *" ${found##*:} "*) ;;
                *) complain "${found%:*}: $root/$folder must not include ${found##*:}/" ;;
            esac
        done
    done
}

# kernels/shared is common to host and device, bundle is the text of the kernels.
check_order host "shared bundle" base image scene assets accel layout device render budget output selftest cli
for found in $(includes kernels/shared); do
    [ "${found##*:}" = shared ] || complain "${found%:*}: kernels/shared must not include ${found##*:}/"
done
check_order kernels "shared" base shapes accel texture material light stages selftest

for folder in host/*/ kernels/*/; do
    case " host/base/ host/image/ host/scene/ host/assets/ host/accel/ host/layout/ host/device/ \
host/render/ host/budget/ host/output/ host/selftest/ host/cli/ kernels/shared/ kernels/base/ kernels/shapes/ \
kernels/accel/ kernels/texture/ kernels/material/ kernels/light/ kernels/stages/ \
kernels/selftest/ " in
        *" $folder "*) ;;
        *) complain "$folder: has no place in the order of tools/lint/layers.sh" ;;
    esac
done

found=$(grep -rnE '\bkernel[[:space:]]+void\b' kernels --include='*.h' --include='*.cl' |
    grep -vE '^kernels/(stages|selftest)/|^[^:]*:[0-9]*:[[:space:]]*//')
[ -z "$found" ] || complain "kernel void outside kernels/stages and kernels/selftest:
$found"

ending='\b(_?exit|_Exit|quick_exit|abort|atexit|signal|sigaction|sigwait) *\('
found=$(grep -rnE "$ending" host --include='*.[ch]' |
    grep -vE '^host/(main|picture|interrupt)\.[ch]:|^[^:]*:[0-9]*:[[:space:]]*//')
[ -z "$found" ] || complain "exit or signals outside host/main.c:
$found"

[ "$status" -eq 0 ] && echo "layers are in order"
exit "$status"
