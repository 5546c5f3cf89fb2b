#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Studies: sweeps of every kind, one file whatever the number of threads, runs that fail.
. tests/support/cli.sh

# A table of the values that do not tell of the way they were computed.
values() {
    LC_ALL=C awk -F '\t' -v OFS='\t' -v first="$1" '
        $first == "buildings" || $first == "energy" {
            if ($(first + 2) !~ /_time$/) print $first, $(first + 1), $(first + 2), $(first + 3), $(first + 4)
        }' | sort
}

mkdir records
awk 'BEGIN { for (i = 0; i < 200; i++) print 2 * sin(0.3 * i) }' >records/one.txt
awk 'BEGIN { for (i = 0; i < 300; i++) print 3 * sin(0.2 * i) }' >records/two.txt
cat >grid.deck <<'END'
title "a grid"
units kN m s
sweep gap values 5mm 8mm
sweep k range 1e5 1e7 3 -log
sweep record files "records/*.txt"
building A -floors 2 -mass 100t -stiffness 50MN/m
building B -floors 3 -mass 80t -stiffness 20MN/m
contact A B -gap $gap -law linear -k $k
ground record $record -unit m/s2 -dt 0.02
step fixed 1ms
END
run "$jostle" run grid.deck -j 1 -o one.h5
expect "a study runs and says how it went" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^study of 12 runs, 0 failed" "$out"'
expect "it leaves only its file" 'only grid.deck one.h5 records/one.txt records/two.txt'
run "$jostle" run grid.deck -q -o two.h5 -j 2
expect "-q prints nothing" '[ $status -eq 0 ] && [ ! -s "$out" ] && [ ! -s "$err" ]'
(sed 's/^step/output -histories -interval 10ms\nstep/' grid.deck) >whole.deck
run "$jostle" run whole.deck -q -o whole.h5
expect "histories are written on request" '[ $status -eq 0 ]'
run "$jostle" run whole.deck -q -o single.h5 -D gap=8mm -D k=1e6 -D record=records/one.txt
expect "with all sweeps fixed they are those of one analysis" '[ $status -eq 0 ]'
run "$jostle" run whole.deck -q -o label.h5 -D gap=8mm -D k=1e6 -D record=one
expect "a file is fixed by its label too" '[ $status -eq 0 ] && [ ! -s "$err" ]'
parameters_of() {
    "$jostle" show --json "$1" | grep "^.parameters"
}
expect "which is the same" '[ -n "$(parameters_of single.h5)" ] && [ "$(parameters_of label.h5)" = "$(parameters_of single.h5)" ]'
run "$jostle" run grid.deck -q -o by_label.h5 -D record=one
expect "while other sweeps go on" '[ $status -eq 0 ] && [ ! -s "$err" ]'
run "$jostle" run grid.deck -q -o by_path.h5 -D record=records/one.txt
run "$jostle" show by_path.h5 --tsv
cp "$out" by_path.tsv
run "$jostle" show by_label.h5 --tsv
expect "with the numbers of its path" 'grep -q "	done	contacts	" "$out" && cmp -s by_path.tsv "$out"'
sed 's|^units.*|&\nparam record records/two.txt|' grid.deck >param.deck
run "$jostle" run param.deck -q -o above.h5 -D record=one
expect "a param above the sweep takes the label too" '[ $status -eq 0 ] && "$jostle" show above.h5 --tsv | cmp -s - by_path.tsv'
run "$jostle" check param.deck -D record=oen
expect "one that is mistyped is told, once, with the one that was meant" '[ $status -eq 2 ] && grep -q "error: unknown record .oen.; did you mean .one.?" "$err" && said "1 error in"'
{ grep -v "^sweep record" param.deck; grep "^sweep record" param.deck; } >by_late.deck
run "$jostle" run by_late.deck -q -D record=one
expect "also one that is used above the sweep" '[ $status -eq 0 ] && "$jostle" show by_late.h5 --tsv | cmp -s - by_path.tsv'
mkdir suite && mv records suite/records
grep '^sweep record' whole.deck >suite/records.deck
sed 's/^sweep record.*/include suite\/records.deck/' whole.deck >beside.deck
run "$jostle" run beside.deck -q -o beside.h5 -D gap=8mm -D k=1e6 -D record=one
expect "which is looked for beside the deck with the sweep" '[ $status -eq 0 ] && [ ! -s "$err" ]'
mv suite/records records; rm -r suite beside.*
run "$jostle" run whole.deck -q -o none.h5 -D gap=8mm -D k=1e6 -D record=three
expect "what is neither is refused" '[ $status -eq 2 ] && grep -q "error: unknown record .three.; available: one, two" "$err" && said "1 error in"'
if command -v h5diff >/dev/null; then
    for path in buildings/A/displacement buildings/B/storey_shear contacts/force impacts/t_start energy/input time; do
        run h5diff whole.h5 single.h5 /runs/000009/$path /$path
        expect "$path of a run is that of the run alone" '[ $status -eq 0 ]'
    done
    run "$jostle" show --tsv single.h5
    grep -v 'wall_seconds\|newton\|command_line' "$out" >table
    run "$jostle" show --tsv 'whole.h5#9'
    expect "a run is shown like a file" '[ $status -eq 0 ] && grep -v "wall_seconds\|newton\|command_line" "$out" | cmp - table'
    run "$jostle" plot 'whole.h5#9' histories --script figure
    expect "and drawn, with its number" '[ $status -eq 0 ] && grep -q "run 9: " figure/histories.gp'
    run "$jostle" show 'whole.h5#9'
    expect "the summary of a run has its number and its parameters" '[ $status -eq 0 ] && grep -qx "run 9 of a study" "$out" && grep -q "^  gap = 0.008$" "$out" && grep -q "^  record = records/" "$out"'
    run "$jostle" plot whole.h5 histories
    expect "a picture of histories needs a run" '[ $status -eq 2 ] && said "histories is for single runs; whole.h5 is a study; name a run of it, such as whole.h5#1"'
    run "$jostle" show 'whole.h5#13'
    expect "a run that is not there is named" '[ $status -eq 2 ] && said "whole.h5 has no run 13; its study has the runs 1 to 12"'
    run "$jostle" show 'two.h5#1'
    expect "and so is a study without histories" '[ $status -eq 2 ] && said "--histories RUNS"'
    rm -r figure table
    expect "all runs have theirs" '[ "$(h5ls whole.h5/runs | wc -l)" -eq 12 ]'
    for i in 1 2; do
        run "$jostle" run whole.deck -q --shard $i/2 -o half$i.h5
        expect "part $i has those of its runs" '[ $status -eq 0 ] && [ "$(h5ls half$i.h5/runs | wc -l)" -eq 6 ]'
    done
    run "$jostle" merge -q half1.h5 half2.h5 -o joined.h5
    expect "a merged file has none, which is said" '[ $status -eq 0 ] && said "the histories of the runs stay in the parts"'
