#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# studies.sh JOSTLE FOLDER: prints what a suite of records, intensities and gaps costs, on one thread and
# on two, and the memory of studies of few and of many runs. RECORDS: the folder of the records (*.AT2);
# ROUNDS: how often.
set -euo pipefail
jostle=$(realpath "$1")
folder=$2
records=$(realpath "${RECORDS:-input/records}")
rounds=${ROUNDS:-3}
. tests/support/many_runs.sh
peak=$(realpath tests/support/peak.py)

mkdir -p "$folder"
cd "$folder"
cat >suite.deck <<END
units kN m s
sweep record files "$records/*.AT2"
sweep pga range 1m/s^2 10m/s^2 20
sweep gap values 10mm 20mm 50mm
building A -floors 8 -mass 300t -stiffness 345MN/m -height 3m
building B -floors 5 -mass 300t -stiffness 345MN/m -height 3m
damping A rayleigh 5%
damping B rayleigh 5%
contact A B -gap \$gap -law jankowski -k 2.75e9N/m^1.5 -e 0.65
ground record \$record -pga \$pga
step fixed 1ms
END
"$jostle" check suite.deck 2>/dev/null >check.txt
n_run=$(sed -n 's/^study of \([0-9]*\) runs/\1/p' check.txt)
n_record=$((n_run / 60))

# Seconds of the suite on so many threads, the fastest of the rounds; rounds take turns, so that what
# else the machine does meets both.
TIMEFORMAT='%R %U %S'
for _ in $(seq "$rounds"); do
    for threads in 1 2; do
        echo "$threads $({ time "$jostle" run suite.deck -q --force -j $threads -o suite.h5; } 2>&1)"
    done
done | awk 'function least(a, b) { return a == "" || b < a ? b : a }
    { wall[$1] = least(wall[$1], $2); cpu[$1] = least(cpu[$1], $3 + $4) }
    END { print wall[1], cpu[1], wall[2], cpu[2] }' >times.txt
read -r one one_cpu two two_cpu <times.txt
LC_ALL=C date -u '+%Y-%m-%d' | tr '\n' ','
sed -n 's/^model name[^:]*: *\(.*\)/ \1/p' /proc/cpuinfo | head -n 1
echo "$n_record records x 20 intensities x 3 gaps: $n_run runs, fastest of $rounds rounds"
awk -v one="$one" -v two="$two" -v one_cpu="$one_cpu" -v two_cpu="$two_cpu" -v n="$n_run" 'BEGIN {
    line = "  %-34s %6.2f s %6.2f ms a run, %6.2f ms of CPU time\n"
    printf line, "one thread", one, 1e3 * one / n, 1e3 * one_cpu / n
    printf line, "two threads", two, 1e3 * two / n, 1e3 * two_cpu / n
    printf "  %-34s %6.2f\n", "speed-up", one / two
}'

# memory TEXT WORD...
memory() {
    local text=$1
    shift
    printf '  %-34s %6.1f MiB\n' "$text" "$(python3 "$peak" "$@" | awk '{ print $1 / 1024 }')"
}

echo "largest memory"
memory "$n_run runs of the suite, 2 threads" "$jostle" run suite.deck -q --force -j 2 -o suite.h5
for n in 10 100 200; do
    many_runs $n >many.deck
    memory "$((n * n)) short runs, 2 threads" "$jostle" run many.deck -q --force -j 2 -o many.h5
done
many_runs 100 >many.deck
parts=()
for k in $(seq 16); do
    parts+=("part.$k.h5")
    "$jostle" run many.deck -q --force --shard "$k/16" -o "part.$k.h5"
done
memory "10000 short runs merged, 16 parts" "$jostle" merge "${parts[@]}" -q --force -o many.h5
rm -f suite.h5 many.h5 "${parts[@]}"
