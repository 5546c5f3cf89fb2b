#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle compare and plot --compare of two studies: runs of the same parameters beside each other.
. tests/support/cli.sh

study_of_records near.deck 3 150
grep -v -e '^contact' -e '^sweep gap' near.deck >apart.deck
"$jostle" run near.deck -q
"$jostle" run apart.deck -q
run "$jostle" compare near.h5 apart.h5
expect "runs with and without pounding are pairs by their record" '[ $status -eq 0 ] && grep -qx "9 pairs of runs of the same record" "$out" && grep -q "^drift:A  *9 " "$out" && ! grep -q "^force" "$out" && [ ! -s "$err" ]'
run "$jostle" compare near.h5 apart.h5 --edp drift:A --tsv
expect "one demand is a table for programs" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 2 ]'
cp "$out" table
if python3 -c 'import h5py' 2>/dev/null; then
    run python3 - <<'END'
import csv, h5py, numpy
row = next(csv.DictReader(open("table"), delimiter="\t"))
with h5py.File("near.h5") as near, h5py.File("apart.h5") as apart:
    drift = lambda f: f["buildings/A/envelope/drift"][...].max(-1)
    a, b = drift(near), drift(apart)
    axis = [d.keys()[0] for d in near["buildings/A/envelope/drift"].dims]
    ratio = (a / (b[:, None] if axis[0] == "record" else b[None, :])).ravel()
close = lambda got, want: numpy.testing.assert_allclose(float(got), want, rtol=1e-12)
close(row["median"], numpy.median(ratio))
close(row["dispersion"], numpy.log(ratio).std(ddof=1))
close(row["smallest"], ratio.min())
close(row["largest"], ratio.max())
assert int(row["run"]) == ratio.argmax() + 1 and int(row["pairs"]) == 9, row
END
    expect "median, dispersion, extremes and the run are those of numpy" '[ $status -eq 0 ]'
else
    skip "median, dispersion, extremes and the run are those of numpy" "no h5py"
fi

# The same study in other units.
sed 's/^units.*/units N mm s/' apart.deck >small.deck
"$jostle" run small.deck -q
"$jostle" compare near.h5 small.h5 --edp drift:A --tsv 2>/dev/null >other
ratios() { awk -F '\t' 'NR == 2 { printf "%d %.9f %.9f %.9f %d\n", $2, $3, $4, $6, $7 }' "$1"; }
expect "the ratio does not depend on the units" '[ "$(ratios table)" = "$(ratios other)" ]'

"$jostle" run near.deck -q -D gap=2mm -o two.h5 --take near.h5
"$jostle" run near.deck -q -D gap=20mm -o twenty.h5 --take near.h5
run "$jostle" compare two.h5 twenty.h5 --edp displacement
expect "one gap is compared with another one" '[ $status -eq 0 ] && grep -qx "3 pairs of runs of the same record" "$out"'

mkdir away
mv records/3.txt away
"$jostle" run apart.deck -q -o less.h5
run "$jostle" compare near.h5 less.h5
expect "runs that only one study has are counted" '[ $status -eq 0 ] && grep -qx "6 pairs of runs of the same record" "$out" && grep -qx "3 runs are only in near.h5" "$out"'
mv away/3.txt records
sed -e 's/^sweep record.*/sweep w values 1 2\nparam record records\/1.txt/' -e 's/-dt 0.01/-dt ${0.01 * $w}/' apart.deck >other.deck
"$jostle" run other.deck -q
run "$jostle" compare near.h5 other.h5
expect "runs that cannot be told apart are an error" '[ $status -eq 2 ] && said "9 runs of near.h5 and 2 of other.h5 have the same parameters; fix a sweep"'
sed 's/^sweep gap.*/sweep gap values 3mm 4mm/' near.deck >wide.deck
"$jostle" run wide.deck -q
run "$jostle" compare near.h5 wide.h5
expect "and so are studies without a run in common" '[ $status -eq 2 ] && said "no run of near.h5 has the record, gap of a run of wide.h5" || said "has the gap, record of a run of wide.h5"'
run "$jostle" compare near.h5 apart.h5 --edp force
expect "a demand must be in both" '[ $status -eq 2 ] && said "apart.h5: force: there is no"'
run "$jostle" compare near.h5 apart.h5 --quantity drift
expect "options of runs are not for studies" '[ $status -eq 2 ] && said "studies take --edp and --limit"'

# Fragilities, over the scale of the records.
for name in near apart; do
    sed -e '/^sweep gap/d' -e 's/\$gap/5mm/' -e 's/^ground.*/sweep im range 0.2 4 12\n& -scale $im/' $name.deck >$name.im.deck
    "$jostle" run $name.im.deck -q -o $name.im.h5
    "$jostle" fragility $name.im.h5 --edp drift:A --limit 25mm --tsv >$name.fragility
done
median() { awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^median/) k = i } NR == 2 { print $k }' "$1"; }
run "$jostle" compare near.im.h5 apart.im.h5 --edp drift:A --limit 25mm --csv
expect "fragilities are those of jostle fragility" '[ $status -eq 0 ] && awk -F , -v a="$(median near.fragility)" -v b="$(median apart.fragility)" "NR == 2 { exit !(a > 0 && \$3 == a && \$5 == b && \$7 - a / b < 1e-12 && a / b - \$7 < 1e-12) }" "$out"'

run "$jostle" plot near.im.h5 --compare apart.im.h5 --edp drift:A --script drawn
expect "a picture shows each pair" '[ $status -eq 0 ] && [ "$(awk "/^.pairs/ { on = 1; next } /^EOD/ { on = 0 } on && !/^#/ && NF == 4" drawn/compare.dat | wc -l)" -eq 36 ] && grep -q "ratio" drawn/compare.gp'
if command -v gnuplot >/dev/null; then
    run "$jostle" plot near.h5 --compare apart.h5 -o pairs.svg
    expect "gnuplot draws it" '[ $status -eq 0 ] && [ -s pairs.svg ] && grep -qx pairs.svg "$out"'
else
    skip "gnuplot draws it" "no gnuplot"
fi
run "$jostle" plot near.h5 response --compare apart.h5
expect "a figure of one study does not take two" '[ $status -eq 2 ] && said "response does not show two studies"'
