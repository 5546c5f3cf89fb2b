#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# tidy.sh FLAG... -- FILE...: clang-tidy on the files with these compiler flags, without its count of
# warnings in system headers.
set -u
flags=''
while [ "$1" != -- ]; do
    flags="$flags $1"
    shift
done
shift
log=$(mktemp)
# shellcheck disable=SC2086  # the flags are one word each
clang-tidy --quiet "$@" -- $flags 2>"$log"
status=$?
grep -v 'warnings\{0,1\} generated' "$log" >&2
rm -f "$log"
exit $status
