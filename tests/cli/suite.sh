#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What engineers make of suites: records scaled to a spectral acceleration, tables of demands,
# fragility, and pictures of studies.
. tests/support/cli.sh

cp "$root"/input/records/ELCENTRO_1940_NS.AT2 "$root"/input/records/NAPA_2014_68150_HNE.AT2 .
cat >scaled.deck <<'END'
building A -floors 1 -mass 1 -stiffness 100
ground record ELCENTRO_1940_NS.AT2 -sa 0.4g -damping 2%
step fixed 0.01
END
run "$jostle" check scaled.deck
factor=$(sed -n 's/.*scaled by \([0-9.e+-]*\) to a PSA of 3.92266 m\/s^2 at a period of 0.628319 s, 2 % damping/\1/p' "$out")
expect "check says how a record is scaled" '[ $status -eq 0 ] && [ -n "$factor" ]'
run "$jostle" spectrum ELCENTRO_1940_NS.AT2 --scale "$factor" --damping 0.02 --periods 0.628318530717959 --tsv
# The factor has six digits.
expect "jostle spectrum finds that acceleration" 'awk -F "\t" "NR == 2 { exit !(\$5 > 0.3999996 && \$5 < 0.4000004) }" "$out"'

# With late = 1, im = 4 makes the narrow gap negative: two runs of twelve fail.
cat >suite.deck <<'END'
title "a suite"
units kN m s
param late 0
sweep record files "*.AT2"
sweep im values 4m/s^2 1m/s^2 2m/s^2
sweep wide values 1 0
building A -floors 2 -mass 100t -stiffness 50MN/m -height 3m
building B -floors 3 -mass 80t -stiffness 20MN/m -height 3m
contact A B -gap ${5mm + wide * 1m - 1m * max(0, im / 1m * 1s^2 - 3.5) * (1 - wide) * late} -law linear -k 1e5
ground record $record -sa $im
step fixed 5ms
duration 8s
END
run "$jostle" run suite.deck -o whole.h5 -q
expect "the suite runs" '[ $status -eq 0 ]'
run "$jostle" run suite.deck -o failed.h5 -q -D late=1
expect "the one with failures, too" '[ $status -eq 1 ]'

run "$jostle" show whole.h5 --csv
expect "--csv has lines of one length" '[ $status -eq 0 ] && head -n 1 "$out" | grep -qx "run,record,im,wide,status,table,name,quantity,location,value,unit,hit" && [ "$(awk -F , "{ print NF }" "$out" | sort -u)" = 12 ]'
run "$jostle" show whole.h5 --long
expect "--long has the columns of engineers" '[ $status -eq 0 ] && head -n 1 "$out" | grep -qxP "record\tim\twide\tedp\tlocation\tvalue\tunit\tstatus\thit" && grep -qP "^ELCENTRO_1940_NS\t4\t0\tdrift-ratio\tB:3\t[0-9.e-]+\t1\tdone\t$" "$out"'
expect "all its lines are as long" '[ "$(awk -F "\t" "{ print NF }" "$out" | sort -u)" = 9 ]'
expect "what no run has is left out" '! grep -q link- "$out" && grep -q "	force	A:2-B:2	" "$out"'
largest=$(awk -F '\t' '$1 ~ /^EL/ && $2 == 2 && $3 == 0 && $4 == "drift" && $6 > m { m = $6; at = $5 } END { print at, m }' "$out")
run "$jostle" show whole.h5 --long --edp drift --edp impacts:A:1-B:1 --csv
expect "--edp gives one line a run, and where it is largest" '[ "$(wc -l <"$out")" -eq 25 ] && grep -q "^ELCENTRO_1940_NS,2,0,drift,${largest/ /,},m,done,$" "$out"'
run "$jostle" show failed.h5 --long
lines=$(awk -F '\t' '$8 == "failed" && $6 == ""' "$out" | wc -l)
expect "failed runs have their lines, without values" '[ $status -eq 0 ] && [ "$lines" -gt 20 ] && ! grep -q "	failed$" <(grep -P "\t[0-9.]+\t[^\t]+\tfailed$" "$out")'
run "$jostle" show whole.h5 --long --edp drift
cut -f 1-3,6 "$out" | tail -n +2 >drift.tsv
run "$jostle" show whole.h5 --wide --edp drift --edp impacts:A:1-B:1
expect "--wide has a line for each run, with its demands side by side" '[ $status -eq 0 ] && head -n 1 "$out" | grep -qxP "run\trecord\tim\twide\tstatus\tdrift \[m\]\timpacts:A:1-B:1" && cmp <(cut -f 2-4,6 "$out" | tail -n +2) drift.tsv'
run "$jostle" show whole.h5 --long
awk -F '\t' '$1 ~ /^EL/ && $2 == 4 && $3 == 0 { print $6 }' "$out" | sort >one.txt
run "$jostle" show whole.h5 --wide
awk -F '\t' '$2 ~ /^EL/ && $3 == 4 && $4 == 0' "$out" | cut -f 6- | tr '\t' '\n' | sort >other.txt
expect "without --edp it has every demand at every place" '[ -s one.txt ] && cmp one.txt other.txt && head -n 1 "$out" | grep -qP "\tdrift:B:3 \[m\]\t.*\tdrift-ratio:B:3\t"'
run "$jostle" show failed.h5 --wide --edp drift
expect "a failed run has a line without demands" '[ $status -eq 0 ] && [ "$(awk -F "\t" "{ print NF }" "$out" | sort -u)" = 6 ] && [ "$(grep -cP "\tfailed\t$" "$out")" -eq "$(grep -c "failed" "$out")" ] && grep -q failed "$out"'
run "$jostle" show whole.h5 --wide --long
expect "a table is long or wide" '[ $status -eq 2 ] && said "give --long or --wide, not both"'
run "$jostle" show whole.h5 --edp drift
expect "--edp needs --long or --wide" '[ $status -eq 2 ]'
run "$jostle" show whole.h5 --long --edp drfit
expect "an unknown demand is refused" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "did you mean '"'drift'"'"'
run "$jostle" show whole.h5 --tsv --csv
expect "two forms exclude each other" '[ $status -eq 2 ]'