else
    skip "histories are those of the runs alone" "no h5diff"
fi
rm -f whole.* single.* half* joined.* by_* above.* param.*
if command -v h5diff >/dev/null; then
    expect "any number of threads gives the same file" 'same one.h5 two.h5'
    run "$jostle" run grid.deck -q -o eight.h5 -j 8
    expect "eight of them too" 'same one.h5 eight.h5'
    run "$jostle" run grid.deck -q -o other.h5 -D gap=6mm
    expect "other values give another one" '! same one.h5 other.h5'
else
    skip "any number of threads gives the same file" "no h5diff"
fi

run "$jostle" show --tsv one.h5
table=$(cat "$out")
expect "show --tsv prints lines of one length, a column for each sweep" '[ $status -eq 0 ] && [ "$(awk -F "\t" "{ print NF }" "$out" | sort -u)" = 12 ] && head -n 1 "$out" | grep -q "^run	gap	k	record	status"'
expect "labels of files are their names" 'grep -q "	one	done	" "$out" && ! grep -q "records/" "$out"'
expect "a logarithmic range has equal ratios" '[ "$(cut -f 3 "$out" | sort -u | grep -c .)" = 4 ] && cut -f 3 "$out" | grep -q "^1000000$"'
"$jostle" run grid.deck -q -o single.h5 -D gap=8mm -D k=1e7 -D record=records/two.txt
run "$jostle" show --tsv single.h5
values 1 <"$out" >single.tsv
# Of buildings that cannot yield only a study tells what their storeys have gone through.
yielding='buildings\t[^\t]+\t(residual_drift|ductility|hysteretic|deterioration|damage)\t'
awk -F '\t' -v y="$yielding" '$1 == 12 && $0 !~ y' <<<"$table" | values 6 >twelfth.tsv
expect "a run of a study is the single run with its values, to the last digit" '[ $(wc -l <single.tsv) -gt 40 ] && cmp single.tsv twelfth.tsv'
run "$jostle" show one.h5
expect "show prints where each quantity is largest" '[ $status -eq 0 ] && grep -qE "^A +drift +[0-9] .* m +[0-9]+ \(gap " "$out"'
(sed 's/^sweep gap/# sweep gap/; s/^building A/param gap 30mm\nparam all ${2 * gap}\n&/; s/-gap $gap/-gap ${all \/ 2}/' grid.deck && grep '^sweep gap' grid.deck) >below.deck
run "$jostle" run below.deck -q -D k=1e7 -D record=records/two.txt
expect "a sweep below the deck takes over its param" '[ $status -eq 0 ]'
"$jostle" show --tsv below.h5 | awk -F '\t' -v y="$yielding" '$1 == 2 && $0 !~ y' | values 4 >below.tsv
expect "with the same numbers" 'cmp single.tsv below.tsv'
rm below.*
same_table() {  # JSON and CSV
    python3 - "$@" <<'END'
import csv, json, sys
table = json.load(open(sys.argv[1]))
columns, *lines = csv.reader(open(sys.argv[2]))
shown = lambda x: "" if x is None else x if isinstance(x, str) else float(x)
cell = lambda x, y: y if isinstance(x, str) else "" if y in ("", "nan") else float(y)
assert table["columns"] == columns and len(table["data"]) == len(lines) > 0
for line, wanted in zip(table["data"], lines):
    assert [shown(x) for x in line] == [cell(x, y) for x, y in zip(line, wanted)], wanted
END
}
for long in '' --long; do
    "$jostle" show --csv $long one.h5 >one.csv
    run "$jostle" show --json $long one.h5
    if command -v python3 >/dev/null; then
        expect "--json $long is the table that --csv is" '[ $status -eq 0 ] && same_table "$out" one.csv'
    else
        skip "--json $long is the table that --csv is" "no python3"
    fi
