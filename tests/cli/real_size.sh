#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A study of the size that engineers run: 44 records x 24 intensities x 3 gaps. One that is killed
# amid its runs and again while its file is written, and one in seven parts, give the same datasets
# as one that is left alone.
. tests/support/cli.sh

# 44 records of 8 s: twelve sines each, under an envelope.
mkdir records
awk 'BEGIN {
    srand(22)
    for (k = 1; k <= 44; k++) {
        file = sprintf("records/made_up_%02d.AT2", k)
        print "made up\nsines under an envelope\nACCELERATION IN UNITS OF G" >file
        print "NPTS= 800, DT= .0100 SEC" >file
        for (j = 1; j <= 12; j++) {
            omega[j] = 2.5 * 1.25 ^ j
            amplitude[j] = 0.05 + 0.1 * rand()
            phase[j] = 6.28 * rand()
        }
        for (i = 0; i < 800; i++) {
            t = 0.01 * i
            x = 0
            for (j = 1; j <= 12; j++) {
                x += amplitude[j] * sin(omega[j] * t + phase[j])
            }
            printf "%15.7E%s", x * t * exp(-t / 2), i % 5 == 4 ? "\n" : "" >file
        }
        close(file)
    }
}'
cat >study.deck <<'END'
units kN m s
sweep record files "records/*.AT2"
sweep pga range 0.05g 1.2g 24
sweep gap values 10mm 20mm 50mm
building A -floors 5 -mass 300t -stiffness 345MN/m -height 3m
building B -floors 3 -mass 300t -stiffness 345MN/m -height 3m
damping A rayleigh 5%
damping B rayleigh 5%
contact A B -gap $gap -law jankowski -k 2.75e9N/m^1.5 -e 0.65
ground record $record -pga $pga
step fixed 4ms
END
run "$jostle" run study.deck -o whole.h5
expect "a study of 3168 runs is written" '[ $status -eq 0 ] && grep -q "^study of 3168 runs, 0 failed" "$out" && only study.deck whole.h5 records/made_up_*'

# start_and_kill CONDITION: kills the study as soon as the condition holds, unless it ends before.
start_and_kill() {
    "$jostle" run study.deck -q -o killed.h5 </dev/null 2>"$err" &
    local child=$!
    until eval "$1" || ! kill -0 $child 2>/dev/null; do
        :
    done
    kill -s KILL $child 2>/dev/null
    wait $child 2>/dev/null
    status=$?
}
runs_kept() {
    grep -aoF 'run ' killed.h5.runs 2>/dev/null | wc -l
}

start_and_kill '[ "$(stat -c %s killed.h5.runs 2>/dev/null || echo 0)" -gt 1000000 ]'
kept=$(runs_kept)
expect "it is killed amid its runs" '[ $status -eq 137 ] && [ $kept -gt 100 ] && [ $kept -lt 3168 ] && [ ! -e killed.h5 ]'
# The file takes some tens of milliseconds: now and then the kill comes too late.
for _ in $(seq 10); do
    start_and_kill '[ -e killed.h5.part ]'
    [ -e killed.h5 ] || break
    mv killed.h5 late.h5
    start_and_kill '[ "$(stat -c %s killed.h5.runs 2>/dev/null || echo 0)" -gt 1000000 ]'
done
expect "it is killed while its file is written" '[ $status -eq 137 ] && [ -e killed.h5.part ] && [ ! -e killed.h5 ] && [ $(runs_kept) -ge 3168 ]'
run "$jostle" run study.deck -o killed.h5
expect "the same command writes it" '[ $status -eq 0 ] && [ ! -e killed.h5.part ] && [ ! -e killed.h5.runs ]'

for k in $(seq 7); do
    run "$jostle" run study.deck -q --shard "$k/7" -o "part$k.h5"
    expect "part $k of 7 is written" '[ $status -eq 0 ]'
done
run "$jostle" merge -q part?.h5 -o merged.h5
expect "the parts are merged" '[ $status -eq 0 ]'
if command -v h5diff >/dev/null; then
    expect "from the runs that were kept" 'h5dump -a runs_kept killed.h5 | grep -q "(0): 3168$"'
    expect "the study that was killed has the same datasets" 'same whole.h5 killed.h5'
    expect "so has the one in parts" 'same whole.h5 merged.h5'
else
    skip "the datasets are the same" "no h5diff"
fi
if python3 -c 'import xarray, netCDF4' 2>/dev/null; then
    run python3 - <<'END'
import xarray
drift = xarray.open_dataset("whole.h5", group="/buildings/A/envelope").drift
assert drift.dims == ("record", "pga", "gap", "floor") and drift.shape == (44, 24, 3, 5)
assert float(drift.min()) > 0
END
    expect "and opens in xarray" '[ $status -eq 0 ]'
else
    skip "and opens in xarray" "no xarray"
fi