cat >yielding.deck <<'END'
units kN m s
sweep im values 0.1m/s^2 4m/s^2 7m/s^2
building A -floors 2 -mass 100t -stiffness 40MN/m -height 4m
storey A:1 bilinear -yield 400kN -hardening 0.02
ground sine -amplitude $im -frequency 1.5Hz -cycles 3
step fixed 1ms
END
run "$jostle" run yielding.deck -q
run "$jostle" show yielding.h5 --long --edp residual-drift --edp residual-drift-ratio:A:1
expect "residual drifts are of storeys that have yielded, and ratios of their heights" '[ $status -eq 0 ] && awk -F "\t" "\$2 == \"residual-drift\" { drift[\$1] = \$4 } \$2 == \"residual-drift-ratio:A:1\" { ratio[\$1] = \$4 } END { exit !(drift[\"0.1\"] < 1e-15 && drift[7] > 1e-3 && ratio[7] > 0.2499 * drift[7] && ratio[7] < 0.2501 * drift[7]) }" "$out"'
run "$jostle" run yielding.deck -q -o strong.h5 -D im=7m/s^2
"$jostle" show strong.h5 --tsv >strong.tsv
for edp in ductility storey-hysteretic:A:1 deterioration damage; do
    run "$jostle" show yielding.h5 --long --edp "$edp"
    expect "$edp of a run of a study is that of the run alone" '[ $status -eq 0 ] && awk -F "\t" -v edp="$edp" "BEGIN { sub(\"storey-\", \"\", edp); sub(\":.*\", \"\", edp) } NR == FNR { if (\$1 == \"buildings\" && \$3 == edp && \$4 == 1) want = \$5; next } \$1 == 7 { got = \$4 } END { exit !(want != \"\" && got == want && (edp ~ /^d[ea]/ || got > 1)) }" strong.tsv "$out"'
done
run "$jostle" show yielding.h5
expect "the largest one is shown" '[ $status -eq 0 ] && grep -qE "^A +residual_drift +1 .* 3 \(im 7\)$" "$out"'
run "$jostle" show whole.h5
expect "of elastic storeys there is none" '[ $status -eq 0 ] && ! grep -q residual_drift "$out"'

