#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What foundations do is in result files of runs and studies, in tables, and among the demands.
. tests/support/cli.sh

cat >two.deck <<'END'
units kN m s
param a 1
building A -floors 2 -mass 100t -stiffness 90MN/m -height 3m
building B -floors 3 -mass 100t -stiffness 60MN/m -height 3m
building C -floors 1 -mass 100t -stiffness 60MN/m
damping A rayleigh 5%
damping B rayleigh 5%
foundation A -mass 60t -inertia 500t*m2 -sway 400MN/m -rocking 4000MN*m -sway-dashpot 4MN*s/m
foundation B -mass 60t -inertia 500t*m2 -sway 300MN/m -rocking 2000MN*m
contact A B -gap 5mm -law hunt-crossley -n 1 -k 500MN/m -e 0.6
ground sine -amplitude ${a * 3m/s^2} -frequency 1.5 -cycles 3
step fixed 1ms
END
run "$jostle" run two.deck
expect "the summary has sway and rocking" '[ $status -eq 0 ] && grep -q "^peak of .* sway .* rocking .* sway force  rocking mom" "$out"'
run "$jostle" show --tsv two.h5
cp "$out" table.tsv
# value BUILDING QUANTITY: the value, or the time with a third word.
value() {
    awk -F '\t' -v b="$1" -v q="$2" -v at="${3-5}" '$1 == "foundations" && $2 == b && $3 == q { print $at }' table.tsv
}
expect "tables have four quantities of each foundation, with their times" '[ "$(grep -c "^foundations" table.tsv)" -eq 8 ] && [ "$(value C sway)" = "" ] && awk "BEGIN { exit !($(value B rocking 7) > 0 && $(value B rocking 7) <= 2) }"'
for place in A:4e5:4e6 B:3e5:2e6; do
    IFS=: read -r name sway rocking <<<"$place"
    expect "forces on $name are those of its springs" 'awk "BEGIN { a = $(value $name sway_force) / ($sway * $(value $name sway)); b = $(value $name rocking_moment) / ($rocking * $(value $name rocking)); exit !(a > 1 - 1e-12 && a < 1 + 1e-12 && b > 1 - 1e-12 && b < 1 + 1e-12) }"'
done
run "$jostle" show --json two.h5
expect "JSON has them" '[ "$(grep -c "\"rocking_moment_time\"" "$out")" -eq 2 ]'
if python3 -c 'import h5py' 2>/dev/null; then
    expect "histories are as large as the envelopes, and rocking moves the floors" 'python3 - <<END
import h5py, numpy as np
f = h5py.File("two.h5")
g = f["buildings/B/foundation"]
for name in ("sway", "rocking", "sway_force", "rocking_moment"):
    most = g["envelope"][name][0]
    assert 0.99 * most < abs(g[name][:]).max() <= most, name
u, d = f["buildings/B/displacement"][:, 2], f["buildings/B/drift"][:]
assert np.allclose(u, d.sum(axis=1) + g["sway"][:, 0] + 9 * g["rocking"][:, 0], atol=1e-12)
END'
else
    skip "histories of foundations" "no h5py"
fi
echo 'output -fields drift' >>two.deck
run "$jostle" run -q two.deck -o few.h5
expect "histories come with displacements and shears" '[ $status -eq 0 ] && h5ls few.h5/buildings/B/foundation | grep -q "^envelope" && ! h5ls few.h5/buildings/B/foundation | grep -q "^sway\|^rocking"'
sed -i '$d' two.deck

sed 's/^param a 1/sweep a values 1 2/' two.deck >study.deck
echo 'output -histories' >>study.deck
run "$jostle" run study.deck
expect "a study has them" '[ $status -eq 0 ]'
# demand EDP: that of the first run.
demand() {
    run "$jostle" show --long study.h5 --edp "$1"
    awk -F '\t' 'NR == 2 { print $4 }' "$out"
}
for pair in foundation-sway:sway foundation-rocking:rocking foundation-force:sway_force foundation-moment:rocking_moment; do
    expect "${pair%:*} is that of the run" '[ "$(demand ${pair%:*}:B)" = "$(value B ${pair#*:})" ] && [ -n "$(value B ${pair#*:})" ]'
done
expect "without a building it is the largest" '[ "$(demand foundation-rocking)" = "$(value B rocking)" ]'
run "$jostle" show --long study.h5 --edp foundation-sway:C
expect "a building without a foundation has none" '[ $status -eq 2 ] && said "foundation-sway:C: no such building has a foundation"'
"$jostle" show --tsv study.h5#1 | grep ^foundations >again.tsv
expect "a run of the study has the same table" 'cmp again.tsv <(grep ^foundations table.tsv)'
expect "and the same histories" 'h5diff two.h5 study.h5 /buildings/B/foundation/rocking /runs/000001/buildings/B/foundation/rocking'
run "$jostle" run study.deck -j 2 --shard 1/2 -o one.h5
run "$jostle" run study.deck --shard 2/2 -o other.h5
run "$jostle" merge one.h5 other.h5 -o merged.h5
expect "parts of a study are merged" '[ $status -eq 0 ] && h5diff merged.h5 study.h5 /buildings/B/foundation/envelope'
run "$jostle" verify study.h5 --rerun 2
expect "runs computed again have the same results" '[ $status -eq 0 ]'
printf 'building A -floors 2 -mass 1 -stiffness 9\nstep fixed 1ms\nduration 1\ninitial A:1 -velocity 1\n' >none.deck
run "$jostle" run -q none.deck
run "$jostle" fragility none.h5 --edp foundation-sway --limit 1
expect "one run is no study" '[ $status -eq 2 ]'
