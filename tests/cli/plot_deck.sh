#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The picture of a model before it runs: what the deck says is at its level, and its numbers stand
# below it. All examples and many kinds of models are drawn without a word of gnuplot.
. tests/support/cli.sh

# levels NAME: the second column of a block, without blanks between.
levels() {
    sed -n "/^\$$1 <</,/^EOD/p" drawn/deck.dat | awk '/^[-0-9]/ { printf "%s%s", n++ ? " " : "", $2 }'
}

# texts: all texts of the picture, a line each.
texts() {
    sed -n "s/^set label '\(.*\)' at .*/\1/p" drawn/deck.gp
}

# drawn DECK WORD...: writes the script of its picture.
drawn() {
    run "$jostle" plot deck "$@" --script drawn --force
}

cat >all.deck <<'END'
title "It's `date` \\ % { } @a_b^c & <b> ©"
units kN m s
param gap 20mm
building low -floors 2 -mass 100t -stiffness 50MN/m -height 3.4m
building a_very_long_name_of_a_building_that_cannot_fit_anywhere -floors 5 -mass 200t -height 4m 4*3m
frame a_very_long_name_of_a_building_that_cannot_fit_anywhere -bays 6m 3m -modulus 30GPa
columns a_very_long_name_of_a_building_that_cannot_fit_anywhere:1:5 -I 0.01
beams a_very_long_name_of_a_building_that_cannot_fit_anywhere:1:5 -I 0.01
building F -floors 4 -mass 100t -stiffness 90MN/m -height 3m
building W -floors 2 -mass 10t -height 2*3m
wall W:1:2 -EI 1e7
base W pinned
building body -floors 1 -mass 10t -stiffness 0 -height 5m
storey F:1:2 bilinear -yield 900 -hardening 0.05
storey W:1 elastic -stiffness 1e4
foundation F -mass 100t -inertia 500t*m2 -sway 1e6 -rocking 1e8
column a_very_long_name_of_a_building_that_cannot_fit_anywhere@6.8m -name c1 -EI 9e4 -mass 1t
contact wall low -gap 10mm -law linear -k 1e6
contact low:2 a_very_long_name_of_a_building_that_cannot_fit_anywhere@6.8m -gap $gap -law linear -k 1e6
contact low:1 a_very_long_name_of_a_building_that_cannot_fit_anywhere@3.4m -gap 30mm -law linear -k 1e6 -name k1
contact low:1 a_very_long_name_of_a_building_that_cannot_fit_anywhere@3.4m -gap 50mm -law linear -k 2e6 -name k2
link a_very_long_name_of_a_building_that_cannot_fit_anywhere:3 F:3 -dashpot 100
link F:0 F:2 -dashpot 100
contact W body:1 -gap 1mm -law linear -k 2e6
contact body:1 wall -gap 5mm -law linear -k 2e6
ground sine -amplitude 0.2g -frequency 2 -cycles 3
step fixed 1ms
END
sed -i 's/^storey W.*//; s/^contact W body:1/contact W:2 body:1/' all.deck
drawn all.deck
expect "a deck with everything is drawn" '[ $status -eq 0 ]'
expect "contacts are at the levels of both ends, one above another where two are equal" '[ "$(levels contacts | cut -d " " -f 1-8)" = "3.4 3.4 6.8 6.8 6.8 6.8 3.4 3.4" ] && [ "$(levels contacts | cut -d " " -f 10)" = "$(levels contacts | cut -d " " -f 9)" ] && awk "BEGIN { exit !($(levels contacts | cut -d " " -f 9) > 3.4) }"'
expect "links join their floors, also within a building" '[ "$(levels links)" = "10 9 0 6" ]'
expect "a struck column stands between its floors" '[ "$(levels struck)" = "4 7" ]'
expect "storeys that yield are filled" '[ "$(levels yielding)" = "0 0 3 3 3 3 6 6" ]'
expect "each floor is a line" '[ "$(levels floors)" = "3.4 3.4 6.8 6.8 4 4 7 7 10 10 13 13 16 16 3 3 6 6 9 9 12 12 3 3 6 6" ]'
expect "frames have columns and beams, walls their storeys" '[ "$(levels frames | wc -w)" -eq 50 ] && [ "$(levels walls)" = "0 3 3 6" ]'
expect "bases are marked" '[ "$(levels fixed)" = "0 0 0" ] && [ "$(levels pinned)" = 0 ]'
expect "a free body is at its level" '[ "$(levels bodies | awk "{ print (\$1 + \$3) / 2 }")" = 5 ]'
expect "rigid walls reach above their contacts" 'awk "BEGIN { exit !($(levels rigid | cut -d " " -f 3) > 6.8 && $(levels rigid | cut -d " " -f 7) > 5) }"'
expect "gaps, heights and masses stand below" 'texts >list && grep -qx "0.02 to 0.05" list && grep -qx "0.01" list && grep -qx "4, 4 × 3" list && grep -qx 1000 list && grep -qx "gap \[m\]" list && grep -qx free list'
expect "and the numbers of things above" 'grep -qx "5 buildings, 7 contacts, 2 links, 1 struck column; heights are to scale, widths and gaps are not" list'
expect "a long name is shortened" 'grep -q "^a_ver.*…" list'
expect "a title is shown as it is, and gnuplot executes nothing" 'grep -q "^set label .It.047s .140date.140 " drawn/deck.gp && ! grep -q "\`" drawn/deck.gp'
sed 's/^contact W:2 body:1 .*/contact F:4 body:1 -gap 7mm -law linear -k 1e6/' all.deck >beyond.deck
drawn beyond.deck
expect "a contact beyond a neighbour has its gap beside it" '[ $status -eq 0 ] && texts | grep -qx 0.007 && [ "$(levels contacts | cut -d " " -f 11-12)" = "12 5" ]'
cat >hinges.deck <<'END'
units kN m s
building A -floors 1 -mass 10t -height 4m
frame A -bays 6m -modulus 30GPa -columns-inextensible
columns A:1 -I 0.01
beams A:1 -I 0.01
hinges A:1 beams bilinear -yield 10kN*m -hardening 1% -stiffness 10MN*m
hinges A bases bilinear -yield 10kN*m -hardening 1% -stiffness 10MN*m
initial A:1 -displacement 1mm
duration 1
step fixed 1ms
END
drawn hinges.deck
expect "hinges are beside the ends of members" '[ $status -eq 0 ] && [ "$(levels hinges)" = "0.48 0.48 4 4" ]'
drawn all.deck -D gap=70mm
expect "-D replaces a parameter" '[ $status -eq 0 ] && texts | grep -qx "0.03 to 0.07"'

