#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The scripts of input/suites: each makes the file of a study run as a whole, goes on after an
# interruption, carries failed runs through to the end, and makes nothing of what does not fit.
. tests/support/cli.sh

if ! command -v h5diff >/dev/null; then
    skip "suites run in parts" "no h5diff"
    exit 0
fi

suites=$root/input/suites
mkdir bin records
ln -s "$jostle" bin/jostle
PATH=$here/bin:$PATH
for i in 1 2; do
    awk -v i=$i 'BEGIN { for (k = 0; k < 200; k++) print i * sin((0.05 + 0.05 * i) * k) }' >records/$i.txt
done
deck="it's a suite.deck"
two_buildings "$deck"
sed -i 's/^param gap .*/sweep gap values 2mm 4mm -1mm 6mm/; s/^ground .*/ground record $record -unit m\/s2 -dt 0.01/' "$deck"
sed -i '3i sweep record files "records/*.txt"' "$deck"
"$jostle" run "$deck" -q -o whole.h5 2>"$err"
expect "two of the eight runs of the suite fail" 'said "2 of 8 runs failed"'
result=${deck%.deck}

# suite NAME COMMAND...: the command runs the suite in 3 parts.
suite() {
    local name=$1
    shift
    rm -f "$result".*h5* jostle-*.log ./*.joblog
    # A part that is there already.
    jostle run "$deck" -q --shard 2/3 2>/dev/null
    cp "$result.2-of-3.h5" kept.h5
    run "$@"
    expect "$name: exit status 1 says that runs have failed" '[ $status -eq 1 ]'
    expect "$name: parts that were there are kept" 'cmp kept.h5 "$result.2-of-3.h5"'
    expect "$name: all runs are there, failed ones too" 'same whole.h5 "$result.h5"'
    rm -f "$result.h5" ./*.joblog
    cp "$deck" kept.deck
    sed -i 's|^step .*|step fixed 2ms|' "$deck"
    run "$@"
    cp kept.deck "$deck"
    expect "$name: parts of another study end in an error, not in a result" '[ $status -ge 2 ] && [ ! -e "$result.h5" ]'
    echo 'building' >>"$deck"
    run "$@"
    cp kept.deck "$deck"
    expect "$name: so does a deck that is wrong" '[ $status -ge 2 ] && [ ! -e "$result.h5" ] && said "building"'
}

suite loop sh "$suites/loop.sh" "$deck" 3
suite xargs sh "$suites/xargs.sh" "$deck" 3
if parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
    suite parallel sh "$suites/parallel.sh" "$deck" 3
    suite "parallel with hosts" env HOSTS=2/: sh "$suites/parallel.sh" "$deck" 3
    rm -f "$result".*h5 ./*.joblog
    run sh "$suites/parallel.sh" "$deck" 3
    rm "$result.3-of-3.h5" "$result.h5"
    awk -F '\t' -v OFS='\t' '$1 == 3 { $7 = 137 } { print }' ./*.joblog >log
    mv log "$deck.3.joblog"
    run sh "$suites/parallel.sh" "$deck" 3
    expect "parallel: only a part that failed is run again" '[ $status -eq 1 ] && same whole.h5 "$result.h5" && [ "$(cut -f 1 "$deck.3.joblog" | grep -c "^1$")" -eq 1 ]'
else
    skip "parallel: a suite" "no GNU parallel"
fi

# Submits, and waits until no job is left. Prints the end of the merge job: STATE EXIT:SIGNAL.
cat >slurm_suite <<'END'
set -eu
numbers=$(sh "$1/slurm/submit.sh" "$2" 3)
for _ in $(seq 600); do
    squeue -h | grep -q . || break
    sleep 0.1
done
scontrol -o show job "${numbers#* }" | sed 's/.* JobState=\([A-Z]*\) .* ExitCode=\([0-9:]*\) .*/\1 \2/' >merge_job
grep -q '^COMPLETED' merge_job || { cat jostle-*.log; exit "$(sed 's/.* //; s/:.*//; s/^0$/3/' merge_job)"; } >&2
END
run bash "$root/tests/support/slurm.sh" true
if [ $status -ne 0 ]; then
    skip "Slurm: a suite" "$(head -n 1 "$err")"
    exit $failed
fi
suite Slurm bash "$root/tests/support/slurm.sh" sh slurm_suite "$suites" "$deck"
