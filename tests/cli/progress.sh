#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What takes more than a second says on a terminal how far it is; piped it says nothing.
. tests/support/cli.sh

if ! has_terminal; then
    skip "progress is shown on a terminal" "no terminal, or no script(1)"
    exit 0
fi

# says SENTENCE AMOUNT COMMAND...: COMMAND on a terminal says how much of AMOUNT is done.
says() {
    local sentence=$1 amount=$2
    shift 2
    shows "$sentence" "^[0-9.]+ of $amount, +[0-9]+ %, [0-9]+ s left" "$@"
}

# shows SENTENCE PATTERN COMMAND...: COMMAND on a terminal says so. It would take minutes, and is ended
# as soon as it has said so, or after a minute.
shows() {
    local sentence=$1 pattern=$2 tries=600 terminal
    shift 2
    rm -f typed pid
    script -qfec "echo \$\$ >pid; exec $*" typed </dev/null >"$out" 2>&1 &
    terminal=$!
    until [ -s typed ] && tr '\r' '\n' <typed | grep -qE "$pattern"; do
        if [ $((tries -= 1)) -eq 0 ] || ! kill -0 "$terminal" 2>/dev/null; then
            break
        fi
        sleep 0.1
    done
    kill -TERM "$(cat pid)" 2>/dev/null
    wait "$terminal"
    tr '\r' '\n' <typed >"$out"
    expect "$sentence" 'grep -qE "$pattern" "$out"'
}

two_buildings long.deck 'duration 1000000s'
says "a run shows time, percent and time left" '1000000 s' '"$jostle" run long.deck -o a.h5'
says "so does converge" '1000000 s' '"$jostle" converge long.deck'

sed 's/^duration.*/duration 100s/; s/^building A/param T1 1s\nparam T2 $T1\nparam unused ${T1 + $T2}\n&/' \
    long.deck >pair.deck
says "a pounding force spectrum counts its runs" '1000000 runs' \
    '"$jostle" spectrum --pounding pair.deck --periods 0.1:2:1000'

# The 40 short runs, which come first, are a thousandth of the work.
sed 's/^duration.*/duration $T/; s/^building A.*/building A -floors 2 -mass 100t -stiffness $k/; s/^param T1/#&/; s/^param T2/#&/; s/^param unused/#&/' pair.deck >study.deck
sed -i '2a sweep T values 50s 50000s\nsweep k range 40MN/m 60MN/m 40' study.deck
shows "the time left of a study is that of its steps, not of its runs" \
    '^[1-9][0-9]* of 80 runs, 0 failed, [0-9.]+ runs/s, ([5-9] min|[1-9][0-9]+ min|[1-9][0-9]* h) .*left' \
    '"$jostle" run study.deck -o study.h5'
rm -f study.*

awk 'BEGIN { for (i = 0; i < 200000; i++) print sin(i * 0.7) }' >long.txt
says "a response spectrum counts its points" '10000 points' \
    '"$jostle" spectrum long.txt --dt 0.01s --unit m/s2 --periods 0.01:10:10000'

"$jostle" spectrum long.txt --dt 0.01s --unit m/s2 --periods 0.01:10:60 --tsv >/dev/null 2>"$err"
expect "piped it says nothing" '[ ! -s "$err" ]'
