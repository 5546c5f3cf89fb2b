#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A run that is stopped by a signal says so, writes nothing and leaves nothing.
. tests/support/cli.sh

two_buildings long.deck 'duration 1000000s'
for signal in INT TERM HUP; do
    # A shell's background jobs ignore SIGINT; the program takes it back.
    "$jostle" run long.deck >"$out" 2>"$err" </dev/null &
    child=$!
    for _ in $(seq 100); do
        [ -e long.h5.part ] && break
        sleep 0.05
    done
    expect "a run keeps its rows in a .part file ($signal)" '[ -e long.h5.part ] && [ ! -e long.h5 ]'
    sleep 0.2
    kill -s $signal $child
    wait $child
    status=$?
    expect "SIG$signal ends the run with 3" '[ $status -eq 3 ]'
    expect "SIG$signal is told, with the time reached" 'grep -qE "interrupted by signal [0-9]+ at t = [0-9.e+]+; nothing was written" "$err" && [ ! -s "$out" ]'
    expect "SIG$signal leaves no file" 'only long.deck'
done

echo 'kept' >long.h5
"$jostle" run long.deck --force >"$out" 2>"$err" </dev/null &
child=$!
sleep 0.5
kill -s TERM $child
wait $child
status=$?
expect "an existing file outlives an interrupted --force" '[ $status -eq 3 ] && [ "$(cat long.h5)" = kept ] && only long.deck long.h5'
