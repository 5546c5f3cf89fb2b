#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# law_outputs.sh JOSTLE FOLDER [PICTURE STOREYS LINKS FIT]: writes docs/law-command.md with its blocks made
# anew into FOLDER, and draws its pictures.
set -eu
jostle=$(realpath "$1")
folder=$2
first='jankowski -k 2.75e9N/m^1.5 -e 0.65'
storey='-yield 600kN -hardening 0.05 -stiffness 60MN/m'
bodies='-m1 25t -m2 40t -v 0.5m/s'

# shellcheck disable=SC2086  # options are one word each
"$jostle" law $first $bodies >"$folder/single"
# shellcheck disable=SC2086
"$jostle" law $first -calibrate $bodies --compare hertz-damp,hertz \
    --compare 'kelvin-voigt -k 93.5MN/m -e 0.65' \
    ${3+--plot "$3" --force} >"$folder/compared"
printf 'drift [mm]\n20\n-20\n40\n-40\n0\n' >"$folder/turns.txt"
(
    cd "$folder"
    # shellcheck disable=SC2086
    "$jostle" law storey bilinear $storey --protocol turns.txt >loops
)
# shellcheck disable=SC2086
[ "${4+set}" = "" ] || "$jostle" law storey bilinear $storey -amplitude 60mm --compare clough,takeda \
    --plot "$4" --force >/dev/null
[ "${5+set}" = "" ] || "$jostle" law link maxwell -stiffness 60MN/m -dashpot 2MN*s/m \
    -amplitude 20mm -period 1s --compare 'viscous -dashpot 2MN*s/m' \
    --compare 'friction -slip 150kN -stiffness 60MN/m' --plot "$5" --force >/dev/null
[ "${6+set}" = "" ] || "$jostle" law link friction -find slack \
    --fit input/loops/friction_damper.txt --plot "$6" --force >/dev/null
sh tests/support/with_block.sh single "$folder/single" <docs/law-command.md |
    sh tests/support/with_block.sh compared "$folder/compared" |
    sh tests/support/with_block.sh loops "$folder/loops" >"$folder/law-command.md"
