#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check_symbols.sh BUILD: every global symbol starts with the name of its module, behind the prefix
# jostle_ if it is public; the library has public ones only, and they are those of the public headers.
# No static variable changes outside src/command. The names of a module: its file (finish_links.c: finish or
# finish_links), its folder, a header of that folder, and the words below. A count is `n_` and what
# is counted. No product is fused with a sum either: the bits must not depend on the processor.
set -euo pipefail
build=$1
library=$build/object/jostle.a
public=$build/libjostle.a
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
    local symbol=${1#jostle_} file=${2##*/} folder=${2#src/} word header
    symbol=${symbol#n_}
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
    object=$build/object/${source%.c}.o
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

while read -r symbol; do
    case $symbol in
    jostle_*) ;;
    *) bad "$public" "$symbol" "is visible, but not public" ;;
    esac
done < <(nm -P -g --defined-only "$public" 2>/dev/null | awk 'NF > 1 { print $1 }')

# A symbol without the prefix is not one that a public header declares.
while read -r symbol; do
    bad include/jostle/names.h "$symbol" "is declared in a public header, but missing"
done < <(nm -P -g --defined-only "$library" 2>/dev/null | awk 'NF > 1 && $1 !~ /^jostle_/ { print $1 }' |
    sort -u | grep -Fwf - <(sed -e 's|//.*||' include/jostle/*.h) |
    sed -n -e 's/^[a-z].*[ *]\([a-z_0-9]*\)(.*/\1/p' -e 's/^extern .*[ *]\([a-z_0-9]*\)[[;].*/\1/p' |
    grep -Fxf <(nm -P -g --defined-only "$library" 2>/dev/null | awk 'NF > 1 { print $1 }') || :)

while read -r member; do
    bad "$library" "$member" "fuses products with sums"
done < <(objdump -d --no-show-raw-insn "$library" |
    awk '/file format/ { sub(/:$/, "", $1); member = $1 } /\tv?fn?m(add|sub|la|ls)/ { print member }' | sort -u)
exit $status
