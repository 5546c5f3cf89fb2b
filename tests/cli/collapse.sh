#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs and studies in which buildings collapse: what the summary, the file, tables, fragility, gap and
# pictures say; and studies that are killed, run in parts or on threads end in the same file.
. tests/support/cli.sh

cat >one.deck <<'END'
title "One storey"
building A -floors 1 -mass 1 -stiffness 39.5 -height 3
storey A bilinear -yield 1 -hardening 0
damping A rayleigh -alpha 0.6 -beta 0
pdelta A -weight 10
collapse drift-ratio 10%
ground sine -amplitude 3 -frequency 0.8
step fixed 1ms
duration 20
END
run "$jostle" run one.deck
expect "a collapse is a result, and the summary says it" '[ $status -eq 0 ] && grep -q "^COLLAPSED at [0-9.]* s: the drift of storey 1 of building A reached 0.3 m; the run ended there" "$out"'
run "$jostle" show one.h5 --tsv
expect "the table has its time, storey and drift" '[ "$(cut -f 3,5 "$out" | grep -cE "^(collapsed.1|collapse_storey.1|collapse_drift.-?0.300000000|collapse_time.[0-9.]+)")" -eq 4 ]'
run "$jostle" show one.h5 --json
expect "so has JSON" 'grep -q "\"collapsed\": 1" "$out" && grep -q "\"collapse_building\": \"A\"" "$out"'
if command -v h5dump >/dev/null; then
    time=$(h5dump -a collapse_time -m %.17g one.h5 | sed -n "s/.*(0): //p")
    rows=$(h5dump -H -d /time one.h5 | sed -n "s/.*SIMPLE { ( \([0-9]*\) ).*/\1/p" | head -n 1)
    last=$(h5dump -d /time -s $((rows - 1)) -c 1 -m %.17g one.h5 | sed -n "s/.*($((rows - 1))): //p" | head -n 1)
    expect "the last row is of that instant, the status is complete" '[ "$time" = "$last" ] && [ "$rows" -gt 20 ] && [ "$rows" -lt 2001 ] && h5dump -a status one.h5 | grep -q complete'
    expect "histories without values end there, too" 'h5dump -H -d /contacts/force one.h5 | grep -q "SIMPLE { ( $rows, 0 )"'
fi
run "$jostle" check one.deck
expect "check tells the limit and the stability coefficient" 'grep -q "a run ends, collapsed, at a storey drift of 0.3 m" "$out" && grep -q "P-delta: 10 N at the base, largest P drift / (V h) 0.08439 in storey 1, buckling factor 11.85" "$out"'
run "$jostle" modes one.deck
expect "modes lists P and the coefficients" 'grep -q "^P-delta: buckling factor 11.85" "$out" && grep -qE "^ +1 +10 +0.08439" "$out"'
run "$jostle" plot one.h5 -o one.svg
expect "it is drawn" '[ $status -eq 0 ] && [ -s one.svg ]'
sed -i 's/^step .*/step adaptive/' one.deck
run "$jostle" run one.deck -o adaptive.h5
expect "adaptive steps end there, too" '[ $status -eq 0 ] && grep -q "^COLLAPSED at" "$out"'

