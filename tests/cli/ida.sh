#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle ida: the intensity at which each record exceeds a limit, by few runs.
. tests/support/cli.sh

# An elastic oscillator: its demand is proportional to the intensity.
cat >linear.deck <<'END'
units kN m s
sweep record values 1.3 2.1 4
sweep im values 0.1 0.2 3
sweep mass values 1 2
building A -floors 1 -mass $mass -stiffness 100
damping A rayleigh 5%
ground sine -amplitude ${im * record * 1m/s^2} -frequency $record -cycles 3
step fixed 5ms
END
"$jostle" run linear.deck -q -D im=1 -o unit.h5
"$jostle" show unit.h5 --wide --edp drift | cut -f 2,3,5 >unit.tsv
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --tolerance 0.1% --over record --tsv
expect "a search of each sample ends with 0" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 7 ] && head -n 1 "$out" | grep -qxP "record\tmass\tbelow\tabove\tcapacity\tdemand \[m\]\truns\toutcome\tedp\tlimit \[m\]\tmedian\tdispersion"'
expect "the demand reaches the limit between both intensities" 'awk -F "\t" "
    NR == FNR { unit[\$1, \$2] = \$3; next }
    FNR > 1 { n++; u = unit[\$1, \$2]; if (!(u > 0 && \$3 * u <= 0.02 && \$4 * u > 0.02 && \$4 < 1.0011 * \$3 && \$6 <= 0.02 && \$6 > 0.01998 && (d = \$5 * u / 0.02 - 1) * d < 1e-18)) bad = 1 }
    END { exit bad || n != 6 }" <(tail -n +2 unit.tsv) "$out"'
awk -F '\t' 'NR > 1 && $2 == 2 { x = log($5); n++; s += x; q += x * x } END { printf "%.9g\t%.9g\n", exp(s / n), sqrt((q - s * s / n) / (n - 1)) }' "$out" >fit.tsv
expect "the curve is that of the mean and the scatter of the logarithms" 'awk -F "\t" "NR == FNR { m = \$1; d = \$2; next } FNR > 1 && \$2 == 2 { n++; if (\$11 / m > 1 + 1e-8 || m / \$11 > 1 + 1e-8 || \$12 / d > 1 + 1e-6 || d / \$12 > 1 + 1e-6) bad = 1 } END { exit bad || n != 3 }" fit.tsv "$out"'
cp "$out" one.tsv
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --tolerance 0.1% --over record --tsv -j 3
expect "threads change nothing" 'cmp one.tsv "$out"'
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --tolerance 0.1% --over record --points --tsv
expect "--points has every run" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq "$(awk -F "\t" "NR > 1 { n += \$7 } END { print n + 1 }" one.tsv)" ] && awk -F "\t" "FNR > 1 && (\$4 > 0.02) != \$5 { bad = 1 } END { exit bad }" "$out"'
# With a hazard curve that is straight in logarithms the rate is H(median) exp((k beta)^2 / 2).
printf '1e-6 1e12\n1e6 1e-12\n' >hazard.txt
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --hazard hazard.txt --tsv
expect "a hazard curve gives the annual rate" '[ $status -eq 0 ] && awk -F "\t" "NR > 1 { want = \$11 ^ -2 * exp(2 * \$12 ^ 2); d = \$13 / want - 1; n += d * d < 1e-18 } END { exit !(n == NR - 1 && n > 1) }" "$out"'
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --hazard hazard.txt
expect "and so does the text" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -qE "^exceeded [0-9.e+]+ times a year, once in [0-9.e-]+ years; probability in 50 years [0-9.]+ %$" "$out"'
printf '0.001 1e-3\n0.002 1e-4\n' >hazard.txt
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --hazard hazard.txt --tsv
expect "a curve that is too short for a rate is told for each group" '[ $status -eq 0 ] && [ "$(grep -c "warning: the hazard curve ends at 0.002, where" "$err")" -eq 2 ]'
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --step 0.05:0.02 --tolerance 10% --tsv
expect "on a coarse search the curve finds what is proportional to the intensity" '[ $status -eq 0 ] && awk -F "\t" "
    NR == FNR { unit[\$1, \$2] = \$3; next }
    FNR > 1 { n++; d = \$5 * unit[\$1, \$2] / 0.02 - 1; if (d * d > 1e-18 || \$4 > 1.1001 * \$3 || \$4 < 1.01 * \$3) bad = 1 }
    END { exit bad || n != 6 }" <(tail -n +2 unit.tsv) "$out"'
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --step 0.05:0.02 --tolerance 10% --runs 20 --points --csv
expect "steps grow, and runs that are left fill the gaps" '[ $status -eq 0 ] && awk -F , "NR > 1 { n[\$1, \$2]++; s = s \" \" \$3 \" \" } END { for (i in n) if (n[i] != 20) bad = 1; exit bad || s !~ / 0.01 .* 0.0600*[0-9]* .* 0.13 .* 0.22 / }" "$out"'
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --runs 4
expect "too few runs are told" '[ $status -eq 1 ] && grep -q "too few runs" "$out" && said "6 of 6 searches have too few runs for the tolerance; give more --runs or a larger --tolerance"'
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --bootstrap 200 --seed 3
cp "$out" seeded.txt
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --bootstrap 200 --seed 3 -j 2
expect "a bootstrap depends on its seed only" '[ $status -eq 0 ] && [ "$(grep -c "^95 % of [0-9]* bootstraps, seed 3: median [0-9.]* to [0-9.]*, dispersion" "$out")" -eq 2 ] && cmp seeded.txt "$out"'
run "$jostle" ida linear.deck --limit drift=20mm --range 0.01:100 --over record --curves 4 --tsv
expect "curves of an elastic oscillator are straight, and their middle is the median of three" '[ $status -eq 0 ] && head -n 1 "$out" | grep -qxP "mass\tdemand \[m\]\tintensity_16\tintensity_50\tintensity_84" && awk -F "\t" "
    NR == FNR { if (FNR > 1 && \$2 == 1) { n++; at[n] = \$5 } next }
    FNR == 2 { for (i = 1; i <= 3; i++) for (j = 1; j < 3; j++) if (at[j] > at[j + 1]) { t = at[j]; at[j] = at[j + 1]; at[j + 1] = t } }
    FNR > 1 && \$1 == 1 { m++; d = \$4 / (at[2] * m / 4) - 1; if (d * d > 1e-16 || \$3 > \$4 || \$4 > \$5) bad = 1 }
    END { exit bad || m != 4 }" one.tsv "$out"'
