#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle law: tables, comparison, history, picture, fit, and what is wrong with the words.
. tests/support/cli.sh

bodies="-m1 25t -m2 40t -v 0.5"
jankowski="jankowski -k 2.75e9N/m^1.5 -e 0.65 $bodies"

# value NAME [COLUMN]: a number of the table in $out.
value() {
    awk -F '\t' -v name="$1" -v column="${2-2}" '$1 == name { print $column }' "$out"
}

# near GOT WANT RELATIVE
near() {
    awk -v got="$1" -v want="$2" -v most="$3" 'BEGIN {
        d = got - want; d = d < 0 ? -d : d; w = want < 0 ? -want : want
        exit !(got != "" && d <= most * w) }'
}

# shellcheck disable=SC2086  # options are one word each
law() {
    run "$jostle" law "$@"
}

law $jankowski --tsv
expect "--tsv prints the seven quantities in their order" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ "$(cut -f 1 "$out" | tr "\n" " ")" = "nominal_restitution achieved_restitution peak_force duration max_penetration impulse dissipated " ]'
expect "with the values of an independent integration" 'near $(value achieved_restitution) 0.647029026882227 1e-9 && near $(value peak_force) 692516.74166 1e-9 && near $(value duration) 0.0289959527745732 1e-9 && near $(value max_penetration) 0.00351382881518338 1e-9 && near $(value impulse) 12669.45405294 1e-9 && near $(value dissipated) 1117.98738148 1e-9 && near $(value nominal_restitution) 0.65 0'
cp "$out" units.tsv
law jankowski -k 2.75e9 -e 0.65 -m1 25000 -m2 40000kg -v 50cm/s --tsv
expect "bare numbers are in SI" 'near $(value peak_force) $(awk "/peak/ { print \$2 }" units.tsv) 1e-12'
law $jankowski -calibrate --tsv
expect "-calibrate delivers what is asked for" 'near $(value achieved_restitution) 0.65 1e-9 && near $(value nominal_restitution) 0.65 0'
law hertz -k 2.75e9 -m1 2 -v 1 --tsv
expect "a law without e asks for none, and without -m2 there is a wall" '[ "$(value nominal_restitution)" = nan ] && near $(value impulse) 4 1e-9'
law stereomechanical -e 0.5 $bodies --tsv
expect "an impact without force has none, nor a duration" '[ $status -eq 0 ] && [ "$(value peak_force)" = nan ] && [ "$(value duration)" = 0 ] && near $(value impulse) 11538.461538461539 1e-12'

law $jankowski
expect "the table has units" '[ $status -eq 0 ] && grep -qE "^peak force +N +692517$" "$out" && grep -q "^jankowski -k 2.75e+09 -e 0.65$" "$out" && grep -q "effective mass 15384.6 kg" "$out"'
expect "and fits 100 columns" '[ "$(wc -L <"$out")" -le 100 ]'

printf '0 0\n1 100\n' >curve.txt
law table -file curve.txt -units mm kN $bodies
expect "of a curve the number of points is told" '[ $status -eq 0 ] && grep -qx "table -file (2 points)" "$out"'
law table -file curve.txt -units "mm kN" $bodies
expect "two units in one word are told apart" '[ $status -eq 2 ] && said "'"'mm kN' is one word; the units are two: -units mm kN"'"'
rm curve.txt
law kelvin-voigt -k 93.5MN/m -e 1 -calibrate $bodies
expect "no damping is 0" '[ $status -eq 0 ] && grep -qx "kelvin-voigt -k 9.35e+07 -zeta 0 (calibrated)" "$out"'

