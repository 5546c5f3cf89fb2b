#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Random sweeps: one dimension of the study, the same values whatever the threads and interruptions.
. tests/support/cli.sh

two_buildings study.deck
sed -i '/^damping B/d; s/^param gap .*/sweep gap random lognormal 5mm 0.5 -n 30 -seed 4 -lhs/; s/-e 0.65/-e $e/' study.deck
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
    "$jostle" run study.deck -q -j 1 -o killed.h5 </dev/null >"$out" 2>"$err" &
    child=$!
    for _ in $(seq 400); do
        [ "$(stat -c %s killed.h5.runs 2>/dev/null || echo 0)" -le 8000 ] || break
        sleep 0.005
    done
    kill -s KILL $child
    wait $child 2>/dev/null
    expect "a killed study leaves its journal" '[ -e killed.h5.runs ]'
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

run "$jostle" fragility one.h5 --edp force --limit 1kN
expect "samples are what fragility counts" '[ $status -eq 0 ] && grep -q "^fragility over pga, 30 samples of sample" "$out"'
"$jostle" run study.deck -q -o weak.h5 -D pga=0.2g
run "$jostle" fragility weak.h5 --edp force --limit 1kN
expect "and no intensity" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "by --im NAME"'
run "$jostle" fragility weak.h5 --edp force --limit 1kN --im gap --tsv
cut -f 5 "$out" | tail -n +2 >over.txt
expect "a random parameter can be one, in ascending order" '[ $status -eq 0 ] && [ "$(sort -gu over.txt | grep -c .)" -eq 30 ] && sort -gc over.txt'
run "$jostle" plot weak.h5 response --against gap --edp force --script scripts
expect "response is a cloud of points over a random parameter" '[ $status -eq 0 ] && grep -q "with points" scripts/response.gp && [ "$(grep -cE "^ [0-9.e-]+ " scripts/response.dat)" -eq 30 ]'
run "$jostle" plot weak.h5 response --against gpa
expect "an unknown one is refused" '[ $status -eq 2 ] && said "no sweep '"'gpa'"'"'

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
