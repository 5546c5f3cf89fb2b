#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The pages that the program prints are committed as it prints them now; `make docs` brings them up
# to date. In the summary, what differs from machine to machine is left out: wall time, rounding
# residuals, and the count of iterations.
set -u
folder=${TMPDIR:-/tmp}/docs
status=0

stable() {
    grep -v -e '^wall time' -e '^residual' -e '^steps' "$1"
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
same docs/spectrum.md
same docs/studies.md
same docs/restitution.md
same docs/law-command.md
same README.md
exit $status
