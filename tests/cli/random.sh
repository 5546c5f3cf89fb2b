#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Random sweeps: one dimension of the study, the same values whatever the threads and interruptions.
. tests/support/cli.sh

two_buildings study.deck
sed -i 's/^damping B.*/damping B rayleigh 0/; s/^param gap .*/sweep gap random lognormal 5mm 0.5 -n 30 -seed 4 -lhs/; s/-e 0.65/-e $e/' study.deck
sed -i '4i sweep e random normal 0.65 0.1 -n 30 -seed 4 -min 0.2 -max 0.95' study.deck
sed -i '5i sweep pga values 0.2g 0.3g' study.deck
sed -i 's/-amplitude 0.3g/-amplitude $pga/' study.deck
run "$jostle" run study.deck -j 1 -o one.h5
expect "samples and values multiply" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^study of 60 runs, 0 failed" "$out" && grep -q "^    gap  *30 values" "$out"'

if command -v h5diff >/dev/null; then
    for threads in 2 8; do
        run "$jostle" run study.deck -q -j $threads -o other.h5 --force
        expect "$threads threads give the same file" 'same one.h5 other.h5'
    done
    run limited -f 8 "$jostle" run study.deck -q -j 1 -o killed.h5
    expect "a study that is cut short leaves its journal" '[ $status -eq 3 ] && [ -e killed.h5.runs ] && [ ! -e killed.h5 ]'
    run "$jostle" run study.deck -q -o killed.h5
    expect "and is resumed to the same file" '[ $status -eq 0 ] && same one.h5 killed.h5'
    sed 's/-seed 4 -lhs/-seed 5 -lhs/' study.deck >seed.deck
    run "$jostle" run seed.deck -q -o seed.h5
    expect "another seed gives another one" '[ $status -eq 0 ] && ! same one.h5 seed.h5'
else
    skip "any number of threads gives the same file" "no h5diff"
fi

run "$jostle" show --tsv one.h5
table=$(cat "$out")
expect "show --tsv has columns for the sample and its parameters" 'head -n 1 "$out" | grep -q "^run	sample	gap	e	pga	status"'
expect "the parameters stand in no group as results" '[ "$(awk -F "\t" "\$9 == \"gap\" || \$9 == \"e\"" "$out" | grep -c .)" -eq 0 ]'
"$jostle" run study.deck -q -o single.h5 -D sample=17 -D pga=0.3g
"$jostle" show --tsv single.h5 | awk -F '\t' '$3 == "drift" { print $5 }' | sort -u >single.txt
awk -F '\t' '$1 == 34 && $9 == "drift" { print $11 }' <<<"$table" | sort -u >of_study.txt
expect "-D sample=17 is that run, to the last digit" '[ $(wc -l <single.txt) -ge 5 ] && cmp single.txt of_study.txt'
run "$jostle" check study.deck -D sample=31
expect "a sample is numbered to its end" '[ $status -eq 2 ] && said "is numbered from 1 to 30"'

if python3 -c 'import xarray, netCDF4' 2>/dev/null; then
    run python3 - <<'END'
import xarray
root = xarray.open_dataset("one.h5")
assert root.status.dims == ("sample", "pga") and set(root.coords) == {"sample", "gap", "e", "pga"}
assert root.gap.dims == ("sample",) and root.gap.attrs["units"] == "m"
force = xarray.open_dataset("one.h5", group="/contacts/envelope").force
assert force.dims == ("sample", "pga", "contact") and "gap" in force.coords
assert force.where(force.e > 0.6, drop=True).sizes["sample"] == int((root.e > 0.6).sum())
END
    expect "xarray has the parameters as coordinates of the sample" '[ $status -eq 0 ]'
else
    skip "xarray has the parameters as coordinates of the sample" "no xarray"
fi

rm -f ./*.h5
run "$jostle" run study.deck -q -o whole.h5
for part in 1 2 3; do
    "$jostle" run study.deck -q -o part$part.h5 --shard $part/3
done
run "$jostle" merge part1.h5 part2.h5 part3.h5 -o merged.h5
if command -v h5diff >/dev/null; then
    expect "parts of a study make the file of the whole" '[ $status -eq 0 ] && same whole.h5 merged.h5'
else
    expect "parts of a study are joined" '[ $status -eq 0 ]'
fi

# Against a random parameter: what show says of each run, sorted by the parameter.
"$jostle" show --long --edp force merged.h5 | awk -F '\t' '$4 == 0.2 * 9.80665 { print $2, $7 }' |
    LC_ALL=C sort -g | awk '{ printf "%.7g %.7g\n", $1, $2 }' >wanted.txt
run "$jostle" plot merged.h5 response --against gap --edp force --script scripts
sed -n '/^\$group0/,/^EOD/p' scripts/response.dat | awk '/^[ 0-9]/ { print $1, $2 }' >drawn.txt
expect "response against a random parameter is drawn over its values" '[ $status -eq 0 ] && [ "$(wc -l <wanted.txt)" -eq 30 ] && cmp wanted.txt drawn.txt'
expect "as points, which no line joins" 'grep -q "with points" scripts/response.gp && ! grep -q "linespoints" scripts/response.gp'
if command -v gnuplot >/dev/null; then
    (cd scripts && gnuplot response.gp) >said 2>&1
    expect "gnuplot draws it without a word" '[ ! -s said ] && [ -s scripts/response.png ]'
fi
run "$jostle" fragility merged.h5 --edp force --limit 1MN --over gap
expect "--over takes the sample, not its parameters" '[ $status -eq 2 ] && said "--over: '"'gap'"' is a random parameter; name its sweep '"'sample'"'"'
run "$jostle" fragility merged.h5 --edp force --limit 1MN --at e=0.6
expect "so does --at" '[ $status -eq 2 ] && said "--at: '"'e'"' is a random parameter"'
run "$jostle" fragility merged.h5 --edp force --limit 1MN --im gap --at pga=0.2g --tsv
expect "fragility against a random parameter has one run at each of its values" '[ $status -eq 0 ] && [ "$(awk -F "\t" "NR > 1 && \$6 == 1" "$out" | grep -c .)" -eq 30 ]'
run "$jostle" fragility merged.h5 --edp force --limit 1MN --im gap --over sample
expect "which is then no sample" '[ $status -eq 2 ] && said "is named for two different parts"'
run "$jostle" fragility merged.h5 --edp force --limit 1MN --im gap --at pga=0.2g --method ida
expect "first exceedances along a random parameter are refused" '[ $status -eq 2 ] && said "'"'gap'"' is a random parameter"'
run "$jostle" plot merged.h5 ida --im gap --over pga -o ida.png
expect "and so is ida" '[ $status -eq 2 ] && said "'"'gap'"' is a random parameter" && [ ! -e ida.png ]'
run "$jostle" fragility merged.h5 --edp force --limit 1MN
expect "realisations are samples where there are no records" '[ $status -eq 0 ] && grep -qx "fragility over pga, 30 samples of sample" "$out"'
