#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# law_outputs.sh JOSTLE FOLDER [PICTURE]: writes docs/law-command.md with its blocks made anew into
# FOLDER, and draws its picture.
set -eu
jostle=$1
folder=$2
first='jankowski -k 2.75e9N/m^1.5 -e 0.65'
bodies='-m1 25t -m2 40t -v 0.5m/s'

# shellcheck disable=SC2086  # options are one word each
"$jostle" law $first $bodies >"$folder/single"
# shellcheck disable=SC2086
"$jostle" law $first -calibrate $bodies --compare hertz-damp,hertz \
    --compare 'kelvin-voigt -k 93.5MN/m -e 0.65' \
    ${3+--plot "$3" --force} >"$folder/compared"
sh tests/support/with_block.sh single "$folder/single" <docs/law-command.md |
    sh tests/support/with_block.sh compared "$folder/compared" >"$folder/law-command.md"
