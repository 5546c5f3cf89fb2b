#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every kind of picture in every format, of runs with impacts, without, against a wall, with links, of
# two grounds, and of two runs; what cannot be drawn says why.
. tests/support/cli.sh

two_buildings pair.deck 'ground sine -amplitude 0.2g -frequency 2 -buildings B'
sed -i 's/-cycles 4$/-cycles 4 -buildings A/' pair.deck
two_buildings bilateral.deck 'link A B -dashpot 100 -stiffness 1000' 'output -precision single'
two_buildings few.deck 'output -fields velocity'
two_buildings taller.deck
sed -i 's/B -floors 3/B -floors 4/' taller.deck
two_buildings free.deck
sed -i '/^contact/d; /^param/d' free.deck
name=the_very_long_name_of_a_building_that_cannot_fit_anywhere
cat >wall.deck <<END
title "It's a title with quotes and \$ % & { } that is too long to fit above any of the pictures"
building $name -floors 1 -mass 1 -stiffness 100
contact wall $name -gap 0.01 -law linear -k 1000
ground sine -amplitude 2 -frequency 1.5 -cycles 3
step fixed 5ms
END
two_buildings rigid.deck
sed -i 's/-law jankowski -k 1e6 -e 0.65/-law stereomechanical -e 0.65/' rigid.deck
for deck in pair bilateral few taller free wall rigid; do
    run "$jostle" run -q $deck.deck
    expect "$deck.deck runs" '[ $status -eq 0 ]'
done
run "$jostle" run -q pair.deck -D gap=1m -o apart.h5
run "$jostle" run -q pair.deck -D gap=8mm -o wider.h5
expect "the runs to compare are there" '[ -s apart.h5 ] && [ -s wider.h5 ]'
kinds=$("$jostle" plot --help | sed -n '/^KIND/,/^$/ s/^  \([a-z]*\) .*/\1/p' | grep -v members)
expect "help names the kinds" '[ "$(echo "$kinds" | wc -l)" -ge 9 ]'

# What gnuplot says to the script of this kind in the folder `scripts`: nothing at all.
silent() {
    (cd scripts && gnuplot "$1.gp") >said 2>&1
    [ ! -s said ] && [ -s "scripts/$1.png" ]
}

# A picture of one colour is empty. PNG packs it: less than 1 byte in 200 of its pixels.
drawn() {
    [ "$(wc -c <"$1")" -gt 12000 ]
}

# drawable FILE OPTION...: each kind makes a script to which gnuplot says nothing. The map of a street
# shows one run.
drawable() {
    local kind
    for kind in $kinds; do
        [ "$kind" = street ] && [ $# -gt 1 ] && continue
        rm -rf scripts
        run "$jostle" plot "$@" "$kind" --script scripts
        expect "$kind of $* is written" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ -s scripts/$kind.gp ] && [ -s scripts/$kind.dat ]'
        expect "gnuplot draws $kind of $* without a word" 'silent $kind && drawn scripts/$kind.png'
    done
}

mkdir none
run env PATH="$here/none" "$jostle" plot pair.h5 energy -o energy.png --script scripts
expect "without gnuplot the script is still written" '[ $status -eq 3 ] && said "not installed" && [ -s scripts/energy.gp ] && [ ! -e energy.png ]'

