#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Holds the layers of docs/house-style.md: a file includes nothing from a higher layer, nor from
# another folder of its own layer; HDF5 belongs to src/result; below src/command nothing prints,
# exits or reads the environment.
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
    plot) echo 6 ;;
    command) echo 7 ;;
    main) echo 8 ;;
    *) echo "check_layers: no layer is known for '$1'" >&2 && exit 1 ;;
    esac
}

# The folder a public header speaks for.
home() {
    case $1 in
    error | units | row | curve) echo core ;;
    contact_law | storey_law) echo law ;;
    record | signal | spectrum | intensity) echo motion ;;
    analysis | ensemble) echo solve ;;
    study_file) echo result ;;
    study_merge) echo study ;;
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

while IFS=: read -r file line include; do
    name=${include#*\"}
    name=${name%%\"*}
    from=$(folder_of "$file")
    to=$(folder_of "$(path_of "$name" "$file")")
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