cat >quotes.deck <<'END'
sweep word values "a,b" plain
building A -floors 1 -mass 1 -stiffness 100
initial A:1 -velocity 1
load A:1 constant 1
output -file "$word.h5"
step fixed 0.01
duration 1
END
run "$jostle" run quotes.deck -q -o quotes.h5
run "$jostle" show quotes.h5 --csv
expect "cells with commas are quoted" 'grep -q "^1,\"a,b\",done,buildings,A,drift,1," "$out" && grep -q "^2,plain,done,buildings,A,drift,1," "$out"'
run "$jostle" show quotes.h5 --tsv
expect "but not in TSV" 'grep -q "^1	a,b	done" "$out"'

run "$jostle" fragility whole.h5 --edp drift-ratio --limit 0.2%,9900% --at wide=1
expect "fragility prints counts, and says where there is no curve" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^drift-ratio > 0.002" "$out" && grep -qE "^ +4 +2 +[0-2] +[01]\.[0-9]+ " "$out" && grep -q "^no curve: no run exceeds the limit" "$out"'
run "$jostle" fragility whole.h5 --edp acceleration --limit 0.1g,9.80665 --at wide=1
expect "a limit on accelerations stands in g, too" '[ $status -eq 0 ] && grep -q "^acceleration > 0.980665 m/s^2 (0.1 g)" "$out" && grep -q "^acceleration > 9.80665 m/s^2 (1 g)" "$out"'
"$jostle" plot whole.h5 ida --edp acceleration --at wide=0 --script g >"$out" 2>"$err"
expect "ida shows the unit of accelerations in g" '[ "$(grep -c "^set label .*m/s² = 0.102 g\]" g/ida.gp)" -eq 2 ]'
rm -r g
run "$jostle" fragility whole.h5 --edp drift-ratio --limit 2 --at wide=1
expect "a percentage without its sign is warned about" '[ $status -eq 0 ] && said "jostle: warning: limit 2 of drift-ratio is 200 %; 2 % is 2% or 0.02"'
run "$jostle" fragility whole.h5 --edp drift-ratio --limit 0.2 --at wide=1
expect "a drift ratio of 20 % is not" '[ $status -eq 0 ] && [ ! -s "$err" ]'
run "$jostle" fragility whole.h5 --edp drift --limit 1mm --tsv
expect "--tsv has a line for each group, limit and intensity" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 7 ] && [ "$(awk -F "\t" "{ print NF }" "$out" | sort -u)" = 17 ] && head -n 1 "$out" | grep -qP "^edp\tlimit\tlimit_unit\twide\tim\t" && [ "$(cut -f 4 "$out" | sort -u | tr "\n" " ")" = "0 1 wide " ]'
run "$jostle" fragility failed.h5 --edp drift --limit 9m --at wide=0
expect "failed runs count as above, and are named" '[ $status -eq 0 ] && said "2 of 6 runs failed; they count as above every value" && said "run 2 (record = ELCENTRO_1940_NS, im = 4 m/s^2, wide = 0): " && grep -qE "^ +4 +2 +2 +1.000" "$out" && grep -q "no curve: one intensity separates" "$out" && grep -q "the median is between 2 and 4 m/s^2" "$out"'
run "$jostle" fragility failed.h5 --edp drift --limit 9m --at wide=0 --failed left-out
expect "or are left out" '[ $status -eq 0 ] && said "they are left out" && grep -qE "^ +4 +0 +0 +- +-" "$out"'
run "$jostle" fragility whole.h5 --edp drift --limit 9m,1e-7m
expect "all or none above the limit is no curve" '[ $status -eq 0 ] && [ "$(grep -c "^no curve: no run exceeds the limit; the largest drift is [0-9.e-]* m$" "$out")" -eq 2 ] && [ "$(grep -c "^no curve: all runs exceed the limit; the smallest drift is [0-9.e-]* m$" "$out")" -eq 2 ]'

