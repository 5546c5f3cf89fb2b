#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle law storey: tables of loops, protocols, comparison, picture, fit, and what is wrong with the
# words.
. tests/support/cli.sh

bilinear="bilinear -yield 600kN -hardening 0 -stiffness 60MN/m"

# cell COLUMN LINE: of the table in $out.
cell() {
    awk -F '\t' -v line="$2" -v column="$1" 'NR == line { print $column }' "$out"
}

# near GOT WANT RELATIVE
near() {
    awk -v got="$1" -v want="$2" -v most="$3" 'BEGIN {
        d = got - want; d = d < 0 ? -d : d; w = want < 0 ? -want : want
        exit !(got != "" && d <= most * w) }'
}

# shellcheck disable=SC2086  # options are one word each
storey() {
    run "$jostle" law storey "$@"
}

# By hand: the storey yields at 10 mm.
printf 'drift [mm]\n40\n-40\n0\n' >turns.txt
storey $bilinear --protocol turns.txt --tsv
expect "a table has a line for each turn" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ "$(wc -l <"$out")" -eq 5 ] && [ "$(head -n 1 "$out")" = "$(printf "law\tturn\tdrift [m]\tshear [N]\ttangent [N/m]\twork [N*m]\tdissipated [N*m]\tplastic [m]")" ]'
expect "with drift and shear" '[ "$(cut -f 1-4 "$out" | tail -n 3)" = "$(printf "bilinear\t1\t0.04\t600000\nbilinear\t2\t-0.04\t-600000\nbilinear\t3\t0\t600000")" ]'
expect "the dissipated energy" 'near $(cell 7 3) 18e3 1e-4 && near $(cell 7 4) 54e3 1e-4 && near $(cell 7 5) 66e3 1e-4'
expect "the work, which stores energy too" 'near $(cell 6 3) 21e3 1e-4 && near $(cell 6 5) 69e3 1e-4'
expect "and the plastic deformation" 'near $(cell 8 3) 0.03 1e-9 && near $(cell 8 4) -0.03 1e-9 && near $(cell 8 5) -0.01 1e-9'

# A hinge: moments and rotations. It yields at 10 mrad.
printf '0.04\n-0.04\n0\n' >rotations.txt
hinge="bilinear -yield 600kN*m -hardening 0 -stiffness 60MN*m"
# shellcheck disable=SC2086  # options are one word each
run "$jostle" law hinge $hinge --protocol rotations.txt --tsv
expect "a hinge has moments over rotations" '[ $status -eq 0 ] && [ "$(head -n 1 "$out")" = "$(printf "law\tturn\trotation [1]\tmoment [N*m]\ttangent [N*m]\twork [N*m]\tdissipated [N*m]\tplastic [1]")" ] && [ "$(cut -f 3,4 "$out" | tail -n 3 | tr "\t\n" "  ")" = "0.04 600000 -0.04 -600000 0 600000 " ] && near $(cell 7 5) 66e3 1e-4'
# shellcheck disable=SC2086
run "$jostle" law hinge $hinge --protocol rotations.txt --script hinge
expect "and a picture of them" '[ $status -eq 0 ] && grep -q "moment \[kN m\]" hinge/loops.gp && grep -q "rotation \[mrad\]" hinge/loops.gp'
run "$jostle" law hinge bilinear -yield 600kN -hardening 0 -stiffness 60MN*m -amplitude 0.02
expect "its yield is a moment" '[ $status -eq 2 ] && said "a moment or energy"'
run "$jostle" law hinge fps -weight 1 -mu 0.1 -stiffness 60 -amplitude 1
expect "no hinge depends on the velocity" '[ $status -eq 2 ] && said "law fps depends on the velocity; it is for storeys only"'

