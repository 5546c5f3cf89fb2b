#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What jostle check and jostle modes print of a model.
. tests/support/cli.sh

cat >model.deck <<'END'
title "everything at once"
units kN m s
building Tower -floors 8 -mass 300t -stiffness 7*345MN/m 250MN/m -height 3.2m
building Annex -floors 2 -mass 150t 100t -stiffness 90MN/m
building Ship -floors 1 -mass 1000t -stiffness 0
damping Tower rayleigh 5% -modes 1 3
damping Annex modal 3%
storey Tower:2:3 bilinear -yield 4MN -hardening 0.02
contact Tower Annex -gap 20mm 30mm -law hertz -k 2e6
contact Annex:2 Ship:1 -gap 1 -law linear -k 5 -name fender
link Tower:1 Annex:1 -dashpot 100
ground sine -amplitude 0.2g -frequency 1 -delay 1 -cycles 2 -buildings Tower Annex
load Annex:2 constant -7
step fixed 0.5ms
END
run "$jostle" check model.deck
expect "check ends with 0, writes nothing and warns about two soft contacts" '[ $status -eq 0 ] && [ "$(grep -c warning: "$err")" -eq 2 ] && [ "$(grep -c "times as stiff as the stiffest storey" "$err")" -eq 2 ] && only model.deck'
has() {
    expect "check prints $1" 'grep -qE "$pattern" "$out"'
}
pattern='^everything at once$' has "the title"
pattern='^units kN m s, mass in t$' has "the units"
pattern='^building Tower: 8 floors, mass 2400 t$' has "the mass of a building"
pattern='mode 1: period [0-9.]+ s, damping 5 %$' has "periods and damping ratios"
pattern='mode 2: period [0-9.]+ s, damping 3 %$' has "the ratio of modal damping"
pattern='mode 1: rigid body$' has "a free body as such"
pattern='^ +2:3 +300 +345000 +3\.2  bilinear$' has "equal storeys in one line"
pattern='^ +8 +300 +250000 +3\.2  elastic$' has "a storey of its own"
pattern='^Tower:2-Annex:2 +0\.03 +75  hertz$' has "gap, effective mass and law of a contact"
pattern='^fender +1 +90\.9091  linear$' has "a contact by its name"
pattern='^Tower:1-Annex:1 to Tower:2-Annex:2: hertz -k 2e\+06 -n 1\.5$' has "the law's parameters"
pattern='^Tower:1-Annex:1 +- +100  viscous$' has "a link, which has no gap"
pattern='^ground under Tower Annex:$' has "the buildings on one ground"
pattern='sine: peak 1\.961 m/s\^2 = 0\.2 g, from 1 to 3 s$' has "a ground motion"
pattern='^ground under Ship: at rest$' has "a ground at rest"
pattern='^load on Annex:2: constant, peak 7 kN$' has "a load on its floor"
pattern='6000 steps of 0\.0005 s, duration 3 s$' has "the steps"
pattern='every 20 steps, 301 rows$' has "the rows of output"
pattern='^Tower:1-Annex:1 +[0-9.]+ +[0-9.]+ +[0-9.]+' has "how long a contact lasts"
pattern='^  the shortest period +[0-9.]+ s, [0-9.]+ steps; over 20: [0-9.]+ s$' has "what the shortest period asks for"
pattern="^so 'step fixed (0\.0*[125])' does; here it is 0\.0005 s$" has "the step that resolves all"
expect "no line is wider than 100 characters" '! grep -qE "^.{101,}" "$out"'
run "$jostle" check -D gap=1 model.deck
expect "a -D without its param is an error" '[ $status -eq 2 ] && said "unknown parameter '"'gap'"'" && [ ! -s "$out" ]'

run "$jostle" modes model.deck
expect "modes ends with 0 and writes nothing" '[ $status -eq 0 ] && [ ! -s "$err" ] && only model.deck'
expect "modes prints every mode of every building" '[ "$(grep -cE "^ +[1-8] +([0-9.]+|rigid body) +[0-9.]+ +[0-9.]+ " "$out")" -ge 11 ]'
expect "modes prints a free body as such" 'grep -q "rigid body" "$out" && ! grep -qiE "inf|nan" "$out"'
expect "shapes are scaled to 1" '[ "$(grep -c " 1.00000" "$out")" -ge 3 ]'