cat >study.deck <<'END'
title "A study of collapses"
sweep scale range 0.06 0.6 7
sweep p values 4 8 12
param gap 20mm
building A -floors 2 -mass 1 -stiffness 60 50 -height 3
building B -floors 1 -mass 2 -stiffness 300 -height 3
storey A bilinear -yield 2 1.2 -hardening 1%
damping A rayleigh -alpha 0.6 -beta 0
pdelta A -weight $p
collapse drift-ratio 10%
contact A B -gap $gap -law linear -k 1e4
ground sine -amplitude ${scale} -frequency 0.8
step fixed 1ms
duration 12
output -histories -interval 0.05
END
# total COLUMN [FILE]: the sum of its numbers.
total() {
    cut -f "$1" "${@:2}" | awk '/^[0-9.]+$/ { n += $1 } END { print n + 0 }'
}
run "$jostle" run study.deck -q -j 1 -o whole.h5
expect "a study of collapses ends" '[ $status -eq 0 ] && [ ! -s "$err" ]'
run "$jostle" show whole.h5
collapsed=$(sed -n 's/^study of 21 runs, 0 failed, \([0-9]*\) collapsed$/\1/p' "$out")
expect "it says how many runs have collapsed" '[ "$collapsed" -gt 5 ] && [ "$collapsed" -lt 16 ]'
"$jostle" show whole.h5 --tsv >whole.tsv
expect "its table has a column of them" '[ "$(awk -F "\t" "\$7 == \"collapsed\" && \$9 == 1" whole.tsv | wc -l)" -eq "$collapsed" ]'
expect "and of their times" '[ "$(awk -F "\t" "\$7 == \"collapse_time\" && \$9 > 0" whole.tsv | wc -l)" -eq "$collapsed" ]'
run "$jostle" fragility whole.h5 --collapse --im scale --at p=8 --tsv
expect "fragility counts them" '[ $status -eq 0 ] && [ "$(total 7 "$out")" -eq "$(awk -F "\t" "\$3 == 8 && \$7 == \"collapsed\"" whole.tsv | total 9)" ]'
cp "$out" collapse.tsv
run "$jostle" fragility whole.h5 --edp drift:A --limit 0.4 --im scale --at p=8 --tsv
expect "a collapse exceeds every limit of a building" 'cmp <(cut -f 4-8 collapse.tsv) <(cut -f 4-8 "$out")'
run "$jostle" fragility whole.h5 --collapse --limit 1
expect "--collapse takes no limit" '[ $status -eq 2 ] && said "--collapse has a demand and a limit; leave out --edp and --limit"'
run "$jostle" gap study.deck -D scale=0.6 -D p=8 --limit drift:A=1m --range 0:0.2:5
expect "gap counts a collapse as exceeded, and finds the gap without" '[ $status -eq 0 ] && grep -qE "^ +0.05 +inf exceeded +1  1 collapsed" "$out" && grep -qE "^gap 0.0[5-9]" "$out"'
run "$jostle" gap study.deck -D scale=2 -D p=8
expect "the separation of a building that collapses without contact is not known" '[ $status -eq 1 ] && said "it collapses without contact, at t = "'
run "$jostle" plot whole.h5 fragility --collapse --im scale -o fragility.svg
expect "a curve of collapses for each value of the other sweep" '[ $status -eq 0 ] && grep -q ">collapse: shares of " fragility.svg && [ "$(grep -cE ">p = (4|8|12)( .no curve.)?<" fragility.svg)" -eq 3 ]'
run "$jostle" plot whole.h5 fragility --collapse --edp drift -o twice.svg
expect "--collapse takes no demand" '[ $status -eq 2 ] && [ ! -e twice.svg ] && said "--collapse has a demand and a limit; leave out --edp and --limit"'
run "$jostle" plot whole.h5 ida --at p=8 --edp drift:A -o ida.svg
expect "curves end flat at a collapse" '[ $status -eq 0 ] && grep -q ">collapse<" ida.svg'

if ! command -v h5diff >/dev/null; then
    skip "a killed study of collapses goes on" "no h5diff"
    exit 0
fi
run "$jostle" run study.deck -q -j 3 -o threads.h5
expect "three threads give the same file" 'same whole.h5 threads.h5'
# As a kill amid the runs leaves the journal.
"$jostle" run study.deck -q -j 1 -o part.h5 </dev/null 2>"$err" &
child=$!
until [ "$(stat -c %s part.h5.runs 2>/dev/null || echo 0)" -gt 60000 ] || ! kill -0 $child 2>/dev/null; do
    :
done
kill -s KILL $child 2>/dev/null
wait $child 2>/dev/null
run "$jostle" run study.deck -q -o part.h5 --force
expect "a killed study goes on to the same file" '[ $status -eq 0 ] && same whole.h5 part.h5'
sed -i '/^output/d' study.deck
"$jostle" run study.deck -q -o bare.h5
for k in 1 2 3; do
    "$jostle" run study.deck -q --shard $k/3 -o shard$k.h5
done
run "$jostle" merge -o merged.h5 shard1.h5 shard2.h5 shard3.h5
expect "parts are merged to the same file" '[ $status -eq 0 ] && same bare.h5 merged.h5'
