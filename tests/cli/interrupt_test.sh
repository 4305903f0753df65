#!/usr/bin/env bash
# SIGINT and SIGTERM are answered within a second, while the program compiles and while it renders; the old
# picture stays, and nothing else.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
need_device
set -m # jobs take SIGINT
small_scene >scene.txt
echo old >out.png

milliseconds() { echo $(($(date +%s%N) / 1000000)); }

# interrupt SIGNAL PAUSE: sends the signal PAUSE seconds after the device is open, and leaves in `took` the
# milliseconds until the program has ended.
interrupt() {
    local job start status
    "$clrt" -v --size 512x512 --samples 1048576 scene.txt out.png 2>stderr &
    job=$!
    for ((i = 0; i < 600; i++)); do
        grep -q 'clrt: device' stderr && break
        sleep 0.05
    done
    sleep "$2"
    start=$(milliseconds)
    kill "-$1" "$job" || fail "ended before the signal: $(cat stderr)"
    wait "$job"
    status=$?
    took=$(($(milliseconds) - start))
    [ "$status" -eq 130 ] || fail "$1 after $2 s: status $status, not 130"
    grep -q interrupted stderr || fail "$1 after $2 s: said $(cat stderr)"
    [ "$(cat out.png)" = old ] || fail "$1 after $2 s: the old picture is gone"
    [ "$(ls -A | tr '\n' ' ')" = "out.png scene.txt stderr " ] || fail "$1 after $2 s: left $(ls -A)"
}

# answers WHAT SIGNAL PAUSE: the best of three takes less than a second, as other programs may hold this one up.
answers() {
    for attempt in 1 2 3; do
        [ -z "$cold" ] || export POCL_CACHE_DIR=$cold/$2-$attempt
        interrupt "$2" "$3"
        echo "$1: $2 answered in $took ms"
        [ "$took" -lt 1000 ] && return
    done
    fail "$1: $2 answered after $took ms"
}

# Shells that were started to ignore SIGINT cannot give it to their jobs.
ignored=$(sed -n 's/^SigIgn:\t//p' /proc/self/status 2>/dev/null)
signals=TERM
[ $((0x${ignored:-0} & 2)) -ne 0 ] || signals='INT TERM'

cold=$(mktemp -d)
for signal in $signals; do
    answers compiling "$signal" 0.1
done
rm -rf "$cold"
cold=
unset POCL_CACHE_DIR
"$clrt" -q --size 512x512 --samples 2 scene.txt - >/dev/null # so that what follows is compiled
for signal in $signals; do
    answers rendering "$signal" 1
done
finish
