#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# No function over 60 lines, no C file over 400, no line over 100 columns.
set -euo pipefail
export LC_ALL=C.UTF-8
find include src tests -name '*.[ch]' -print0 | sort -z | xargs -0 awk '
    function bad(text) { printf "%s:%d: %s\n", FILENAME, FNR, text; status = 1 }
    FNR == 1 { start = 0 }
    FNR == 401 { bad("the file is over 400 lines") }
    length($0) > 100 { bad("the line is over 100 columns") }
    # A body opens at the end of a line that starts in column 1 or continues one that does.
    /^[a-z].*\(/ && !/;$/ { head = FNR }
    /\) \{$/ && head && !start && (/^[a-z]/ || FNR - head < 6) { start = head }
    /^}/ {
        if (start && FNR - start + 1 > 60) {
            bad("the function that ends here is " FNR - start + 1 " lines long; the limit is 60")
        }
        start = head = 0
    }
    END { exit status }'