run "$jostle" ida linear.deck --limit drift=20mm --curves 4 --points
expect "runs or curves are printed" '[ $status -eq 2 ] && said "--curves is for a demand, without --collapse and --points"'
run "$jostle" ida linear.deck --limit drift=20mm --factor 2 --step 1
expect "a search goes by a factor or by steps" '[ $status -eq 2 ] && said "give --factor or --step, not both"'
run "$jostle" ida linear.deck --limit drift=20mm --step 0.1:x
expect "a step is a value of the intensity" '[ $status -eq 2 ] && said "--step takes FIRST or FIRST:GROWTH, values of im, not '"'0.1:x'"'"'
printf '1 1\n2 1\n' >hazard.txt
run "$jostle" ida linear.deck --limit drift=20mm --over record --hazard hazard.txt
expect "a hazard curve must fall" '[ $status -eq 2 ] && grep -q "hazard.txt: the rate does not fall from intensity 1 to 2" "$err"'
run "$jostle" ida linear.deck --limit drift=20mm --over record --range 0.2:0.4
expect "what is exceeded from the lowest intensity on, or never, is told" '[ $status -eq 1 ] && grep -q "always exceeded" "$out" && grep -q "never exceeded" "$out" && said "searches never exceed the limit; search further with --range"'
expect "text has the curve of each group" '[ "$(grep -c "^mass = [12]: " "$out")" -eq 2 ]'

