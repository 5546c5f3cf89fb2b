#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The pages that the program prints are committed as it prints them now; `make docs` brings them up
# to date. In the summary, what may differ from machine to machine is left out: rounding residuals, and
# the count of iterations.
set -u
folder=${TMPDIR:-/tmp}/docs
status=0
missing=

stable() {
    grep -v -e '^residual' -e '^steps' "$1"
}

same() {
    if diff <(stable "$1") <(stable "$folder/${1##*/}"); then
        echo "ok $1 is what the program prints"
    else
        echo "not ok $1 is what the program prints: run make docs"
        status=1
    fi
}

if ! sh tests/support/docs.sh "$JOSTLE" "$folder"; then
    echo "not ok the program prints its pages"
    exit 1
fi
same docs/laws.md
same docs/deck-statements.md
same docs/ground-motions.md
same docs/accuracy.md
same docs/studies.md
same docs/ida.md
same docs/gap.md
same docs/law-command.md
same docs/contact-values.md
same README.md
sh tests/support/man.sh "$JOSTLE" "$folder"
same docs/jostle.1
same docs/jostle-deck.5
if [ "jostle $(sed -n 's/^version: //p' CITATION.cff)" = "$("$JOSTLE" --version)" ]; then
    echo "ok CITATION.cff names the version"
else
    echo "not ok CITATION.cff names the version of the program"
    status=1
fi
for page in docs/*.md; do
    [ "$page" = docs/README.md ] || grep -qF "(${page#docs/})" docs/README.md || missing="$missing $page"
done
if [ -z "$missing" ]; then
    echo "ok docs/README.md leads to every page"
else
    echo "not ok docs/README.md leads to every page, but not to$missing"
    status=1
fi
missing=
for file in src/solve/*.[ch] src/solve/*/*.[ch]; do
    grep -qE "(^|[^a-z_])${file##*/}([^a-z_]|\$)" docs/architecture.md || missing="$missing $file"
done
if [ -z "$missing" ]; then
    echo "ok docs/architecture.md says what each file of src/solve is for"
else
    echo "not ok docs/architecture.md says what each file of src/solve is for, but not$missing"
    status=1
fi
for page in docs/jostle.1 docs/jostle-deck.5; do
    if ! command -v groff >/dev/null; then
        echo "ok $page is a man page # SKIP no groff"
    elif [ -z "$(groff -man -ww -T utf8 -z "$page" 2>&1)" ]; then
        echo "ok $page is a man page to which groff says nothing"
    else
        echo "not ok $page is a man page: $(groff -man -ww -T utf8 -z "$page" 2>&1 | head -n 3)"
        status=1
    fi
done
exit $status
