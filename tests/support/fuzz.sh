#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# fuzz.sh FOLDER FUZZER...: runs each fuzzer for SECONDS_EACH seconds. The project's own decks and
# records are the seeds; what is found is kept in FOLDER/corpus. A crash leaves its input in FOLDER.
set -euo pipefail
folder=$1
shift
seeds=()
for seed in input tests/deck tests/records; do
    [ -d "$seed" ] && seeds+=("$seed")
done
for fuzzer in "$@"; do
    name=${fuzzer##*/}
    corpus=$folder/corpus/$name
    mkdir -p "$corpus"
    echo "$name: ${SECONDS_EACH:-30} s"
    if ! "$fuzzer" -max_total_time="${SECONDS_EACH:-30}" -max_len=65536 -timeout=20 -verbosity=0 \
        -print_final_stats=1 -artifact_prefix="$folder/$name-" "$corpus" "${seeds[@]}" \
        >"$folder/$name.log" 2>&1; then
        cat "$folder/$name.log"
        exit 1
    fi
    grep -E 'number_of_executed_units|new_units_added' "$folder/$name.log" || true
done
