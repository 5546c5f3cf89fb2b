#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# However little memory there is, a command ends in good order or says what is wrong. The HDF5
# library crashes where memory runs out amid its work, so it is not called without some to spare.
. tests/support/cli.sh

if [ -n "${JOSTLE_SANITIZED-}" ]; then
    skip "little memory does no harm" "the sanitizers need terabytes of addresses"
    exit
fi

two_buildings pair.deck
sed 's/^param gap.*/sweep gap values 2mm 5mm 8mm 9mm/' pair.deck >study.deck
"$jostle" run -q pair.deck
"$jostle" run -q study.deck
"$jostle" run -q study.deck --shard 1/2 -o one.h5
"$jostle" run -q study.deck --shard 2/2 -o two.h5

# Where the limit is too low to start a program, nothing is said about it.
starts() {
    (ulimit -d "$1" && "$jostle" --version) >"$out" 2>&1
}

# sweep OUTPUT WORD...: the command under limits of 500 kB to 24 MB; OUTPUT is what it writes.
sweep() {
    local limit file=$1
    shift
    fine=0
    short=0
    bad=
    for limit in $(seq 500 1103 24000); do
        starts "$limit" || continue
        rm -f "$file" "$file".part "$file".runs
        run bash -c 'ulimit -c 0; ulimit -d "$0"; exec "$@"' "$limit" "$jostle" "$@"
        if [ $status -eq 0 ] && [ ! -s "$err" ]; then
            fine=$((fine + 1))
        elif [ $status -eq 3 ] && said "out of memory" && [ "$(wc -l <"$err")" -eq 1 ] && [ ! -e "$file" ] && [ ! -e "$file".part ]; then
            short=$((short + 1))
        else
            bad="$bad $limit:$status"
        fi
    done
    [ -z "$bad" ] || echo "limits and status:$bad"
    expect "$1 $2 does its work or says that memory is out" '[ -z "$bad" ] && [ $short -gt 0 ] && [ $fine -gt 0 ]'
}

sweep none show pair.h5
sweep none show study.h5
sweep new.h5 run pair.deck -q -o new.h5
sweep whole.h5 merge one.h5 two.h5 -q -o whole.h5
"$jostle" run -q pair.deck -D gap=8mm -o other.h5
sweep none compare pair.h5 other.h5
