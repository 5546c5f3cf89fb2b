#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every tests/deck/bad/NAME.deck is refused with exactly the messages of NAME.err and exit status 2.
# A line `# arguments: ...` of the deck goes to the command line. ACCEPT=1 writes the .err files anew:
# read what changed before you commit it.
set -u
jostle=${JOSTLE:-build/jostle}
out=${TMPDIR:-/tmp}/bad_decks.$$
trap 'rm -f "$out" "$out.err"' EXIT

for deck in tests/deck/bad/*.deck; do
    name=$(basename "$deck" .deck)
    read -r -a arguments < <(sed -n 's/^# arguments: //p' "$deck")
    "$jostle" check "$deck" ${arguments[@]+"${arguments[@]}"} >"$out" 2>"$out.err"
    status=$?
    [ "${ACCEPT-}" = 1 ] && cp "$out.err" "${deck%.deck}.err"
    if [ $status -eq 2 ] && [ ! -s "$out" ] && cmp -s "$out.err" "${deck%.deck}.err"; then
        echo "ok $name"
    else
        echo "not ok $name"
        echo "exit status $status, $(wc -c <"$out") bytes on stdout; messages:"
        diff "${deck%.deck}.err" "$out.err"
    fi
done
