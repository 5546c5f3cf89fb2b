#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# demo.sh JOSTLE FOLDER: two towers through an earthquake; the result file and a picture of it are
# left in FOLDER.
set -eu
jostle=$1
folder=$2
result=$folder/two_towers.h5
picture=$folder/two_towers.png

mkdir -p "$folder"
"$jostle" run input/two_towers.deck -o "$result" --force
printf '\nThe result file %s holds\n' "$result"
h5ls -r "$result" | sed -n '1,24p'
"$jostle" plot "$result" -o "$picture" --force
printf '\nThe picture is %s\n' "$picture"
