#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The same deck gives the same numbers, bit for bit, from run to run and from folder to folder, and
# however often rows are written.
. tests/support/cli.sh

# Bodies that rattle to rest between each other, of more floors than go through a step at once.
cat >rattle.deck <<'DECK'
param every 1
building B0 -floors 4 -mass 52670.4 -stiffness 3.08664e+07
building B1 -floors 12 -mass 925409 -stiffness 5.83488e+08
damping B1 rayleigh 0.03
building B2 -floors 14 -mass 750985 -stiffness 9.63048e+08
building B3 -floors 2 -mass 263047 -stiffness 3.33453e+08
damping B3 rayleigh 0.03
building B4 -floors 7 -mass 91988.9 -stiffness 2.63778e+08
building B5 -floors 4 -mass 774003 -stiffness 9.44728e+08
damping B5 rayleigh 0.03
contact B0 B1 -gap 0.00018439 -law kelvin-voigt -k 7.8095e+07 -e 0.171
contact B1 B2 -gap 0.00025616 -law kelvin-voigt -k 7.2401e+08 -e 0.887
contact B2 B3 -gap 0.00011341 -law kelvin-voigt -k 3.9282e+08 -e 0.321
contact B3 B4 -gap 0 -law stereomechanical -e 0.0221
contact B4 B5 -gap 0.00024239 -law stereomechanical -e 0.606
contact wall B0 -gap 5.4491e-05 -law kelvin-voigt -k 8.5393e+08 -e 0.307
ground sine -amplitude 4.39 -frequency 2.66 -cycles 0.943
step fixed 0.003068
integrator newmark -beta 0.1666667 -gamma 0.5
duration 1.2323
output -every $every
DECK
for every in 1 7 100000; do
    run "$jostle" run -q rattle.deck -D every=$every -o $every.h5
    run "$jostle" show --tsv $every.h5
    grep -v -e residual_peak -e wall_seconds "$out" >$every.tsv
done
expect "how often rows are written changes no result" \
    '[ "$(wc -l <1.tsv)" -gt 1000 ] && cmp 1.tsv 7.tsv && cmp 1.tsv 100000.tsv'

if ! command -v h5diff >/dev/null; then
    skip "two runs give the same numbers" "no h5diff"
    exit 0
fi
two_buildings pair.deck 'storey A:1 bilinear -yield 200kN -hardening 0.02' \
    'link A:2 B:2 -dashpot 50 -exponent 0.5' 'duration 6'
mkdir -p other/folder
cp pair.deck other/folder/

run "$jostle" run -q pair.deck -o one.h5
run "$jostle" run -q pair.deck -o two.h5
expect "two runs give the same numbers" 'same one.h5 two.h5'
cd other/folder || exit 1
run "$jostle" run -q pair.deck -j 2 -o "$here/three.h5"
cd "$here" || exit 1
expect "another folder and -j 2 change nothing" 'same one.h5 three.h5'
run "$jostle" run -q pair.deck -D gap=5.001mm -o four.h5
expect "another gap gives other numbers" '! same one.h5 four.h5'
