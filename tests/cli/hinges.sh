#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Frames with hinges: what check, the summary, tables, the file and studies say of them.
. tests/support/cli.sh

cat >portal.deck <<END
title "A portal with hinges"
units kN m s
param pga 0.5
building A -floors 1 -mass 50t -height 3.5m
frame A -bays 6m -modulus 200GPa -columns-inextensible
columns A:1 -I 2e-4
beams A:1 -I 2.5e-4
hinges A bases bilinear -yield 260kN*m -hardening 0.03 -stiffness 680MN*m
damping A rayleigh 5%
ground record $root/input/records/ELCENTRO_1940_NS.AT2 -pga \${pga * 9.81}
step fixed 2ms
duration 8
END
run "$jostle" check portal.deck
expect "check counts the hinges" '[ $status -eq 0 ] && grep -q "frame: 1 x 1 from 2 columns and 1 beams, 2 hinges" "$out"'
expect "and says which storeys they are in" 'grep -qE "^ +1 +50 +13752.6 +3.5 +hinges$" "$out"'
sed 's/^building.*/& -stiffness 1e3/; s/^damping/storey A:1 bilinear -yield 10 -hardening 0.01\n&/' portal.deck >both.deck
run "$jostle" check both.deck
expect "beside a law of the storey" 'grep -qE "^ +1 +50 +14752.6 +3.5 +bilinear, hinges$" "$out"'
run "$jostle" run portal.deck -o portal.h5
expect "the summary has plastic rotations and ductilities" '[ $status -eq 0 ] && grep -q "^largest of          plastic                ductility" "$out" && grep -qE "^A columns +0\.0[0-9]+ column_1_[12] +[0-9.]+ column_1_[12]" "$out"'
run "$jostle" show portal.h5 --tsv
expect "a table has the signed extremes, nan at ends without a hinge" '[ "$(cut -f 2,3,5 "$out" | grep -cE "^A/column_1_1.(plastic_rotation_i_max.0\.00|plastic_rotation_i_min.-0\.00|rotation_j_max.nan)")" -eq 3 ]'
expect "members without hinges have none" 'cut -f 2,3,5 "$out" | grep -qE "^A/beam_1_1.plastic_rotation.0$"'
run "$jostle" show portal.h5 --json
expect "so has JSON" 'grep -q "\"plastic_rotation\": 0" "$out" && grep -q "\"rotation_j_max\": null" "$out"'
if command -v h5ls >/dev/null; then
    run h5ls portal.h5/buildings/A/members
    expect "histories are written on request only" '! grep -q rotation "$out"'
    echo 'output -fields members' >>portal.deck
    run "$jostle" run portal.deck -o fields.h5
    run h5ls fields.h5/buildings/A/members
    expect "histories have rotations and plastic rotations" '[ "$(grep -cE "^(plastic_)?rotation_[ij] " "$out")" -eq 4 ]'
fi
sed -e '/^output/d' -e 's/^param pga .*/sweep pga range 0.1 0.9 5 -as intensity/' portal.deck >study.deck
run "$jostle" run study.deck -o study.h5 -j 2
expect "a study of hinges runs" '[ $status -eq 0 ]'
run "$jostle" show study.h5 --long --edp plastic-rotation:A --edp hinge-ductility:A:column_1_2
expect "studies know the demands of hinges" '[ $status -eq 0 ] && [ "$(grep -c "plastic-rotation:A" "$out")" -ge 5 ] && grep -q "hinge-ductility:A:column_1_2" "$out"'
sed '/^hinges/d' study.deck >plain.deck
run "$jostle" run plain.deck -o plain.h5
run "$jostle" show plain.h5 --long --edp plastic-rotation:A
expect "a study without hinges has no such demand" '[ $status -eq 2 ] && grep -q "plastic-rotation:A: no building has hinges" "$err"'
run "$jostle" deck hinges
expect "the reference has the statement and the storey laws" '[ $status -eq 0 ] && grep -q "bouc-wen" "$out" && grep -q -- "-stiffness LIST *N\*m\|-stiffness LIST" "$out"'
