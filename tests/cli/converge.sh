#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle converge: its table, its verdict, its exit status and its options.
. tests/support/cli.sh

cat >bodies.deck <<'END'
title "two bodies"
param dt 0.2ms
building A -floors 1 -mass 25t -stiffness 0
building B -floors 1 -mass 40t -stiffness 0
initial A:1 -velocity 0.5
contact A B -gap 5mm -law linear -k 93.5MN/m
duration 0.08
step fixed $dt
END
run "$jostle" converge bodies.deck
expect "a deck that converges ends with 0" '[ $status -eq 0 ] && [ ! -s "$err" ]'
expect "nothing is written" 'only bodies.deck'
expect "the title and the levels stand on top" 'grep -qx "two bodies" "$out" && grep -qx "4 levels, steps 0.0002 0.0001 5e-05 2.5e-05 s" "$out"'
expect "buildings and contacts have their results" 'grep -qx "building B" "$out" && grep -qx "contact A:1-B:1" "$out" && grep -qE "^  force \[N\] .* yes$" "$out"'
expect "the verdict counts them" 'grep -qx "12 of 12 results have converged to 0.001" "$out"'
expect "accelerations stand in g, too" 'awk "/acceleration \\[m/ { a = \$5 } /acceleration \\[g\\]/ { g = \$5; n++; if (a < 9.806 * g || a > 9.807 * g) bad = 1 } END { exit bad || n != 2 }" "$out"'
expect "no line is wider than 100 characters" '! grep -qE "^.{101,}" "$out"'

column() {
    awk -F'\t' -v quantity="$1" -v name="$2" -v field="$3" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == field) at = i }
        $3 == quantity && $2 == name { print $at }' "$out"
}
run "$jostle" converge bodies.deck --tsv -n 5
expect "--tsv has a column for each level" '[ $status -eq 0 ] && [ "$(head -n 1 "$out" | tr "\t" "\n" | grep -c "^step_")" -eq 5 ]'
expect "--tsv has a row for each result and 14 fields in each" '[ "$(wc -l <"$out")" -eq 13 ] && [ "$(awk -F"\t" "NF != 14" "$out" | wc -l)" -eq 0 ]'
# The closed form is 2 m* v = 15384.6 N s; the error bar has to hold it.
expect "the impulse is the closed form within its error bar" \
    '[ "$(echo "$(column impulse A:1-B:1 step_1.25e-05) $(column impulse A:1-B:1 error)" | awk "{ d = \$1 - 15384.615384615385; print (d < 0 ? -d : d) <= \$2 }")" = 1 ]'

run "$jostle" converge bodies.deck -D dt=5ms -n 3 --rtol 1e-6
expect "a step that is too long ends with 1" '[ $status -eq 1 ]'
expect "what has not converged is named with its reason" 'grep -qE "^  contact A:1-B:1 force: .+" "$out"'
expect "-D changes the first step" 'grep -qx "3 levels, steps 0.005 0.0025 0.00125 s" "$out"'
expect "an estimated contact of few steps is not warned of, as steps are halved" '[ ! -s "$err" ]'

sed 's/^contact/link A B -stiffness 10MN\/m\n&/' bodies.deck >both.deck
run "$jostle" converge both.deck --tsv
expect "a contact and a link between the same floors are told from each other" '[ "$(cut -f1-3 "$out" | sort | uniq -d | wc -l)" -eq 0 ] && grep -q "^contact	A:1-B:1	force" "$out" && grep -q "^link	A:1-B:1	force" "$out"'

two_buildings pair.deck
run "$jostle" converge pair.deck -n 3 --rtol 1e-9
expect "several buildings and contacts make one table" '[ $status -eq 1 ] && [ "$(grep -c "^building" "$out")" -eq 2 ]'
expect "the verdict of nothing converged is cut to a page" '[ "$(wc -l <"$out")" -lt 60 ]'

# Forced below its period, which longer steps lengthen: the longer they are, the wider it swings, to
# 0.14623, 0.14568 and 0.14555 m.
cat >grazes.deck <<'END'
building A -floors 1 -mass 1 -stiffness ${4 * pi^2}
damping A rayleigh 5%
contact A wall -gap 0.1456 -law linear -k 100
ground sine -amplitude 1 -frequency 0.9
step fixed 0.02
duration 10
END
run "$jostle" converge grazes.deck -n 3
expect "what is 0 at the shortest step only has no error bar relative to it" '[ $status -eq 1 ] && grep -qE "^  impacts +1 +1 +0 +- +0 +inf  no$" "$out" && grep -qE "^  force \[N\] .* inf  no$" "$out"'

sed 's/^contact .*/contact A B -gap 5mm -law jankowski -k 2.75e9N\/m^1.5 -e 0.6/; s/0.08/0.1/' bodies.deck >slow.deck
run "$jostle" converge slow.deck -D dt=5ms
expect "more levels are promised where the order says so" '[ $status -eq 1 ] && grep -qx "  building B roof displacement: the step is too long; 2 more levels should do" "$out"'
expect "but not more than -n takes" 'grep -qx "  building A roof displacement: the step is too long" "$out"'

sed 's/^param dt .*/sweep dt values 0.4ms 0.2ms/' bodies.deck >study.deck
for command in converge modes check; do
    run "$jostle" $command study.deck
    expect "$command of a study says that it looks at the first run" '[ $status -eq 0 ] && grep -qx "study of 2 runs" "$out" && grep -qx "the model of the first run:" "$out"'
done
run "$jostle" converge study.deck
expect "and looks at it" 'grep -qx "4 levels, steps 0.0004 0.0002 0.0001 5e-05 s" "$out"'

run "$jostle" converge
expect "a deck is needed" '[ $status -eq 2 ] && said "one deck is expected"'
run "$jostle" converge bodies.deck -n 2
expect "two levels give no order" '[ $status -eq 2 ] && said "-n takes a whole number from 3 to 16"'
run "$jostle" converge bodies.deck -n 3.5
expect "levels are whole" '[ $status -eq 2 ] && said "whole number"'
run "$jostle" converge bodies.deck --rtol 0
expect "the tolerance is above 0" '[ $status -eq 2 ] && said "--rtol takes a number"'
run "$jostle" converge none.deck
expect "a deck that is not there is an error" '[ $status -eq 2 ] && [ ! -s "$out" ]'
run "$jostle" converge --help
expect "--help tells what there is" '[ $status -eq 0 ] && grep -q -- "--rtol R" "$out"'
