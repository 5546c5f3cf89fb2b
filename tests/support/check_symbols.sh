#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check_symbols.sh LIBRARY: every global symbol starts with the name of its module, and no static
# variable changes outside src/command. The names of a module: its file (finish_links.c: finish or
# finish_links), its folder, a header of that folder, and the words below. A count is `n_` and what
# is counted. No product is fused with a sum either: the bits must not depend on the processor.
set -euo pipefail
library=$1
status=0

# Words of public headers, and of what a public header declares.
words() {
    case $1 in
    core) echo "error diagnostics row range units unit dimension" ;;
    deck) echo "deck" ;;
    law) echo "contact storey" ;;
    motion) echo "record signal" ;;
    model) echo "model field statement" ;;
    solve) echo "analysis results energy peak" ;;
    result) echo "result report" ;;
    esac
}

bad() {
    echo "$1: '$2' $3" >&2
    status=1
}

allowed() {
    local symbol=${1#n_} file=${2##*/} folder=${2#src/} word header
    file=${file%.c}
    folder=${folder%%/*}
    for header in "src/$folder"/*.h; do
        header=${header##*/}
        set -- "$@" "${header%.h}"
    done
    shift 2
    # shellcheck disable=SC2046  # one word each
    for word in "$file" "${file%%_*}" "$folder" $(words "$folder") "$@"; do
        case $symbol in
        "$word" | "$word"_* | "$word"s) return 0 ;;
        esac
    done
    return 1
}

while IFS= read -r source; do
    object=${library%/*}/object/${source%.c}.o
    while read -r symbol; do
        allowed "$symbol" "$source" || bad "$source" "$symbol" "does not start with its module's name"
    done < <(nm -P -g --defined-only "$object" | cut -d ' ' -f 1)
    case $source in
    src/command/*) continue ;;
    esac
    # Const tables of addresses are in .data.rel.ro.
    while read -r symbol; do
        bad "$source" "$symbol" "is a static variable that changes"
    done < <(objdump -t "$object" |
        awk 'NF > 4 && $(NF - 2) ~ /^\.(data|bss|tdata|tbss)$/ && $NF !~ /^\./ { print $NF }')
done < <(find src -name '*.c' -not -path src/main.c | sort)

while read -r member; do
    bad "$library" "$member" "fuses products with sums"
done < <(objdump -d --no-show-raw-insn "$library" |
    awk '/file format/ { sub(/:$/, "", $1); member = $1 } /\tv?fn?m(add|sub|la|ls)/ { print member }' | sort -u)
exit $status
