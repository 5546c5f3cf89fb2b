#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The decks, commands and Python that the pages tell readers to type.
. tests/support/cli.sh

ln -s "$root/input" input
ln -s input/records records

# The code blocks of docs/modelling.md go into the files named above them.
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
run "$jostle" run measures.deck -q -D measure=1 -o one.h5
expect "one measure is looked at by its number" '[ $status -eq 0 ]'
run "$jostle" spectrum records/*.AT2 --target input/en1998.txt --match 0.2:2:50
expect "the common factor of motions.deck is the one told" '[ $status -eq 0 ] && grep -q "factors times $(sed -n "s/.*scale \${\([0-9.]*\) .*/\1/p" input/motions.deck)$" "$out"'
"$jostle" spectrum records/*.AT2 --target input/en1998.txt --match 0.2:2:50 --deck >motions.inc
expect "and its factors those for a deck" '[ "$(grep "^sweep factor" motions.inc | tr -s " ")" = "$(grep "^sweep factor" input/motions.deck | tr -s " ")" ]'
sed -e 's/^sweep record.*/include motions.inc/' -e 's/^ground.*/ground record $record -scale $factor/' measures.deck >scaled.deck
run "$jostle" run scaled.deck -q
expect "which a study takes" '[ $status -eq 0 ] && "$jostle" show scaled.h5 | grep -q "^study of 15 runs, 0 failed"'

# What the quick start says, but for its own start, `make demo`, and then what other pages do.
awk '/`first.deck`/ { inside = 1; next } /^[-|] / { inside = 0 } inside && /^    / { print substr($0, 5) }' \
    "$root/docs/quick-start.md" >first.deck
mkdir build && ln -s "$jostle" build/jostle
PATH=$PWD/build:$PATH
"$jostle" run input/gap_study.deck -q && "$jostle" run input/monte_carlo.deck -q && "$jostle" run input/motions.deck -q
for page in quick-start pictures ground-motions ida gap; do
    grep -E '^    (build/)?jostle ' "$root/docs/$page.md" | sed 's/ *#.*//' >commands
    while read -r command; do
        case $command in *plot* | *png*) command -v gnuplot >/dev/null || continue ;; esac
        run bash -c "$command"
        expect "$page: $command" '[ $status -eq 0 ]'
    done <commands
    expect "$page has commands" '[ -s commands ]'
done

# Their Python, without its plots.
cat >blocks.py <<'END'
import re
import sys
import xarray

text = open(sys.argv[1]).read()
fenced = re.findall(r"```python\n(.*?)```", text, re.S)
indented = re.findall(r"\n\n((?:    .*\n)+)", text)
names = {"xr": xarray}
blocks = fenced + [re.sub("(?m)^    ", "", b) for b in indented if "xr." in b or "import" in b]
if not blocks:
    sys.exit("the page has none")
for block in blocks:
    exec(re.sub(r"\.plot\(.*?\)", "", block), names)
END
"$jostle" show ida.h5 --long --csv >long.csv
"$jostle" show ida.h5 --wide --edp drift-ratio:A --edp force --csv >wide.csv
for page in result-file studies ida ground-motions; do
    if ! python3 -c 'import h5py, pandas, xarray' 2>/dev/null; then
        echo "ok $page: its Python # SKIP no h5py, pandas or xarray"
        continue
    fi
    run python3 blocks.py "$root/docs/$page.md"
    expect "$page: its Python" '[ $status -eq 0 ]'
done

# Links between the pages, with the headings they name.
cat >links.py <<'END'
import os
import re
import sys

def read(path):
    return re.sub(r"(?ms)^```.*?^```", "", open(path, encoding="utf-8").read())

def headings(path):
    plain = (re.sub(r"[^\w\- ]", "", h.lower()).strip() for h in re.findall(r"(?m)^#+ (.*)", read(path)))
    return {h.replace(" ", "-") for h in plain}

bad = []
for page in sys.argv[1:]:
    for link in re.findall(r"\]\(([^)\s]+)\)", read(page)):
        file, _, heading = link.partition("#")
        to = os.path.join(os.path.dirname(page), file) if file else page
        if not link.startswith("http") and (
            not os.path.exists(to) or (heading and heading not in headings(to))
        ):
            bad.append(f"{page}: {link}")
sys.exit("\n".join(bad) or 0)
END
if command -v python3 >/dev/null; then
    run python3 links.py "$root"/*.md "$root"/docs/*.md "$root"/input/records/*.md
    expect "all links between pages lead somewhere" '[ $status -eq 0 ]'
fi