done
rm one.csv
run "$jostle" check grid.deck -D k=2e6
expect "check prints the sweeps and the first model" '[ $status -eq 0 ] && grep -q "^study of 4 runs" "$out" && grep -q "k  *fixed with -D: 2e+06" "$out" && grep -q "building A: 2 floors" "$out"'
run "$jostle" run grid.deck -o one.h5 -D k=3e6
expect "an existing file of other runs is refused" '[ $status -eq 2 ] && said "one.h5 holds 12 finished runs that this study does not have, as the deck or a file has changed; --force overwrites it, -o NAME.h5 --take one.h5 keeps it"'
run "$jostle" run grid.deck -o single.h5
expect "and so is a file of another kind" '[ $status -eq 2 ] && said "single.h5 exists; --force overwrites it"'
mkdir folder.h5
run "$jostle" run grid.deck -o folder.h5 --force
expect "so is a folder, before a run is made" '[ $status -eq 2 ] && said "folder.h5 is a directory" && [ ! -s "$out" ] && [ ! -e folder.h5.runs ]'
rmdir folder.h5
rm -f ./*.h5 ./*.tsv

if python3 -c 'import xarray, netCDF4' 2>/dev/null; then
    "$jostle" run grid.deck -q -o x.h5
    run python3 - <<'END'
import xarray
root = xarray.open_dataset("x.h5")
assert root.status.dims == ("gap", "k", "record") and int(root.status.sum()) == 0
assert list(root.record.values) == ["one", "two"] and list(root.gap.values) == [0.005, 0.008]
assert root.gap.attrs["units"] == "m"
drift = xarray.open_dataset("x.h5", group="/buildings/B/envelope").drift
assert drift.dims == ("gap", "k", "record", "floor") and drift.attrs["units"] == "m"
assert drift.sel(gap=0.008, k=1e6, record="two").shape == (3,)
links = xarray.open_dataset("x.h5", group="/contacts/envelope")
assert float(links.impacts.sum()) > 0 and links.force.dims[-1] == "contact"
assert "steps" in xarray.open_dataset("x.h5", group="/totals")
END
    expect "xarray selects by the values of the sweeps" '[ $status -eq 0 ]'
    rm x.h5
else
    skip "xarray selects by the values of the sweeps" "no xarray"
fi

cat >late.deck <<'END'
sweep gap values 1m -1m -2m -3m -4m -5m -6m -7m -8m -9m -10m -11m
building A -floors 1 -mass 1 -stiffness 100
contact A wall -gap $gap -law linear -k 1
initial A:1 -velocity 1
step fixed 0.01
duration 1
END
run "$jostle" run late.deck -q -j 3
expect "the first of those that fail is told, whichever ends first" '[ $status -eq 1 ] && said "11 of 12 runs failed" && said "the first: run 2 "'
rm late.*

failing_study fails.deck
run "$jostle" run fails.deck
expect "runs that fail do not stop the others; exit status 1" '[ $status -eq 1 ] && grep -q "^study of 9 runs, 5 failed" "$out" && said "5 of 9 runs failed" && said "run 2 (m = 1, e = 1.5): fails.deck:4:48: e is 1.5"'
run "$jostle" show --tsv fails.h5
expect "their messages are in the file" '[ "$(grep -c "	failed	message	" "$out")" -eq 5 ] && grep -q "not finite at floor 1 of building A" "$out" && ! grep drift "$out" | grep -qE "nan|inf"'
expect "and nothing else is left" 'only fails.deck fails.h5 grid.deck records/one.txt records/two.txt'
rm fails.*

# Run 1 is long and fails at its end, run 2 fails before its first step.
printf '0\n0\n1e300\n' >late.txt
cat >late.deck <<'END'
sweep e values 0.5 1.5
building A -floors 1 -mass 1e-300 -stiffness 0
contact A wall -gap 1 -law stereomechanical -e $e
load A:1 history late.txt -dt 100s
step fixed 1ms
duration 200
END
run "$jostle" run late.deck -j 2
expect "the failed run that is named is that of the lowest number, not the first to end" '[ $status -eq 1 ] && said "2 of 2 runs failed" && said "the first: run 1 (e = 0.5): "'
rm late.*

cat >shapes.deck <<'END'
sweep n values 2 3
building A -floors $n -mass 1 -stiffness 400
ground sine -amplitude 1 -frequency 1
step fixed 0.01
duration 1
END
run "$jostle" run shapes.deck -j 1
expect "models of different sizes are refused" '[ $status -eq 2 ] && said "run 2 (n = 3) has 3 floors in building A, the first run has 2" && [ ! -e shapes.h5 ]'
sed '1a sweep a range 1 8 8' shapes.deck | sed 's/-amplitude 1/-amplitude $a/' >later.deck
run "$jostle" run later.deck -j 1
expect "before the first run" '[ $status -eq 2 ] && said "run 9 (n = 3, a = 1) has 3 floors" && ! said kept && [ ! -e later.h5.runs ] && [ ! -e later.h5 ]'
# One of 100 numbers, and one of 70 texts, that the survey of check would not pick.
sed 's/^sweep n.*/sweep k range 1 100 100/; s/-floors $n/-floors ${2 + max(0, 1 - (k - 52)^2)}/' shapes.deck >later.deck
run "$jostle" run later.deck -j 1
expect "whatever the place of the value among many" '[ $status -eq 2 ] && said "run 52 (k = 52) has 3 floors" && [ ! -e later.h5.runs ]'
run "$jostle" check later.deck
expect "check finds it too" '[ $status -eq 2 ] && said "run 52 (k = 52) has 3 floors"'
{
    printf 'sweep a values 1 2\nsweep b values 1 2 3\n'
    sed '/^sweep/d; s/-floors $n/-floors ${1 + (a - 1)*(b - 1)}/' shapes.deck
} >both.deck
run "$jostle" run both.deck -q -o later.h5
expect "or if only a combination of two sweeps makes it" '[ $status -eq 2 ] && said "run 5 (a = 2, b = 2) has 2 floors" && ! said kept && [ ! -e later.h5.runs ]'
run "$jostle" check both.deck
expect "which check finds too" '[ $status -eq 2 ] && said "run 5 (a = 2, b = 2) has 2 floors"'
sed 's/^sweep \([ab]\).*/sweep \1 range 1 50 50/' both.deck >many.deck
run "$jostle" run many.deck -q -o later.h5
expect "among more than 2000 runs it ends the study, which cannot go on as it is" '[ $status -eq 2 ] && said "floors in building A, the first run has 1" && ! said "goes on"'
rm -f later.h5.runs both.deck many.deck
for i in $(seq 70); do
    [ "$i" -eq 33 ] && echo 'param n 3' >part$i.deck || echo 'param n 2' >part$i.deck
