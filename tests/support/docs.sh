#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# docs.sh JOSTLE FOLDER: writes into FOLDER the pages that the program prints, laws.md and
# deck-statements.md, and the pages with its output, made again: law-command.md,
# contact-values.md, ground-motions.md, studies.md, ida.md, gap.md, accuracy.md and README.md. The
# output is without wall times, because they differ from run to run.
set -eu
jostle=$1
folder=$2
example=input/multistorey.deck

mkdir -p "$folder"
"$jostle" laws --markdown >"$folder/laws.md"
sh tests/support/restitution.sh "$jostle" >>"$folder/laws.md"
"$jostle" deck --markdown >"$folder/deck-statements.md"
sh tests/support/law_outputs.sh "$jostle" "$folder"
sed '/^#/d' "$example" >"$folder/deck"
"$jostle" run "$example" -o "$folder/multistorey.h5" --force >"$folder/printed"
sed -e "s|$folder/||" -e '/^wall time/d' "$folder/printed" >"$folder/summary"
sh tests/support/with_block.sh deck "$folder/deck" <README.md |
    sh tests/support/with_block.sh summary "$folder/summary" >"$folder/README.md"
"$jostle" run input/gap_study.deck -o "$folder/gap_study.h5" --force >"$folder/printed"
sed -e "s|$folder/||" -e '/^wall time/d' "$folder/printed" >"$folder/study"
sh tests/support/with_block.sh study "$folder/study" <docs/studies.md >"$folder/studies.md"
"$jostle" sensitivity input/monte_carlo.deck --edp force -D record=ELCENTRO_1940_NS >"$folder/ranked"
"$jostle" sensitivity input/monte_carlo.deck --edp force -D record=ELCENTRO_1940_NS --morris 10 >"$folder/effects"
sh tests/support/with_block.sh sensitivity "$folder/ranked" <"$folder/studies.md" |
    sh tests/support/with_block.sh morris "$folder/effects" >"$folder/studies.ranked"
mv "$folder/studies.ranked" "$folder/studies.md"
"$jostle" run input/ida.deck -o "$folder/ida.h5" -q --force
"$jostle" fragility "$folder/ida.h5" --edp drift-ratio:A --limit 2% >"$folder/fragility"
"$jostle" fragility "$folder/ida.h5" --edp impacts --limit 0 >"$folder/hits"
"$jostle" fragility "$folder/ida.h5" --edp impacts --limit 0 --hazard input/hazard.txt |
    tail -n 15 >"$folder/hazard"
"$jostle" ida input/ida.deck --limit drift-ratio:A=2% >"$folder/adaptive"
"$jostle" ida input/ida.deck --limit drift-ratio:A=2% --step 0.1g:0.05g --tolerance 10% >"$folder/hunted"
"$jostle" fragility "$folder/ida.h5" --edp drift-ratio:A --limit 2% --bootstrap 1000 |
    tail -n 2 >"$folder/bootstrap"
"$jostle" fragility "$folder/ida.h5" --edp drift-ratio:A --limit 2% --method cloud |
    tail -n 2 >"$folder/cloud"
"$jostle" fragility "$folder/ida.h5" --edp drift-ratio:A --limit 2% --im "Sa_avg(0.2s:2s)" \
    --method cloud | tail -n 4 >"$folder/measured"
"$jostle" run input/stripes.deck -o "$folder/stripes.h5" -q --force
"$jostle" fragility "$folder/stripes.h5" --edp drift-ratio:A --limit 2% --bootstrap 1000 \
    >"$folder/stripes"
"$jostle" run input/collapse.deck -o "$folder/collapse.h5" -q --force
"$jostle" fragility "$folder/collapse.h5" --collapse | grep -e '^collapse' -e '^median' >"$folder/collapse"
"$jostle" show "$folder/ida.h5" --long --edp drift-ratio:A | sed -n 1,5p >"$folder/long"
sh tests/support/with_block.sh fragility "$folder/fragility" <docs/ida.md |
    sh tests/support/with_block.sh hits "$folder/hits" |
    sh tests/support/with_block.sh hazard "$folder/hazard" |
    sh tests/support/with_block.sh adaptive "$folder/adaptive" |
    sh tests/support/with_block.sh hunted "$folder/hunted" |
    sh tests/support/with_block.sh bootstrap "$folder/bootstrap" |
    sh tests/support/with_block.sh cloud "$folder/cloud" |
    sh tests/support/with_block.sh measured "$folder/measured" |
    sh tests/support/with_block.sh stripes "$folder/stripes" |
    sh tests/support/with_block.sh collapse "$folder/collapse" |
    sh tests/support/with_block.sh long "$folder/long" >"$folder/ida.md"
"$jostle" spectrum input/records/*.AT2 --periods 0,0.1,0.2,0.5,1,2,5 >"$folder/spectra"
"$jostle" spectrum --pounding input/pounding_spectrum.deck --periods 0.1:2:8 >"$folder/pounding"
"$jostle" spectrum input/records/*.AT2 --target input/en1998.txt --match 0.2:2:50 \
    --periods 0.1,0.2,0.5,1,2 | sed '1,/^$/d' >"$folder/target"
sh tests/support/with_block.sh spectrum "$folder/spectra" <docs/ground-motions.md |
    sh tests/support/with_block.sh target "$folder/target" >"$folder/ground-motions.md"
"$jostle" check "$example" | sed -n '/^estimated for contact/,$p' >"$folder/checked"
"$jostle" converge "$example" >"$folder/printed" || [ $? -eq 1 ]
awk '/^building B/ { print "..."; cut = 1 } /^contact A:5/ { cut = 0 } !cut' "$folder/printed" >"$folder/converged"
sh tests/support/with_block.sh check "$folder/checked" <docs/accuracy.md |
    sh tests/support/with_block.sh converge "$folder/converged" >"$folder/accuracy.md"
"$jostle" gap input/separation.deck >"$folder/closing"
"$jostle" gap input/separation.deck --limit storey-shear:A:6=6MN --range 0:120mm:13 >"$folder/limit"
sh tests/support/with_block.sh closing "$folder/closing" <docs/gap.md |
    sh tests/support/with_block.sh limit "$folder/limit" |
    sh tests/support/with_block.sh pounding "$folder/pounding" >"$folder/gap.md"
sh tests/support/sensitivity.sh "$jostle" "$folder"
sh tests/support/with_block.sh choices "$folder/sensitivity/choices" <docs/contact-values.md |
    sh tests/support/with_block.sh storeys "$folder/sensitivity/storeys" >"$folder/contact-values.md"
