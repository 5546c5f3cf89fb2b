#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The same deck gives the same numbers, bit for bit, from run to run and from folder to folder.
. tests/support/cli.sh

if ! command -v h5diff >/dev/null; then
    skip "two runs give the same numbers" "no h5diff"
    exit 0
fi
two_buildings pair.deck 'storey A:1 bilinear -yield 200kN -hardening 0.02' \
    'link A:2 B:2 -dashpot 50 -exponent 0.5' 'duration 6'
mkdir -p other/folder
cp pair.deck other/folder/

run "$jostle" run -q pair.deck -o one.h5
run "$jostle" run -q pair.deck -o two.h5
expect "two runs give the same numbers" 'same one.h5 two.h5'
cd other/folder || exit 1
run "$jostle" run -q pair.deck -j 2 -o "$here/three.h5"
cd "$here" || exit 1
expect "another folder and -j 2 change nothing" 'same one.h5 three.h5'
run "$jostle" run -q pair.deck -D gap=5.001mm -o four.h5
expect "another gap gives other numbers" '! same one.h5 four.h5'
