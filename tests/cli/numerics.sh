#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The results of the decks in tests/numerics have the bits on record in results.tsv, or the version of
# the numerics is another one: docs/architecture.md, "The version of the numerics". Bits depend on the
# compiler and its options, $BUILT, and on the libraries: with others than those of the record there is
# nothing to compare. ACCEPT=1 records the bits of a new version, ACCEPT=datasets those of the same
# version where datasets were added or renamed.
record=$PWD/tests/numerics/results.tsv
accept=${ACCEPT-}
built=${BUILT-unknown}
. tests/support/cli.sh
ln -s "$root/tests" tests
mkdir -p input
ln -s "$root/input/records" input/records

libraries="$(getconf GNU_LIBC_VERSION 2>/dev/null), GSL $(pkg-config --modversion gsl 2>/dev/null)"
fused=$(grep -qw fma /proc/cpuinfo 2>/dev/null && echo ', fma')  # the C library has functions for it
tag="$built, $libraries$fused"
recorded_tag=$(sed -n 's/^# built: //p' "$record" 2>/dev/null)
recorded_version=$(sed -n 's/^# version: //p' "$record" 2>/dev/null)

for deck in tests/numerics/*.deck; do
    name=$(basename "$deck" .deck)
    run "$jostle" run "$deck" -q -o "$name.h5"
    expect "$name runs" '[ $status -eq 0 ] && [ ! -s "$err" ]'
    sum=$("$jostle" verify "$name.h5" | sed -n 's/^results *SHA-256 //p')
    printf '%s\t%s\n' "$name" "$sum" >>now
done
version=$(h5dump -a /numerics_version newmark.h5 | sed -n 's/.*(0): //p')
printf '# version: %s\n# built: %s\n' "$version" "$tag" | cat - now >new

# changed: the decks whose results are not those on record.
changed() {
    awk -F '\t' 'NR == FNR { was[$1] = $2; next } was[$1] != $2 { print $1 }' "$record" now | tr '\n' ' '
}

if [ -n "$accept" ]; then
    if [ "$accept" = 1 ] && [ "$version" = "$recorded_version" ] && [ "$tag" = "$recorded_tag" ] && [ -n "$(changed)" ]; then
        echo "not ok the results of $(changed)have changed: raise NUMERICS_VERSION in include/jostle/numerics.h first"
        failed=1
    else
        cp new "$record"
        echo "recorded in tests/numerics/results.tsv, version $version, built with $tag"
    fi
elif [ "$tag" != "$recorded_tag" ]; then
    skip "results have the bits on record" "built with $tag, recorded with $recorded_tag"
elif [ "$version" != "$recorded_version" ]; then
    expect "results of version $version are on record: make numerics ACCEPT=1 records them" false
else
    expect "results have the bits on record; else raise NUMERICS_VERSION in include/jostle/numerics.h: $(changed)" '[ -z "$(changed)" ]'
fi
