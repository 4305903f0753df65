#!/usr/bin/env bash
# clrt-report: its figures with a renderer of which all is known, what it says when something is wrong, that nothing
# half-written is left, and a small report of the real clrt.
. "$(dirname "${BASH_SOURCE[0]}")/lib"
report=$(dirname "$clrt")/clrt-report
[ -x "$report" ] || skip "no clrt-report"

# A clrt whose pictures of 8 x 8 pixels are grey 1 where they are references or double, 1 + 1/4n with n samples and a
# seed, and one ulp off in the first pixel without a seed. It uses nothing but the shell. FAKE: what is wrong with it.
cat >fake <<'END'
#!/bin/bash
samples=16 seed= math=exact aov= check= stats= crop= kind=mirrored idle=null
while [ $# -gt 0 ]; do
    case $1 in
        --check) check=yes ;;
        --stats=*) stats=${1#--stats=} ;;
        --samples) samples=$2; shift ;;
        --seed) seed=$2; shift ;;
        --math) math=$2; shift ;;
        --aov) aov=$2; shift ;;
        --crop) crop=$2; shift ;;
        --integrator) [ "$2" = path ] && kind=scattered idle=0.125; shift ;;
        --size | --device | --depth) shift ;;
        --) shift; break ;;
    esac
    shift
done
scene=$1 out=$2
[ -e "$scene" ] || { echo "clrt: $scene: No such file" >&2; exit 4; }
[ "$FAKE" = errors ] && { echo "$scene:1:1: error: this is no scene" >&2; exit 1; }
[ "$check" ] && exit 0
[ "$FAKE" = device ] && { echo 'clrt: there is no device' >&2; exit 3; }
[ "$FAKE" = no-double ] && [ "$math" = double ] && { echo 'clrt: the device has no fp64' >&2; exit 3; }
[ "$FAKE" = slow ] && { echo $$ >fake.pid; while :; do read -rt 1 <>pipe; done; }
one='\0\0\x80\x3f' grey=$one first=$one
case $seed:$samples in
    :*) [ "$math" = double ] || first='\x01\0\x80\x3f' ;;
    100000?:* | 100001?:*)
        [ "$FAKE" = noisy ] && grey=$([ $((seed % 2)) = 0 ] && echo '\0\0\0\x3f' || echo '\0\0\xc0\x3f') && first=$grey ;;
    *:1) grey='\0\0\xa0\x3f' first=$grey ;;
    *:4) grey='\0\0\x88\x3f' first=$grey ;;
    *:16) grey='\0\0\x82\x3f' first=$grey ;;
esac
picture() {
    printf 'PF\n8 8\n-1.0\n'
    for ((i = 0; i < 64; i++)); do
        [ $i = 0 ] && printf "$2$2$2" || printf "$1$1$1"
    done
}
picture "$grey" "$first" >"$out"
[ "$aov" ] && picture "$one" "$([ "$math" = double ] && echo "$one" || echo '\0\0\0\x40')" >"${out%.pfm}.id.pfm"
pixels=64
[ "$crop" ] && pixels=1
printf '{"width": 8, "height": 8, "device": "none & nowhere", "features": ["A", "B"],
 "seconds": {"total": 0.5, "device": 0.1, "scene": 0.01, "meshes": 0, "layout": 0.02, "compile": 0.25, "trace": %s},
 "bytes": {"device_peak": 1048576, "scene": 1, "state": 2, "film": 3, "host_peak": 4},
 "rays": {"camera": %d, "shadow": 10, "'$kind'": 20, "transmitted": 0}, "idle_lanes": '$idle',
 "run": {"scene_hash": "0123456789abcdef", "kernel_hash": "k", "driver": "1"}, "budget": {"e_quant": 0.25}}' \
    "0.$((1000 + samples))" $((pixels * samples)) >"$stats"
END
chmod +x fake
mkfifo pipe
export FAKE=
echo 'sphere { }' >'a<b.txt'