law $jankowski --compare hertz-damp,hertz --compare "linear -k 93.5MN/m" --tsv
expect "--compare sets laws side by side" '[ $status -eq 0 ] && [ "$(head -n 1 "$out")" = "$(printf "law\tjankowski\thertz-damp\thertz\tlinear")" ] && near $(value achieved_restitution 3) 0.774819081 1e-8 && near $(value peak_force 5) 599679.401526 1e-9'
law $jankowski -calibrate --compare hertz-damp,hertz --compare "linear -k 93.5MN/m" --compare hertz
expect "many laws stand below one another" '[ $status -eq 0 ] && [ "$(grep -c "^peak force" "$out")" -eq 2 ] && [ "$(wc -L <"$out")" -le 100 ]'
law $jankowski --compare linear
expect "a stiffness of another dimension is not lent" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "command line:1:"'
law jankowski -k 2.75e9 -e 0.65 $bodies --compare linear
expect "not even without a unit" '[ $status -eq 2 ] && said "command line:1:15: error: -k of jankowski is in N/m^1.5, that of linear in N/m" && said "^~"'
law $jankowski --compare bilinear
expect "what the first law cannot lend is missing" '[ $status -eq 2 ] && said "command line:2:5: error: bilinear needs -k1"'
law hertz-damp -k-from hertz -radius1 1 -modulus1 30e9 -poisson1 0.2 -e 0.65 $bodies --compare hertz --tsv
expect "an estimate of the stiffness is lent" '[ $status -eq 0 ] && near $(value achieved_restitution 3) 1 1e-9'
law $jankowski --compare hertz,
expect "an empty name is refused" '[ $status -eq 2 ] && said "command line:3:1: error: law needs the name of a law"'

law
expect "a law is needed" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "a contact law is expected"'
law jankwski -k 1
expect "an unknown law is named with the nearest" '[ $status -eq 2 ] && said "command line:1:5: error: unknown contact law '"'jankwski'; did you mean 'jankowski'?"'" && said "^~~~~~~~"'
law jankowski -k 2e9N/m -e 2 $bodies
expect "all errors come in one go" '[ $status -eq 2 ] && said "command line:1:18: error: k has the dimension of a stiffness" && said "command line:1:28: error: e is 2; it must be >= 1e-6 and <= 1" && said "the command line has 2 errors"'
law jankowski -k 2e9 -e 0.5 -v 1
expect "a mass is needed" '[ $status -eq 2 ] && said "error: jankowski needs -m1: mass of one body"'
law jankowski -k 2e9 -e 0.5 -m1 1 -v 0
expect "and a velocity > 0" '[ $status -eq 2 ] && said "v is 0 m/s; it must be > 0"'
law jankowski -k 2e9 -e 0.5 -m1 1 -v 1 -n 2
expect "an option of another law is unknown" '[ $status -eq 2 ] && said "unknown option '"'-n'"'"'
law jankowski "-k 2e9" -e 0.5 -m1 1 -v 1
expect "words are not taken apart" '[ $status -eq 2 ] && said "is not expected"'
law jankowski "-k
title x" -e 0.5
expect "a line end in a word is refused" '[ $status -eq 2 ] && said "a word of the command line has a line end"'
law stereomechanical -e 0.5 -m1 5e-324 -m2 5e-324 -v 1
expect "the effective mass of the smallest masses is 0" '[ $status -eq 0 ] && grep -q "effective mass 0 kg" "$out"'
law linear -k 1 -m1 5e-324 -m2 5e-324 -v 1
expect "under which a spring has no impact" '[ $status -eq 1 ] && said "under linear cannot be followed"'
law kelvin-voigt -k 1 -zeta 2 -m1 1 -v 1
expect "bodies that do not part are a failure" '[ $status -eq 1 ] && said "under kelvin-voigt the bodies have not separated"'
law $jankowski --tvs
expect "a wrong option is named with the nearest" '[ $status -eq 2 ] && said "unknown option '"'--tvs'; did you mean '--tsv'?"'"'
law $jankowski --tsv=yes
expect "--tsv takes no value" '[ $status -eq 2 ] && said "option '"'--tsv=yes' takes no value"'"'
for option in --history --plot --fit --compare; do
    law $jankowski $option
    expect "$option needs a value" '[ $status -eq 2 ] && said "option '"'$option' needs a value"'"'
done
law $jankowski --plot a.png --plot b.png
expect "--plot is given once" '[ $status -eq 2 ] && said "--plot is given twice"'
law $jankowski --plot a.jpg
expect "a picture has a known ending" '[ $status -eq 2 ] && said "'"'a.jpg' must end in .png, .svg or .pdf"'"'
law $jankowski --history h.tsv --compare hertz
expect "a history is that of one law" '[ $status -eq 2 ] && said "--history writes one law"'
expect "nothing was written" 'only units.tsv'

