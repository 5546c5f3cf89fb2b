#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle spectrum --pounding: each force is that of a run of the deck; tables, pictures, wrong usage.
. tests/support/cli.sh

deck=$root/input/pounding_spectrum.deck
cat >pair.deck <<'END'
title "a pair"
units kN m ms
param T1 0.3s
param T2 0.5s
param s 1
param gap 5mm
building A -floors 1 -mass 100t -stiffness ${4 * pi^2 * 100t / T1^2}
building B -floors 1 -mass 100t -stiffness ${4 * pi^2 * 100t / T2^2}
damping A rayleigh 5%
damping B rayleigh 5%
contact A B -gap $gap -law jankowski -k 2e9N/m^1.5 -e 0.65
ground sine -amplitude ${s * 0.3g} -frequency 2Hz -cycles 4
step fixed 1ms
END

# The largest force of a run of the deck with these options.
force_of_run() {
    "$jostle" run pair.deck "$@" -q -o run.h5 --force &&
        "$jostle" show --tsv run.h5 | awk -F '\t' '$1 == "contacts" && $3 == "force" { print $5 }'
}
cell() {
    awk -F '\t' -v a="$1" -v b="$2" 'NR > 1 && $1 == a && $2 == b { print $3 }' "$3"
}

run "$jostle" spectrum --pounding pair.deck --periods 0.25,0.5,1 --tsv
cp "$out" plus.tsv
expect "--tsv prints a line for each pair" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ "$(head -n 1 "$out")" = "$(printf "T1 [s]\tT2 [s]\tforce [kN]")" ] && [ "$(wc -l <"$out")" -eq 10 ]'
for pair in "0.25 0.5" "0.5 0.25" "0.5 1" "1 0.25"; do
    set -- $pair
    force=$(force_of_run -D "T1=$1s" -D "T2=$2s")
    found=$(cell "$1" "$2" plus.tsv)
    expect "at T1 = $1 s, T2 = $2 s it is the force of a run, to the last bit" '[ -n "$force" ] && [ "$force" != 0 ] && [ "$found" = "$force" ]'
done
expect "structures of one period do not touch" '[ "$(cell 0.5 0.5 plus.tsv)" = 0 ]'
run "$jostle" spectrum --pounding pair.deck --periods 0.25,0.5,1 --tsv -D s=-1
cp "$out" minus.tsv
mirrored=$(awk -F '\t' -v OFS='\t' 'NR > 1 { print $2, $1, $3 }' minus.tsv | sort)
expect "seen from behind, left and right are exchanged" '[ $status -eq 0 ] && [ "$mirrored" = "$(tail -n +2 plus.tsv | sort)" ]'
run "$jostle" spectrum --pounding pair.deck --periods 0.25,0.5,1 -D gap=1m
expect "-D reaches the deck, and the summary says what it finds" '[ $status -eq 0 ] && grep -qx "a pair" "$out" && grep -q "no contact for 9 of 9 pairs" "$out"'
run "$jostle" spectrum --pounding "$deck" --periods 0.3:1:3
expect "the example runs" '[ $status -eq 0 ] && grep -qE "^largest [0-9]+ kN at T1 = .* s, T2 = .* s; no contact for [0-9]+ of 9 pairs$" "$out"'

for threads in 1 2 7; do
    run "$jostle" spectrum --pounding pair.deck --periods 0.2:1:5 --tsv -j $threads
    cp "$out" threads$threads.tsv