# 25 t and 40 t under 93.5 MN/m touch for 40.3 ms: nine steps of 4.48 ms, ten of 4.02 ms.
bodies() {
    cat >"$1" <<END
building A -floors 1 -mass 25t -stiffness 0
building B -floors 1 -mass 40t -stiffness 0
initial A:1 -velocity 0.5
contact A B -gap 5mm -law $2
duration 0.1
step fixed $3
END
}
bodies coarse.deck "linear -k 93.5MN/m" 4.48ms
run "$jostle" check coarse.deck
expect "check warns of a step that cuts a contact" '[ $status -eq 0 ] && said "coarse.deck:6:1: warning: step 0.00448 s covers contact A:1-B:1, which lasts about 0.04 s at 0.5 m/s, by 9 steps; fewer than 10 are rejected; step fixed 0.0005 resolves it"'
run "$jostle" run coarse.deck
expect "so does run" '[ $status -eq 0 ] && said "coarse.deck:6:1: warning: step 0.00448 s covers contact"'
run "$jostle" run -q --force coarse.deck
expect "but not with -q" '[ $status -eq 0 ] && [ ! -s "$err" ]'
# The stiffest storey beside the contacts has 300 MN/m.
soft() {
    cat >soft.deck <<END
units kN m s
building A -floors 3 -mass 300t -stiffness 300MN/m 2*200MN/m
building B -floors 3 -mass 300t -stiffness 100MN/m
contact A B -gap 20mm -law $1
contact A:3 wall -gap 20mm -law stereomechanical -e 0.5
initial A -velocity 1
duration 0.1
step fixed 0.1ms
END
}
soft "linear -k 1500MN/m"
run "$jostle" check soft.deck
expect "check warns about a soft contact, once for its worst level" '[ $status -eq 0 ] && [ "$(grep -c warning: "$err")" -eq 1 ] && said "soft.deck:4:9: warning: contact A:1-B:1 is only 5 times as stiff as the stiffest storey beside it; below 10 drifts depend on the stiffness of the contact: compare with stiffer ones; a bumper has law rubber or table"'
run "$jostle" run soft.deck
expect "run does not" '[ $status -eq 0 ] && [ ! -s "$err" ]'
for law in "linear -k 3001MN/m" "rubber -k 100MN/m^2.5 -n 2.5 -e 0.5"; do
    soft "$law"
    run "$jostle" check soft.deck
    expect "contact $law is stiff enough, or a bumper" '[ $status -eq 0 ] && [ ! -s "$err" ]'
done
bodies fine.deck "linear -k 93.5MN/m" 4.02ms
run "$jostle" check fine.deck
expect "ten steps are not warned of" '[ $status -eq 0 ] && [ ! -s "$err" ]'
for step in "fixed 1ms" adaptive; do
    bodies hard.deck "linear -k 5e20" 1ms
    sed -i "s/^step.*/step $step/" hard.deck
    run "$jostle" check hard.deck
    expect "a contact harder than any is warned of once, step $step" '[ $status -eq 0 ] && [ "$(grep -c warning: "$err")" -eq 1 ] && said "hard.deck:4:9: warning: contact A:1-B:1 lasts about 1.7e-08 s, shorter than any contact of bodies; is its stiffness in the units of the deck?"'
    bodies soft.deck "linear -k 1kN/m" 1ms
    sed -i "s/^step.*/step $step/" soft.deck
    run "$jostle" check soft.deck
    expect "and one softer than any, step $step" '[ $status -eq 0 ] && [ "$(grep -c warning: "$err")" -eq 1 ] && said "soft.deck:4:9: warning: contact A:1-B:1 gives way by about 2 m at 0.5 m/s; is its stiffness in the units of the deck?"'
    bodies stuck.deck "kelvin-voigt -k 93.5MN/m -zeta 1.4" 1ms
    sed -i "s/^step.*/step $step/" stuck.deck
    run "$jostle" check stuck.deck
    expect "and one that never ends, step $step" '[ $status -eq 0 ] && [ "$(grep -c warning: "$err")" -eq 1 ] && said "stuck.deck:4:9: warning: contact A:1-B:1 does not part bodies that meet at 0.5 m/s: its damping is so strong that they stick"'
done
bodies rigid.deck "stereomechanical -e 0.5" 1ms
run "$jostle" check rigid.deck
expect "a rigid contact has no duration" '[ $status -eq 0 ] && grep -qE "^A:1-B:1 +0\.5 +- +-$" "$out" && ! grep -q "must resolve" "$out"'
two_buildings idle.deck 'param c 0' 'link A:1 B:1 -dashpot $c'
run "$jostle" check idle.deck
expect "a link without stiffness and damping is warned of" '[ $status -eq 0 ] && said "idle.deck:12:1: warning: this link does nothing: its values are 0"'
run "$jostle" check idle.deck -D c=1kN*s/m
expect "one that does something is not" '[ $status -eq 0 ] && ! said "does nothing"'

printf '%s\n' 100 110 80 130 100 >offset.txt
two_buildings offset.deck 'ground record offset.txt -dt 10ms -unit gal -demean -scale 2'
run "$jostle" check offset.deck
expect "check says what -demean subtracts" '[ $status -eq 0 ] && grep -q "offset.txt: peak 0.52 m/s^2" "$out" && grep -q "a mean of 2.08 m/s^2 was subtracted" "$out"'

cp "$root/tests/records/good/cwa.dat" .
two_buildings channel.deck 'ground record cwa.dat -channel 3'
run "$jostle" check channel.deck
expect "a channel of a file is read" '[ $status -eq 0 ] && grep -q "cwa.dat: peak 0.8999 m/s^2" "$out"'
two_buildings channel.deck 'ground record cwa.dat -channel 4'
run "$jostle" check channel.deck
expect "the caret of a wrong channel is below it" '[ $status -eq 2 ] && said "channel.deck:11:32: error" && said "the file has no channel 4"'

{
    cat idle.deck
    awk 'BEGIN { for (i = 0; i < 600000; i++) printf "param p%d %d\n", i, i }'
} >parameters.deck
run timeout 30 "$jostle" check parameters.deck -D c=1kN*s/m
expect "hundred thousands of parameters are found as fast as a few" '[ $status -eq 0 ] && said "the deck does not use parameter"'
rm parameters.deck
