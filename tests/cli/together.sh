#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sweeps that go together: one dimension of the study, whose runs are those of -D, of parts, and of files
# that are included in their place.
. tests/support/cli.sh

cp "$root"/input/records/*.AT2 .
cat >study.deck <<'END'
title "motions"
units kN m s
sweep factor values 1.31 2.4 1.1 2.4 0.95 -as motion
sweep im range 0.5 2.5 3
sweep record files "*.AT2" -as motion
sweep gap values 5mm 5mm 20mm -as measure
sweep k values 1e5kN/m 2e5kN/m 1e5kN/m -as measure
building A -floors 2 -mass 100t -stiffness 50MN/m -height 3m
building B -floors 3 -mass 80t -stiffness 20MN/m -height 3m
damping A rayleigh 5%
contact A B -gap $gap -law linear -k $k
ground record $record -scale ${factor * im}
step fixed 5ms
duration 6s
END
run "$jostle" check study.deck
expect "check counts the runs and shows what goes together" '[ $status -eq 0 ] && grep -qx "study of 45 runs" "$out" && grep -qx "  motion                5 values:  1 2 3 4 5" "$out" && grep -qx "    factor              5 values:  1.31 2.4 1.1 2.4 0.95" "$out" && grep -qx "    k                   3 values:  100000 200000 100000 kN/m" "$out"'
run "$jostle" run study.deck -q -o whole.h5
expect "the study runs" '[ $status -eq 0 ]'
run "$jostle" show whole.h5
expect "its largest values name what belongs to their runs" 'grep -q "(motion [1-5] (factor [0-9.]*, record [A-Z0-9_]*), im [0-9.]*, measure [1-3] (gap [0-9.]*, k [12]e+05))$" "$out"'
"$jostle" show --tsv whole.h5 >whole.tsv
expect "its table has a column for each" 'head -n 1 whole.tsv | grep -qP "^run\tmotion\tfactor\trecord\tim\tmeasure\tgap\tk\tstatus\t"'

# values FILE: all that the file of one analysis says but for what no two runs share.
values() {
    "$jostle" show --tsv "$1" | grep -v wall_seconds
}

# peaks FIRST: what runs of the table say of drifts and forces, their columns from FIRST on.
peaks() {
    awk -F '\t' -v first="$1" '$first != "impacts" && $(first + 2) ~ /^(drift|acceleration|force)$/ {
        for (i = first; i < first + 5; i++) printf "%s ", $i; print "" }' | LC_ALL=C sort
}
wrong=0
compared=0
for number in 1 2 5; do
    for pair in 1 3; do
        "$jostle" run study.deck -q -o one.h5 --force -D motion=$number -D im=1.5 -D measure=$pair
        "$jostle" show --tsv one.h5 | peaks 1 >one.txt
        awk -F '\t' -v m=$number -v c=$pair '$2 == m && $5 == 1.5 && $6 == c' whole.tsv | peaks 10 >of_study.txt
        cmp one.txt of_study.txt || wrong=1
        compared=$((compared + $(wc -l <one.txt)))
    done
done
expect "each run is that of its -D, to the last digit" '[ $wrong -eq 0 ] && [ $compared -ge 70 ]'
"$jostle" run study.deck -q -o one.h5 --force -D motion=2 -D measure=3 -D im=0.5
"$jostle" run study.deck -q -o other.h5 --force -D record=NAPA_2014_68150_HNE -D measure=3 -D im=0.5
expect "-D record=NAME is the motion of that record" 'cmp <(values one.h5) <(values other.h5)'
run "$jostle" check study.deck -D factor=1
expect "-D factor=1 leaves the records" 'grep -qx "study of 45 runs" "$out" && grep -qx "  factor           fixed with -D: 1" "$out" && grep -q "^    record  *5 values" "$out"'
run "$jostle" run study.deck -q -D record=NAPA_2014_68150_HNE -D measure=1 -o one_motion.h5
expect "-D goes with a study" '[ $status -eq 0 ] && "$jostle" show one_motion.h5 | grep -q "^study of 3 runs"'
run "$jostle" tasks study.deck -n 3
expect "tasks makes parts of it" '[ $status -eq 0 ] && [ "$(grep -c -- "--shard" "$out")" -eq 3 ]'

for part in 1 2 3; do
    "$jostle" run study.deck -q -o part$part.h5 --shard $part/3
done
run "$jostle" merge part3.h5 part1.h5 part2.h5 -o merged.h5
expect "parts are joined" '[ $status -eq 0 ] && "$jostle" show --tsv merged.h5 | cmp - whole.tsv'
sed 's/1\.31/1.32/' study.deck >changed.deck
"$jostle" run changed.deck -q -o changed.h5 --shard 2/3
run "$jostle" merge part3.h5 part1.h5 changed.h5 -o wrong.h5
expect "but none with another factor" '[ $status -eq 2 ] && said "are parts of different studies" && [ ! -e wrong.h5 ]'
if command -v h5diff >/dev/null; then
    expect "to the file of the whole" 'same whole.h5 merged.h5'
    run "$jostle" run study.deck -q -j 1 -o single.h5
    expect "one thread gives the same file" 'same whole.h5 single.h5'
    run limited -f 8 "$jostle" run study.deck -q -j 1 -o killed.h5
    expect "a study that is cut short leaves its journal" '[ $status -eq 3 ] && [ -e killed.h5.runs ] && [ ! -e killed.h5 ]'
    run "$jostle" run study.deck -q -o killed.h5
    expect "and is resumed to the same file" '[ $status -eq 0 ] && same whole.h5 killed.h5'
else
    skip "any way to run it gives the same file" "no h5diff"
fi

if python3 -c 'import h5py, xarray, netCDF4' 2>/dev/null; then
    run python3 - <<'END'
import h5py
import numpy
import xarray
f = h5py.File("whole.h5")
assert f["sweep/motion"].attrs["together"] in ("factor record", b"factor record")
assert "sampled" not in f["sweep/motion"].attrs and list(f["sweep/motion"]) == [1, 2, 3, 4, 5]
assert f["sweep/record"].asstr()[1] == "NAPA_2014_68150_HNE" and f["sweep/factor"][3] == 2.4
root = xarray.open_dataset("whole.h5")
assert root.status.dims == ("motion", "im", "measure")
assert root.record.dims == root.factor.dims == ("motion",) and root.gap.dims == ("measure",)
assert set(root.coords) == {"motion", "record", "factor", "im", "measure", "gap", "k"}
drift = xarray.open_dataset("whole.h5", group="buildings/A/envelope").drift.max("floor")
of = drift.swap_dims(motion="record").sel(record="NAPA_2014_68150_HNE")
assert (of == drift.sel(motion=2)).all() and of.factor == 2.4 and of.shape == (3, 3)
assert numpy.isfinite(drift).all()
END
    expect "h5py and xarray find runs by record and by number" '[ $status -eq 0 ]'
else
    skip "h5py and xarray find runs by record and by number" "no h5py or xarray"
fi

# The same study with a file for each motion and each measure, in the same order.
mkdir motions measures
number=0
factors=(1.31 2.4 1.1 2.4 0.95)
for record in *.AT2; do
    echo "ground record ../$record -scale \${${factors[number]} * im}" >motions/$number.deck
    number=$((number + 1))
done
echo 'contact A B -gap 5mm -law linear -k 1e5kN/m' >measures/1.deck
echo 'contact A B -gap 5mm -law linear -k 2e5kN/m' >measures/2.deck
echo 'contact A B -gap 20mm -law linear -k 1e5kN/m' >measures/3.deck
sed -e '/^sweep factor/c sweep motion files "motions/*.deck"' -e '/^sweep record/d; /^sweep k/d' \
    -e '/^sweep gap/c sweep measure files "measures/*.deck"' -e '/^contact/c include $measure' \
    -e '/^ground/c include $motion' study.deck >include.deck
"$jostle" run include.deck -q -o include.h5
"$jostle" show --tsv include.h5 | awk -F '\t' '$8 != "gap"' | cut -f 1,5- >include.txt
cut -f 1,9- whole.tsv >whole.txt
expect "files that are included make the same runs" '[ "$(wc -l <include.txt)" -gt 1000 ] && cmp whole.txt include.txt'
limits=(--edp drift-ratio --limit '2%,3%')
for method in counts ida; do
    "$jostle" fragility include.h5 "${limits[@]}" --over motion --method $method --tsv | cut -f 1-3,5- >wanted.txt
    run "$jostle" fragility whole.h5 "${limits[@]}" --method $method --tsv
    expect "fragility by $method takes the motions for samples, and is that of the files" '[ $status -eq 0 ] && head -n 1 "$out" | grep -q "limit_unit	measure	gap	k	im" && cut -f 1-3,7- "$out" | cmp - wanted.txt && grep -q "	fitted$" "$out"'
done
run "$jostle" fragility whole.h5 "${limits[@]}" --at measure=2
expect "the groups are named by what belongs to them" '[ $status -eq 0 ] && grep -qx "fragility over im, 5 samples of motion; measure = 2 (gap = 0.005 m, k = 200000 kN/m)" "$out"'
run "$jostle" fragility whole.h5 "${limits[@]}" --at record=NAPA_2014_68150_HNE --at k=2e5 --tsv
expect "--at takes one that goes together with others" '[ $status -eq 0 ] && [ "$(awk -F "\t" "NR > 1 && \$6 == 1" "$out" | wc -l)" -eq 6 ]'
run "$jostle" fragility whole.h5 "${limits[@]}" --at gap=5mm
expect "but not a value that stands twice" '[ $status -eq 2 ] && said "--at gap=5mm: this occurs more than once; give a number of '"'measure'"'"'
run "$jostle" fragility whole.h5 "${limits[@]}" --im motion
expect "numbers of what goes together are no intensity" '[ $status -eq 2 ] && said "--im motion: it only numbers paired sweeps"'
run "$jostle" fragility whole.h5 "${limits[@]}" --im factor --over "" --method ida
expect "first exceedances along one of them are refused" '[ $status -eq 2 ] && said "'"'factor'"' is a sweep that is paired with others"'
run "$jostle" plot whole.h5 ida --im measure -o ida.png
expect "and so is ida along them" '[ $status -eq 2 ] && said "'"'measure'"' is a dimension of paired sweeps" && [ ! -e ida.png ]'
run "$jostle" plot whole.h5 response --against measure --at im=2.5 --script scripts
expect "response is drawn over their values" '[ $status -eq 0 ] && grep -q "2: 0.005, 200000. 2" scripts/response.gp && grep -q "measure: gap \[m\], k" scripts/response.gp && ! grep -q linespoints scripts/response.gp'
if command -v gnuplot >/dev/null; then
    (cd scripts && gnuplot response.gp) >said 2>&1
    expect "gnuplot draws it without a word" '[ ! -s said ] && [ -s scripts/response.png ]'
fi

run "$jostle" gap study.deck --tsv
expect "gap --tsv has a column for each of them" '[ $status -eq 0 ] && head -n 1 "$out" | grep -qP "^run\tmotion\tfactor\trecord\tim\tmeasure\tgap\tk\t"'
run "$jostle" gap study.deck
expect "gap sees that the measures make no difference" '[ $status -eq 0 ] && grep -qx "the values of measure make no difference and count once" "$out"'

sed -e 's/^sweep im .*/param im 2.5/' -e '$a output -histories' study.deck >histories.deck
"$jostle" run histories.deck -q -o histories.h5
"$jostle" run histories.deck -q -o one.h5 --force -D record=NAPA_2014_68150_HNN -D measure=2
expect "histories of a run are those of its -D" 'cmp <(values histories.h5#8) <(values one.h5)'

# A random factor for each record.
sed 's/^sweep factor .*/sweep factor random lognormal 1 0.5 -n 5 -seed 3 -as motion/' study.deck >random.deck
"$jostle" run random.deck -q -o random.h5
"$jostle" run random.deck -q -o part.h5 --force --shard 1/1
"$jostle" merge part.h5 -o random_merged.h5 >"$out"
expect "a random sweep goes together with others" '[ "$("$jostle" show random.h5 --tsv | cut -f 3 | sort -u | wc -l)" -eq 6 ] && cmp <("$jostle" show random.h5 --tsv) <("$jostle" show random_merged.h5 --tsv)'
run "$jostle" fragility random.h5 "${limits[@]}" --at measure=1
expect "and makes samples" '[ $status -eq 0 ] && grep -q "^fragility over im, 5 samples of motion" "$out"'
sed '/^sweep factor/s/ 0.95/ 0.95 1/' study.deck >sizes.deck
run "$jostle" check sizes.deck
expect "other sizes are told with both sweeps" '[ $status -eq 2 ] && said "sizes.deck:5:7: error: '"'record' has 5 files, but 'factor' in line 3 has 6 values"'"'
