#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle status tells how far studies are, complete, running, stopped and killed ones, and does not
# disturb the one that runs. Limits of a run make it a failed run.
. tests/support/cli.sh

study_of_records study.deck 60 2000
run "$jostle" run study.deck -q -o whole.h5
failing_study fails.deck
"$jostle" run fails.deck -q -o fails.h5 2>/dev/null
# field FILE COLUMN: a cell of the last table.
field() {
    awk -F '\t' -v file="$1" -v column="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ "^" column) k = i; next } $1 == file { print $k }' "$out"
}
run "$jostle" status whole.h5 fails.h5 --tsv
expect "of complete studies it counts the runs" '[ $status -eq 0 ] && [ "$(field whole.h5 state)" = complete ] && [ "$(field whole.h5 done)" = 180 ] && [ "$(field whole.h5 left)" = 0 ] && [ "$(field fails.h5 failed)" = 5 ] && [ "$(field fails.h5 runs)" = 9 ]'

mkdir parts
"$jostle" run study.deck -q --shard 1/3 -o parts/1.h5
"$jostle" run study.deck -q -j 1 --shard 2/3 -o parts/2.h5 >/dev/null 2>&1 </dev/null &
child=$!
for _ in $(seq 400); do
    [ "$(stat -c %s parts/2.h5.runs 2>/dev/null || echo 0)" -le 8000 ] || break
    sleep 0.005
done
kill -s STOP $child
run "$jostle" status parts --tsv
expect "of a folder it lists all parts, with the one that runs" '[ $status -eq 0 ] && [ "$(field parts/1.h5 state)" = complete ] && [ "$(field parts/1.h5 runs)" = 60 ] && [ "$(field parts/2.h5 state)" = running ] && [ "$(field parts/2.h5 done)" -ge 1 ] && [ "$(field parts/2.h5 done)" -lt 60 ] && [ "$(($(field parts/2.h5 done) + $(field parts/2.h5 left)))" = 60 ]'
kill -s TERM $child
kill -s CONT $child
wait $child
code=$?
run "$jostle" status parts/2.h5.runs --tsv
if [ $code -eq 3 ]; then
    expect "an interrupted one has stopped" '[ $status -eq 0 ] && [ "$(field parts/2.h5 state)" = stopped ]'
else
    skip "an interrupted one has stopped" "it had ended"
fi
counted=$(field parts/2.h5 "done")
"$jostle" run study.deck -q --shard 2/3 -o parts/2.h5
kept=$("$jostle" show parts/2.h5 | grep -oE "[0-9]+ taken" | grep -oE "[0-9]+")
expect "and goes on with the runs that it counted" '[ $code -ne 3 ] || [ "$kept" = "$counted" ]'
run "$jostle" status parts
expect "several studies have a sum" '[ $status -eq 0 ] && grep -qE "^all  *120  *120  *0" "$out"'
run "$jostle" status none.h5
expect "a file that is not there is an error" '[ $status -eq 2 ] && said "none.h5"'
echo 'not a journal' >odd.h5.runs
run "$jostle" status odd.h5
expect "a file of another kind too" '[ $status -eq 2 ] && said "odd.h5.runs is not the journal of a study"'
mkdir empty
run "$jostle" status empty
expect "a folder without studies too" '[ $status -eq 2 ] && said "the folder empty has no study"'

# --- limits of a run -------------------------------------------------------------------------------
cat >long.deck <<'END'
sweep length values 1 1000
building A -floors 1 -mass 1 -stiffness 100
load A:1 constant 1
step fixed 0.001
duration $length
END
run "$jostle" run long.deck -q -o long.h5 --steps 100000
expect "a run with too many steps fails, and the other is done" '[ $status -eq 1 ] && said "1 of 2 runs failed" && said "the limit of 100000 steps was reached at t = "'
run "$jostle" run long.deck -q -o long.h5
expect "which is a result as others" '[ $status -eq 1 ]'
run "$jostle" run long.deck -q -o long.h5 --retry
expect "until it is computed again" '[ $status -eq 0 ]'
sed -i 's/1000/1000000/' long.deck
run "$jostle" run long.deck -q -o time.h5 --seconds 0.05
expect "a run that takes too long fails, too" '[ $status -eq 1 ] && said "the limit of 0.05 s was reached at t = "'