done
sed 's/^sweep n.*/sweep part files part*.deck\ninclude $part/' shapes.deck >later.deck
run "$jostle" run later.deck -j 1
expect "or of a file among many" '[ $status -eq 2 ] && said "has 3 floors in building A" && said "part33" && [ ! -e later.h5.runs ]'
rm -f shapes.* later.* part*.deck
# late DERIVED: six runs of one shape, then six of another.
late() {
    printf '%s\n' 'units N m s' 'sweep n values 2 3' 'sweep gap range 2mm 7mm 6' "param more $1" \
        'building A -floors ${more} -mass 1e5 -stiffness 5e7' \
        'building B -floors 2 -mass 8e4 -stiffness 2e7' \
        'contact A:1 B:1 -gap $gap -law linear -k 1e8' \
        'ground sine -amplitude 0.3g -frequency 1.5 -cycles 1' 'step fixed 1ms' 'duration 0.5' \
        >shapes.deck
}
for derived in '$n' '${1 + n - 1}'; do
    late "$derived"
    run "$jostle" run shapes.deck -j 1
    expect "before the first run, where the number of floors is $derived" '[ $status -eq 2 ] && said "run 7 (n = 3, gap = 0.002) has 3 floors in building A, the first run has 2" && ! said "kept" && only grid.deck shapes.deck records/one.txt records/two.txt'
    run "$jostle" check shapes.deck
    expect "by check too" '[ $status -eq 2 ] && said "has 3 floors in building A, the first run has 2"'