touch none/gnuplot
run env PATH="$here/none" "$jostle" plot pair.h5 energy -o energy.png
expect "a gnuplot that may not be run is named as the cause" '[ $status -eq 3 ] && said "gnuplot failed: error: it cannot be started: Permission denied" && [ ! -e energy.png ]'
mkdir slow slow/tmp
printf '#!/bin/sh\necho started\nexec sleep 60\n' >slow/gnuplot
chmod +x slow/gnuplot
for signal in INT TERM HUP; do
    TMPDIR=$here/slow/tmp PATH=$here/slow:$PATH env --default-signal=INT "$jostle" plot pair.h5 energy -o energy.png >"$out" 2>"$err" &
    child=$!
    for _ in $(seq 100); do
        grep -qs started slow/tmp/*/messages && break
        sleep 0.05
    done
    began=$SECONDS
    kill -s "$signal" $child
    wait $child
    status=$?
    expect "SIG$signal ends gnuplot and leaves no folder behind" '[ $status -eq 3 ] && [ $((SECONDS - began)) -lt 40 ] && said "interrupted by signal" && [ -z "$(ls slow/tmp)" ] && [ ! -e energy.png ]'
done
rm -r none slow

if ! command -v gnuplot >/dev/null; then
    skip "pictures" "no gnuplot"
    exit
fi
drawable pair.h5
drawable wall.h5
drawable bilateral.h5
drawable apart.h5
drawable rigid.h5
expect "rigid impacts have no force to tell" '[ $status -eq 0 ] && ! grep -qi "nan k" scripts/*.gp'
drawable rigid.h5 --compare pair.h5
drawable pair.h5 --compare rigid.h5
expect "nor beside others" '[ $status -eq 0 ] && ! grep -qi "nan k" scripts/*.gp'
run "$jostle" plot rigid.h5 impacts --compare pair.h5 --script scripts
expect "beside others they are shown by their impulses" '[ $status -eq 0 ] && [ "$(sed -n "/^\$impacts0/,/^EOD/p" scripts/impacts.dat | grep -ci nan)" -eq 1 ] && grep -q "kN·s" scripts/impacts.gp'
drawable pair.h5 --compare wider.h5
drawable pair.h5 --compare apart.h5
drawable apart.h5 --compare pair.h5

for kind in $kinds; do
    for ending in png svg pdf; do
        run "$jostle" plot pair.h5 $kind -o $kind.$ending
        expect "$kind is drawn as $ending" '[ $status -eq 0 ] && [ "$(cat "$out")" = $kind.$ending ] && [ "$(wc -c <$kind.$ending)" -gt 8000 ]'
    done
    expect "$kind.pdf is PDF, the others what they say" 'head -c 5 $kind.pdf | grep -q "^%PDF" && grep -q "<svg" $kind.svg && head -c 4 $kind.png | grep -q PNG'
    rm -f $kind.*
done

# Script and data: they belong together, and stand where they are put.
two_buildings mixed.deck 'link A:1 B:1 -dashpot 10kN*s/m'
sed -i 's/-cycles 4$/-cycles 4 -buildings A/; s/1e6 -e/1e9 -e/' mixed.deck
run "$jostle" run -q mixed.deck
rm -rf scripts
run "$jostle" plot mixed.h5 contact --script scripts
expect "small link forces beside large contact forces are in the unit of their common axis" '[ $status -eq 0 ] && grep -q "force \[10³ kN\]" scripts/contact.gp && [ "$(grep -c "^set ytics (" scripts/contact.gp)" -ge 3 ] && ! grep -q "^set ytics [0-9]" scripts/contact.gp'

rm -rf scripts
run "$jostle" plot mixed.h5 loops --script scripts
expect "forces of one picture are in one unit" '[ $status -eq 0 ] && [ "$(grep -c "^set label .contact force \[10³ kN\]" scripts/loops.gp)" -eq 1 ] && [ "$(grep -c "^set label .storey shear \[10³ kN\]" scripts/loops.gp)" -eq 2 ]'

# A link that yields between two buildings that do not meet.
cat >linked.deck <<'END'
units kN m s
building A -floors 2 -mass 100t -stiffness 50MN/m
building B -floors 2 -mass 100t -stiffness 90MN/m
ground sine -amplitude 3m/s^2 -frequency 1.5Hz -cycles 4
link A:1 B:1 -law bilinear -stiffness 20MN/m -yield 30kN -hardening 0.05
step fixed 1ms
duration 3
END
run "$jostle" run -q linked.deck
"$jostle" show linked.h5 --tsv >linked.tsv
run "$jostle" plot linked.h5 loops --script linked
awk -F '\t' '$1 == "links" && $3 == "force" { print $5 }' linked.tsv >most
awk 'NR == FNR { want = $1; next } /^.storey02/ { inside = 1 } /^EOD/ { inside = 0 } inside && /^[0-9]/ { size = $3 < 0 ? -$3 : $3; most = size > most ? size : most } END { exit !(most > 0.95 * want && most < 1.001 * want) }' most linked/loops.dat
same=$?
expect "a link has its loop beside those of storeys" '[ $status -eq 0 ] && [ $same -eq 0 ] && [ "$(grep -c "^plot" linked/loops.gp)" -eq 3 ] && grep -q "^set label .link force" linked/loops.gp'

# A single impact, which lasts beyond the end; the ground is at rest.
cat >closed.deck <<'END'
building A -floors 1 -mass 25t -stiffness 0
building B -floors 1 -mass 40t -stiffness 0
initial A:1 -velocity 1
contact A B -gap 0.5005mm -law hertz -k 2e10
step fixed 0.01ms
duration 2ms
output -every 1
END
run "$jostle" run -q closed.deck
run "$jostle" plot closed.h5 contact --script closed
expect "a force that is still there at the end does not fall to 0" '[ $status -eq 0 ] && [ "$(sed -n "/^.pulse0/,/^EOD/p" closed/contact.dat | grep -c " 0$")" -eq 1 ]'
run "$jostle" plot closed.h5 histories --script closed
expect "a ground at rest takes no room" '[ $status -eq 0 ] && ! grep -q "ground acc\." closed/histories.gp && grep -q "time \[" closed/histories.gp'
rm -rf closed closed.*

# Two free bodies that collide once; two rows are within the impact.
cat >bodies.deck <<'END'
building A -floors 1 -mass 25t -stiffness 0
building B -floors 1 -mass 40t -stiffness 0
initial A:1 -velocity 1
contact A B -gap 5mm -law linear -k 1e8
step fixed 0.1ms
duration 0.2
param rows 150
output -every $rows
END
run "$jostle" run -q bodies.deck
run "$jostle" plot bodies.h5 loops --script bodies
sed -n "/^.hardest0/,/^EOD/p" bodies/loops.dat >hardest
expect "few rows say how to get more, in loops and contact" 'grep -q "output -every 1" bodies/loops.gp && "$jostle" plot bodies.h5 contact --script bodies && grep -q "output -every 1" bodies/contact.gp'
expect "an impact of two rows is no loop: they are not joined" '[ $status -eq 0 ] && [ "$(grep -c "^[0-9]" hardest)" -eq 2 ] && awk "/^[0-9]/ && joined { exit 1 } { joined = /^[0-9]/ }" hardest'
# joined ROWS: whether an impact of so many rows is drawn as a line.
joined() {
    run "$jostle" run -q --force bodies.deck -o rows.h5 -D rows="$1"
    run "$jostle" plot rows.h5 loops --script bodies --force
    [ "$(sed -n "/^.hardest0/,/^EOD/p" bodies/loops.dat | grep -c "^[0-9]")" -eq "$2" ] && sed -n "/^.hardest0/,/^EOD/p" bodies/loops.dat | awk "/^[0-9]/ && joined { found = 1 } { joined = /^[0-9]/ } END { exit !found }"
}
expect "nor is one of five rows, but one of seven" '! joined 80 5 && [ "$status" -eq 0 ] && joined 60 7'
for file in pair apart; do
    run "$jostle" plot $file.h5 profiles --script $file.hit
done
expect "profiles mark the accelerations of floors that were hit" '[ "$(grep -c "hit00 using 2:1 with points" pair.hit/profiles.gp)" -eq 1 ] && grep -q "floor that was hit" pair.hit/profiles.gp'
expect "and none where nothing was" '! grep -q "hit00 using\|floor that was hit" apart.hit/profiles.gp'
rm -r pair.hit apart.hit
run "$jostle" plot bodies.h5 profiles --script bodies
expect "free bodies have no storeys to show" '[ $status -eq 0 ] && [ "$(grep -c "^plot" bodies/profiles.gp)" -eq 2 ] && ! grep -q "drift\|shear" <(grep "^set label" bodies/profiles.gp)'
sed -i 's/-velocity 1/-velocity -1/' bodies.deck
run "$jostle" run -q bodies.deck -o apart_bodies.h5
run "$jostle" plot apart_bodies.h5 loops
expect "bodies that never meet have no loops" '[ $status -eq 2 ] && said "has no storeys, and no impact with a force" && [ ! -e apart_bodies-loops.png ]'
rm -rf bodies bodies.* apart_bodies.h5 hardest
run "$jostle" plot rigid.h5 loops --script scripts --force
expect "rigid impacts have no loop, the storeys beside them have" '[ $status -eq 0 ] && [ "$(grep -c "^plot" scripts/loops.gp)" -eq 2 ] && ! grep -q "^set label .penetration" scripts/loops.gp'
run "$jostle" plot rigid.h5 contact --script scripts --force
expect "an empty strip of contact forces says why it is empty" '[ $status -eq 0 ] && grep -q "^set label .rigid impacts have no force" scripts/contact.gp && ! grep -q "label .hardest:" scripts/contact.gp'
rm -rf scripts

printf '100 -50\n-50 60\n' >matrix.txt
printf 'building A -floors 2 -mass 1\nmatrix A matrix.txt -unit N/m\nbuilding B -floors 1 -mass 1 -stiffness 100\ncontact A:1 B -gap 1 -law linear -k 1\nstep fixed 1ms\nduration 0.1\n' >matrix.deck
run "$jostle" run -q matrix.deck
run "$jostle" plot matrix.h5 modes --script matrix
expect "a building with a matrix has no mode shapes, and the legend says so" '[ $status -eq 0 ] && [ "$(grep -c "shapes not in the file" matrix/modes.gp)" -eq 1 ]'
rm -r matrix matrix.*

# A building beside a free body, which is drawn as points without a line.
cat >cart.deck <<'END'
building tower -floors 2 -mass 100t -stiffness 50MN/m
building cart -floors 1 -mass 40t -stiffness 0
contact tower:1 cart -gap 5mm -law linear -k 1e9
initial cart:1 -velocity -0.5
step fixed 1ms
duration 0.5
END
run "$jostle" run -q cart.deck
points=3  # those of the two buildings, and the ring of floors that were hit
for kind in profiles modes; do
    run "$jostle" plot cart.h5 $kind --script cart
    expect "the legend of $kind has no line for a free body" '[ $status -eq 0 ] && [ "$(grep -c "^set arrow from screen" cart/$kind.gp)" -eq 1 ] && [ "$(grep -c "^set label .. at screen.* point pt" cart/$kind.gp)" -eq $points ]'
    points=2
done
rm -rf cart cart.*

rm -rf scripts
run "$jostle" plot pair.h5 overview --script scripts
expect "no two blocks of a picture have one name" '[ "$(grep -c "<< EOD" scripts/overview.dat)" -gt 5 ] && [ -z "$(grep "<< EOD" scripts/overview.dat | sort | uniq -d)" ] && ! grep -q EOD scripts/overview.gp'
run gnuplot scripts/overview.gp
expect "the data is found beside the script, from any folder" '[ $status -eq 0 ] && [ ! -s "$err" ] && drawn overview.png'
mkdir "other folder"
mv scripts/overview.gp "other folder/mine.gp"
mv scripts/overview.dat "other folder/mine.dat"
run gnuplot "other folder/mine.gp"
expect "both can be moved and renamed" '[ $status -eq 0 ] && [ ! -s "$err" ]'
for ending in gp dat; do
    rm -rf scripts
    mkdir scripts
    echo mine >scripts/energy.$ending
    run "$jostle" plot pair.h5 energy --script scripts
    expect "an energy.$ending that exists is kept, and nothing is put beside it" '[ $status -eq 2 ] && said "scripts/energy.$ending exists; --force overwrites it" && [ "$(ls scripts)" = energy.$ending ] && [ "$(cat scripts/energy.$ending)" = mine ]'
    run "$jostle" plot pair.h5 energy --script scripts --force
    expect "unless it is forced, with energy.$ending" '[ $status -eq 0 ] && [ "$(ls scripts | tr "\n" " ")" = "energy.dat energy.gp " ] && ! grep -q mine scripts/*'
done
run limited -f 4 "$jostle" plot pair.h5 energy --script limited
expect "data that cannot grow leaves nothing behind" '[ $status -eq 3 ] && said "cannot write limited/energy.dat" && [ -z "$(ls limited)" ]'

# Two runs at once: whoever comes second leaves the files of the first one alone.
rm -rf scripts
mkdir scripts
for file in energy.png scripts/energy.dat scripts/energy.gp; do
    echo mine >$file.part
    option=$([ $file = energy.png ] && echo "-o $file" || echo "--script scripts")
    # shellcheck disable=SC2086  # two words
    run flock $file.part "$jostle" plot pair.h5 energy $option
    expect "a $file that another run is writing is left alone" '[ $status -eq 3 ] && said "cannot write $file: another run is writing $file.part" && [ ! -e $file ] && [ "$(cat $file.part)" = mine ] && [ "$(find . -name "energy*" | wc -l)" -eq 1 ]'
    rm $file.part
done
echo old >energy.png.part
run "$jostle" plot pair.h5 energy -o energy.png
expect "what a killed run has left is replaced" '[ $status -eq 0 ] && drawn energy.png && [ ! -e energy.png.part ]'
run "$jostle" plot pair.h5 energy --script whole
for _ in 1 2 3 4 5 6 7 8; do
    "$jostle" plot pair.h5 energy --script scripts --force 2>>raced &
done
wait
expect "of eight at once nobody spoils the files of another" 'cmp -s whole/energy.gp scripts/energy.gp && cmp -s whole/energy.dat scripts/energy.dat && [ "$(ls scripts | wc -l)" -eq 2 ] && ! grep -qv "another run is writing" raced'
rm -rf energy.png whole raced scripts

# More pairs than find room, and names that would stand in each other.
{
    echo 'units kN m s'
    for i in $(seq 30); do
        echo "building B$i -floors 1 -mass 100t -stiffness $((20 + i))MN/m"
        [ "$i" -eq 1 ] || echo "contact B$((i - 1)) B$i -gap 5mm -law linear -k 1e5"
    done
    printf 'ground sine -amplitude 0.3g -frequency 1.5 -cycles 2\nstep fixed 1ms\n'
} >row.deck
run "$jostle" run -q row.deck
run "$jostle" plot row.h5 impacts --script scripts
expect "pairs that are not shown are told of" '[ $status -eq 0 ] && grep -q "impacts, those of the first 24 pairs are shown" scripts/impacts.gp && [ "$(grep -c "^set label .B.* | B" scripts/impacts.gp)" -eq 24 ]'
expect "names and numbers of pairs do not touch" 'grep "^set label .B" scripts/impacts.gp | sed "s/.* first \([0-9.]*\) .*/\1/" | awk "NR > 1 && \$1 - last < 1.5 { exit 1 } { last = \$1 }" && [ "$(grep -o ", .1. [0-9.]*" scripts/impacts.gp | wc -l)" -lt 24 ]'
rm -rf scripts row.*