law $jankowski --tsv
expect "numbers have no more digits than they need to be read as the same" 'grep -qxP "nominal_restitution\t0.65" "$out"'
law $jankowski --history h.tsv
expect "--history writes the impact" '[ $status -eq 0 ] && [ "$(head -n 1 h.tsv)" = "$(printf "time [s]\tpenetration [m]\tvelocity [m/s]\tforce [N]")" ] && [ "$(wc -l <h.tsv)" -gt 100 ]'
expect "from closure to opening" '[ "$(sed -n 2p h.tsv | cut -f 1,3)" = "$(printf "0\t0.5")" ] && near $(tail -n 1 h.tsv | cut -f 1) 0.0289959527745732 1e-9 && near $(tail -n 1 h.tsv | cut -f 3) -0.323514513441 1e-9'
expect "with the impulse below its force" 'near $(awk "NR > 2 { s += (\$4 + f) / 2 * (\$1 - t) } { t = \$1; f = \$4 } END { print s }" h.tsv) 12669.454 2e-4'
cp h.tsv kept.tsv
law hertz -k 1 -m1 1 -v 1 --history=h.tsv --plot p.svg
expect "an existing file is kept" '[ $status -eq 2 ] && said "h.tsv exists; --force overwrites it" && [ ! -s "$out" ] && cmp -s h.tsv kept.tsv && [ ! -e p.svg ]'
law hertz -k 1 -m1 1 -v 1 --history h.tsv --force
expect "unless --force is given" '[ $status -eq 0 ] && ! cmp -s h.tsv kept.tsv'
law $jankowski --history no_such_folder/h.tsv
expect "a folder that is not there ends with 3" '[ $status -eq 3 ] && said "cannot write no_such_folder/h.tsv: No such file or directory" && [ ! -s "$out" ]'
run limited -f 4 "$jostle" law $jankowski --history limited.tsv
expect "a file that cannot grow leaves nothing behind" '[ $status -eq 3 ] && said "cannot write limited.tsv" && only units.tsv h.tsv kept.tsv'
mkdir small
if mount -t tmpfs -o size=4k tmpfs small 2>/dev/null; then
    law $jankowski --history small/h.tsv
    expect "nor does a full disk" '[ $status -eq 3 ] && said "small/h.tsv" && [ -z "$(ls -A small)" ]'
    umount small
else
    skip "nor does a full disk" "no disk can be mounted here"
fi

# One line every tenth of a millisecond, after a lead without force.
awk 'BEGIN { print "time [ms];force [kN]"; for (i = 0; i < 20; i++) print i / 10 ";0" }
    NR > 2 && int($1 * 1e4) != last { last = int($1 * 1e4); printf "%.12g;%.12g\n", 1e3 * $1 + 2, $4 / 1e3 }' \
    kept.tsv >force.txt
law jankowski $bodies --fit force.txt --tsv
expect "--fit finds k and zeta of the history" '[ $status -eq 0 ] && near $(value k) 2.75e9 1e-6 && near $(value zeta) 0.37283566526 1e-6 && near $(value start) 2e-3 1e-6 && near $(value achieved_restitution) 0.647029026882227 1e-6 && near $(value peak_force) 692516.74 1e-6'
expect "with next to no error" '[ "$(cut -f 1 "$out" | tail -n 7 | tr "\n" " ")" = "k k_error zeta zeta_error start start_error normalised_error " ] && awk -F "\t" "/error/ && !(\$2 >= 0 && \$2 < 1e4) { bad = 1 } /normalised/ && \$2 > 1e-6 { bad = 1 } END { exit bad }" "$out"'
law jankowski $bodies --fit force.txt --compare hertz-damp
expect "laws are compared by their fits" '[ $status -eq 0 ] && [ "$(grep -c "normalised error" "$out")" -eq 2 ]'
law jankowski -k 1e9 -e 0.5 $bodies --fit force.txt
expect "what is found is not given" '[ $status -eq 2 ] && said "command line:1:15: error: -k cannot be given: --fit finds it" && said "error: -e cannot be given"'
law jankowski -k-from hertz -radius1 1 -modulus1 30e9 -poisson1 0.2 $bodies --fit force.txt
expect "nor estimated" '[ $status -eq 2 ] && said "command line:1:15: error: -k-from cannot be given: --fit finds it"'
law hertz -k 2.75e9 $bodies --history elastic.tsv
awk 'BEGIN { print "time [ms];force [kN]"; for (i = 0; i < 20; i++) print i / 10 ";0" }
    NR > 2 && int($1 * 1e4) != last { last = int($1 * 1e4); printf "%.12g;%.12g\n", 1e3 * $1 + 2, $4 / 1e3 }' \
    elastic.tsv >elastic.txt
