#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# law_pictures.sh JOSTLE FOLDER: draws the pictures of docs/laws.md by the examples that stand there.
set -eu
jostle=$1
folder=$2

"$jostle" laws --markdown | sed -n 's/^- example: `jostle law \(.*\)`$/\1/p' | while read -r words; do
    name=law_${words%% *}
    case $words in
    storey\ *)
        name=${words#storey }
        name=storey_${name%% *}
        ;;
    esac
    # shellcheck disable=SC2086  # options are one word each
    "$jostle" law $words --plot "$folder/$name.svg" --force </dev/null >/dev/null
done
