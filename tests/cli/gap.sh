#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle gap: its tables, its search, its exit status and its options.
. tests/support/cli.sh

cat >swing.deck <<'END'
title "swings against a wall"
units kN m s
param gap 100mm
sweep a values 0.1m 0.2m 0.4m
building A -floors 1 -mass 100t -stiffness ${100t * (2 * pi / 1s)^2}
initial A -displacement ${-a}
contact A wall -gap $gap -law linear -k 1e5
integrator dormand-prince
step adaptive -tolerance 1e-9
duration 2
END
run "$jostle" gap swing.deck
expect "closing displacements of all runs are printed" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^3 runs without contact, 0 failed; lengths in m" "$out"'
# mean 0.7/3, 16 % 0.132, 50 % 0.2, 84 % 0.336, largest 0.4 in run 3, two runs beyond the gap
expect "with mean, percentiles and the runs that would hit" 'grep -qE "^A:1-wall +0\.2333 +0\.132 +0\.2 +0\.336 +0\.4 +3 +0\.1 +2$" "$out"'
expect "each column ends below its head" 'awk "function ends(line, at,  i, n) { n = 0; for (i = 1; i <= length(line); i++) if (substr(line, i, 1) != \" \" && substr(line, i + 1, 1) ~ /^ ?\$/ && i > 14) at[++n] = i; return n } /^closing by / { head = \$0; sub(/16 %/, \"16_%\", head); sub(/50 %/, \"50_%\", head); sub(/84 %/, \"84_%\", head); sub(/in run/, \"in_run\", head); sub(/runs hit/, \"runs_hit\", head); n = ends(head, h) } /^A:1-wall +0.2333 +0.132 / { m = ends(\$0, v); bad = m != n || n != 8; for (i = 1; i <= n; i++) bad = bad || h[i] != v[i]; found = 1 } END { exit !found || bad }" "$out"'
sed 's/^building A/building a-long-name/; s/^initial A/initial a-long-name/; s/^contact A/contact a-long-name/' swing.deck >long.deck
run "$jostle" gap long.deck
expect "so it does where a name is long, whose end is kept" 'awk "/^closing by/ { n = length(\$0) } /^\.\.-name:1-wall +0.2333 +0.132/ { found = length(\$0) == n } END { exit !found }" "$out"'
rm long.deck
run "$jostle" gap swing.deck
expect "each rule has its formula and its source" '[ "$(grep -cE "^(abs. sum|SRSS|0.7 SRSS|double diff.) += " "$out")" -eq 4 ] && grep -q "Der Kiureghian (1980)" "$out" && grep -q "EN 1998-1" "$out"'
expect "no line is wider than 100 characters" '! grep -qE "^.{101,}" "$out"'
expect "nothing is written" 'only swing.deck'
cp "$out" one.txt
for threads in 1 3; do
    run "$jostle" gap swing.deck -j $threads
    expect "-j $threads gives the same table" 'cmp one.txt "$out"'
done

run "$jostle" gap swing.deck --tsv
expect "--tsv has a line for each run and contact" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 4 ] && [ "$(awk -F "\t" "{ print NF }" "$out" | sort -u | wc -l)" -eq 1 ] && head -n 1 "$out" | grep -q "^run	a	status	contact	gap \[m\]	closing \[m\]"'

