#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check_script.sh [FILE]...: holds src/plot to safe_put of src/core/safe.h, because gnuplot executes
# what it reads: a text in a comment of a script runs commands once it has a line break. Without
# safe_put only literals reach a script or its data. A literal is a text in quotes, a choice of two, or
# an element of a table that the list below names. The names of blocks of data are literals, too.
set -euo pipefail
[ $# -gt 0 ] || set -- src/plot/*.c

awk -v tables='colour dash font heading before between comma palette power dark data words FONT' '
BEGIN { format_of["fprintf"] = 2; format_of["panelseries"] = 3; format_of["canvasblock"] = 3; format_of["datawrite"] = 5 }
BEGIN { n = split(tables, word, " "); while (n > 0) is_table[word[n--]] = 1 }

# True if the argument, in which "" stands for a text in quotes, is a literal.
function is_literal(x,   part) {
    gsub(/[ \n]/, "", x)
    if (match(x, /\?[^?:]*:[^?:]*$/)) {
        split(substr(x, RSTART + 1), part, ":")
        return is_literal(part[1]) && is_literal(part[2])
    }
    if (x ~ /^("")+$/) return 1
    if (x ~ /^head->(name|doc)$/) return 1
    gsub(/\[[^]]*\]|\([^)]*\)/, "", x)
    sub(/^.*(->|\.|\*)/, "", x)
    sub(/^.*_/, "", x)
    return x in is_table
}

function bad(text) {
    printf "%s:%d: only literals and safe_put reach a script, not %s\n", file, line, text
    status = 1
}

# Checks the arguments of one call, from that which is its format on.
function check(call,   k, rest, one) {
    if (!(call in format_of)) {
        if (!is_literal(quoteless[1])) bad(argument[1])
        return
    }
    k = format_of[call]
    if (argument[k] ~ /^const char \*/) return  # it is declared here
    if (!is_literal(quoteless[k]) && argument[k] != "p->format") bad("the format " argument[k])
    rest = argument[k++]
    while (match(rest, /%[-+ #0]*[*0-9]*(\.[*0-9]*)?[hlzjtL]*[a-zA-Z%]/)) {
        one = substr(rest, RSTART, RLENGTH)
        rest = substr(rest, RSTART + RLENGTH)
        if (one ~ /%$/) continue
        k += gsub(/\*/, "*", one)
        if (one ~ /s$/ && !is_literal(quoteless[k])) bad(argument[k])
        k++
    }
}

# Takes the file apart into calls, their arguments and the texts in quotes.
function take(text,   call, at, depth, n, c, name, size) {
    line = 1
    while (match(text, /(^|[^a-z_])(fprintf|fputs|vfprintf|fwrite|dprintf|panel_series|canvas_block|data_write)\(/)) {
        call = substr(text, RSTART, RLENGTH)
        name = substr(text, 1, RSTART + RLENGTH)
        line += gsub(/\n/, "", name)
        gsub(/[^a-z]/, "", call)
        text = substr(text, RSTART + RLENGTH)
        split("", argument); split("", quoteless)
        n = depth = 1
        size = length(text)
        for (at = 1; at <= size && depth > 0; at++) {
            c = substr(text, at, 1)
            if (c == "\"") {
                match(substr(text, at), /^"([^"\\]|\\.)*"/)
                argument[n] = argument[n] substr(text, at, RLENGTH)
                quoteless[n] = quoteless[n] "\"\""
                at += RLENGTH - 1
                continue
            }
            depth += c ~ /[(\[{]/ ? 1 : c ~ /[])}]/ ? -1 : 0
            if (depth == 0) break
            if (c == "," && depth == 1) { n++; continue }
            if (argument[n] == "" && c ~ /[ \n]/) continue
            argument[n] = argument[n] c
            quoteless[n] = quoteless[n] c
        }
        if (call == "vfprintf" && file ~ /plot\/(panel|canvas)\.c$/) continue  # of the last three
        if (call ~ /^(vfprintf|fwrite|dprintf)$/) bad("by " call)
        else check(call)
        name = substr(text, 1, at)
        line += gsub(/\n/, "", name)
        text = substr(text, at)
    }
}

FNR == 1 { take(all); all = ""; file = FILENAME }
{ sub(/^[ \t]*\/\/.*/, ""); sub(/[ \t]\/\/ .*/, ""); all = all $0 "\n" }
END { take(all); exit status }' "$@" >&2