done
expect "the number of threads changes no bit" '[ $status -eq 0 ] && cmp -s threads1.tsv threads2.tsv && cmp -s threads1.tsv threads7.tsv && [ "$(wc -l <threads7.tsv)" -eq 26 ]'
cat >fails.deck <<'END'
units kN m s
param T1 1s
param T2 1s
building A -floors 1 -mass 100t -stiffness ${sqrt(0.6s - T1) / 1s^0.5 * 1e3kN/m}
building B -floors 1 -mass 100t -stiffness ${4 * pi^2 * 100t / T2^2}
contact A B -gap 5mm -law linear -k 1e5kN/m
ground sine -amplitude 3m/s2 -frequency 2Hz -cycles 4
step fixed 1ms
END
for threads in 1 4; do
    run "$jostle" spectrum --pounding fails.deck --periods 0.3,0.5,0.7,0.9 -j $threads
    expect "the first pair that fails is named, $threads threads" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "at T1 = 0.7 s, T2 = 0.3 s: fails.deck:4:"'
done
grep -v duration pair.deck | sed 's/^step.*/step fixed 1e-3ms\nduration 10000s/' >long.deck
env --default-signal=INT "$jostle" spectrum --pounding long.deck --periods 0.25,0.5,1 -o long.png -j 2 >"$out" 2>"$err" &
sleep 1
kill -INT $!
wait $!
status=$?
expect "an interrupt ends it" '[ $status -eq 3 ] && [ ! -s "$out" ] && said "interrupted by signal 2" && [ ! -e long.png ]'

wrong() {
    local sentence=$1 words=$2
    shift 2
    run "$jostle" spectrum "$@"
    expect "$sentence" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "$words"'
}
sed 's/T2/other/g' pair.deck >one.deck
grep -v '^contact' pair.deck | sed '/param gap/d' >free.deck
wrong "the deck must take both periods" "T2" --pounding one.deck --periods 0.5,1
sed 's/-law jankowski -k 2e9N\/m^1.5 -e 0.65/-law stereomechanical -e 0.6/' pair.deck >rigid.deck
wrong "its contacts must have a force" "rigid contacts have no force" --pounding rigid.deck --periods 0.5,1
wrong "it must have a contact" "the deck has no contact" --pounding free.deck --periods 0.5,1
wrong "a deck that is not there is named" "no.deck: No such file" --pounding no.deck
wrong "records are the deck's" "takes records and damping from the deck" --pounding pair.deck record.AT2
wrong "so is damping" "takes records and damping from the deck" --pounding pair.deck --damping 2%
wrong "a period of 0 is refused" "period 0" --pounding pair.deck --periods 0,1,2
wrong "so are too many" "up to 1000" --pounding pair.deck --periods 0.1:2:1001
wrong "-D needs a deck" "-D is for the deck of --pounding" record.AT2 -D gap=1
wrong "-j takes a number" "-j takes a number of threads" --pounding pair.deck -j 0
wrong "-j needs a deck" "-j is for the deck of --pounding" record.AT2 -j 2
wrong "a map needs periods" "three periods" --pounding pair.deck --periods 0.5,1 -o map.png
wrong "a picture has an ending" "must end in .png, .svg or .pdf" --pounding pair.deck -o map.gif

run env PATH= "$jostle" spectrum --pounding pair.deck --periods 0.25,0.5,1 -o map.png --script scripts
expect "without gnuplot the script is there all the same" '[ $status -eq 3 ] && said "gnuplot" && [ -s scripts/pounding.gp ] && [ -s scripts/pounding.dat ] && [ ! -e map.png ]'
if command -v gnuplot >/dev/null; then
    run gnuplot scripts/pounding.gp
    expect "gnuplot draws it without a word" '[ $status -eq 0 ] && [ ! -s "$out" ] && [ ! -s "$err" ] && [ -s pounding.png ]'
    for ending in png svg pdf; do
        run "$jostle" spectrum --pounding pair.deck --periods 0.25,0.5,1 -o map.$ending
        expect "a map is drawn, $ending" '[ $status -eq 0 ] && [ "$(wc -c <map.$ending)" -gt 5000 ]'
    done
    run "$jostle" spectrum --pounding pair.deck --periods 0.25,0.3,0.35 -D gap=1m -o apart.png
    expect "one without contact too" '[ $status -eq 0 ] && [ -s apart.png ]'
else
    skip "maps are drawn" "no gnuplot"
fi
