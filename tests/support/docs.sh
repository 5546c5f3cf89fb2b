#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# docs.sh JOSTLE FOLDER: writes into FOLDER what of the documentation the program itself prints:
# laws.md, deck-statements.md, README.md with its deck and its summary made anew, and spectrum.md with
# its table.
set -eu
jostle=$1
folder=$2
example=input/multistorey.deck

# The page with the code block behind the line `<!-- NAME -->` replaced by the file NAME.
with_block() {
    awk -v name="$1" -v file="$2" '
        inside && /^```$/ { while ((getline line < file) > 0) print line; inside = 0 }
        !inside { print }
        $0 == "<!-- " name " -->" { due = 1 }
        due && /^```/ { inside = 1; due = 0 }'
}

mkdir -p "$folder"
"$jostle" laws --markdown >"$folder/laws.md"
"$jostle" deck --markdown >"$folder/deck-statements.md"
sed '/^#/d' "$example" >"$folder/deck"
"$jostle" run "$example" -o "$folder/multistorey.h5" --force >"$folder/printed"
sed "s|$folder/||" "$folder/printed" >"$folder/summary"
with_block deck "$folder/deck" <README.md | with_block summary "$folder/summary" >"$folder/README.md"
"$jostle" spectrum input/records/*.AT2 --periods 0,0.1,0.2,0.5,1,2,5 >"$folder/spectra"
with_block spectrum "$folder/spectra" <docs/spectrum.md >"$folder/spectrum.md"
