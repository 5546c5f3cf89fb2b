#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A stack of 64 kB is enough for every command, and for the threads of studies.
. tests/support/cli.sh

if [ -n "${JOSTLE_SANITIZED-}" ]; then
    skip "a stack of 64 kB is enough" "the sanitizers need more"
    exit
fi
two_buildings pair.deck
sed 's/^param gap .*/sweep gap range 5mm 30mm 40/' pair.deck >study.deck
# High buildings of one height are solved together; bodies that rest on each other in a row, too.
for i in 1 2 3; do
    echo "building T$i -floors 300 -mass 1 -stiffness 1e6"
done >tall.deck
for i in 1 2; do
    echo "contact T$i T$((i + 1)) -gap 0.01 -law linear -k 1e6"
done >>tall.deck
printf '%s\n' 'initial T1:all -velocity 1' 'step fixed 1e-4' 'duration 0.05' >>tall.deck
for i in $(seq 60); do
    echo "building B$i -floors 1 -mass 1 -stiffness 100"
done >row.deck
for i in $(seq 59); do
    echo "contact B$i B$((i + 1)) -gap 0 -law stereomechanical -e 0"
done >>row.deck
printf '%s\n' 'initial B1:1 -velocity 1' 'step fixed 1e-3' 'duration 0.2' >>row.deck
record=$root/input/records/ELCENTRO_1940_NS.AT2

while read -r words; do
    # shellcheck disable=SC2086
    run limited -s 64 "$jostle" $words
    expect "a stack of 64 kB is enough: ${words//$root\//}" '[ $status -eq 0 ]'
done <<END
check pair.deck
run pair.deck -o pair.h5
show pair.h5
run study.deck -o study.h5 -j 4
show study.h5
run study.deck -o part.1.h5 --shard 1/2
run study.deck -o part.2.h5 --shard 2/2
merge part.1.h5 part.2.h5 -o whole.h5
run tall.deck -q
run row.deck -q
modes tall.deck
plot pair.h5 overview --script script
plot pair.h5 contact --script script
plot pair.h5 modes --script script
plot study.h5 response --script script
law hertz-damp -k 1e6 -m1 1 -v 1 -e 0.5
law hertz-damp -k 1e6 -m1 1 -v 1 -e 0.5 --compare ye-hertz-damp --script script
law hertz -k 1e6 -m1 1 -v 1 --history h.tsv
spectrum $record
spectrum $record --script script
gap pair.deck
tasks study.deck
laws
deck
END
for deck in "$root"/input/*.deck; do
    name=$(basename "$deck")
    run limited -s 64 "$jostle" run -q "$deck" -o example.h5 --force
    expect "a stack of 64 kB is enough to run $name" '[ $status -eq 0 ]'
done
