#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# docs/verification.md and docs/papers.md say what their cases give now: all of them with
# JOSTLE_LONG=1, else those of docs/papers.md and the quick ones of the other page, and under
# sanitizers those of no more than seconds. `make verification` brings both up to date.
set -u
folder=${TMPDIR:-/tmp}/verification
status=0

quick='chopra buildings oscillators vibration impacts rigid energy fragility bar frames'
papers=$(cat tests/verification/papers.cases)
if [ "${JOSTLE_LONG-}" = 1 ]; then
    quick=$(cat tests/verification/verification.cases)
elif [ "${JOSTLE_SANITIZED-}" = 1 ]; then
    quick='chopra rigid'
    papers=relations
fi

# committed PAGE CASE: its part of the page, from its mark to the next one.
committed() {
    awk -v mark="<!-- $2 -->" '
        /^<!-- / { inside = $0 == mark }
        inside && NF' "docs/$1.md"
}

# page NAME CASE...: the head of the page, and these cases.
page() {
    local page=$1 name
    shift
    for name in "$@"; do
        if ! PICTURES=0 sh tests/verification/case.sh "$JOSTLE" "$folder" "$name"; then
            echo "not ok the case $name of docs/$page.md runs"
            status=1
        elif diff <(committed "$page" "$name") <(grep . "$folder/$name.md"); then
            echo "ok $name is in docs/$page.md as it runs"
        else
            echo "not ok $name is in docs/$page.md as it runs: run make $page"
            status=1
        fi
    done
    if diff <(awk '/^<!-- [a-z_]+ -->$/ { exit } { print }' "docs/$page.md" | grep .) \
        <(grep . "tests/verification/$page.head.md"); then
        echo "ok the head of docs/$page.md is that of the cases"
    else
        echo "not ok the head of docs/$page.md is that of the cases: run make $page"
        status=1
    fi
}

# shellcheck disable=SC2086  # one word a case
page verification $quick
# shellcheck disable=SC2086
page papers $papers
exit $status
