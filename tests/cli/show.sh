#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle show in its three forms, and show and plot on files that are no results.
. tests/support/cli.sh

two_buildings pair.deck
run "$jostle" run -q pair.deck
run "$jostle" show pair.h5
expect "show prints the summary" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "two buildings" "$out" && grep -q "jankowski" "$out"'
expect "no line is wider than 100 characters" '! grep -qE "^.{101,}" "$out"'

run "$jostle" show --tsv pair.h5
expect "--tsv prints lines of one length" '[ $status -eq 0 ] && [ "$(awk -F "\t" "{ print NF }" "$out" | sort -u | wc -l)" -eq 1 ] && [ "$(wc -l <"$out")" -gt 50 ]'
expect "its numbers are full and have a point" 'grep -qP "\tpeak_force\t|force\t.*\t[0-9]+\.[0-9]{6,}" "$out"'
run "$jostle" show pair.h5 --json
if command -v python3 >/dev/null; then
    expect "--json is JSON" '[ $status -eq 0 ] && python3 -m json.tool "$out" >/dev/null'
else
    skip "--json is JSON" "no python3"
fi
expect "numbers have no more digits than tell them apart" 'grep -qx "\"step\": 0.001," "$out" && grep -q "9.80665,\$" "$out"'
run "$jostle" show pair.h5 --json --tsv
expect "--json and --tsv exclude each other" '[ $status -eq 2 ] && [ ! -s "$out" ]'

head -c 4000 pair.h5 >truncated.h5
: >empty.h5
echo 'these are only words' >words.h5
head -c 20000 /dev/urandom >noise.h5
cp pair.h5 scribbled.h5
printf 'xxxxxxxxxxxxxxxx' | dd of=scribbled.h5 bs=1 seek=96 conv=notrunc 2>/dev/null
files="truncated empty words noise scribbled"
if python3 -c 'import h5py' 2>/dev/null; then
    python3 -c 'import h5py; h5py.File("foreign.h5", "w")["x"] = [1, 2]'
    files="$files foreign"
fi
for command in show plot; do
    for file in $files; do
        run "$jostle" $command $file.h5
        expect "$command refuses a file that is $file" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "$file.h5"'
    done
    run "$jostle" $command .
    expect "$command refuses a folder" '[ $status -eq 2 ] && [ ! -s "$out" ] && said ". is a directory"'
done

# A dataset that was never written has a shape, but no bytes.
if python3 -c 'import h5py' 2>/dev/null; then
    sed 's/^param gap.*/sweep gap values 2mm 5mm/' pair.deck >study.deck
    for name in status message contacts/envelope/force; do
        rm -f study.h5
        run "$jostle" run -q study.deck
        python3 - "$name" <<'END'
import sys, h5py
name = sys.argv[1]
with h5py.File("study.h5", "r+") as f:
    old = f[name]
    attributes = {k: v for k, v in old.attrs.items() if k != "DIMENSION_LIST"}
    scales = [d[0] for d in old.dims]
    del f[name]
    new = f.create_dataset(name, old.shape, old.dtype)
    new.attrs.update(attributes)
    for d, scale in zip(new.dims, scales):
        d.attach_scale(scale)
END
        run "$jostle" show study.h5
        expect "show of a study without the values of $name says so" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "dataset '"'${name##*/}'"' is not all there"'
    done
else
    skip "show of a study without values says so" "no h5py"
fi