# The pair under many records: the same median as a fine grid, by a tenth of its runs.
mkdir records
awk -v folder=records -v n=44 -f "$root/tests/support/artificial_records.awk"
cat >pair.deck <<'END'
units kN m s
sweep record files "records/*.AT2"
sweep sa range 0.1m/s^2 20m/s^2 200
building A -floors 1 -mass 100t -stiffness 4MN/m -height 3m
building B -floors 1 -mass 80t -stiffness 9MN/m -height 3m
damping A rayleigh 5%
damping B rayleigh 5%
contact A B -gap 20mm -law linear -k 100MN/m
ground record $record -sa $sa -building A
step fixed 5ms
END
run "$jostle" ida pair.deck --limit drift-ratio:A=2% --tsv
expect "the pair is searched" '[ $status -eq 0 ]'
runs=$(awk -F '\t' 'NR > 1 { n += $6 } END { print n }' "$out")
median=$(awk -F '\t' 'NR == 2 { print $10 }' "$out")
"$jostle" run pair.deck -q
grid=$("$jostle" fragility pair.h5 --edp drift-ratio:A --limit 2% --method ida --tsv | awk -F '\t' 'NR == 2 { print $9 }')
coarse=$("$jostle" ida pair.deck --limit drift-ratio:A=2% --step 0.1g:0.05g --tolerance 10% --tsv | awk -F '\t' 'NR == 2 { m = $10 } NR > 1 { n += $6 } END { print m, n }')
expect "steps that grow and a tolerance of 10 % find it by a twentieth" 'awk -v coarse="$coarse" "BEGIN { split(coarse, c, \" \"); exit !(c[1] / $grid < 1.01 && $grid / c[1] < 1.01 && c[2] <= 440 && c[2] > 200) }"'
expect "its median is that of a grid of 200 intensities within 1 %, by a tenth of the runs" 'awk "BEGIN { exit !($median / $grid < 1.01 && $grid / $median < 1.01 && $runs <= 880 && $runs > 300) }"'

cp pair.deck wrong.deck
sed -i 's/^building A.*/building A -floors 1 -mass 100t -stiffness ${4MN\/m * (2.5m\/s^2 - sa) \/ 1m*1s^2} -height 3m/' wrong.deck
run "$jostle" ida wrong.deck --limit drift-ratio:A=50% --range 1:20
expect "a search that fails is told with its run" '[ $status -eq 1 ] && said "44 of 44 searches failed, the first: run 1 (record = 01): at sa = 2.8561: wrong.deck:4:"'

# Values of the intensity and of samples that follow from parameters, and paired samples.
cat >used.deck <<'END'
param top 3m/s
param stiffest 900
sweep im range 0.5m/s $top 7
sweep k values 100 400 $stiffest -as pair
sweep a values 1 1 1 -as pair
building A -floors 1 -mass $a -stiffness $k
initial A:1 -velocity $im
step fixed 0.1ms
duration 0.4
END
run "$jostle" ida used.deck --limit drift=0.07 --over pair --tolerance 0.1% --tsv
expect "sweeps may use parameters, and may be paired" '[ $status -eq 0 ] && [ "$(awk -F "\t" "NR == 1 { for (i = 1; i <= NF; i++) at[\$i] = i; next } { low = \$at[\"below [m/s]\"] / sqrt(\$at[\"k\"]); high = \$at[\"above [m/s]\"] / sqrt(\$at[\"k\"]); n += low < 0.07001 && high > 0.06999 } END { print n }" "$out")" = 3 ]'
run "$jostle" ida linear.deck
expect "a limit or a collapse is needed" '[ $status -eq 2 ] && said "give --limit EDP=VALUE or --collapse"'
run "$jostle" ida "$root/input/ida.deck" --collapse
expect "without the statement collapse no run collapses" '[ $status -eq 2 ] && said "the deck has no statement '"'collapse'"', and without it no run collapses"'
run "$jostle" ida linear.deck --limit drift
expect "a limit has a value" '[ $status -eq 2 ] && said "--limit takes EDP=VALUE, not '"'drift'"'"'
run "$jostle" ida pair.deck --limit drift=1 --im record
expect "the intensity is a sweep of its own" '[ $status -eq 2 ] && said "--im record: it has to be a sweep of numbers of its own"'
run "$jostle" ida linear.deck --limit drift=1 --range 2:1
expect "a range has two ends" '[ $status -eq 2 ] && said "im from 2 to 1 is no range to search"'
run "$jostle" ida linear.deck --limit drift=1 --factor 1
expect "a factor is larger than 1" '[ $status -eq 2 ] && said "--factor takes a number > 1, not '"'1'"'"'
run "$jostle" ida linear.deck --limit drift=1 --factor 1.0001
expect "a search has not too many runs" '[ $status -eq 2 ] && said "more than 200 runs for one record"'
run "$jostle" ida linear.deck --limit drfit=1
expect "an unknown demand is refused" '[ $status -eq 2 ] && said "did you mean '"'drift'"'"'
