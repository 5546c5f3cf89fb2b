#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# make.sh JOSTLE FOLDER PAGE [CASE...]: runs the cases of the page verification or papers, all if none is
# named, JOBS at a time, and writes FOLDER/CASE.md for each, its pictures beside it. All cases
# together give FOLDER/PAGE.md.
set -eu
jostle=$1
folder=$2
page=$3
shift 3
here=tests/verification
all=$(cat $here/$page.cases)

mkdir -p "$folder"
if [ $# -gt 0 ]; then
    printf '%s\n' "$@"
else
    printf '%s\n' "$all"
fi | xargs -n 1 -P "${JOBS:-2}" sh $here/case.sh "$jostle" "$folder"
if [ $# -eq 0 ]; then
    for name in $all; do
        cat "$folder/$name.md"
    done | cat $here/$page.head.md - >"$folder/$page.md"
fi
