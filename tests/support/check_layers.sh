#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Holds the layers of docs/house-style.md: a file includes nothing from a higher layer, nor from
# another folder of its own layer; the files of src/solve and of src/deck have an order, too; HDF5
# belongs to src/result; below src/command nothing prints, exits or reads the environment.
set -euo pipefail
status=0

bad() {
    echo "$1" >&2
    status=1
}

level() {
    case $1 in
    core) echo 0 ;;
    deck | law | motion) echo 1 ;;
    model) echo 2 ;;
    solve) echo 3 ;;
    result) echo 4 ;;
    study) echo 5 ;;
    plot | export) echo 6 ;;
    command) echo 7 ;;
    main) echo 8 ;;
    *) echo "check_layers: no layer is known for '$1'" >&2 && exit 1 ;;
    esac
}

# The folder a public header speaks for.
home() {
    case $1 in
    error | units | row | curve | checksum | names | numerics) echo core ;;
    contact_law | storey_law) echo law ;;
    part) echo model ;;
    record | signal | spectrum | intensity) echo motion ;;
    analysis | ensemble) echo solve ;;
    study_file) echo result ;;
    study_merge | study_rerun) echo study ;;
    *) echo "$1" ;;
    esac
}

# src/law/contact/hertz.c -> law; include/jostle/units.h -> core; src/main.c -> main
folder_of() {
    local path=$1
    case $path in
    include/jostle/*.h) path=${path#include/jostle/} && home "${path%.h}" ;;
    src/*/*) path=${path#src/} && echo "${path%%/*}" ;;
    *) echo main ;;
    esac
}

# "core/arena.h" and "jostle/row.h" as paths of the tree.
path_of() {
    case $1 in
    jostle/*) echo "include/$1" ;;
    */*) echo "src/$1" ;;
    *) echo "${2%/*}/$1" ;;
    esac
}

# The groups of src/solve, the lowest first; a file belongs to the first pattern that it matches.
# Headers of scratch hold what struct work is made of, and nothing of how it is computed.
solve_group() {
    case ${1#src/solve/} in
    fields.* | pace.* | scale.*) echo "0 base" ;;
    floors/effective* | floors/floor_terms.h | floors/floor_vectors.h) echo "1 matrix" ;;
    state.* | forcing.*) echo "2 state" ;;
    event/*) echo "3 event" ;;
    account/*) echo "4 account" ;;
    contact/gaps.*) echo "5 scratch" ;;
    floors/floors.h | newmark/newmark.h | work.h) echo "5 scratch" ;;
    floors/*) echo "6 floors" ;;
    contact/*) echo "7 contact" ;;
    newmark/run_step.c | newmark/*_newmark.c) echo "10 method" ;;
    dormand_prince/dormand_prince.c) echo "10 method" ;;
    newmark/* | work.c) echo "8 newmark" ;;
    dormand_prince/*) echo "8 dormand_prince" ;;
    run.h | method_list.inc) echo "9 run" ;;
    ensemble/*) echo "11 ensemble" ;;
    analysis.c) echo "12 analysis" ;;
    *) echo "check_layers: no group is known for '$1'" >&2 && exit 1 ;;
    esac
}

# The order of the files of src/deck, the lowest first.
deck_group() {
    case ${1#src/deck/} in
    reader.h | source.c | random.*) echo 0 ;;
    quantity.*) echo 1 ;;
    parameter.*) echo 2 ;;
    expression.*) echo 3 ;;
    replace.c | values.c | options.c) echo 4 ;;
    definition.*) echo 5 ;;
    sweep*.[ch] | bundle.c) echo 6 ;;
    statement.* | scan.c) echo 7 ;;
    deck.c | key.c) echo 8 ;;
    *) echo "check_layers: no place is known for '$1'" >&2 && exit 1 ;;
    esac
}

# Within src/deck: file $1, line $2, includes $3.
check_deck() {
    if [ "$(deck_group "$3")" -gt "$(deck_group "$1")" ]; then
        bad "$1:$2: includes \"${3#src/}\", which is above it in src/deck"
    fi
}

# Within src/solve: file $1, line $2, includes $3.
check_groups() {
    local from to
    from=$(solve_group "$1")
    to=$(solve_group "$3")
    if [ "$from" != "$to" ] && [ "${to%% *}" -ge "${from%% *}" ]; then
        bad "$1:$2: group '${from#* }' includes \"${3#src/}\" of '${to#* }', which is not below it"
    fi
}

while IFS=: read -r file line include; do
    name=${include#*\"}
    name=${name%%\"*}
    from=$(folder_of "$file")
    to=$(folder_of "$(path_of "$name" "$file")")
    case $file:$name in
    src/solve/*:solve/*) check_groups "$file" "$line" "src/$name" ;;
    src/deck/*:deck/*) check_deck "$file" "$line" "src/$name" ;;
    esac
    [ "$from" = "$to" ] && continue
    if [ "$(level "$to")" -ge "$(level "$from")" ]; then
        # A public header may speak of its neighbours of the same layer.
        case $file:$(level "$to") in
        include/*:"$(level "$from")") continue ;;
        esac
        bad "$file:$line: '$from' includes \"$name\" of '$to', which is not below it"
    fi
done < <(grep -rnE --include='*.[ch]' --include='*.inc' '^#include "' include src)

while IFS=: read -r file line include; do
    bad "$file:$line: only src/result includes HDF5: $include"
done < <(grep -rnE --include='*.[ch]' '^#include [<"](hdf5|H5)' include src | grep -v '^src/result/' || true)

# Comments and texts in quotes are no calls.
forbidden='(^|[^a-zA-Z0-9_])(printf|puts|putchar|perror|exit|_exit|abort|getenv|setlocale)[ ]*[(]|[^a-zA-Z_](stdout|stderr)[^a-zA-Z_]'
while IFS= read -r -d '' file; do
    while IFS= read -r hit; do
        bad "$file:$hit (only src/command may print, exit or read the environment)"
    done < <(sed -E 's/"([^"\\]|\\.)*"/""/g; s,//.*,,' "$file" | grep -nE "$forbidden" || true)
done < <(find src -name '*.c' -not -path 'src/command/*' -not -path src/main.c -print0)
exit $status
