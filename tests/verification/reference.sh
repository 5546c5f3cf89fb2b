# SPDX-License-Identifier: GPL-3.0-or-later
# The reference solutions of tests/verify/reference: one row a case.

for deck in tests/verify/reference/*.deck; do
    one=$(basename "$deck" .deck)
    simulate "$one" "$deck"
    table -v case="$one" -f $here/reference.awk "${deck%.deck}.tsv" "$work/$one.tsv"
done
pick reference 1 4 5 6 7 | tr _ ' ' >"$work/errors"
draw 760