# Links. By hand: a hook catches at 10 mm, a dashpot does c v^2 of work, and a spring and a dashpot in
# series lose pi a^2 k x / (1 + x^2) in a cycle of the circular frequency w, with x = w c / k.
# shellcheck disable=SC2086
link() {
    run "$jostle" law link "$@"
}
link hook -stiffness 60MN/m -slack 10mm --protocol turns.txt --tsv
expect "a link has tensions over lengthenings" '[ $status -eq 0 ] && [ "$(head -n 1 "$out" | cut -f 3,4)" = "$(printf "lengthening [m]\ttension [N]")" ] && near $(cell 4 3) 1.8e6 1e-12 && [ "$(cell 4 4)" = 0 ]'
link gap -yield 600kN -hardening 0 -stiffness 60MN/m -slack 10mm --protocol turns.txt --tsv
expect "a gap spring pushes only" '[ "$(cell 4 3)" = 0 ] && near $(cell 4 4) -600e3 1e-12 && near $(cell 7 4) 12e3 1e-4'
link friction -slip 600kN -stiffness 60MN/m --protocol turns.txt --tsv
expect "friction slips as bilinear does" 'near $(cell 7 5) 66e3 1e-4'
link viscous -dashpot 1MN*s/m --protocol turns.txt -period 1s --tsv
expect "a dashpot loses c v^2" '[ $status -eq 0 ] && near $(cell 7 5) 23687.05 1e-4 && [ "$(cell 4 3)" = 0 ]'
for _ in 1 2 3 4 5 6 7 8 9 10; do printf '0.02\n-0.02\n'; done >cycles.txt
link maxwell -stiffness 60MN/m -dashpot 2MN*s/m --protocol cycles.txt -period 1s --tsv
expect "a spring in series with it loses less" 'near $(awk -F "\t" "{ x[NR] = \$7 } END { print x[NR] - x[NR - 2] }" "$out") 15127.788 1e-4'
link maxwell -stiffness 60MN/m -dashpot 2MN*s/m --protocol turns.txt -period 1s --compare "viscous -dashpot 2MN*s/m" --script link
expect "links are compared in a picture" '[ $status -eq 0 ] && grep -q "tension \[kN\]" link/loops.gp && grep -q "lengthening \[mm\]" link/loops.gp && [ "$(grep -cx "viscous -dashpot 2e+06" "$out")" -eq 1 ]'
link hook -stiffness 60MN/m -slack 5mm --protocol turns.txt --history hook.tsv
cut -f 1,2 hook.tsv >hook.txt
link hook --fit hook.txt -find slack --tsv
expect "--fit finds a slack" '[ $status -eq 0 ] && near $(cell 3 2) 6e7 1e-6 && near $(cell 3 3) 0.005 1e-6'
loop=$root/input/loops/friction_damper.txt
link friction -find slack --fit "$loop" --tsv
expect "the loop of a damper with backlash: its slip, its slack, and the error" 'near $(cell 3 2) 9.02e6 0.01 && near $(cell 3 3) 2.321e-3 1e-3 && near $(cell 3 4) 10142 1e-3 && near $(cell 3 5) 0.1226 1e-3'
link friction --fit "$loop" --tsv
expect "which is larger without the slack" 'near $(cell 3 4) 0.1932 1e-3'
link viscous -dashpot 1 --protocol turns.txt
expect "a dashpot needs a period" '[ $status -eq 2 ] && said "law viscous depends on the velocity: give -period, the time of a cycle of the protocol"'
link viscous --protocol turns.txt -period 1
expect "and a constant" '[ $status -eq 2 ] && said "a link needs -stiffness or -dashpot"'
link maxwell -dashpot 1 --fit hook.txt
expect "--fit knows no velocities" '[ $status -eq 2 ] && said "law maxwell depends on the velocity, which --fit does not know"'
link bilinear -yield 1 -hardening 0 -stiffness 1 -tension-only -compression-only --protocol turns.txt
expect "a link acts in some direction" '[ $status -eq 2 ] && said "-tension-only and -compression-only cannot be combined"'
link hok
expect "an unknown law of a link is named with the nearest" '[ $status -eq 2 ] && said "unknown law of a link '"'hok'; did you mean 'hook'?"'"'
storey bilinear --fit hook.txt -period 1
expect "--fit has no -period" '[ $status -eq 2 ] && said "--fit knows no times; leave out -period"'
storey fps -weight 1MN -mu 0.1 -mu-slow 0.05 -rate 50s/m -radius 2m -stiffness 100MN/m --protocol turns.txt -period 1s --history fps.tsv
expect "a bearing slides with its velocity" 'near $(awk "NR == 33 { print \$2 - 500000 * \$1 }" fps.tsv) 1e5 0.05'
storey $bilinear --protocol turns.txt -amplitude 20mm --tsv
expect "-amplitude scales the drifts of a file" '[ "$(cut -f 3 "$out" | tail -n 3 | tr "\n" " ")" = "0.02 -0.02 0 " ]'
storey $bilinear --protocol turns.txt
expect "text has the laws, the largest values and the turns" '[ $status -eq 0 ] && grep -qx "protocol turns.txt, 3 turns" "$out" && grep -qx "bilinear -yield 600000 -hardening 0 -stiffness 6e+07" "$out" && grep -qE "^dissipated energy +N\*m +66000$" "$out" && grep -qE "^ +2 +-0.04 +-600000 +0 " "$out" && [ "$(wc -L <"$out")" -le 100 ]'
storey $bilinear --protocol turns.txt --csv
expect "--csv has commas" '[ "$(sed -n 3p "$out" | cut -d , -f 1-4)" = bilinear,1,0.04,600000 ]'
storey $bilinear --protocol turns.txt --json
if command -v python3 >/dev/null; then
    expect "--json is JSON" 'python3 -m json.tool "$out" >/dev/null && grep -q "\"law\"" "$out"'