# The demand is im / sqrt(k), so that the limit 0.1 is crossed at 0.1 sqrt(k) = 1, 2, 3, and 5, which is
# beyond the last intensity.
cat >first.deck <<'END'
sweep im range 0.5m/s 3.5m/s 7
sweep k values 100 400 900 2500
building A -floors 1 -mass 1 -stiffness $k
initial A:1 -velocity $im
step fixed 0.1ms
duration 0.4
END
run "$jostle" run first.deck -q
run "$jostle" fragility first.h5 --edp drift --limit 0.1001m --over k --method ida --at k=100
expect "a sweep is a sample or fixed, not both" '[ $status -eq 2 ]'
sed 's/^sweep k .*/sweep k values 98.06651234 400.0001 400.0002/' first.deck >shown.deck
run "$jostle" run shown.deck -q
run "$jostle" fragility shown.h5 --edp drift --limit 0.1m --at k=98.0665 --over ""
expect "--at takes a number as tables show it" '[ $status -eq 0 ] && [ ! -s "$err" ]'
run "$jostle" fragility shown.h5 --edp drift --limit 0.1m --at k=400 --over ""
expect "unless they show two of them so" '[ $status -eq 2 ] && said "has 3 values"'
run "$jostle" fragility shown.h5 --edp drift --limit 0.1m --at k=98.066 --over ""
expect "but no other" '[ $status -eq 2 ] && said "has 3 values"'
run "$jostle" fragility first.h5 --edp drift --limit 0.1001m --over k --method ida
expect "--method ida counts samples, and names those that never exceed" '[ $status -eq 0 ] && grep -qx "3 of 4 samples first exceed the limit between two intensities" "$out" && grep -qx "1 of 4 samples never exceed it and count as above their highest intensity: k 2500" "$out" && grep -q "^median 2\." "$out"'
run "$jostle" fragility first.h5 --edp drift --limit 0.05001m --over k --method ida --tsv
# All four cross at 0.5, 1, 1.5 and 2.5: the mean and the standard deviation of their logarithms; the
# limit is 2e-4 more, and drifts at the steps are within 1e-5.
expect "where all exceed, the moments of the logarithms count" 'awk -F "\t" "NR == 2 { exit !(\$9 > 1.1700 && \$9 < 1.1710 && \$10 > 0.6795 && \$10 < 0.6797 && \$13 == \"ida\" && \$14 == 0 && \$15 == 0) }" "$out"'
run "$jostle" fragility first.h5 --edp drift --limit 0.1,0 --over k --method ida
expect "zeros do not tell where 0 is first exceeded" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "cannot locate the first exceedance of 0 on drift, which is 0 until the first contact"'
run "$jostle" fragility first.h5 --edp drift --limit 1 --over k --method ida
expect "where none does, there is no curve" '[ $status -eq 0 ] && grep -q "^no curve: no run exceeds" "$out" && grep -q "^4 of 4 samples never exceed" "$out"'
cat >scatter.deck <<'END'
sweep im values 1m/s 2m/s
sweep law values linear hertz
sweep k random uniform 300 400 -n 5 -seed 1
building A -floors 1 -mass 1 -stiffness $k
contact A wall -gap 1mm -law $law -k 1e3
initial A:1 -velocity $im
step fixed 1ms
duration 0.4
END
run "$jostle" run scatter.deck -q
run "$jostle" fragility scatter.h5 --edp drift --limit 0.06m --tsv
cut -f 6 "$out" | tr '\n' ' ' >n.txt
expect "records and realisations of random parameters are samples together" '[ $status -eq 0 ] && [ "$(cat n.txt)" = "n 10 10 " ]'
# With a hazard curve that is straight in logarithms the rate is H(median) exp((k beta)^2 / 2).
printf '1e-6 1e6\n1e6 1e-6\n' >hazard.txt
run "$jostle" fragility first.h5 --edp drift --limit 0.05001m --over k --method ida --hazard hazard.txt --tsv
expect "a hazard curve gives annual rates, and what each intensity adds" '[ $status -eq 0 ] && [ ! -s "$err" ] && awk -F "\t" "NR == 1 { for (i = 1; i <= NF; i++) at[\$i] = i; next } { b = \$at[\"dispersion\"]; rate = \$at[\"annual_rate\"]; to = \$at[\"annual_rate_up_to\"]; d = rate * \$at[\"median\"] / exp(b * b / 2) - 1; bad += d * d > 1e-18 || to <= last || to >= rate; last = to } END { exit bad || NR != 8 }" "$out"'
printf '1 1e-3\n2 1e-4\n' >hazard.txt
run "$jostle" fragility first.h5 --edp drift --limit 0.05001m --over k --method ida --hazard hazard.txt
expect "where it is too short there is a warning" '[ $status -eq 0 ] && grep -q "^exceeded [0-9.e-]* times a year, once in" "$out" && grep -q "warning: the hazard curve ends at 2 m.s, where the probability is " "$err"'
run "$jostle" fragility first.h5 --edp drift --limit 0.05001m --over k --method ida --hazard hazard.txt --csv
expect "beside data, too, and once" '[ $status -eq 0 ] && [ "$(grep -c "warning: the hazard curve ends at 2 m.s" "$err")" -eq 1 ]'
run "$jostle" fragility whole.h5 --edp drift --limit 1mm --hazard hazard.txt --tsv
expect "without a curve of the study there is no rate" '[ $status -eq 0 ] && [ "$(cut -f 18,19 "$out" | sort -u | tr "\n\t" ",;")" = ";,annual_rate;annual_rate_up_to," ]'
for wrong in "--edp drift --limit 1m --edp force" "--edp drift --limit 1m --limit 2m" "--edp drift --limit 1m --over record --over wide" "--edp drift --limit 1m --method" "--edp drift --limit 1m --method other" "--edp drift" "--limit 1m" "--edp drift --limit 1kN" "--edp drift --limit" "--edp drift --limit 1m --im record" "--edp drift --limit 1m --over nothing" "--edp drift --limit 1m --at im=3" "--edp drift --limit 1m --failed perhaps" "--edp drift --limit 1m --tsv --csv" "--edp drift:Z --limit 1m"; do
    # shellcheck disable=SC2086  # several words
    run "$jostle" fragility whole.h5 $wrong
    expect "refused: fragility $wrong" '[ $status -eq 2 ] && [ ! -s "$out" ] && [ -s "$err" ]'
