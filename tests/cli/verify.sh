#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle verify: a result is as it was written, however it is stored; a changed one is told; runs of
# a study give the same bits again. Damaged parts never merge to another result. JOSTLE_LONG=1
# damages more of them.
. tests/support/cli.sh

two_buildings one.deck
"$jostle" run one.deck -q
run "$jostle" verify one.h5
expect "a run is as it was written" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -qx "one.h5: the data are as they were written" "$out" && [ "$(grep -cE " SHA-256 [0-9a-f]{64}$" "$out")" -eq 2 ]'
cp "$out" first
"$jostle" run one.deck -q -o other.h5
run "$jostle" verify other.h5
expect "another run of the deck has other attributes and the same results" '[ "$(grep results "$out")" = "$(grep results first)" ] && [ "$(grep ^data "$out")" != "$(grep ^data first)" ]'
h5repack -l /time:CHUNK=10 -f /time:GZIP=5 -l /buildings/A/displacement:CHUNK=7x1 one.h5 packed.h5
run "$jostle" verify packed.h5
expect "chunks and compression do not count" '[ $status -eq 0 ] && [ "$(tail -n 2 "$out")" = "$(tail -n 2 first)" ] && ! cmp -s one.h5 packed.h5'
run "$jostle" verify one.h5 --run 1
expect "a single run has no runs" '[ $status -eq 2 ] && said "one.h5 is not one"'
run "$jostle" verify one.deck
expect "a deck is no result" '[ $status -eq 2 ] && said "one.deck is not an HDF5 file"'
run "$jostle" verify nothing.h5
expect "nor is what is not there" '[ $status -eq 2 ] && said "nothing.h5"'
run "$jostle" verify one.h5 other.h5
expect "one file is expected" '[ $status -eq 2 ] && said "one result file is expected, not 2"'
run "$jostle" verify one.h5 --rerun 0
expect "and a number of runs" '[ $status -eq 2 ] && said "--rerun takes a number of runs"'