else
    skip "--json is JSON" "no python3"
fi

storey $bilinear -amplitude 60mm --tsv
expect "without --protocol it is FEMA 461: 40 turns up to -amplitude, and back" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 43 ] && near $(cell 3 3) 0.00288 1e-12 && near $(cell 3 42) -0.06 1e-12 && [ "$(cell 3 43)" = 0 ]'
storey $bilinear -amplitude 40mm --protocol sac --tsv
expect "sac has 30 cycles" '[ "$(wc -l <"$out")" -eq 63 ] && near $(cell 3 3) 0.00375 1e-12 && near $(cell 3 14) -0.00375 1e-12 && near $(cell 3 62) -0.04 1e-12'
storey $bilinear --protocol turns.txt --compare clough,takeda --compare "flag -yield 600kN -hardening 0 -b 1" --tsv
expect "laws are compared in one table" '[ $status -eq 0 ] && [ "$(cut -f 1 "$out" | uniq | tr "\n" " ")" = "law bilinear clough takeda flag " ] && [ "$(wc -l <"$out")" -eq 17 ]'
storey $bilinear --protocol turns.txt --compare "imk -hardening 0.03 -yield 500kN -stiffness 50MN/m -cycle pinched"
expect "a law with options of its own may have its own stiffness" 'grep -qx "imk -yield 500000 -hardening 0.03 -cycle pinched -stiffness 5e+07" "$out"'
storey $bilinear --protocol turns.txt --history h.tsv
expect "--history writes the whole path" '[ $status -eq 0 ] && [ "$(head -n 1 h.tsv | cut -f 1,2)" = "$(printf "drift [m]\tshear [N]")" ] && [ "$(wc -l <h.tsv)" -eq 182 ]'

storey
expect "a law is needed" '[ $status -eq 2 ] && said "a storey law is expected"'
storey billinear
expect "an unknown law is named with the nearest" '[ $status -eq 2 ] && said "unknown storey law '"'billinear'; did you mean 'bilinear'?"'"'
storey bilinear -yield 1 -hardening 0
expect "a stiffness is needed" '[ $status -eq 2 ] && said "error: bilinear needs -stiffness: initial stiffness"'
storey $bilinear
expect "and an amplitude" '[ $status -eq 2 ] && said "protocol fema461 needs -amplitude: largest deformation of the protocol"'
storey bilinear -yield 600kN 500kN -hardening 0 -stiffness 60MN/m -amplitude 1mm
expect "one storey has one value" '[ $status -eq 2 ] && said "command line:1:27: error: -yield has one value here"'
storey takeda -yield 1 -hardening 0 -alpha 1 -stiffness 1 -amplitude 1
expect "values have their ranges" '[ $status -eq 2 ] && said "error: alpha is 1; it must be >= 0 and < 1"'
storey imk -yield 1 -hardening 0 -capping 3 -stiffness 1 -amplitude 1
expect "and must agree" '[ $status -eq 2 ] && said "command line:1:5: error: capping and post-capping must be given together"'
storey $bilinear --protocol no_such_file
expect "a protocol must exist" '[ $status -eq 2 ] && said "no_such_file: No such file or directory"'
storey $bilinear --protocol h.tsv
expect "and has one column" '[ $status -eq 2 ] && said "h.tsv:2: 6 columns; one is read, drift"'
printf 'drift [kN]\n1\n' >force.txt
storey $bilinear --protocol force.txt
expect "of lengths" '[ $status -eq 2 ] && said "force.txt:1: unit '"'kN' is not that of a length"'"'
run "$jostle" law hertz -k 1 -m1 1 -v 1 --protocol sac
expect "impacts have no protocol" '[ $status -eq 2 ] && said "--protocol is for storey laws"'
storey bilinear --fit turns.txt --protocol sac
expect "nor has a fit" '[ $status -eq 2 ] && said "--fit follows the measured loop; leave out --protocol"'