done
run "$jostle" run scaled.deck -q
for file in scaled.h5 suite.deck nothing.h5; do
    run "$jostle" fragility $file --edp drift --limit 1mm
    expect "fragility refuses $file" '[ $status -eq 2 ] && said "$file"'
done

# drawn NAME OPTION...: gnuplot draws it without a word.
drawn() {
    local kind=$1
    shift
    rm -rf scripts
    run "$jostle" plot "$@" "$kind" --script scripts
    [ $status -eq 0 ] && (cd scripts && gnuplot "$kind.gp") >said 2>&1
    [ ! -s said ] && [ "$(wc -c <"scripts/$kind.png")" -gt 9000 ]
}
# Between two samples a percentile is on a straight line.
"$jostle" show whole.h5 --long --edp drift-ratio | LC_ALL=C awk -F '\t' '$3 == 0 && $4 == "drift-ratio" { print $2, 100 * $6 }' |
    sort -k 1,1n -k 2,2n | awk 'NR % 2 { low = $2; next } { print $1, low + 0.84 * ($2 - low), (low + $2) / 2, low + 0.16 * ($2 - low) }' >percentiles
run "$jostle" plot whole.h5 ida --at wide=0 --script scripts
sed -n '/^\$percentiles/,/^EOD/p' scripts/ida.dat | grep '^ *[0-9]' >drawn
expect "the percentiles of ida are those of the values printed, in per cent" '[ $status -eq 0 ] && grep -q "drift ratio \[%\]" scripts/ida.gp && paste -d " " percentiles drawn | awk "{ for (i = 1; i < 5; i++) if (\$i - \$(i + 4) > 1e-5 * \$i || \$(i + 4) - \$i > 1e-5 * \$i) exit 1 } END { exit NR != 3 || NF != 8 }"'
if command -v gnuplot >/dev/null; then
    expect "ida is drawn" 'drawn ida whole.h5 --at wide=0 --limit 0.1%'
    expect "with failures" 'drawn ida failed.h5 --at wide=0 && grep -q "next run failed" scripts/ida.gp && grep -q "2 of 6 runs failed, counted above" scripts/ida.gp'
    expect "with samples of two sweeps" 'drawn ida whole.h5 --over record,wide --edp force'
    expect "fragility is drawn" 'drawn fragility whole.h5 --edp acceleration:B --limit 2,0.3g'
    expect "where there is no curve, too" 'drawn fragility whole.h5 --edp acceleration:B --limit 2e9'
    expect "response is drawn" 'drawn response whole.h5 --at wide=0 --edp drift:A:1'
    expect "with groups" 'drawn response whole.h5 --against im --edp impacts'
    expect "the axis of an intensity begins at 0 where the values are near" 'grep -q "^set xrange \[0:" scripts/response.gp'
    expect "not where a third of it were empty" 'drawn response scatter.h5 --against im --edp drift && grep -q "^set xrange \[0.95:" scripts/response.gp'
    expect "against texts" 'drawn response whole.h5 --against record --over im --at wide=0'
    expect "against texts in groups" 'drawn response whole.h5 --against record --over "" --at wide=0'
    run "$jostle" plot whole.h5
    expect "without a kind it draws the response of each group" '[ $status -eq 0 ] && [ -s whole-response.png ]'
    run "$jostle" plot whole.h5 --at wide=1
    expect "or the incremental analysis where there is one" '[ $status -eq 0 ] && [ -s whole-ida.png ]'
