#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every example deck runs, without a warning, and its result file can be read back.
set -u
folder=${TMPDIR:-/tmp}/examples
status=0
mkdir -p "$folder"

for deck in input/*.deck; do
    name=$(basename "$deck" .deck)
    result=$folder/$name.h5
    if "$JOSTLE" run "$deck" -o "$result" >"$folder/printed" 2>"$folder/errors" &&
        [ ! -s "$folder/errors" ] && "$JOSTLE" show "$result" | cmp -s - "$folder/printed"; then
        echo "ok $deck runs and its result reads back"
    else
        echo "not ok $deck runs and its result reads back"
        cat "$folder/errors"
        status=1
    fi
done
exit $status