done
rm -f shapes.*

cat >names.deck <<'END'
sweep force values 1 2
building A -floors 1 -mass $force -stiffness 400
ground sine -amplitude 1 -frequency 1
step fixed 0.01
duration 1
END
run "$jostle" run names.deck
expect "a sweep cannot have the name of a result" '[ $status -eq 2 ] && said "sweep '"'force'"' has the name of a result" && only grid.deck names.deck records/one.txt records/two.txt'
sed -i 's/sweep force/sweep mass/; s/\$force/$mass/' names.deck
run "$jostle" run names.deck
expect "but that of a property, which it replaces" '[ $status -eq 0 ] && "$jostle" show --tsv names.h5 | grep -q "	period	"'
rm names.*

# 300 buildings, of which number 7 is the softest by far.
{
    printf 'sweep gap values 1mm 5mm\n'
    for i in $(seq 300); do
        echo "building B$i -floors 1 -mass 100t -stiffness $((i == 7 ? 5 : 20 + i % 97))MN/m"
        [ "$i" -eq 1 ] || echo "contact B$((i - 1)) B$i -gap \$gap -law linear -k 1e8"
    done
    printf 'ground sine -amplitude 0.3g -frequency 1.5 -cycles 1\nstep fixed 2ms\nduration 0.5\n'
} >many.deck
run "$jostle" run many.deck
expect "of many buildings those that drift most are shown, on a page" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -le 60 ] && grep -qE "^B7 +drift " "$out" && [ "$(grep -cE "^B[0-9]+ +drift " "$out")" -eq 8 ] && grep -q "^  292 more buildings not shown (by drift); all are in many.h5" "$out"'
expect "accelerations stand in g beside the units of the deck" 'awk "/^B7 +acceleration/ { n++; good = \$5 == \"m/s^2\" && (\$4 / 9.80665 - \$6)^2 < 1e-7 } END { exit !(n == 1 && good) }" "$out" && grep -qE "^ +quantity +floor +unit +.g.  run$" "$out"'
sed 's/^building B7 /building the-tower-of-1968 /; s/ B7 / the-tower-of-1968 /g' many.deck >long.deck
run "$jostle" run long.deck
expect "long names keep the table's columns" 'awk "/^ +quantity / { at = index(\$0, \"quantity\") } /^(the-tower-of-1968|B[0-9]+) +drift / { n++; bad = bad || index(\$0, \"drift\") != at } END { exit bad || n != 8 }" "$out"'
rm long.*
expect "the table for programs has them all" '[ "$("$jostle" show --tsv many.h5 | awk -F "\t" "NR > 1 && \$0 ~ /\tdrift\t/ && \$0 !~ /_time/" | wc -l)" -ge 600 ]'
rm many.*
