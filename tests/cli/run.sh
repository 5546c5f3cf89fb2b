#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle run: where the result goes, what is printed where, and the exit status.
. tests/support/cli.sh

two_buildings pair.deck
run "$jostle" run pair.deck
expect "a run ends with 0 and leaves only the result file" '[ $status -eq 0 ] && only pair.deck pair.h5'
expect "the summary goes to stdout" 'grep -q "two buildings" "$out"'
expect "the warning goes to stderr, with its place" 'said "pair.deck:7:11: warning: Rayleigh coefficient"'
expect "neither is coloured" '! grep -q $'"'\033'"' "$out" "$err"'

mark='* this floor was hit: its peak depends on the contact stiffness'
hit='^[AB] +[0-9.e+-]+ +[0-9.e+-]+\* +[0-9]+ '
expect "accelerations of floors that were hit are marked" 'grep -qE "$hit" "$out" && grep -qxF "$mark" "$out"'
run "$jostle" run pair.deck -D gap=1m -o apart.h5
expect "those of other floors are not" '[ $status -eq 0 ] && ! grep -qE "$hit" "$out" && ! grep -qF "$mark" "$out"'
sed 's/-law jankowski -k 1e6 -e 0.65/-law stereomechanical -e 0.65/' pair.deck >rigid.deck
run "$jostle" run rigid.deck
expect "nor are those at rigid contacts, which leave the impact out" '[ $status -eq 0 ] && ! grep -q " 0 impacts" "$out" && ! grep -qF "$mark" "$out"'
rm apart.h5 rigid.*

sum=$(cksum <pair.h5)
run "$jostle" run pair.deck
expect "an existing file is refused" '[ $status -eq 2 ] && said "pair.h5 exists; --force overwrites it" && [ ! -s "$out" ]'
expect "and left untouched" '[ "$(cksum <pair.h5)" = "$sum" ] && only pair.deck pair.h5'
run "$jostle" run pair.deck --force -D gap=6mm
expect "--force overwrites it" '[ $status -eq 0 ] && [ "$(cksum <pair.h5)" != "$sum" ] && only pair.deck pair.h5'
rm pair.h5

run "$jostle" run pair.deck -q
expect "-q prints nothing" '[ $status -eq 0 ] && [ ! -s "$out" ] && [ ! -s "$err" ] && [ -s pair.h5 ]'
run "$jostle" run pair.deck -q
expect "-q does not hide an error" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "exists"'
rm pair.h5

mkdir results
run "$jostle" run pair.deck -o results/one.h5
expect "-o names the result file" '[ $status -eq 0 ] && only pair.deck results/one.h5'
run "$jostle" run -q --output=results/two.h5 pair.deck
expect "--output=FILE may stand before the deck" '[ $status -eq 0 ] && [ -s results/two.h5 ]'
for name in table.csv picture.PNG results/one.deck; do
    run "$jostle" run pair.deck -o $name
    expect "$name promises another kind of file" '[ $status -eq 2 ] && said "$name: a result is an HDF5 file, not" && [ ! -e $name ]'
done
cp pair.deck pair.old
run "$jostle" run pair.deck -o pair.old --force
expect "--force does not replace what is no HDF5 file" '[ $status -eq 2 ] && said "pair.old exists and is not an HDF5 file" && cmp -s pair.deck pair.old'
for name in empty.old junk.h5; do
    [ $name = empty.old ] || echo junk >$name
    : >>$name
    run "$jostle" run pair.deck -o $name -q --force
    expect "but it replaces $name" '[ $status -eq 0 ] && [ "$(head -c 4 $name | tail -c 3)" = HDF ]'
done
rm *.old junk.h5
run "$jostle" run pair.deck -o no/such/folder.h5
expect "a folder that does not exist ends with 3" '[ $status -eq 3 ] && said "No such file or directory" && [ ! -s "$out" ]'
run "$jostle" run pair.deck -o results
expect "a folder in place of the file is refused" '[ $status -ge 2 ] && [ -d results ] && [ ! -s "$out" ]'
run "$jostle" run pair.deck -o results --force
expect "even with --force" '[ $status -ge 2 ] && only pair.deck results/one.h5 results/two.h5'
rm -r results

mkfifo pipe
run "$jostle" run pair.deck -q -o pipe --force
expect "nor does a file take the place of a pipe or a device" '[ $status -eq 2 ] && said "pipe is not a regular file" && [ -p pipe ]'
rm pipe

