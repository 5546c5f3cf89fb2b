#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# count.sh BENCH: instructions per step in analysis_run, counted by valgrind for the cases of
# `BENCH -c`, against those recorded in instructions.tsv. Fails where a case takes over a tenth
# more. The count depends on the compiler and its options, $BUILT: with others than those of the
# record there is nothing to compare, which is said. ACCEPT=1 writes the record anew.
set -euo pipefail
bench=$1
record=${0%/*}/instructions.tsv
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

recorded_with=$(sed -n 's/^# //p' "$record" 2>/dev/null || true)
if [ -z "${ACCEPT-}" ] && [ "$recorded_with" != "$BUILT" ]; then
    echo "not counted: built with $BUILT, recorded with $recorded_with"
    exit 0
fi

# Instructions per step of case $1; the log of valgrind where it fails.
count() {
    local steps total
    if ! steps=$(valgrind --tool=callgrind --toggle-collect=*analysis_run \
        --callgrind-out-file="$folder/out" "$bench" -c "$1" 2>"$folder/log"); then
        cat "$folder/log" >&2
        return 1
    fi
    total=$(sed -n 's/^summary: //p' "$folder/out")
    echo $((total / steps))
}

# The cases are counted JOBS at a time: what else runs does not change a count.
if [ "${2-}" = --one ]; then
    count "$3" >"$4/$3"
    exit
fi
mkdir "$folder/counts"
"$bench" -c >"$folder/names"
tr '\n' '\0' <"$folder/names" |
    xargs -0 -P "${JOBS:-1}" -I NAME bash "$0" "$bench" --one NAME "$folder/counts"

status=0
echo "# $BUILT" >"$folder/new"
printf '%-24s %12s %12s\n' 'instructions per step' now recorded
while IFS= read -r name; do
    now=$(cat "$folder/counts/$name")
    printf '%s\t%d\n' "$name" "$now" >>"$folder/new"
    was=$(awk -F '\t' -v name="$name" '$1 == name { print $2 }' "$record" 2>/dev/null || true)
    word=''
    if [ -n "${ACCEPT-}" ]; then
        :
    elif [ -z "$was" ]; then
        word='not recorded: run make bench-count ACCEPT=1'
        status=1
    elif [ $((10 * now)) -gt $((11 * was)) ]; then
        word='over a tenth more'
        status=1
    elif [ $((11 * now)) -lt $((10 * was)) ]; then
        word='less: make bench-count ACCEPT=1 records it'
    fi
    printf '%-24s %12d %12s  %s\n' "$name" "$now" "${was:--}" "$word"
done <"$folder/names"
if [ -n "${ACCEPT-}" ]; then
    cp "$folder/new" "$record"
    echo "recorded in $record, built with $BUILT"
fi
exit $status
