#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# pictures.sh JOSTLE FOLDER PICTURES: runs examples in FOLDER and draws the pictures of the
# documentation into PICTURES.
set -eu
jostle=$1
folder=$2
pictures=$3

mkdir -p "$folder" "$pictures"
for deck in two_towers multistorey elastoplastic row_of_five ida gap_study; do
    "$jostle" run input/$deck.deck -o "$folder/$deck.h5" -q --force
done
"$jostle" run input/multistorey.deck -D gap=1m -o "$folder/apart.h5" -q --force

# draw NAME FILE KIND...: the picture NAME.png.
draw() {
    picture=$pictures/$1.png
    file=$folder/$2.h5
    shift 2
    "$jostle" plot "$file" "$@" -o "$picture" --force
}

draw two_towers two_towers histories
draw multistorey multistorey profiles --compare "$folder/apart.h5"
draw contact multistorey contact
draw loops elastoplastic loops
draw impacts row_of_five impacts
draw energy multistorey energy --compare "$folder/apart.h5"
draw floor_spectrum multistorey spectrum
draw modes multistorey modes
draw ida ida ida
draw fragility ida fragility --edp drift-ratio:A --limit 1%,2%
draw response gap_study response --edp force --against gap --at pga=3