result() { awk -F '\t' '$1 == "result" { print $2 }' "$out"; }
within() { awk -v x="$(result)" -v a="$1" -v b="$2" 'BEGIN { exit !(x >= a && x <= b) }'; }
run "$jostle" gap swing.deck --limit impacts=0 --tsv
expect "a swing of 0.4 m hits below a gap of 0.4 m only" '[ $status -eq 0 ] && within 0.399999 0.4005'
run "$jostle" gap swing.deck --limit impacts=0 --percentile 50 --tolerance 0.001mm --tsv
expect "the median one below 0.2 m" '[ $status -eq 0 ] && within 0.199999 0.200002'
run "$jostle" gap swing.deck --limit penetration=-5mm --tsv
expect "5 mm more keep 5 mm open" '[ $status -eq 0 ] && within 0.404999 0.405406'
run "$jostle" gap swing.deck --limit impacts=0 --parameter gap --range 50mm:500mm:10 --tsv -j 2
expect "a parameter of the deck can be searched" '[ $status -eq 0 ] && within 0.399999 0.4005'
sed 's/^param gap .*/sweep gap values 0.1m 0.2m 0.3m/' swing.deck >swept.deck
run "$jostle" gap swept.deck --limit impacts=0 --parameter gap --range 50mm:500mm:4
expect "a sweep of it takes no part" '[ $status -eq 0 ] && grep -qx "impacts at most 0 in all 3 runs" "$out"'
sed 's/^param gap .*/param gap 100mm\nparam k 1e5kN\/m/; s/-k 1e5/-k $k/' swing.deck >stiff.deck
run "$jostle" gap stiff.deck --limit impacts=0 --parameter k --range 50mm:500mm:4
expect "a parameter that is no length is refused" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "this is a length (m)"'
rm swept.deck stiff.deck
run "$jostle" gap swing.deck --limit displacement:A=0.3
expect "a limit that no gap keeps ends with 1" '[ $status -eq 1 ] && grep -q "^no gap: the limit is exceeded at the widest one" "$out" && said "no gap of the range meets the limit"'
expect "nor any without contact, which is said" 'grep -qE "^ +no contact +0.4 exceeded +3$" "$out" && grep -q "^Without any contact the limit is exceeded: a gap that avoids contact does not meet it" "$out"'
run "$jostle" gap swing.deck --limit displacement:A=0.3 --tsv
expect "nor in the table for programs" 'awk -F "\t" "\$1 == \"no contact\" { n++; good = \$2 == \"inf\" && \$3 > 0.39999 && \$3 < 0.40001 && \$4 == \"broken\" && \$6 == 3 } END { exit !(n == 1 && good) }" "$out"'
for parameter in "" "--parameter gap"; do
    run "$jostle" gap swing.deck --limit displacement:A=0.45 --range 50mm:500mm:4 $parameter
    expect "a limit that is met without contact is said to be${parameter:+, for a parameter too}" '[ $status -eq 0 ] && grep -qE "^ +no contact +0.4 +met +3$" "$out" && grep -q "^Without any contact the limit is met.$" "$out"'
done
run "$jostle" gap swing.deck --limit force=1000kN
expect "a limit is searched by default over all gaps that matter" '[ $status -eq 0 ] && grep -q "^gap 0\.[0-9]* m: from here on every gap scanned meets the limit" "$out" && grep -q "may be exceeded unseen" "$out"'
expect "a limit on a contact has no value without contact" '! grep -qi "without any contact\|no contact" "$out"'
expect "the scan is shown" '[ "$(grep -cE "^ .* (met|exceeded) " "$out")" -eq 33 ]'

cat >tall.deck <<'END'
units kN m s
building A -floors 10 -mass 1t -stiffness 1MN/m -height 3m
building B -floors 7 -mass 1t -stiffness 1MN/m -height 3m
initial A -displacement 10mm
contact A:7 B:7 -gap 100mm -law linear -k 1e5
contact A:10 wall -gap 100mm -law linear -k 1e5
step fixed 1ms
duration 0.1
END
run "$jostle" gap tall.deck --tsv --gb 8 --gb-type frame-wall --ntc II --factor 3 --factor A=2
# B is 21 m high, 6 m above 15 m: 70 % of 100 mm + 20 mm 6/3; A is 30 m high: 70 % of 200 mm. Zone
# II: 0.003 of 21 m and of 30 m, with twice 10 mm of A, at least 50 mm.
expect "rules by height are those computed by hand, with factors of displacements" '[ $status -eq 0 ] && awk -F "\t" "function near(x, y) { return x - y < 1e-9 && y - x < 1e-9 } NR == 1 { for (i = 1; i <= NF; i++) at[\$i] = i } NR == 2 { good = near(\$at[\"u_left [m]\"], 0.01) && near(\$at[\"absolute_sum [m]\"], 0.02) && near(\$at[\"gb50011 [m]\"], 0.1) && near(\$at[\"ntc2004 [m]\"], 0.146) } NR == 3 { good = good && near(\$at[\"gb50011 [m]\"], 0.14) && near(\$at[\"ntc2004 [m]\"], 0.11) } END { exit !good }" "$out"'
run "$jostle" gap tall.deck --gb 8 --factor B=1.5
expect "and have a table, with their formula and what the user gave" 'grep -qE "^A:7-B:7 +21 +21 +30 +21 +0\.14 " "$out" && grep -qE "^A:10-wall +30 +- +30 +- +0\.2 " "$out" && grep -q "^    here step = 3 m, share = 1$" "$out" && grep -q "^The rules multiply the displacements of B by 1.5.$" "$out" && ! grep -q "NTC" "$out" && ! grep -qE "^.{101,}" "$out"'
run "$jostle" gap tall.deck --gb 9 --ntc III
expect "both rules fit a line of 100 characters" '! grep -qE "^.{101,}" "$out"'