for kind in profiles spectrum histories; do
    "$jostle" plot pair.h5 $kind --script g >"$out" 2>"$err"
    expect "$kind shows the unit of accelerations in g" 'grep -q "^set label .*m/s² = 0.102 g\]" g/$kind.gp'
done
rm -r g

run "$jostle" plot pair.h5
expect "without a kind histories are drawn" '[ $status -eq 0 ] && [ -s pair-histories.png ]'
run "$jostle" plot pair.h5
expect "a picture is not overwritten" '[ $status -eq 2 ] && said "--force"'
run "$jostle" plot few.h5
expect "of a file without displacements it is another figure" '[ $status -eq 0 ] && [ -s few-profiles.png ]'

for kind in histories contact loops spectrum; do
    run "$jostle" plot few.h5 $kind
    expect "$kind needs histories" '[ $status -eq 2 ] && said "few.h5 has no" && said "output -fields" && [ ! -e few-$kind.png ]'
done
run "$jostle" plot few.h5 overview
expect "the overview leaves out what is not there" '[ $status -eq 0 ] && drawn few-overview.png'
for kind in contact impacts; do
    run "$jostle" plot free.h5 $kind
    expect "$kind needs contacts" '[ $status -eq 2 ] && said "free.h5 has no contacts"'
done
run "$jostle" plot pair.h5 --compare few.h5
expect "a comparison draws what both files have" '[ $status -eq 0 ] && [ -s pair-profiles.png ]'