# measure LAW...: a loop of the law in the units of a test.
measure() {
    rm -f h.tsv
    storey "$@" -stiffness 60MN/m -amplitude 60mm --history h.tsv
    awk 'BEGIN { print "deformation [mm], force [kN]" }
        NR > 1 && NR % 5 == 2 { printf "%.9g, %.9g\n", 1e3 * $1, $2 / 1e3 }' h.tsv >loop.txt
}
found() {
    awk -F '\t' -v name="$1" '$2 == name { print $3 }' "$out"
}
measure bilinear -yield 600kN -hardening 0.05
storey bilinear --fit loop.txt --tsv
expect "--fit finds the stiffness and the required options" '[ $status -eq 0 ] && [ "$(cut -f 2 "$out" | tr "\n" " ")" = "parameter stiffness yield hardening normalised_error " ] && near $(found stiffness) 6e7 1e-6 && near $(found yield) 6e5 1e-6 && near $(found hardening) 0.05 1e-5'
storey bilinear -stiffness 60MN/m -hardening 0.05 --fit loop.txt --compare clough
expect "what is given is kept, and laws are compared by their fits" '[ $status -eq 0 ] && [ "$(grep -c "normalised error" "$out")" -eq 2 ] && grep -q "^bilinear -yield 600000 -hardening 0.05 -stiffness 6e+07$" "$out" && grep -q "^  yield 600000 +-" "$out"'
storey bilinear -stiffness 60MN/m -hardening 0 -yield 1 --fit loop.txt
expect "something must be left to find" '[ $status -eq 2 ] && said "all options of bilinear are given: --fit has nothing to find"'
measure trilinear -crack 200kN -yield 600kN -cracked 0.3 -hardening 0.05 -takeda
storey trilinear -takeda --fit loop.txt --tsv
expect "of three lines too" 'near $(found stiffness) 6e7 1e-4 && near $(found crack) 2e5 1e-4 && near $(found yield) 6e5 1e-4 && near $(found cracked) 0.3 1e-4'
measure imk -yield 600kN -hardening 0.05 -capping 30mm -post-capping -0.1 -gamma-s 100
storey imk -find capping post-capping gamma-s --fit loop.txt --tsv
expect "-find names more options" 'near $(found capping) 0.03 1e-3 && near $(found post-capping) -0.1 1e-3 && near $(found gamma-s) 100 1e-3'
storey imk -find cycle --fit loop.txt
expect "which are numbers of the law" '[ $status -eq 2 ] && said "imk has no number -cycle that could be found"'
measure ramberg-osgood -yield 600kN -eta 0.2 -r 7
storey ramberg-osgood --fit loop.txt
expect "what a loop does not determine is said" '[ $status -eq 0 ] && said "jostle: warning: -yield of ramberg-osgood is undetermined" && grep -q "(undetermined)" "$out"'
storey ramberg-osgood -eta 0.2 --fit loop.txt --tsv
expect "and is found if the rest is given" '[ ! -s "$err" ] && near $(found r) 7 1e-4'
printf '1 1\n2 2\n3 1\n' >short.txt
storey bilinear --fit short.txt
expect "a loop has more samples than unknowns" '[ $status -eq 2 ] && said "the loop has 3 samples; 3 parameters need 9"'

if command -v gnuplot >/dev/null; then
    storey $bilinear --protocol turns.txt --compare clough --plot loops.svg
    expect "loops are drawn" '[ $status -eq 0 ] && grep -q "drift \[mm\]" loops.svg && grep -q "shear \[kN\]" loops.svg && grep -q "clough" loops.svg && grep -q "dissipated" loops.svg'
    storey ramberg-osgood -eta 0.2 --fit loop.txt --plot fit.svg --script scripts
    expect "measurement and fit are drawn" '[ $status -eq 0 ] && grep -q measured fit.svg && [ -s scripts/loops.gp ] && [ -s scripts/loops.dat ]'
    storey $bilinear --protocol turns.txt --compare clough,takeda,clough,takeda,clough,takeda,clough --plot many.svg
    expect "a picture has a limit" '[ $status -eq 2 ] && said "a picture shows at most 7 laws, not 8"'
else
    skip "loops are drawn" "gnuplot is not installed"
fi