cat >away.deck <<'END'
building A -floors 1 -mass 1 -stiffness 40
building B -floors 1 -mass 1 -stiffness 0
initial B -velocity 1
contact A B -gap 0.1 -law linear -k 1e5
step fixed 1ms
duration 0.2
END
run "$jostle" gap away.deck
expect "what does not exist is a dash: ratios to 0, rho of a free body" '[ $status -eq 0 ] && ! grep -q nan "$out" && grep -qE "^A:1-B:1( +-){8}$" "$out" && grep -qE "^A:1-B:1 +0 +0.2 +- " "$out"'
run "$jostle" gap away.deck --limit force=1
expect "buildings that move apart have no range of gaps" '[ $status -eq 2 ] && said "never move towards each other"'
rm away.deck
sed 's/^sweep a .*/sweep a values 0.1m 2000m/' swing.deck >far.deck
run "$jostle" gap far.deck
expect "a run that fails is told, with exit status 1" '[ $status -eq 1 ] && said "1 of 2 runs failed, the first: run 2 (a = 2000): a contact would close a gap of 1024 m" && grep -q "1 failed" "$out"'
rm far.deck one.txt

refuses() {
    local text=$1
    shift
    run "$jostle" gap "$@"
    expect "refused: $text" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "$text"'
}
refuses "one deck is expected, not 0"
for option in --limit --range --tolerance --percentile --parameter; do
    refuses "$option is given twice" swing.deck $option 1 $option 2
done
refuses "--range goes with --limit" swing.deck --range 0:1:3
refuses "--gb takes a whole number from 6 to 9, not '5'" swing.deck --gb 5
refuses "--gb-type is frame or frame-wall or wall, not 'steel'" swing.deck --gb 7 --gb-type steel
refuses "--gb-type goes with --gb" swing.deck --gb-type wall
refuses "--ntc is I or II or III, not 'IV'" swing.deck --ntc IV
refuses "--gb needs the storey heights of building A" swing.deck --gb 7
refuses "--ntc needs the storey heights of building A" swing.deck --ntc I
refuses "--factor is for the rules, which --limit does not apply" swing.deck --limit impacts=0 --factor 2
refuses "--gb is for the rules, which --limit does not apply" swing.deck --limit impacts=0 --gb 7
for factor in A=0 A= x -1 A=2s; do
    refuses "--factor takes a number > 0 or BUILDING=NUMBER, not '$factor'" swing.deck "--factor=$factor"
done
refuses "--factor C=2: the deck has no building of this name" swing.deck --factor C=2
run "$jostle" gap swing.deck --limit acceleration:A=20
expect "and so does each value" 'awk "/\\[g\\]/ { head = 1 } head && \$1 ~ /^[0-9]/ { n++; if (\$2 < 9.80 * \$3 || \$2 > 9.81 * \$3) bad = 1 } END { exit bad || n < 3 }" "$out"'
expect "a limit of accelerations shows g too" 'grep -q "^largest acceleration:A at most 20 m/s^2 (2.039 g) in all 3 runs$" "$out"'
refuses "unknown EDP 'forc'; did you mean 'force'?" swing.deck --limit forc=1
refuses "--limit takes EDP=VALUE" swing.deck --limit force
refuses "limit -1 is below 0, where impacts never is" swing.deck --limit impacts=-1
refuses "limit 1mm is a length; force needs a force (kN)" swing.deck --limit force=1mm
refuses "force:X: unknown contact; 1 available: A:1-wall" swing.deck --limit force:X=1
refuses "drift:X: unknown building; available: A" swing.deck --limit drift:X=1
refuses "drift:A:2: building A has 1 floor" swing.deck --limit drift:A:2=1
refuses "drift-ratio: the deck gives no height of storey A:1" swing.deck --limit drift-ratio=1%
sed 's/-law linear -k 1e5/-law stereomechanical -e 0.6/; /^integrator/d; s/^step .*/step fixed 1ms/' swing.deck >rigid.deck
refuses "force: A:1-wall is rigid: it has an impulse, but no force" rigid.deck --limit force=1
refuses "--range takes FROM:TO:N" swing.deck --limit force=1 --range 1:0:3
refuses "--range takes FROM:TO:N" swing.deck --limit force=1 --range 0:1:1
refuses "--range takes FROM:TO:N" swing.deck --limit force=1 --range 0kN:1:3
refuses "--tolerance takes a value" swing.deck --limit force=1 --tolerance 1s
refuses "--percentile takes a number from 0 to 100" swing.deck --limit force=1 --percentile 101
refuses "-j takes a number of threads" swing.deck -j 0
refuses "unknown parameter 'gapp'" swing.deck --limit force=1 --parameter gapp --range 0:1:3
refuses "no_such_file: No such file or directory" no_such_file
sed '/^contact/d; s/\$gap/1/; /^param/d' swing.deck >none.deck
refuses "the deck has no contact" none.deck
