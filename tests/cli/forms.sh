#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tables as TSV, CSV and JSON: the same columns and the same cells, in every command that has them.
. tests/support/cli.sh

if ! command -v python3 >/dev/null; then
    skip "the forms of tables agree" "no python3"
    exit
fi
cat >agree.py <<'END'
import csv, json, sys
tsv = [line.rstrip("\n").split("\t") for line in open("tsv")]
comma = list(csv.reader(open("csv", newline="")))
j = json.load(open("json"))
if len(j["columns"]) > len(tsv[0]) or tsv[0] != comma[0]:
    tsv.insert(0, comma[0])  # TSV of one law has no head
assert tsv == comma, "TSV and CSV"
assert tsv[0] == j["columns"], "the heads"
assert len(tsv) == len(j["data"]) + 1 > 1, "lines"
for line, data in zip(tsv[1:], j["data"]):
    assert len(line) == len(data) == len(tsv[0]), "cells of a line"
    for text, cell in zip(line, data):
        if cell is None:
            assert text in ("", "nan", "inf", "-inf"), text
        else:
            assert float(text) == cell if isinstance(cell, (int, float)) else text == cell, text
END

# agree NAME WORD...: the forms of what the command prints agree; its exit status may be 1.
agree() {
    local name=$1 form
    shift
    for form in tsv csv json; do
        "$jostle" "$@" "--$form" >"$form" 2>>messages
        status=$?
        [ "$status" -le 1 ] || break
    done
    [ "$status" -le 1 ] && run python3 agree.py
    expect "$name: TSV, CSV and JSON agree" '[ $status -eq 0 ]'
}

# Sweeps of numbers and of texts; runs fail where the gap is negative.
cat >pair.deck <<'END'
title "a pair"
units kN m s
sweep gap values 1cm 2m -1m
sweep side values A B
building A -floors 1 -mass 100t -stiffness 20MN/m -height 3m
building B -floors 2 -mass 80t -stiffness 9MN/m -height 3m
contact A B -gap $gap -law linear -k 1e5
initial $side -velocity 2m/s
step fixed 2ms
duration 2s
END
agree "gap" gap pair.deck
agree "gaps looked at" gap pair.deck -D side=A -D gap=1cm --limit impacts=0 --range 0:1:4
agree "modes" modes pair.deck
agree "converge" converge pair.deck -D gap=1cm -D side=A -n 3
agree "law" law hertz -k 2.75e9 -m1 1e5 -v 0.5
agree "law of several" law kelvin-voigt -k 1e8 -e 0.6 -m1 1e5 -v 0.5 --compare linear

cp "$root"/input/records/ELCENTRO_1940_NS.AT2 "$root"/input/records/NAPA_2014_68150_HNE.AT2 .
agree "spectra" spectrum ./*.AT2 --periods 0.1,1 --damping 2%,5%
agree "intensities" spectrum ./*.AT2 --intensities
cat >map.deck <<'END'
param T1 1
param T2 1
building A -floors 1 -mass 1000 -stiffness ${1000 * (2 * pi / T1)^2}
building B -floors 1 -mass 1000 -stiffness ${1000 * (2 * pi / T2)^2}
contact A B -gap 1mm -law linear -k 1e6
ground sine -amplitude 1 -frequency 1
step fixed 10ms
duration 3
END
agree "pounding" spectrum --pounding map.deck --periods 0.5,1

run "$jostle" run pair.deck -q
agree "a study" show pair.h5
agree "its demands" show pair.h5 --long
agree "its runs" show pair.h5 --wide
agree "fragility" fragility pair.h5 --edp drift:A --limit 1mm,1m --im gap --at side=A
agree "fragility by first exceedances" fragility pair.h5 --edp drift:A --limit 1mm,1m --im gap --over side --method ida
