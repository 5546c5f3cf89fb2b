#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Studies of one to six sweeps, with datasets on both sides of 64 values and of 64 KiB, which HDF5
# stores in different ways: run, run in parts and merged, all give the same datasets.
. tests/support/cli.sh

if ! command -v h5diff >/dev/null; then
    skip "studies of any shape are written, in parts too" "no h5diff"
    exit 0
fi

# sized FLOORS N...: shape.deck with a sweep of each of these sizes. Its largest datasets have
# FLOORS values a run; the sweeps change nothing but the load, so that a run takes 20 steps.
sized() {
    local floors=$1 i=0 n load=1
    shift
    : >shape.deck
    for n in "$@"; do
        i=$((i + 1))
        echo "sweep s$i range $i $((i + 1)) $n" >>shape.deck
        load="$load + \$s$i"
    done
    cat >>shape.deck <<END
building A -floors $floors -mass 1 -stiffness 400
contact A:1 wall -gap 0.01 -law linear -k 1000
load A:all constant \${$load}
step fixed 0.01
duration 0.2
END
}

# check_deck SENTENCE WORD...: shape.deck with these words on the command line.
check_deck() {
    local sentence=$1 whole k parts=0
    shift
    run "$jostle" run shape.deck -q -o whole.h5 "$@"
    whole=$status
    for k in 1 2 3; do
        run "$jostle" run shape.deck -q --shard $k/3 -o part$k.h5 "$@"
        parts=$((parts + status))
    done
    run "$jostle" merge -q part?.h5 -o merged.h5
    expect "$sentence" \
        '[ $whole -eq 0 ] && [ $parts -eq 0 ] && [ $status -eq 0 ] && same whole.h5 merged.h5'
    rm -f part?.h5* merged.h5
}

# check_shape FLOORS N...
check_shape() {
    local floors=$1 runs=1 n
    sized "$@"
    shift
    for n in "$@"; do
        runs=$((runs * n))
    done
    check_deck "$(echo "$@" | tr ' ' x): $runs runs, $((8 * floors * runs)) bytes a dataset"
    rm -f whole.h5*
}

# 64 values and one or a few more; 65536 bytes and a few less or more.
check_shape 1 64
check_shape 1 65
check_shape 127 64
check_shape 128 64
check_shape 126 65
check_shape 1 8 8
check_shape 1 8 9
check_shape 128 8 8
check_shape 17 60 9
check_shape 1 4 4 4
check_shape 31 16 4 4
check_shape 33 16 4 4
check_shape 24 44 4 3
check_shape 1 2 2 4 4
check_shape 9 33 2 4 4
check_shape 1 2 2 2 2 4
check_shape 9 4 4 4 4 4
check_shape 1 2 2 2 2 2 2
check_shape 1 2 2 2 2 2 3
check_shape 128 2 2 2 2 2 2
check_shape 3 4 4 4 4 4 3

# Texts of more than the 64 KiB that an object header takes: the deck, its title, the name of a
# parameter, with it the command line, and the labels of a sweep together.
long() {
    head -c 70000 /dev/zero | tr '\0' "$1"
}
sized 1
{
    echo "# $(long c)"
    echo "title \"$(long t)\""
    echo "param $(long p) 1"
    echo "sweep load values 1 2"
    echo "sweep label values $(seq 40 | sed "s/^/w/; s/$/$(head -c 2000 /dev/zero | tr '\0' l)/" | tr '\n' ' ')"
    sed "s/^load.*/param note \$label/" shape.deck
    echo "load A:1 constant \${\$load + \$$(long p)}"
} >long.deck
mv long.deck shape.deck
check_deck "texts of more than 64 KiB are written" -D "$(long p)=2"
run "$jostle" show whole.h5
expect "and read" '[ $status -eq 0 ] && grep -q "^study of 80 runs, 0 failed" "$out"'
