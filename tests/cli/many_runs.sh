#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A study of ten thousand runs: its file opens in xarray, one slice of it takes milliseconds, and the
# program needs no more memory than for a small one, but for a buffer. The same with eight sweeps, and
# a study of a hundred thousand runs.
. tests/support/cli.sh
. "$root/tests/support/many_runs.sh"

many_runs 10 >few.deck
many_runs 100 >many.deck

if ! python3 -c 'import xarray, netCDF4' 2>/dev/null; then
    skip "a study of ten thousand runs opens in xarray" "no xarray"
    exit 0
fi

# cost DECK: the largest memory [KiB] and the CPU time [s] of the study.
cost() {
    python3 "$root/tests/support/peak.py" "$jostle" run "$1" -q
}
read -r few _ < <(cost few.deck)
read -r many _ < <(cost many.deck)
expect "a study of ten thousand runs ends" '[ "$("$jostle" show many.h5 | head -n 1)" = "study of 10000 runs, 0 failed" ]'
if [ -n "${JOSTLE_SANITIZED-}" ]; then
    skip "it needs no more memory than one of a hundred" "the sanitizers keep what is freed"
else
    # Its file is written in blocks of up to 16 MiB with 2 MiB of messages; 8 bytes a run say where
    # its results are in the journal; the rest is for the library.
    expect "it needs $many KiB, one of a hundred $few: 24 MiB more at most" '[ "$many" -lt $((few + 24 * 1024)) ]'
fi
for k in 1 2 3; do
    "$jostle" run many.deck --shard $k/3 -q
done
run "$jostle" merge many.?-of-3.h5 -q -o merged.h5
if command -v h5diff >/dev/null; then
    expect "its parts are joined" '[ $status -eq 0 ] && same many.h5 merged.h5'
fi

# Reading 8 numbers takes 1 ms here, of which the disk has no part; 50 ms are for a busy machine, and
# less than a tenth of what reading the whole table in text would take.
cat >slice.py <<'END'
import time, xarray
def best(of):
    times = []
    for _ in range(10):
        start = time.perf_counter()
        result = of()
        times.append(time.perf_counter() - start)
    return result, 1e3 * min(times)
peak, opened = best(lambda: xarray.open_dataset("many.h5", group="buildings/A/envelope"))
drift, took = best(lambda: peak.drift.sel(gap=0.0107, amplitude=2.2, method="nearest").load())
assert drift.dims == ("floor",) and drift.shape == (8,) and float(drift.min()) > 0
curve, curve_took = best(lambda: peak.drift.sel(gap=0.0107, floor=1, method="nearest").load())
assert curve.dims == ("amplitude",) and curve.shape == (100,)
print(f"opened in {opened:.1f} ms, a run selected in {took:.1f} ms, a curve in {curve_took:.1f} ms")
assert took < 50 and curve_took < 50
END
run python3 slice.py
expect "in xarray it is $(cat "$out")" '[ $status -eq 0 ]'
rm -f ./*.h5

# Ten thousand runs once more, of eight sweeps.
{
    i=0
    for n in 2 5 2 5 2 5 2 5; do
        i=$((i + 1))
        echo "sweep s$i range $i $((i + 1)) $n"
    done
    cat <<'END'
building A -floors 2 -mass 1 -stiffness 400
contact A:1 wall -gap 0.01 -law linear -k 1000
load A:all constant ${$s1 + $s2 + $s3 + $s4 + $s5 + $s6 + $s7 + $s8}
step fixed 0.01
duration 0.1
END
} >eight.deck
run "$jostle" run eight.deck -q
cat >eight.py <<'END'
import xarray
drift = xarray.open_dataset("eight.h5", group="buildings/A/envelope").drift
assert drift.dims == ("s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8", "floor")
assert drift.shape == (2, 5, 2, 5, 2, 5, 2, 5, 2) and int(drift.isnull().sum()) == 0
one = drift.sel(s1=2, s2=2.25, s3=3, s4=5, s5=6, s6=6, s7=7, s8=9, floor=1)
last = drift.isel(s1=1, s2=1, s3=0, s4=4, s5=1, s6=0, s7=0, s8=4, floor=0)
assert float(one) == float(last) > 0
END
[ $status -ne 0 ] || run python3 eight.py
expect "ten thousand runs of eight sweeps open in xarray" '[ $status -eq 0 ]'

# What such a study may cost: 60 s of CPU time and 64 MiB.
many_runs 400 250 >most.deck
read -r memory seconds < <(cost most.deck)
if [ -n "${JOSTLE_SANITIZED-}" ]; then
    skip "a hundred thousand runs take 60 s of CPU time and 64 MiB at most" "the sanitizers take more"
else
    expect "a hundred thousand runs take $seconds s of CPU time and $memory KiB: 60 s and 64 MiB at most" \
        '[ "$memory" -lt 65536 ] && [ "${seconds%.*}" -lt 60 ] && [ "$("$jostle" show most.h5 | head -n 1)" = "study of 100000 runs, 0 failed" ]'
fi