law rubber -n 2 -k 3e9 -zeta 0.8 $bodies --history rubber.tsv
awk 'NR > 1 && $1 != last { print last = $1, $4 }' rubber.tsv >rubber.txt
law rubber -n 2 $bodies --fit rubber.txt --tsv
expect "of options that exclude each other none is asked for" '[ $status -eq 0 ] && near $(value zeta) 0.8 1e-4'
law rubber -n 2 -c 1 $bodies --fit force.txt
expect "nor taken" '[ $status -eq 2 ] && said "error: -c cannot be given: --fit finds it"'
law stereomechanical -e 0.5 $bodies --fit force.txt
expect "a law without stiffness is not fitted" '[ $status -eq 2 ] && said "stereomechanical has no k that could be fitted"'
law jankowski -m1 2500 -m2 4000 -v 0.5 --fit force.txt
expect "masses that contradict the impulse are refused with e" '[ $status -eq 2 ] && said "e = J/(m* v) - 1 is 15.47 with m* = 1538.46 kg and v = 0.5 m/s"  && [ ! -s "$out" ]'
awk -F ';' 'NR > 1 && $2 > most { most = $2; row = NR } END { print row + 40 }' force.txt | xargs -I N head -n N force.txt >cut.txt
law jankowski $bodies --fit cut.txt --tsv
expect "a record that is cut off is said to be" '[ $status -eq 0 ] && said "jostle: warning: the record is cut off at " && near $(value k) 2.75e9 1e-4'
awk -F ';' 'BEGIN { OFS = ";" } NR > 1 { $2 += 30 * sin(NR * NR) } { print }' elastic.txt >noisy.txt
law jankowski $bodies --fit noisy.txt
expect "what a record does not determine is said" '[ $status -eq 0 ] && said "jostle: warning: zeta of jankowski is undetermined: its standard error of " && grep -q "(undetermined)" "$out"'
law jankowski $bodies --fit no_such_file
expect "the record must exist" '[ $status -eq 2 ] && said "no_such_file: No such file or directory"'
law jankowski $bodies --fit kept.tsv
expect "and have two columns" '[ $status -eq 2 ] && said "kept.tsv:2: 4 columns; two are read, time and value"'

if command -v gnuplot >/dev/null; then
    for ending in png svg pdf; do
        law $jankowski --compare hertz --plot "p.$ending"
        expect "--plot draws .$ending" '[ $status -eq 0 ] && [ -s p.$ending ]'
    done
    law jankowski $bodies --fit force.txt --plot fit.svg
    expect "measurement and fit are drawn" '[ $status -eq 0 ] && grep -q measured fit.svg && grep -q "contact force \[kN\]" fit.svg && grep -q "penetration \[mm\]" fit.svg'
    law hertz -k 2.75e9 $bodies --plot hertz.svg
    expect "an elastic impact loses nothing" '[ $status -eq 0 ] && grep -q "; 0 J lost" hertz.svg'
    law hertz -k 2.75e9 -m1 25t -v 0.001mm/s --plot small.svg
    expect "the numbers above the panels are in the units of the axes" '[ $status -eq 0 ] && grep -q "contact force \[N\]" small.svg && grep -q "largest 0.1873 N, over 491 ms" small.svg && grep -q "penetration \[µm\]" small.svg && grep -q "e 1, 0.1668 µm" small.svg'
    law stereomechanical -e 0.5 $bodies --plot none.svg
    expect "no force makes no picture" '[ $status -eq 2 ] && said "stereomechanical has no force to draw" && [ ! -e none.svg ]'
else
    skip "--plot draws" "gnuplot is not installed"
