#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# docs/verification.md says what its cases give now: all of them with JOSTLE_LONG=1, else the quick
# ones, and under sanitizers those of no more than seconds. `make verification` brings it up to
# date.
set -u
folder=${TMPDIR:-/tmp}/verification
status=0

quick='chopra buildings oscillators vibration impacts rigid energy fragility bar frames'
if [ "${JOSTLE_LONG-}" = 1 ]; then
    names=$(cat tests/verification/cases)
elif [ "${JOSTLE_SANITIZED-}" = 1 ]; then
    names='chopra rigid'
else
    names=$quick
fi

# committed CASE: its part of the manual, from its mark to the next one.
committed() {
    awk -v mark="<!-- $1 -->" '
        /^<!-- / { inside = $0 == mark }
        inside && NF' docs/verification.md
}

for name in $names; do
    if ! PICTURES=0 sh tests/verification/case.sh "$JOSTLE" "$folder" "$name"; then
        echo "not ok the case $name of the verification manual runs"
        status=1
    elif diff <(committed "$name") <(grep . "$folder/$name.md"); then
        echo "ok $name is in docs/verification.md as it runs"
    else
        echo "not ok $name is in docs/verification.md as it runs: run make verification"
        status=1
    fi
done
if diff <(awk '/^<!-- [a-z]+ -->$/ { exit } { print }' docs/verification.md | grep .) \
    <(grep . tests/verification/head.md); then
    echo "ok the head of docs/verification.md is that of the cases"
else
    echo "not ok the head of docs/verification.md is that of the cases: run make verification"
    status=1
fi
exit $status