run "$jostle" plot pair.h5 --compare taller.h5
expect "other buildings are not compared" "[ \$status -eq 2 ] && said \"floors of 'B' is 3 in one, 4 in the other\""
run "$jostle" plot pair.h5 --compare wall.h5
expect "other units are not compared" "[ \$status -eq 2 ] && said \"'kN m s' in one, 'N m s' in the other\""
run "$jostle" plot pair.h5 --compare nothing.h5
expect "the other file must exist" '[ $status -eq 2 ] && said "nothing.h5"'
run "$jostle" plot pair.h5 --compare
expect "--compare needs a file" '[ $status -eq 2 ] && said "needs a value"'
run "$jostle" plot pair.h5 impact
expect "the nearest kind is proposed" "[ \$status -eq 2 ] && said \"did you mean 'impacts'\""
run "$jostle" plot pair.h5 energy -o energy.jpg
expect "other formats are refused" '[ $status -eq 2 ] && said ".png, .svg or .pdf"'

# Largest of the second column of a block of data.
largest() {
    sed -n "/^\$$1 <</,/^EOD/p" "$2" | awk '/^[-0-9]/ && $2 > m { m = $2 } END { print m }'
}
two_buildings long.deck 'output -every 1' 'duration 30'
run "$jostle" run -q long.deck
rm -rf scripts
run "$jostle" plot long.h5 loops --script scripts
run "$jostle" plot long.h5 contact --script scripts
force=$("$jostle" show --tsv long.h5 | awk -F '\t' '$1 == "contacts" && $3 == "force" && $5 > m { m = $5 } END { print m }')
expect "thinning keeps the peak" 'awk -v a="$(largest "force0[01]" scripts/contact.dat)" -v b="$force" "BEGIN { exit !(b > 0 && a > 0.999 * b && a < 1.001 * b) }"'
expect "30000 rows make few data, and a script to be read" '[ "$(wc -c <scripts/contact.dat)" -lt 300000 ] && [ "$(wc -c <scripts/contact.gp)" -lt 20000 ]'