else
    skip "pictures of studies" "no gnuplot"
fi
run "$jostle" plot whole.h5 ida --at wide=1 --limit 1% --script limits
expect "a limit is drawn as its line in the legend: solid, as wide" '[ $status -eq 0 ] && grep -q "graph 1 nohead lc rgb .#000000. lw 1.5$" limits/ida.gp && grep -q "rto screen .* nohead lc rgb .#000000. lw 1.5$" limits/ida.gp'
rm -rf limits
run "$jostle" plot whole.h5 ida -o groups.png
expect "ida of several groups is refused" '[ $status -eq 2 ] && said "wide = 1 ...)" && [ ! -e groups.png ]'
run "$jostle" plot whole.h5 fragility
expect "fragility needs a limit" '[ $status -eq 2 ] && said "--limit"'
run "$jostle" plot whole.h5 response --limit 1% -o limits.png
expect "response has no use for one" '[ $status -eq 2 ] && said "--limit" && [ ! -e limits.png ]'
run "$jostle" plot whole.h5 response --against im --im wide -o twice.png
expect "one sweep is gone along" '[ $status -eq 2 ] && said "given twice" && [ ! -e twice.png ]'
run "$jostle" plot whole.h5 energy
expect "a study has its own kinds" '[ $status -eq 2 ] && said "energy is for single runs; whole.h5 is a study"'
run "$jostle" plot whole.h5 --compare scaled.h5
expect "a study is not compared with one run" '[ $status -eq 2 ] && said "--compare takes two runs or two studies; whole.h5 is a study"'
run "$jostle" plot scaled.h5 --edp drift
expect "options of studies are refused for one run" '[ $status -eq 2 ] && said "--edp is for studies"'
run "$jostle" plot scaled.h5 --against gap
expect "by the name that was given" '[ $status -eq 2 ] && said "--against is for studies"'
run "$jostle" plot scaled.h5 ida
expect "and their figures" '[ $status -eq 2 ] && said "ida is for studies; scaled.h5 is one run"'
run "$jostle" plot missing.h5 --edp drift
expect "a file that is not there is said to be so" '[ $status -eq 2 ] && said "cannot open missing.h5"'

# Parts of a study hold some of its runs; the numbers are those of the whole.
for k in 1 2; do
    run "$jostle" run suite.deck --shard $k/3 -q -o part$k.h5
done
run "$jostle" fragility part1.h5 --edp drift --limit 1mm --at wide=1
expect "runs that a part does not have are left out" '[ $status -eq 0 ] && said "runs are not in part1.h5; they are left out"'
run "$jostle" merge part1.h5 part2.h5 -o parts.h5 --partial -q
run "$jostle" show parts.h5 --long --edp drift
cp "$out" parts.tsv
run "$jostle" show whole.h5 --long --edp drift
expect "those that are there are the runs of the whole" '[ "$(grep -c "	missing	$" parts.tsv)" -eq 4 ] && [ "$(grep -Fxc -f parts.tsv "$out")" -eq 9 ]'
run "$jostle" show part2.h5 --long --edp drift
expect "in a part, too" '[ "$(wc -l <"$out")" -eq 5 ] && [ "$(grep -Fxc -f parts.tsv "$out")" -eq 5 ]'
run "$jostle" fragility parts.h5 --edp drift --limit 1mm --at wide=1
expect "missing runs of a merged study are left out" '[ $status -eq 0 ] && said "runs are not in parts.h5"'
