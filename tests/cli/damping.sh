#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Rayleigh damping of storeys that yield is warned about with the force of its dashpots.
. tests/support/cli.sh

# One storey of k = 10 MN/m and omega = 10 rad/s starts at 0.5 m/s, its largest drift rate. With 5 % beta
# is 0.01 s, and the dashpot's force 0.01 * 10000 * 0.5 = 50 kN.
storey() {
    cat >storey.deck <<END
units kN m s
param yield $1
building A -floors 1 -mass 100t -stiffness 10MN/m
storey A:1 bilinear -yield \$yield -hardening 0
damping A $2
initial A:1 -velocity 0.5
duration 1
step fixed 1ms
END
}
warning='the Rayleigh damping of building A has dashpots in storeys that yield: in storey 1 their force is 0.2 times the yield force at the'
storey 250kN "rayleigh 5%"
run "$jostle" check storey.deck
expect "check warns with the ratio of dashpot and yield force" '[ $status -eq 0 ] && said "storey.deck:5:11: warning: $warning estimated largest drift rate of 0.5 m/s"'
run "$jostle" run storey.deck
expect "run warns with the computed drift rate, once" '[ $status -eq 0 ] && said "jostle: warning: $warning largest drift rate of 0.5 m/s" && [ "$(grep -c warning: "$err")" -eq 1 ]'
run "$jostle" run -q --force storey.deck
expect "but not with -q" '[ $status -eq 0 ] && [ ! -s "$err" ]'
run "$jostle" run --force storey.deck -D yield=501kN
expect "less than 10 % is not warned about" '[ $status -eq 0 ] && [ ! -s "$err" ]'
run "$jostle" run --force storey.deck -D yield=499kN
expect "more than 10 % is" '[ $status -eq 0 ] && said "their force is 0.1 times"'
for other in "dashpot 100kN*s/m" "modal 5%" "rayleigh -alpha 1"; do
    storey 250kN "$other"
    for command in check "run --force"; do
        run "$jostle" $command storey.deck
        expect "$command does not warn about damping $other" '[ $status -eq 0 ] && [ ! -s "$err" ]'
    done
done
storey 250kN "rayleigh 1%
damping A rayleigh -beta 8ms"
run "$jostle" run --force storey.deck
expect "statements that add up are judged by their sum" '[ $status -eq 0 ] && said "their force is 0.2 times"'
sed 's/^param yield.*/sweep yield values 250kN 5000kN/' storey.deck >study.deck
run "$jostle" run study.deck
expect "a study is judged by the estimate for its first run" '[ $status -eq 0 ] && said "$warning estimated"'
sed 's/^sweep yield.*/sweep yield values 5000kN 250kN 400kN/' study.deck >later.deck
run "$jostle" check later.deck
expect "check looks at the others, and names the run in which the force is largest" '[ $status -eq 0 ] && said "later.deck:6:11: warning: in run 2 (yield = 250), $warning estimated" && [ "$(grep -c warning: "$err")" -eq 1 ] && grep -q "^run 2 (yield = 250) is the strongest run checked:" "$out"'

# An isolated building of 2.5 s, as in docs/modelling.md.
isolated() {
    cat >isolated.deck <<END
units kN m s
param kd \${4 * pi^2 * 1700t / (2.5s)^2}
building A -floors 5 -mass 500t 4*300t -stiffness \${kd / 0.1} 4*600MN/m
storey A:1 bilinear -yield \${0.06 * 1700t * 9.80665m/s^2 / 0.9} -hardening 0.1
$1
ground record $root/input/records/NAPA_2014_68150_HNE.AT2
step fixed 1ms
END
}
isolator_drift() {
    "$jostle" show --tsv isolated.h5 | awk -F '\t' '$2 == "A" && $3 == "drift" && $4 == 1 { print $5 }'
}
isolated "damping A dashpot 0 4*1.4MN*s/m"
run "$jostle" run isolated.deck
expect "dashpots with 0 at the isolators are not warned about" '[ $status -eq 0 ] && [ ! -s "$err" ]'
without=$(isolator_drift)
isolated "damping A rayleigh -alpha 0.3"
run "$jostle" run --force isolated.deck
expect "damping by the mass alone brakes the isolated building" 'said "between the ground and floors above storeys that yield: in storey 1 "'
expect "and takes more than a tenth of the drift" 'awk "BEGIN { exit !($(isolator_drift) < 0.9 * $without) }"'
isolated "damping A rayleigh 5%"
run "$jostle" run --force isolated.deck
expect "Rayleigh damping that reaches the isolators is" 'said "dashpots in storeys that yield: in storey 1 "'
expect "and takes more than a fifth of their drift" 'awk "BEGIN { exit !($(isolator_drift) < 0.8 * $without) }"'
run "$jostle" check isolated.deck
expect "check foresees it" 'said "dashpots in storeys that yield: in storey 1 "'