printf 'units kN m s\n' >ten.deck
for i in $(seq 10); do
    echo "building tower_$i -floors $((5 * i)) -mass 100t -stiffness 500MN/m -height 3m"
    [ "$i" -eq 1 ] || echo "contact tower_$((i - 1)) tower_$i -gap ${i}mm -law linear -k 1e6"
done >>ten.deck
sed 's/ -height 3m//; s/^building tower_10 .*/& -height 3m/' ten.deck >bare.deck
for i in $(seq 30); do
    echo "building B$i -floors 1 -mass 100 -stiffness 5e5"
    [ "$i" -eq 1 ] || echo "contact B$((i - 1)) B$i -gap 0.01234 -law linear -k 1e6"
done >thirty.deck
printf 'building A -floors 1 -mass 1 -stiffness 0\n' >one.deck
for deck in ten bare thirty one; do
    printf 'step fixed 1ms\nduration 1\n' >>$deck.deck
done
drawn thirty.deck
expect "of many buildings the first are drawn, and the picture says so" '[ $status -eq 0 ] && texts | grep -qx "30 buildings, 29 contacts; the first 16 buildings are drawn" && [ "$(levels contacts | wc -w)" -eq 30 ]'
drawn bare.deck
expect "without all heights storeys are equal, and the picture says so" '[ $status -eq 0 ] && texts | grep -q "not all storeys have heights" && [ "$(levels contacts | cut -d " " -f 1-4)" = "1 1 2 2" ]'
drawn ten.deck
expect "each gap has its size" '[ "$(texts | grep -cx "0.00[2-9]\|0.01")" -eq 9 ]'

run "$jostle" plot deck
expect "without a deck it says what it takes" '[ $status -eq 2 ] && said "plot deck DECK"'
run "$jostle" plot deck nothing.deck
expect "a deck that is not there is named" '[ $status -eq 2 ] && said "nothing.deck"'
run "$jostle" plot deck all.deck --compare x.h5
expect "--compare is for results" '[ $status -eq 2 ] && said "--compare is for results; all.deck is a deck"'
run "$jostle" plot deck all.deck --edp drift
expect "so is --edp" '[ $status -eq 2 ] && said "--edp is for results"'
run "$jostle" plot x.h5 -D gap=1
expect "-D is for decks" '[ $status -eq 2 ] && said "-D is for decks"'
sed -i 's/^column.*/column nowhere/' one.deck
echo 'column nowhere' >>one.deck
run "$jostle" plot deck one.deck
expect "the errors of a deck are told" '[ $status -eq 2 ] && said "one.deck:4:" && [ ! -e one-deck.png ]'
sed -i '$d' one.deck

if ! command -v gnuplot >/dev/null; then
    skip "pictures" "no gnuplot"
    exit
fi
for deck in all ten bare thirty one "$root"/input/{collapse,dampers,frame_wall,free_bodies,levels,row_of_five,wall}; do
    drawn "$deck.deck"
    (cd drawn && gnuplot deck.gp) >words 2>&1
    expect "gnuplot draws $(basename "$deck") without a word" '[ $status -eq 0 ] && [ ! -s words ] && [ "$(wc -c <drawn/deck.png)" -gt 6000 ]'
done
for ending in png svg pdf; do
    run "$jostle" plot deck all.deck -o all.$ending
    expect "it is drawn as $ending" '[ $status -eq 0 ] && [ "$(cat "$out")" = all.$ending ] && [ "$(wc -c <all.$ending)" -gt 6000 ]'
done
run "$jostle" plot deck all.deck
expect "without -o it has the name of the deck" '[ $status -eq 0 ] && [ -s all-deck.png ]'
