#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Intensities of the ground motions of a study, cloud analysis, and stripes whose runs have records
# of their own.
. tests/support/cli.sh

mkdir records
awk -v folder=records -v n=6 -f "$root/tests/support/artificial_records.awk"
model='building A -floors 1 -mass 100t -stiffness 4MN/m -height 3m
storey A:1 clough -yield 150kN -hardening 3%
damping A rayleigh -alpha 0.6 -beta 0
ground record $record -sa $sa -period 1s
step fixed 5ms
duration 12s'

cat >grid.deck <<END
units kN m s
sweep record files "records/*.AT2"
sweep sa values 1.6m/s^2 2m/s^2 2.5m/s^2
$model
END
files=$(cd records && printf '"records/%s" ' *)
cat >stripes.deck <<END
units kN m s
sweep sa values 1.6m/s^2 1.6 1.6 1.6 1.6 1.6 2 2 2 2 2 2 2.5 2.5 2.5 2.5 2.5 2.5 -as motion
sweep record values $files $files $files -as motion
sweep mass values 100t 60t
${model/100t/\$mass}
END
"$jostle" run grid.deck -q
run "$jostle" run stripes.deck -q
expect "stripes are a study" '[ $status -eq 0 ]'
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --tsv
awk -F '\t' 'NR > 1 { print $4, $6, $7, $8, $9, $10 }' "$out" >grid.txt
run "$jostle" fragility stripes.h5 --edp drift-ratio --limit 1.6% --at mass=100 --tsv
expect "runs of one intensity are a stripe, whatever their record" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 4 ] && awk -F "\t" "NR > 1 { print \$4, \$6, \$7, \$8, \$9, \$10 }" "$out" | cmp grid.txt - && grep -qP "\tfitted$" "$out"'
run "$jostle" fragility stripes.h5 --edp drift-ratio --limit 1.6% --bootstrap 300 --seed 7
cp "$out" seeded.txt
expect "each group has its curve and its bootstrap" '[ $status -eq 0 ] && [ "$(grep -c "^95 % of " "$out")" -eq 2 ] && grep -qE "^ +1.6 +6 +" "$out"'
run "$jostle" fragility stripes.h5 --edp drift-ratio --limit 1.6% --bootstrap 300 --seed 7
expect "the same seed gives the same" 'cmp seeded.txt "$out"'
run "$jostle" plot stripes.h5 fragility --edp drift-ratio --limit 1.6% --script g
expect "the picture has a point for each stripe" '[ $status -eq 0 ] && [ "$(sed -n "/counts0 <</,/^EOD/p" g/fragility.dat | grep -cE "^[ 0-9]+")" -eq 3 ]'

run "$jostle" show grid.h5 --wide --edp drift-ratio --im "Sa(1s)" --im PGA --im "Sa_avg(0.5s:2s)" --csv
cp "$out" wide.csv
expect "intensities are columns beside the sweeps" '[ $status -eq 0 ] && head -n 1 "$out" | grep -qx "run,record,sa,Sa(1s) \[m/s^2\],PGA \[m/s^2\],Sa_avg(0.5s:2s) \[m/s^2\],status,drift-ratio"'
expect "where a record is scaled, it has that intensity" 'awk -F , "NR > 1 { n++; d = \$4 / \$3 - 1; if (d * d > 1e-10) bad = 1 } END { exit bad || n != 18 }" wide.csv'
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --im PGA --method cloud --tsv
expect "a cloud is the regression of these columns" '[ $status -eq 0 ] && awk -F "[,\t]" "
    NR == FNR { if (FNR > 1) { n++; x = log(\$5); y = log(\$8); sx += x; sy += y; xx += x * x; xy += x * y; yy += y * y } next }
    FNR == 1 { for (i = 1; i <= NF; i++) at[\$i] = i }
    FNR == 2 {
        b = (n * xy - sx * sy) / (n * xx - sx * sx); a = (sy - b * sx) / n
        s = sqrt((yy - a * sy - b * xy) / (n - 2))
        exit !(same(\$at[\"slope\"], b) && same(\$at[\"intercept\"], a) && same(\$at[\"scatter\"], s) &&
            same(\$at[\"median\"], exp((log(0.016) - a) / b)) && same(\$at[\"dispersion\"], s / b))
    }
    function same(x, y) { return (x / y - 1) ^ 2 < 1e-16 }" wide.csv "$out"'
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --im PGA --method cloud --bootstrap 100
expect "its text has the line and the bootstrap" '[ $status -eq 0 ] && grep -qE "^ln drift-ratio = -[0-9.]+ \+ [0-9.]+ ln PGA, scatter [0-9.]+, of 18 runs$" "$out" && grep -q "^95 % of " "$out" && ! grep -q "standard errors" "$out"'
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --im "Sa(1s)" --method ida --tsv
one=$(awk -F '\t' 'NR == 2 { print $9 }' "$out")
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --method ida --tsv
two=$(awk -F '\t' 'NR == 2 { print $9 }' "$out")
expect "first exceedances go along a measure, too" 'awk "BEGIN { d = $one / $two - 1; exit !(d * d < 1e-10) }"'
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --im PGX
expect "what is no measure is a sweep that is unknown" '[ $status -eq 2 ] && said "the study has no sweep '"'PGX'"'"'
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --im "Sa(1m)"
expect "a period is a time" '[ $status -eq 2 ] && said "'"'Sa(1m)'"' is no intensity; known are"'

# Records that are not scaled, with no sweep of intensities: other sweeps of numbers stay groups.
sed -e '/^sweep sa/s/.*/sweep gap values 1 2/' -e 's/-mass 100t/-mass ${100t * gap}/' -e 's/ -sa .*/ -scale 1.5/' grid.deck >cloud.deck
"$jostle" run cloud.deck -q
run "$jostle" fragility cloud.h5 --edp drift-ratio --limit 1% --im PGV --method cloud
expect "a cloud needs no sweep of intensities" '[ $status -eq 0 ] && [ "$(grep -c "^ln drift-ratio = .* ln PGV, scatter .*, of 6 runs$" "$out")" -eq 2 ] && grep -q "^drift-ratio > 0.01, gap = 2$" "$out"'

mkdir away
mv grid.deck records away
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --im PGA
expect "without the deck there is no measure" '[ $status -eq 2 ] && said "cannot open grid.deck"'
run "$jostle" fragility grid.h5 --edp drift-ratio --limit 1.6% --im PGA --deck away/grid.deck
expect "it may lie elsewhere" '[ $status -eq 0 ]'
sed -i '$s/.*/0.001/' away/records/03.AT2
run "$jostle" show grid.h5 --wide --im PGA --deck away/grid.deck
expect "a record that has changed is refused" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "grid.h5 cannot be computed again: records/03.AT2 has changed since"'
