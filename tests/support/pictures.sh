#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# pictures.sh JOSTLE FOLDER PICTURES: runs examples in FOLDER and draws the pictures of the
# documentation into PICTURES.
set -eu
jostle=$1
folder=$2
pictures=$3

mkdir -p "$folder" "$pictures"
for deck in two_towers row_of_five ida gap_study frame_wall; do
    "$jostle" run input/$deck.deck -o "$folder/$deck.h5" -q --force
done
# Rows that show the course of an impact.
for deck in multistorey elastoplastic; do
    printf 'include "%s/input/%s.deck"\noutput -interval 1ms\n' "$PWD" $deck >"$folder/$deck.deck"
    "$jostle" run "$folder/$deck.deck" -o "$folder/$deck.h5" -q --force
done
"$jostle" run input/multistorey.deck -D gap=1m -o "$folder/apart.h5" -q --force
# The two buildings of collapse.deck under 44 artificial records, and more intensities.
mkdir -p "$folder/artificial"
awk -v folder="$folder/artificial" -v n=44 -f tests/support/artificial_records.awk
sed -e "s|records/|$(cd "$folder" && pwd)/artificial/|" -e 's/range 0.1g 1.5g 15/range 0.05g 1.5g 30/' \
    input/collapse.deck >"$folder/collapse.deck"
"$jostle" run "$folder/collapse.deck" -o "$folder/collapse.h5" -q --force

# draw NAME FILE KIND...: the picture NAME, which has its ending.
draw() {
    picture=$pictures/$1
    file=$folder/$2.h5
    shift 2
    "$jostle" plot "$file" "$@" -o "$picture" --force
}

"$jostle" plot deck input/low_roof.deck -o "$pictures/deck.png" --force
draw two_towers.svg two_towers histories
draw multistorey.png multistorey profiles --compare "$folder/apart.h5"
draw contact.png multistorey contact
draw loops.png elastoplastic loops
draw impacts.png row_of_five impacts
draw energy.png multistorey energy --compare "$folder/apart.h5"
draw floor_spectrum.png multistorey spectrum
draw modes.png multistorey modes
draw members.png frame_wall members
"$jostle" street input/street.csv --record "$PWD/input/records/ELCENTRO_1940_NS.AT2" --pga 0.2g \
    -o "$folder/street.deck" --force
"$jostle" run "$folder/street.deck" -o "$folder/street.h5" -q --force
draw street.png street street
draw ida.png ida ida
draw fragility.png ida fragility --edp drift-ratio:A --limit 1%,2%
draw collapse.png collapse fragility --collapse
draw response.png gap_study response --edp force --against gap --at pga=3
