#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Isolated buildings: what summaries, files, demands and converge leave out, and damping of storeys that
# yield.
. tests/support/cli.sh

cat >house.deck <<END
units kN m s
param mark 1
param end 12s
building A -floors 4 -mass 200t -stiffness 20MN/m 3*300MN/m -height 3m -isolated \$mark
storey A:1 bilinear -yield 300kN -hardening 0.1
ground record $root/input/records/ELCENTRO_1940_NS.AT2
duration \$end
step fixed 5ms
END
value() { "$jostle" show --tsv "$1" | awk -F '\t' -v q="$2" -v i="$3" '$2 == "A" && $3 == q && $4 == i { print $5 }'; }
is() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && (a - b)^2 <= (1e-3 * b)^2) }'; }

run "$jostle" run house.deck
expect "a summary has the drifts of the storeys above" '[ $status -eq 0 ] && is "$(awk "/^peak of +roof/ { getline; getline; print \$4 }" "$out")" "$(value house.h5 drift 2)"'
expect "and their residual drifts" 'awk "/^yielding/ { getline; getline; exit !(\$2 == 0) }" "$out"'
expect "and a table of the isolators" 'is "$(awk "/^isolator / { getline; getline; print \$3 }" "$out")" "$(value house.h5 drift 1)" && is "$(awk "/^isolator / { getline; getline; print \$6 }" "$out")" "$(value house.h5 storey_shear 1)"'
run "$jostle" show house.h5 --json
expect "JSON names the storey" 'grep -q "\"isolated\": *1" "$out"'
run "$jostle" check house.deck
expect "and so does check" 'grep -q "^  isolators: storey 1$" "$out"'
run "$jostle" check "$root/input/isolated.deck"
expect "isolator marks its storey" 'grep -q "^  isolators: storey 1$" "$out" && grep -qE "^ +1 .* fps$" "$out"'
run "$jostle" run house.deck -o bare.h5 -D mark=4
expect "other storeys can be marked" '[ $status -eq 0 ] && is "$(awk "/^peak of +roof/ { getline; getline; print \$4 }" "$out")" "$(value bare.h5 drift 1)"'
run "$jostle" converge -n 3 house.deck --tsv
expect "converge judges the storeys above" 'is "$(awk -F "\t" "/storey drift/ { print; exit }" "$out" | grep -oE "0\.00[0-9]+" | head -n 1)" "$(value house.h5 drift 2)"'

sed 's/^param end.*/sweep end values 6s 12s/' house.deck >study.deck
run "$jostle" run study.deck
expect "the largest drifts of a study are those of the storeys above" '[ $status -eq 0 ] && grep -qE "^A +drift +2 " "$out" && grep -qE "^A +storey_shear +1 " "$out"'
run "$jostle" show study.h5 --long --tsv
expect "a table of all demands has those of the isolators" '[ $status -eq 0 ] && grep -qE "drift.A:1." "$out"'
for edp in drift:2 residual-drift:2 acceleration:4 storey-shear:1 drift:A:1:1; do
    run "$jostle" show study.h5 --long --edp "${edp%:*}" --tsv
    expect "the demand ${edp%:*} is at A:${edp##*:}" '[ $status -eq 0 ] && [ "$(awk -F "\t" "NR > 1 { print \$3 }" "$out" | sort -u)" = "A:${edp##*:}" ]'
done
sed 's/^param mark.*/sweep mark values 1 2/; s/^sweep end.*/param end 6s/' house.deck >marks.deck
run "$jostle" run marks.deck
expect "all runs of a study have the same isolators" '[ $status -ne 0 ] && said "isolators of buildings"'
cat >one.deck <<END
building A -floors 1 -mass 100t
isolator A:1 sliding -mu 5%
ground record $root/input/records/ELCENTRO_1940_NS.AT2
step fixed 5ms
END
run "$jostle" run one.deck
expect "the drift of an isolator alone is in the summary" '[ $status -eq 0 ] && is "$(awk "/^peak of +roof/ { getline; getline; print \$4 }" "$out")" "$(value one.h5 drift 1)"'

# Storeys that yield, and damping that leaves them out or follows their tangent stiffness.
yielding() {
    sed "s/^step.*/damping A rayleigh $1/; s/-isolated .mark//; /^param mark/d" house.deck >damped.deck
    printf '%s\n' "${2:-step fixed 5ms}" >>damped.deck
}
yielding 5%
run "$jostle" run damped.deck
expect "Rayleigh damping by the mass brakes isolators, and the warning says what does not" '[ $status -eq 0 ] && said "between the ground and floors above storeys that yield" && said "give rayleigh -beta without -alpha"'
yielding "-beta 20ms"
run "$jostle" run --force damped.deck
expect "Rayleigh damping on a storey that yields is warned of, with what helps" '[ $status -eq 0 ] && said "in storey 1 their force is" && said "leave such storeys out with -storeys, or use -tangent"'
for remedy in "-beta 2ms -storeys 2:4" "-beta 2ms -tangent"; do
    yielding "$remedy"
    run "$jostle" run --force damped.deck
    expect "$remedy helps" '[ $status -eq 0 ] && [ ! -s "$err" ]'
done
yielding "5% -tangent" "step adaptive"
run "$jostle" check damped.deck
expect "adaptive steps take Newmark's method for it" '[ $status -eq 0 ] && grep -q "newmark" "$out"'