study_of_records study.deck 4 200
sed 's/^step fixed 1ms/include step.deck/' study.deck >including.deck
mv including.deck study.deck
echo 'step fixed 1ms' >step.deck
"$jostle" run study.deck -q
run "$jostle" verify study.h5 --rerun 5 --run 1 --run 12
expect "runs of a study give the same bits" '[ $status -eq 0 ] && grep -qE "^[567] runs computed again, all values with the same bits: 1, .*12 of 12$" "$out"'
run "$jostle" verify study.h5 --rerun 3
cp "$out" draw
run "$jostle" verify study.h5 --rerun 3
expect "a draw is the same again" 'cmp "$out" draw'
run "$jostle" verify study.h5 --run 13
expect "a run must be there" '[ $status -eq 2 ] && said "study.h5 has no run 13; its study has the runs 1 to 12"'
echo '# a comment' >>step.deck
run "$jostle" verify study.h5 --run 7
expect "a comment in an included deck does not count" '[ $status -eq 0 ]'
echo 'step fixed 0.5ms' >step.deck
run "$jostle" verify study.h5 --run 7
expect "another step does" '[ $status -eq 2 ] && said "study.h5: run 7 cannot be computed again: its statements, a file that they name or the version"'
echo 'step fixed 1ms' >step.deck
awk '{ print 2 * $1 }' records/1.txt >records/0.txt
run "$jostle" verify study.h5 --run 7
expect "a deck that has more runs has run 7 at another number" '[ $status -eq 0 ] && grep -q "^1 run computed again.*: 7 of 12$" "$out"'
rm records/0.txt
mkdir away
mv study.deck step.deck records away
run "$jostle" verify study.h5 --run 7 --deck away/study.deck
expect "the deck may lie elsewhere" '[ $status -eq 0 ]'
mv away/* .
"$jostle" run study.deck -q --shard 2/3
run "$jostle" verify study.2-of-3.h5 --rerun 2
expect "a part is verified too" '[ $status -eq 0 ] && grep -q "^2 runs computed again" "$out"'

# changed FILE DATASET: the first value of a dataset of doubles is another one.
changed() {
    python3 - "$@" <<'END'
import sys, h5py
with h5py.File(sys.argv[1], "r+") as f:
    f[sys.argv[2]][...] = f[sys.argv[2]][...] * (1 + 2**-52)
END
}
if python3 -c 'import h5py' 2>/dev/null; then
    cp study.h5 changed.h5
    changed changed.h5 buildings/A/envelope/drift
    run "$jostle" verify changed.h5
    expect "a last bit that changed is found" '[ $status -eq 1 ] && said "changed.h5: its data have changed since it was written: their checksum differs"'
    python3 -c 'import h5py
with h5py.File("study.h5", "r+") as f: f["sweep/gap"].attrs["long_name"] = "other"'
    run "$jostle" verify study.h5
    expect "and an attribute" '[ $status -eq 1 ] && said "study.h5: its data have changed"'
else
    skip "changed values and attributes are found" "no h5py"
fi

# in_hdf5: did the sanitizers end the program in a function of the HDF5 library? That library reads
# beyond its memory in some damaged files. The signal is theirs, so jostle cannot name the file.
in_hdf5() {
    [ -n "${JOSTLE_SANITIZED-}" ] &&
        sed -n '/^    #0 /,/^$/p' "$err" | grep -v interceptor | head -n 1 | grep -q libhdf5
}

# Single bits are turned over, at places drawn by awk's generator, seed 2.
"$jostle" run one.deck -q --force
cp one.h5 sound.h5
for bit in $(awk -v n=60 -v size="$(stat -c %s sound.h5)" 'BEGIN {
    srand(2)
    for (i = 0; i < n; i++) print int(rand() * size) ":" int(rand() * 8) }'); do
    byte=$(od -An -tu1 -j "${bit%:*}" -N 1 sound.h5)
    # shellcheck disable=SC2059  # the byte is written as an octal escape
    printf "\\$(printf %03o $((byte ^ 1 << ${bit#*:})))" |
        dd of=one.h5 bs=1 seek="${bit%:*}" conv=notrunc 2>/dev/null
    for words in "verify one.h5" "show one.h5" "plot one.h5 overview --script drawn --force"; do
        # shellcheck disable=SC2086
        run timeout 20 "$jostle" $words
        [ $status -eq 0 ] || { [ $status -eq 1 ] && [ "${words%% *}" = verify ]; } ||
            { [ $status -eq 2 ] && said one.h5; } || in_hdf5 ||
            echo "bit $bit, $words: status $status, $(cat "$err")" >>misread
    done
    cp sound.h5 one.h5
done
expect "a file with a wrong bit is read or called damaged" '[ ! -s misread ] || ! cat misread'

# Bytes of parts are changed one by one, at places drawn by awk's generator, seed 1.
"$jostle" run study.deck -q --force
for part in 1 2 3; do
    "$jostle" run study.deck -q --shard $part/3 --force
done
"$jostle" show study.h5 --tsv >whole.tsv
cp study.2-of-3.h5 sound.h5
size=$(stat -c %s sound.h5)
# The sanitizers slow each merge down; they see the first of the same places.
places=450
[ -z "${JOSTLE_SANITIZED-}" ] || places=60
[ -z "${JOSTLE_LONG-}" ] || places=2000
awk -v n=$places -v size="$size" 'BEGIN {
    srand(1)
    for (i = 0; i < n; i++) print int(rand() * size), 1 + int(rand() * 255) }' >damage
refused=0 same=0 other=0
while read -r at add; do
    cp sound.h5 study.2-of-3.h5
    byte=$(od -An -tu1 -j "$at" -N 1 sound.h5)
    # shellcheck disable=SC2059  # the byte is written as an octal escape
    printf "\\$(printf %03o $(((byte + add) % 256)))" |
        dd of=study.2-of-3.h5 bs=1 seek="$at" conv=notrunc 2>/dev/null
    run timeout 20 "$jostle" merge study.?-of-3.h5 -o merged.h5 -q --force
    if [ $status -ne 0 ]; then
        refused=$((refused + 1))
        said study.2-of-3.h5 || in_hdf5 || echo "place $at, $add more: status $status, $(cat "$err")" >>unnamed
    elif "$jostle" show merged.h5 --tsv | cmp -s - whole.tsv; then
        same=$((same + 1))
    else
        other=$((other + 1))
        echo "place $at, $add more" >>others
    fi
    rm -f merged.h5 merged.h5.part
done <damage
echo "# of $(wc -l <damage) damaged parts $refused are refused, $same have the damage in unused space"
expect "no damaged part merges to another result" '[ $other -eq 0 ] && [ $((refused + same)) -eq "$(wc -l <damage)" ] && [ $refused -gt $same ]'
expect "refused parts are named, also where the HDF5 library crashes" '[ ! -s unnamed ] || ! cat unnamed'
