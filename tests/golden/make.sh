#!/bin/sh
# make.sh ORACLE CASE: makes the golden of one case anew, by the command in the `origin` line of its case.txt.
# Look at the picture afterwards. There is no way to make all of them at once, on purpose.
set -eu
if [ $# -ne 2 ]; then
    echo "usage: make.sh ORACLE CASE" >&2
    exit 2
fi
oracle=$(realpath "$1")
cd "$(dirname "$0")/$2"
command=$(sed -n 's/^origin[[:space:]]*//p' case.txt)
case $command in
    "clrt-oracle "*) ;;
    *) echo "$2: its golden does not come from the oracle: $command" >&2; exit 1 ;;
esac
# shellcheck disable=SC2086
exec "$oracle" ${command#clrt-oracle }
