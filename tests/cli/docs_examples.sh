#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The decks and commands that docs/quick-start.md and docs/modelling.md tell readers to type.
. tests/support/cli.sh

ln -s "$root/input" input
ln -s input/records records

# The code blocks of docs/modelling.md go into the files named above them.
mkdir measures
awk '/^<!-- file / { file = $3 } /^```/ { inside = !inside && file; if (!inside) file = ""; next }
     inside { print > file }' "$root/docs/modelling.md"
for deck in *.deck; do
    run "$jostle" run "$deck" -q
    expect "$deck of the page on modelling runs" '[ $status -eq 0 ] && [ -s "${deck%.deck}.h5" ]'
done
expect "and all its decks are there" '[ "$(ls ./*.deck | wc -l)" -eq 5 ]'
run "$jostle" show columns.h5 --tsv
expect "the columns are hit" 'awk -F "\t" "\$3 == \"impacts\" && \$5 > 0 { hit = 1 } END { exit !hit }" "$out"'
run "$jostle" show moat.h5 --tsv
expect "and both moat walls" '[ "$(awk -F "\t" "\$3 == \"impacts\" && \$5 > 0" "$out" | wc -l)" -eq 2 ]'
expect "whose period before yield is the one told" 'grep -qP "^buildings\tA\tperiod\t1\t0\.859" "$out"'
run "$jostle" run measures.deck -q -D measure=damper -o one.h5
expect "one measure is looked at by its name" '[ $status -eq 0 ]'
"$jostle" spectrum records/*.AT2 --periods 0.2:2:50 --tsv >spectra.tsv
if python3 -c 'import pandas' 2>/dev/null; then
    run python3 factors.py
    expect "the script writes a factor for each record" '[ $status -eq 0 ] && [ "$(cat motions/*.deck | grep -c "^ground record ../records/[A-Z0-9_]*.AT2 -scale [0-9.]*$")" -eq 5 ]'
    sed -e 's/^sweep record.*/sweep motion files "motions\/*.deck"/' -e 's/^ground.*/include $motion/' measures.deck >scaled.deck
    run "$jostle" run scaled.deck -q
    expect "which a study takes" '[ $status -eq 0 ]'
else
    echo "ok the script writes a factor for each record # SKIP no pandas"
fi

# What docs/quick-start.md says, but for its own start, `make demo`.
awk '/`first.deck`/ { inside = 1; next } /^- / { inside = 0 } inside && /^    / { print substr($0, 5) }' \
    "$root/docs/quick-start.md" >first.deck
mkdir build && ln -s "$jostle" build/jostle
grep -E '^    build/jostle ' "$root/docs/quick-start.md" | sed 's/#.*//' >commands
while read -r command; do
    case $command in *plot*) command -v gnuplot >/dev/null || continue ;; esac
    run bash -c "$command"
    expect "the quick start's $command" '[ $status -eq 0 ]'
done <commands
expect "of which there are ten" '[ "$(wc -l <commands)" -eq 10 ]'