# value NAME MODE: of a column of report.csv in the row of a mode; no value of the fake has a comma.
value() {
    awk -F, -v name="$1" -v mode="$2" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
        NR > 1 && $at["run.mode"] == mode { print $at[name] }' report/report.csv
}
# is NAME MODE VALUE: up to rounding.
is() {
    local got
    got=$(value "$1" "$2")
    awk -v a="$got" -v b="$3" 'BEGIN { exit !(a != "" && a - b <= 1e-6 * b && b - a <= 1e-6 * b) }' ||
        fail "$1 of $2 is '$got', not $3"
}
nothing_left() {
    ls -d report.* >/dev/null 2>&1 && fail "left behind: $(ls -d report.*)"
    ls -d "$TMPDIR"/* >/dev/null 2>&1 && fail "left behind: $(ls -d "$TMPDIR"/*)"
}
export TMPDIR=$work/tmp
mkdir "$TMPDIR"

expect 0 '' "$report" --help
grep -q '^usage: clrt-report' stdout || fail "no usage"
expect 0 '' "$report" --version
expect 2 'no scene' "$report"
expect 2 'not an option' "$report" --fast 'a<b.txt'
expect 2 'rising' "$report" --samples 4,1 'a<b.txt'

# ---- figures -----------------------------------------------------------------------------------------------------
run=("$report" --clrt ./fake --samples 1,4 --runs 3 --cold-runs 2)
expect 0 'warm run 3 of 3' "${run[@]}" --variant low="--depth 1 --integrator path" --peers <(echo 'other & more,1,0.5') 'a<b.txt'
grep -q '^a_b *exact ' stdout || fail "no row in the table: $(cat stdout)"
[ "$(wc -l <report/report.csv)" = 5 ] || fail "not four rows in the CSV"
[ "$(wc -l <report/rows.jsonl)" = 4 ] || fail "not four rows of JSON"
[ "$(grep -c '^a_b,none & nowhere,exact,' report/convergence.csv)" = 2 ] || fail "not two points of exact"
grep -q '"schema": "clrt-report/1"' report/report.json || fail "no schema"
# The scene has 16 samples, the most that is measured is 4.
is run.spp.mean exact 4
is rays.camera exact 256
is rays.total exact 286
is rays.reflect exact 20
[ -z "$(value rays.idle_lanes exact)" ] || fail "lanes of nothing are idle"
is rays.reflect low 20
is rays.idle_lanes low 0.125
is time.warm.kernel_s.median exact 0.1004
is time.warm.kernel_s.mad exact 0
is rays.ns_per_ray exact $(awk 'BEGIN { printf "%.9g", 0.1004 / 286 * 1e9 }')
is time.cold_runs exact 2
is time.cold.compile_s.median fast 0.25
is memory.device_peak_bytes exact 1048576
is error.r64.max_ulp exact 1
is error.r64.max_abs exact 1.1920929e-7
is error.r64.different_values exact 3
is error.r64.values exact 192
is error.r64.other_object_pixels exact 1
is error.r64_one_sample.spp exact 1
is error.rinf.rmse exact 0.0625
is error.rinf.mse exact 0.00390625
is error.rinf.bias low 0.0625
is error.rinf.bias_low exact 0.0625
is error.rinf.reference.standard_error exact 0
is error.rinf.reference.spp exact 128
is error.rinf.relmse exact $(awk 'BEGIN { printf "%.9g", 0.00390625 / 1.01 }')
is efficiency.per_mse_kernel exact $(awk 'BEGIN { printf "%.9g", 1 / (0.00390625 * 0.1004) }')
is time.kernel_to_exact.median fast 1
is budget.e_quant exact 0.25
is health.nan_values exact 0
[ -z "$(value error.r64.max_ulp double)" ] || fail "double has an error against itself"
[ "$(value run.kernel_hash exact)" = k ] || fail "no hash of the kernels"
html=report/report.html
grep -q 'none &amp; nowhere' $html || fail "the device is not escaped"
grep -q '<code>a&lt;b.txt</code>' $html || fail "the scene's file is not escaped"
grep -qE '(src|href)="[^d]' $html && fail "the page needs something beside itself"
grep -q 'data:image/png;base64,' $html || fail "no maps in the page"
if command -v gnuplot >/dev/null; then
    [ "$(grep -c 'data:image/svg' $html)" = 3 ] || fail "not three plots in the page"
    grep -q 'other &amp; more\|other & more' report/plots/a_b_pareto.svg || fail "no peer in the plot"
fi
nothing_left

# Without gnuplot the data are there and the page says so.
expect 0 '*' env PATH=/nowhere "${run[@]}" --quiet --math exact 'a<b.txt'
grep -q 'gnuplot was not found' $html || fail "the page does not say that there is no gnuplot"
[ -s report/plots/a_b_convergence.dat ] || fail "no data of the plot"
[ -e report/plots/a_b_convergence.svg ] && fail "who has drawn this?"

FAKE=no-double expect 0 'fp64' "${run[@]}" 'a<b.txt'
grep -q 'the device has no fp64' $html || fail "the page does not say why there is no double"
is error.rinf.rmse exact 0.0625
[ -z "$(value error.r64.max_abs exact)" ] || fail "an error against a double that there is not"
[ "$(value error.r64.reason exact)" ] || fail "no reason why there is none"

FAKE=noisy expect 0 '*' "${run[@]}" --math exact 'a<b.txt'
[ -z "$(value error.rinf.rmse exact)" ] || fail "an error against a reference that is noise"
grep -q 'more than a quarter of this error' report/report.json || fail "no reason for the refusal"

expect 0 '*' "${run[@]}" --quiet --features=torus,checker
[ "$(grep -c '"feature":' report/report.json)" = 3 ] || fail "not the control and two features"
grep -q '"same_kernels": true' report/report.json || fail "the same hash is not the same"

# ---- what is wrong -----------------------------------------------------------------------------------------------
# An older report stays as it is.
cp report/report.json before
FAKE=errors expect 1 'error: this is no scene' "${run[@]}" 'a<b.txt'
FAKE=device expect 3 'there is no device' "${run[@]}" 'a<b.txt'
expect 4 'No such file' "${run[@]}" none.txt
expect 4 'No such file' "${run[@]}" --against none.txt 'a<b.txt'
expect 4 'no-such-clrt' "$report" --clrt ./no-such-clrt 'a<b.txt'
expect 4 'none.csv' "${run[@]}" --peers none.csv 'a<b.txt'
expect 4 'none.json' "${run[@]}" --ulp none.json 'a<b.txt'
expect 2 "no feature 'wings'" "${run[@]}" --features=wings
cmp -s report/report.json before || fail "a failed run has changed the report"
expect 4 'none/report' "${run[@]}" --out none/report 'a<b.txt'
mkdir mine && touch mine/own
expect 2 'is no report' "${run[@]}" --out mine 'a<b.txt'
[ "$(ls mine)" = own ] || fail "a folder that was no report has changed"
nothing_left

FAKE=slow "${run[@]}" --quiet 'a<b.txt' 2>stderr &
asked=$!
i=0
until [ -s fake.pid ] || [ $((i++)) -gt 200 ]; do sleep 0.1; done
kill -TERM $asked
wait $asked
[ $? = 130 ] || fail "interrupted, it did not end with 130: $(cat stderr)"
kill -0 "$(cat fake.pid)" 2>/dev/null && fail "the child goes on"
nothing_left

# ---- the real one ------------------------------------------------------------------------------------------------
"$clrt" --list-devices >/dev/null 2>&1 || finish
small_scene >small.txt
expect 0 '*' "$report" --quiet --math exact --samples 1,4 --runs 2 --cold-runs 1 --reference-samples 512 small.txt
is rays.camera exact 768
is run.width exact 32
is error.rinf.reference.spp exact 512
awk -v e="$(value error.rinf.rmse exact)" 'BEGIN { exit !(e > 0.001 && e < 0.2) }' ||
    fail "what an error: $(value error.rinf.rmse exact)"
[ "$(value health.image_hash exact | wc -c)" = 17 ] || fail "no hash of the picture"
nothing_left
finish
