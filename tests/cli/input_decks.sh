#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every example deck is read, runs, and keeps the account of its energy.
. tests/support/cli.sh

# The residual is rounding only: below 1e-9 of the largest share of the energy.
energy_is_kept() {
    LC_ALL=C awk -F '\t' '
        function size(x) { return x < 0 ? -x : x }
        $1 == "energy" && $3 !~ /^residual/ && size($5) > largest { largest = size($5) }
        $1 == "energy" && $3 == "residual_peak" { residual = size($5); ++found }
        END { exit !(found == 1 && largest > 0 && residual < 1e-9 * largest) }' "$out"
}

for deck in "$root"/input/*.deck; do
    name=$(basename "$deck" .deck)
    for command in check modes; do
        run "$jostle" $command "$deck"
        expect "$command $name is done without a warning" '[ $status -eq 0 ] && [ -s "$out" ] && [ ! -s "$err" ]'
    done
    run "$jostle" run "$deck"
    expect "run $name is done without a warning" '[ $status -eq 0 ] && [ -s "$out" ] && [ ! -s "$err" ] && [ -s "$name.h5" ]'
    "$jostle" show --tsv "$name.h5" >"$out"
    expect "$name accounts for its energy" 'energy_is_kept'
    rm -f "$name.h5"
done
