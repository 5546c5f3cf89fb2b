#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# case.sh JOSTLE FOLDER CASE: one case of the verification manual. CASE.sh runs it and prints the
# values, `name TAB text` a line; CASE.md is the page, in which {{name}} stands for the text of that
# name, and alone on a line for all its lines, a table for example. Writes FOLDER/CASE.md.
set -eu
jostle=$1
folder=$2
name=$3
here=tests/verification
root=$PWD
work=$folder/$name.work

. $here/common.sh

mkdir -p "$work"
# shellcheck source=/dev/null  # each case is checked by itself
. "$here/$name.sh" >"$work/values"
awk -f $here/fill.awk "$work/values" "$here/$name.md" >"$work/page.md"
{
    echo
    echo "<!-- $name -->"
    cat "$work/page.md"
} >"$folder/$name.md"
