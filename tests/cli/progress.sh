#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What takes more than a second says on a terminal how far it is; piped it says nothing.
. tests/support/cli.sh

if ! command -v script >/dev/null; then
    skip "progress is shown on a terminal" "no script(1)"
    exit 0
fi

# on_terminal COMMAND...: runs it on a terminal for two seconds, long enough for the first line.
on_terminal() {
    timeout 60 script -qec "timeout -s INT ${seconds:-2} $*" /dev/null </dev/null 2>&1 |
        tr '\r' '\n' >"$out"
}
time_left='[0-9]+ %, [0-9]+ s left'

two_buildings long.deck 'duration 1000000s'
on_terminal "'$jostle' run long.deck -o a.h5"
expect "a run shows time, percent and time left" 'grep -qE "^[0-9.e+]+ of 1e\+06 s, +$time_left" "$out"'
on_terminal "'$jostle' converge long.deck"
expect "so does converge" 'grep -qE "^[0-9.e+]+ of 1e\+06 s, +$time_left" "$out"'

sed 's/^duration.*/duration 100s/; s/^building A/param T1 1s\nparam T2 $T1\nparam unused ${T1 + $T2}\n&/' \
    long.deck >pair.deck
on_terminal "'$jostle' spectrum --pounding pair.deck --periods 0.1:2:1000"
expect "a pounding force spectrum counts its runs" 'grep -qE "^[0-9]+ of 1e\+06 runs, +$time_left" "$out"'

awk 'BEGIN { for (i = 0; i < 200000; i++) print sin(i * 0.7) }' >long.txt
on_terminal "'$jostle' spectrum long.txt --dt 0.01s --unit m/s2 --periods 0.01:10:10000"
expect "a response spectrum counts its points" 'grep -qE "^[0-9]+ of 1e\+04 points, +$time_left" "$out"'

"$jostle" spectrum long.txt --dt 0.01s --unit m/s2 --periods 0.01:10:60 --tsv >/dev/null 2>"$err"
expect "piped it says nothing" '[ ! -s "$err" ]'