mkdir decks
two_buildings decks/named.deck 'output -file "in here.h5"'
run "$jostle" run decks/named.deck
expect "the deck may name the file, from the current folder" '[ $status -eq 0 ] && [ -s "in here.h5" ]'
run "$jostle" run decks/named.deck -o other.h5
expect "-o comes first" '[ $status -eq 0 ] && [ -s other.h5 ]'
rm -r decks ./*.h5

mkdir "a folder" "a folder/motions"
printf '0\n1\n-2\n1\n0\n' >"a folder/motions/short record.txt"
printf '%s\n' 'building A -floors 1 -mass 1 -stiffness 400' \
    'ground record "motions/short record.txt" -unit m/s2 -dt 0.5' 'step fixed 0.01' >"a folder/my deck.v2"
run "$jostle" run "a folder/my deck.v2"
expect "blanks in names do no harm; a record is found from its deck" '[ $status -eq 0 ] && [ -s "my deck.h5" ]'
cd "a folder/motions" || exit 1
run "$jostle" run "../my deck.v2"
expect "from whatever folder" '[ $status -eq 0 ] && [ -s "my deck.h5" ]'
cd "$here" || exit 1
rm -r "a folder" ./*.h5

sum=$(cksum <pair.deck)
run "$jostle" run pair.deck -o ./pair.deck --force
expect "the deck is not overwritten by its result, even with --force" '[ $status -eq 2 ] && said "is the deck" && [ "$(cksum <pair.deck)" = "$sum" ] && only pair.deck'

cp pair.deck .hidden
run "$jostle" run .hidden
expect "a deck without an ending gets one" '[ $status -eq 0 ] && [ -s .hidden.h5 ]'
rm .hidden .hidden.h5

printf '%s\n' 'building A -floors 1 -mass 1e-300 -stiffness 1' 'load A:1 constant 1e300' \
    'step fixed 0.01' 'duration 1' >fails.deck
run "$jostle" run fails.deck
expect "a state that is not finite ends with 1 and names floor and time" '[ $status -eq 1 ] && said "not finite at floor 1 of building A at t = 0.01" && [ ! -s "$out" ]'
expect "and leaves nothing" 'only fails.deck pair.deck'
sed -i 's/-gap \$gap/-gpa $gap/' pair.deck
run "$jostle" run pair.deck
expect "an error in the deck ends with 2 and leaves nothing" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "pair.deck:8:13: error: unknown option" && only fails.deck pair.deck'

two_buildings pair.deck
NO_COLOR=1 run "$jostle" check pair.deck
expect "NO_COLOR is accepted" '[ $status -eq 0 ] && ! grep -q $'"'\033'"' "$err"'
if has_terminal; then
    script -qec '"$jostle" check pair.deck' /dev/null >"$out" 2>"$err" </dev/null
    expect "a terminal shows colours" 'grep -q $'"'\033'"' "$out"'
    NO_COLOR=1 script -qec '"$jostle" check pair.deck' /dev/null >"$out" 2>"$err" </dev/null
    expect "NO_COLOR takes them away" '! grep -q $'"'\033'"' "$out" && grep -q "warning:" "$out"'
else
    skip "a terminal shows colours" "no terminal, or no script(1)"
fi
run "$jostle" run -q pair.deck -o one.h5
comma=$(locale -a 2>/dev/null | grep -iE '^(de|fr|it|es|nl)_.*utf-?8$' | head -n 1)
if [ -n "$comma" ]; then
    LC_ALL=$comma run "$jostle" check pair.deck
    expect "a locale with a decimal comma changes nothing" '[ $status -eq 0 ] && grep -q "gap  *m\*" "$out" && grep -q "0\.005" "$out"'
else
    skip "a locale with a decimal comma changes nothing" "no such locale here"
fi

mkdir includes
two_buildings includes/more.inc
printf 'title "inner"' >includes/inner.inc
sed -i '/^title/d' includes/more.inc
printf 'include includes/inner.inc\ninclude includes/more.inc\n' >outer.deck
run "$jostle" run -q outer.deck -o includes.h5
"$jostle" show --json includes.h5 >"$out"
expect "the texts of included files are kept in the order read" 'grep -qF "\"includes\": \"# include includes/inner.inc\\ntitle \\\"inner\\\"\\n# include includes/more.inc\\nunits kN m s\\n" "$out"'

ln -s "$root/input/records" records
sed "s/step fixed 0.2ms/step fixed 5ms/" "$root/input/multistorey.deck" >few.deck
run "$jostle" run few.deck
expect "run tells of impacts that few steps cover" '[ $status -eq 0 ] && grep -qE "^jostle: warning: fewer than 10 steps cover [0-9]+ of [0-9]+ impacts; the hardest, of contact A:[1-5]-B:[1-5] at t = [0-9.]+ s, lasted [0-9.]+ s; step fixed [0-9.]+ resolves it$" "$err"'
expect "and so does the summary" 'grep -qE "^5 contacts, [0-9] hit, [0-9]+ impacts \([0-9]+ of fewer than 10 steps\)" "$out"'

# A load and a record that end with the analysis jump to 0 there, which is after it.
printf '0\n0.1\n0.2\n0.3\n' >rise.txt
ending() {
    cat >ending.deck <<END
units kN m s
building A -floors 2 -mass 100t -stiffness 50MN/m
load A:2 sine -amplitude 4MN -frequency 0.9 -cycles 1.17
ground record rise.txt -dt \${1.3s / 3} -unit g
duration 1.3
step $1
END
    "$jostle" run ending.deck -q --force >"$out" 2>"$err" &&
        "$jostle" show --tsv ending.h5 | awk -F '\t' '$2 == "A" && $3 == "acceleration" && $4 == 2 { print $5 }'
}
fixed=$(ending "fixed 0.1ms")
for integrator in dormand-prince newmark; do
    adaptive=$(ending "adaptive
integrator $integrator")
    expect "$integrator counts nothing after the end of the analysis: $adaptive, with fixed steps $fixed" \
        'awk "BEGIN { exit !($fixed > 1 && ($adaptive / $fixed - 1)^2 < 1e-6) }"'
done
