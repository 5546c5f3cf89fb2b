#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Contacts at levels between two floors, from the deck to tables, studies, parts and pictures.
. tests/support/cli.sh

deck() {
    cat <<DECK
units kN m s
param z 6.8m
param gap 5mm
building A -floors 3 -mass 100t -stiffness 80MN/m -height 3m
building B -floors 2 -mass 300t -stiffness 200MN/m -height 4m 4.5m
contact A:2 B@\$z -gap \$gap -law linear -k 1e6 $1
contact A:1 wall -gap 80mm -law linear -k 1e6
link A:0 A:1 -dashpot 100
initial A:1:3 -velocity 1
step fixed 1ms
duration 0.5
DECK
}

deck '' >one.deck
run "$jostle" run one.deck
expect "the table of contacts names the level" '[ $status -eq 0 ] && grep -q -- "^A:2-B@6.8m " "$out"'
expect "floors above and below a level that was hit have a mark" '[ "$(grep -c "[0-9]\*  *2 " "$out")" -eq 2 ]'
run "$jostle" show one.h5 --json
expect "a file says the level and the weight of the floor above" 'grep -q -- "\"right_floor\": 2" "$out" && grep -q -- "\"right_below\": 1" "$out" && grep -q -- "\"right_level\": 6.8" "$out" && grep -q -- "\"right_weight\": 0.6222" "$out" && grep -q -- "\"left_level\": null" "$out"'
expect "a link within a building has the same building on both sides" 'tr -d "\n" <"$out" | grep -q "\"A:0-A:1\",\"left\": \"A\",\"right\": \"A\",.*\"left_floor\": 0,\"right_floor\": 1,"'
run "$jostle" plot one.h5 histories -o one.svg
expect "a picture names the level" '[ $status -eq 0 ] && grep -q "level 6.8 m" one.svg'
run "$jostle" converge one.deck -n 3
expect "steps are halved" 'grep -q -- "A:2-B@6.8m" "$out"'

{
    deck '-name c'
    echo 'sweep z values 5m 6.8m 8m'
} >study.deck
run "$jostle" run study.deck -q
expect "a level can be swept within its storey" '[ $status -eq 0 ]'
run "$jostle" show study.h5 --long --edp force:c
expect "its demands have the name" '[ $status -eq 0 ] && [ "$(grep -c "force" "$out")" -ge 3 ]'
run "$jostle" show study.h5 --tsv
expect "floors above and below a level have a mark in studies" '[ "$(grep -c "B.acceleration.[12].*m/s^2.1$" "$out")" -eq 6 ]'
run "$jostle" verify study.h5 --rerun 3
expect "runs alone have the bits of those of the study" '[ $status -eq 0 ]'
for part in 1 2; do
    run "$jostle" run study.deck --shard $part/2 -o part$part.h5 -q
done
run "$jostle" merge part1.h5 part2.h5 -o whole.h5
expect "parts are merged" '[ $status -eq 0 ]'
"$jostle" show study.h5 --tsv >want
run "$jostle" show whole.h5 --tsv
expect "and have the levels" '[ -s want ] && cmp -s want "$out"'

run "$jostle" run study.deck -D z=4m -o floor.h5 -q
expect "at a floor the study is one analysis" '[ $status -eq 0 ]'
sed 's/^sweep.*/sweep z values 6.8m 8.5m/' study.deck >floors.deck
run "$jostle" run floors.deck
expect "a sweep from a level to a floor is refused" '[ $status -eq 2 ] && said "contacts and links"'

{
    deck '-name c'
    echo 'sweep gap range 0mm 40mm 9'
} >gap.deck
run "$jostle" gap gap.deck
expect "gap estimates the closing of a level" '[ $status -eq 0 ] && grep -q -- "^c " "$out"'