fi
run env PATH=/nowhere "$jostle" law $jankowski --plot lost.png --script scripts
expect "without gnuplot the status is 3" '[ $status -eq 3 ] && said "cannot run gnuplot" && [ ! -e lost.png ] && [ ! -s "$out" ]'
expect "but the script is there" '[ -s scripts/impact.gp ] && [ -s scripts/impact.dat ]'

# A measured peak force, from which k follows: of a linear spring k = (F / v)^2 / m*.
law linear -m1 204kg -m2 146.5kg -v 0.3 --peak 12kN --tsv
expect "--peak finds the stiffness of a spring" '[ $status -eq 0 ] && near $(value k) $(awk "BEGIN { printf \"%.15g\", (12000 / 0.3) ^ 2 / (204 * 146.5 / 350.5) }") 1e-6 && near $(value peak_force) 12000 1e-9'
law jankowski -e 0.65 $bodies --peak 692516.74166N --compare "hunt-crossley -e 0.5" --tsv
expect "--peak finds the k of every law" 'near $(value k) 2.75e9 1e-8 && near $(value peak_force 3) 692516.74166 1e-9'
law bilinear -m1 1 -v 1 --peak 3
expect "--peak needs a law with -k" '[ $status -eq 2 ] && grep -q "has no -k that --peak could find" "$err"'
law linear -k 3 -m1 1 -v 1 --peak 3
expect "--peak and -k cannot be combined" '[ $status -eq 2 ] && grep -q -- "-k cannot be given: --peak finds it" "$err"'
law linear -m1 1 -v 1 --peak 3m
expect "--peak is a force" '[ $status -eq 2 ] && grep -q "must be a force above 0" "$err"'
law linear -m1 1 -v 1 --peak 3 --fit some.txt
expect "--peak and --fit cannot be combined" '[ $status -eq 2 ] && grep -q "not with --fit" "$err"'

# Lists. The force of Hertz's spring grows with v^1.2 and with k^0.4.
law hertz -k 2.75e9N/m^1.5 -m1 25t -m2 40t --over v=0.1,20cm/s,0.4m/s --tsv
expect "--over prints a line for each velocity" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 4 ] && awk -F "\t" "NR > 1 { r = \$4 / \$2 ^ 1.2; if (f && (r / f > 1 + 1e-9 || r / f < 1 - 1e-9)) exit 1; f = r } END { exit NR != 4 }" "$out"'
law hertz -k 1 $bodies --over k=1e9:9e9:5 --tsv
expect "--over takes a range of stiffnesses in place of -k" '[ "$(cut -f 2 "$out" | tr "\n" " ")" = "k [N/m^1.5] 1000000000 3000000000 5000000000 7000000000 9000000000 " ] && awk -F "\t" "NR > 1 { r = \$3 / \$2 ^ 0.4; if (f && (r / f > 1 + 1e-9 || r / f < 1 - 1e-9)) exit 1; f = r }" "$out"'
law jankowski -k 2.75e9N/m^1.5 -calibrate $bodies --over e=0.4,0.8 --compare hunt-crossley --tsv
expect "--over of e calibrates each law again" 'awk -F "\t" "NR > 1 && (\$7 / \$2 > 1 + 1e-9 || \$7 / \$2 < 1 - 1e-9) { exit 1 } END { exit NR != 5 }" "$out"'
law jankowski -k 1e9 -calibrate $bodies --over e=0.1:1:19 --tsv
expect "a range ends with its last number" '[ $status -eq 0 ] && [ "$(tail -n 1 "$out" | cut -f 2)" = 1 ]'
law hertz $bodies --over q=3
expect "--over takes v, e or k" '[ $status -eq 2 ] && grep -q "takes v, e or k" "$err"'
law hertz -k 1e9 -m1 25t -m2 40t --over v=3,-1
expect "a wrong value of a list has its place" '[ $status -eq 2 ] && grep -q "v is -1 m/s; it must be > 0" "$err"'
if type gnuplot >/dev/null 2>&1; then
    law hertz -m1 25t -m2 40t -v 0.5 --over k=1e9:9e9:9 --plot over.svg --script .
    expect "--plot draws the forces of a list" '[ $status -eq 0 ] && grep -q "impact stiffness" over.svg && grep -q "force0 using" over.gp'
fi
