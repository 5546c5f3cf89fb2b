#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# with_block.sh NAME FILE: copies its input with the code block behind the line `<!-- NAME -->`
# replaced by FILE.
set -eu
awk -v name="$1" -v file="$2" '
    inside && /^```$/ { while ((getline line < file) > 0) print line; inside = 0 }
    !inside { print }
    $0 == "<!-- " name " -->" { due = 1 }
    due && /^```/ { inside = 1; due = 0 }'
