#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The numbers in pictures are those of the results: curves, axes, units, legends, of every kind.
. tests/support/cli.sh
if ! python3 -c 'import h5py' 2>/dev/null; then
    skip "numbers in pictures" "no h5py"
    exit
fi

# checked CHECKER SCRIPT FILE...: the numbers of this picture, of which the data is kept.
checked() {
    local checker=$1
    shift
    run python3 "$root/tests/support/$checker.py" "$@"
}

# Storeys with heights; other units with links, two grounds and dense rows; a wall, and large numbers.
two_buildings pair.deck
sed -i 's/-floors .*/& -height 3.5m/' pair.deck
two_buildings other.deck 'link A:1 B:1 -dashpot 10kN*s/m' \
    'ground sine -amplitude 2m/s^2 -frequency 2Hz -cycles 3 -buildings B' 'output -every 1'
sed -i 's/^units.*/units kip in ms/; s/-k 1e6/-k 1e9N\/m^1.5/; s/-frequency 1.5/&Hz/; s/-cycles 4$/& -buildings A/; s/^building A/building Z -floors 1 -mass 100t -stiffness 90MN\/m\n&/' other.deck
cat >wall.deck <<'END'
title "a wall"
units N mm s
building Gebäude -floors 3 -mass 1e4t -stiffness 1e10N/m -height 3m
contact wall Gebäude -gap 1mm -law linear -k 1e10N/m
initial Gebäude:3 -velocity -0.5m/s
ground sine -amplitude 2m/s^2 -frequency 1.5 -cycles 3
step fixed 1ms
END
cat >body.deck <<'END'
units kN mm s
building Turm -floors 2 -mass 100t -stiffness 50MN/m
building Karren -floors 1 -mass 40t -stiffness 0
contact Turm:1 Karren -gap 5mm -law linear -k 1e6N/m
initial Karren:1 -velocity -0.5m/s
ground sine -amplitude 2m/s^2 -frequency 1.5 -cycles 3
step fixed 1ms
END
cat >towers.deck <<'END'
units kN m s
building left -floors 1 -mass 100t -stiffness 20MN/m -height 3m
building right -floors 1 -mass 80t -stiffness 40MN/m -height 3m
contact left right -gap 5mm -law linear -k 1e5
ground sine -amplitude 0.3g -frequency 1.5 -cycles 3
step fixed 1ms
END
for deck in pair other wall body towers; do
    run "$jostle" run -q $deck.deck
    expect "$deck.deck runs" '[ $status -eq 0 ]'
done
run "$jostle" run -q pair.deck -D gap=8mm -o wider.h5
sed -i 's/-gap 5mm/-gap 8mm/' towers.deck
run "$jostle" run -q towers.deck -o farther.h5

kinds=$("$jostle" plot --help | sed -n '/^KIND/,/^$/ s/^  \([a-z]*\) .*/\1/p' | grep -v "overview\|members\|street")
for kind in $kinds; do
    for files in pair.h5 other.h5 wall.h5 body.h5 towers.h5 "pair.h5 wider.h5" "towers.h5 farther.h5"; do
        # shellcheck disable=SC2086  # one file or two
        set -- $files
        run "$jostle" plot "$1" ${2:+--compare "$2"} "$kind" --script scripts --force
        checked check_picture "scripts/$kind.gp" "$@"
        expect "$kind shows the numbers of $files" '[ $status -eq 0 ] && [ ! -s "$err" ]'
    done
    run "$jostle" plot pair.h5 "$kind" --script alone
done
run "$jostle" plot pair.h5 overview --script scripts
expect "the overview is drawn from the data of its parts" '[ $status -eq 0 ] && cmp -s <(grep -vh "^# Data" alone/{histories,contact,profiles,impacts,energy}.dat) <(grep -v "^# Data" scripts/overview.dat)'

# Samples of many kinds of ground; with late = 1 the largest intensities fail where the gap is narrow.
cat >suite.deck <<'END'
title "a suite"
units kN m s
param late 0
sweep record range 1 6 6
sweep im values 4m/s^2 1m/s^2 2m/s^2 8m/s^2
sweep wide values 1 0
building A -floors 2 -mass 100t -stiffness 50MN/m -height 3m
building B -floors 3 -mass 80t -stiffness 20MN/m -height 3m
contact A B -gap ${5mm + wide * 1m - 1m * max(0, im / 1m * 1s^2 - 3.5) * (1 - wide) * late} -law linear -k 1e5
ground sine -amplitude $im -frequency ${record * 0.7 / 1s} -cycles 3
step fixed 5ms
END
run "$jostle" run suite.deck -o whole.h5 -q
expect "the suite runs" '[ $status -eq 0 ]'
run "$jostle" run suite.deck -o failed.h5 -q -D late=1
expect "and fails in part" '[ $status -eq 1 ]'

# study KIND FILE EDP WORDS [OPTION]...: the words of check_study_picture.py behind the abscissa.
study() {
    local kind=$1 file=$2 edp=$3 words=$4
    shift 4
    run "$jostle" plot "$file" "$kind" --edp "$edp" --im im --over record "$@" --script scripts --force
    # shellcheck disable=SC2086  # several words
    checked check_study_picture "scripts/$kind.gp" "$file" "$edp" im $words
    expect "$kind shows the $edp of $file $*" '[ $status -eq 0 ]'
}
study ida whole.h5 drift-ratio "wide=0 0.5 2" --at wide=0 --limit 0.5%,2%
study ida failed.h5 force "wide=0" --at wide=0
study response whole.h5 impacts ""
study response failed.h5 drift-ratio:B "wide=0" --at wide=0
study cloud whole.h5 drift-ratio:A "wide=0" --at wide=0
study fragility whole.h5 acceleration:B "3 9" --limit 3,9
study fragility failed.h5 drift-ratio "wide=0 1.5" --at wide=0 --limit 1.5%

bodies="-k 2.75e9 -m1 25t -m2 40t -v 0.5"
for law in jankowski linear; do
    nominal=$([ $law = linear ] || printf '%s' "-e 0.65")
    # shellcheck disable=SC2086  # several words
    run "$jostle" law $law $bodies $nominal --tsv --history $law.tsv --script scripts --force
    cp "$out" values.tsv
    checked check_table_picture scripts/impact.gp values.tsv $law.tsv
    expect "an impact under law $law shows its numbers" '[ $status -eq 0 ]'
done
# shellcheck disable=SC2086  # several words
run "$jostle" law jankowski $bodies -e 0.65 --compare "linear -k 2.75e9" --script scripts --force
checked check_table_picture scripts/impact.gp values.tsv {jankowski,linear}.tsv
expect "and so do laws beside each other" '[ $status -eq 0 ]'

run "$jostle" spectrum --pounding "$root/input/pounding_spectrum.deck" --periods 0.3,0.5,1 --tsv
cp "$out" table.tsv
run "$jostle" spectrum --pounding "$root/input/pounding_spectrum.deck" --periods 0.3,0.5,1 --script scripts
checked check_table_picture scripts/pounding.gp table.tsv
expect "a map shows the forces of its pairs" '[ $status -eq 0 ]'
