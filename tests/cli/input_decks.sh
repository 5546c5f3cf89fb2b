#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every example deck is read, runs, can be read back, and keeps the account of its energy.
. tests/support/cli.sh

# The residual is rounding only: below 1e-9 of the largest share of the energy, in every run.
energy_is_kept() {
    LC_ALL=C awk -F '\t' '
        function size(x) { return x < 0 ? -x : x }
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["table"] != "energy" { next }
        { run = "run" in at ? $at["run"] : 1; name = $at["quantity"]; value = size($at["value"]) }
        name == "residual_peak" { residual[run] = value; next }
        name != "residual" && value > largest[run] { largest[run] = value }
        END {
            for (run in residual) bad += !(largest[run] > 0 && residual[run] < 1e-9 * largest[run])
            exit length(residual) == 0 || bad
        }' "$out"
}

# The last line of `check` is: so 'step fixed 0.001' does; here it is 0.001 s
step_is_short_enough() {
    LC_ALL=C awk -F "[' ]" '/^so .step fixed/ { found = 1; good = $(NF - 1) <= $5 }
        END { exit !(found && good) }' "$out"
}

for deck in "$root"/input/*.deck; do
    name=$(basename "$deck" .deck)
    for command in check modes; do
        run "$jostle" $command "$deck"
        expect "$command $name is done without a warning" '[ $status -eq 0 ] && [ -s "$out" ] && [ ! -s "$err" ]'
        [ $command != check ] || expect "$name has a step that check is content with" step_is_short_enough
    done
    run "$jostle" run "$deck"
    # On a slow machine studies say there how far they are.
    expect "run $name is done without a warning" '[ $status -eq 0 ] && [ -s "$out" ] && ! said warning'
    expect "the result of $name reads back" '"$jostle" show "$name.h5" | cmp -s - "$out"'
    "$jostle" show --tsv "$name.h5" >"$out"
    expect "$name accounts for its energy" 'energy_is_kept'
    rm -f "$name.h5"
done
