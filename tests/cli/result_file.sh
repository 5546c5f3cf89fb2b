#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The result file has the groups, datasets and attributes that its users count on.
. tests/support/cli.sh

two_buildings pair.deck 'storey A:1 bilinear -yield 200kN -hardening 0.02' 'contact B wall -gap 1 -law hertz -k 1e6' 'link A:2 B:2 -stiffness 5'
run "$jostle" run -q pair.deck
expect "the deck runs" '[ $status -eq 0 ]'

if command -v h5ls >/dev/null; then
    h5ls -r pair.h5 >"$out"
    for group in / /buildings /buildings/A /buildings/A/envelope /contacts /contacts/envelope /impacts /energy /ground; do
        expect "$group is a group" 'grep -qE "^$group  *Group" "$out"'
    done
    for dataset in time buildings/B/{floor,mass,stiffness,height,period,displacement,velocity,acceleration,drift,storey_shear} \
        buildings/B/envelope/{displacement,drift_time} buildings/A/envelope/residual_drift contacts/{contact,name,left,right,law,left_floor,right_floor,gap,effective_mass,restitution,calibrated,force,penetration} \
        contacts/envelope/{force,force_time,penetration,impulse,impacts,dissipated} \
        impacts/{impact,contact,t_start,t_end,v_approach,v_rebound,peak_force,max_penetration,impulse,dissipated} \
        energy/{input,kinetic,strain,damping,hysteretic,contact,residual} ground/{A,B}; do
        expect "/$dataset is a dataset" 'grep -qE "^/$dataset  *Dataset" "$out"'
    done
    expect "a building that cannot yield has no residual drift" '! grep -q "^/buildings/B/envelope/residual_drift" "$out"'
    h5dump -H pair.h5 >"$out"
    for attribute in format format_version title status program version deck_file deck includes parameters impacts_coarse unit_force \
        unit_length unit_time command_line created steps newton_iterations wall_seconds; do
        expect "the file has the attribute $attribute" 'grep -q "ATTRIBUTE \"$attribute\"" "$out"'
    done
    h5dump -a /status pair.h5 >"$out"
    expect "the file says that it is complete" 'grep -q "\"complete\"" "$out"'
else
    skip "the file has its groups" "no h5ls"
fi

two_buildings lean.deck 'output -fields displacement -precision single -interval 20ms'
run "$jostle" run -q lean.deck
two_buildings alone.deck
sed -i '/^contact/d' alone.deck
run "$jostle" run -q alone.deck
two_buildings packed.deck 'output -every 1 -compress 6'
run "$jostle" run -q packed.deck
two_buildings loose.deck 'output -every 1'
run "$jostle" run -q loose.deck
two_buildings long.deck 'output -every 1 -fields displacement' 'duration 5'
run "$jostle" run -q long.deck
expect "decks with few fields and without contacts run" '[ $status -eq 0 ] && only {pair,lean,alone,packed,loose,long}.{deck,h5}'
sed 's/^units .*/units kN cm ms/; s/^param gap .*/sweep gap values 5mm 8mm/' pair.deck >study.deck
echo 'output -histories' >>study.deck
run "$jostle" run -q study.deck
expect "a study with histories runs" '[ $status -eq 0 ]'
cat >frame.deck <<'END'
title "a frame, a column that is struck, a foundation, P-delta, a limit of collapse"
units kip in s
building F -floors 2 -mass 100t -height 3m
frame F -bays 6m -modulus 200GPa
columns F:1:2 -I 2e-4m^4 -A 0.01m^2
beams F:1:2 -I 3e-4m^4
pdelta F
building T -floors 3 -mass 100t -stiffness 150MN/m -height 4m
column T@5m -name c1 -EI 20MN*m^2 -mass 500kg -shear-strength 500kN
foundation T -mass 50t -inertia 500t*m^2 -sway 1GN/m -rocking 20GN*m
contact F:1 T -gap 1mm -law linear -k 1e8N/m
contact F:2 T@5m -gap 1mm -law linear -k 1e8N/m
collapse drift-ratio 20%
ground sine -amplitude 3m/s^2 -frequency 1.5 -cycles 3
step fixed 1ms
END
run "$jostle" run -q frame.deck
expect "a deck with the parts of buildings runs" '[ $status -eq 0 ]'
expect "compressed histories take less room" '[ "$(wc -c <packed.h5)" -lt "$(wc -c <loose.h5)" ]'
if command -v h5diff >/dev/null; then
    run h5diff packed.h5 loose.h5 /buildings/A/displacement /buildings/A/displacement
    expect "and are the same to the last bit" '[ $status -eq 0 ]'
else
    skip "and are the same to the last bit" "no h5diff"
fi
if command -v h5dump >/dev/null; then
    expect "histories that fit in one block are contiguous" 'h5dump -p -H -d /energy/input loose.h5 | grep -q CONTIGUOUS'
    expect "longer ones are written in chunks" 'h5dump -p -H -d /energy/input long.h5 | grep -q CHUNKED'
else
    skip "histories that fit in one block are contiguous" "no h5dump"
fi
if python3 -c 'import h5py' 2>/dev/null; then
    run python3 "$root/tests/support/check_result.py" {pair,lean,alone,packed,long,study,frame}.h5
    expect "names, units and dimension scales are right" '[ $status -eq 0 ]'
else
    skip "names, units and dimension scales are right" "no h5py"
fi
