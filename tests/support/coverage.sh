#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# coverage.sh FOLDER: the share of lines that ran, for each file of src/, least first, and in all,
# from the counters that a run of programs built with --coverage left in FOLDER.
set -euo pipefail
find "$1/src" -name '*.gcno' -print0 | sort -z | xargs -0 gcov -n 2>/dev/null |
    awk -F"[':%]" '
        /^File / { file = $2 }
        /^Lines executed:/ && file ~ /^src\// {
            lines = $NF; sub(/.* of /, "", lines)
            share[file] = $2; size[file] = lines; file = ""
        }
        END {
            for (f in share) {
                printf "%6.1f %% of %5d  %s\n", share[f], size[f], f | "sort -n"
                ran += share[f] * size[f]; all += size[f]
            }
            close("sort -n")
            if (all) printf "%6.1f %% of %5d  in all\n", ran / all, all
        }'
