# SPDX-License-Identifier: GPL-3.0-or-later
# Isolated impacts of 25 t against 40 t at 0.5 m/s under each law, by `jostle run` and `jostle law`,
# against closed forms.

dt=20e-6
linear='-k 93.5e6'
curved='-k 2.75e9'

# Label, options of the law, and the row of formulas.awk, whose zeta or q follow from e = 0.65 by
# the relation of the law.
laws() {
    cat <<END
linear;linear $linear;power 93.5e6 1
hertz;hertz $curved;power 2.75e9 1.5
hertz, n = 2;hertz -k 3e10 -n 2;power 3e10 2
bilinear;bilinear -k1 560e6 -k2 60e6 -dy 0.5e-3;bilinear 560e6 60e6 0.5e-3
kelvin-voigt;kelvin-voigt $linear -e 0.65;dashpot 93.5e6 $zeta_linear 1
komodromos;komodromos $linear -e 0.65;dashpot 93.5e6 $zeta_linear 2
mahmoud-jankowski;mahmoud-jankowski $linear -e 0.65;dashpot 93.5e6 $zeta_2011 3
mahmoud-jankowski, 2008;mahmoud-jankowski $linear -e 0.65 -relation 2008;dashpot 93.5e6 $zeta_2008 3
ye-kelvin;ye-kelvin $linear -e 0.65;family 93.5e6 1 $q_ye_kelvin
hertz-damp;hertz-damp $curved -e 0.65;family 2.75e9 1.5 $q_hertz_damp
lankarani-nikravesh;lankarani-nikravesh $curved -e 0.65;family 2.75e9 1.5 $q_hertz_damp
ye-hertz-damp;ye-hertz-damp $curved -e 0.65;family 2.75e9 1.5 $q_ye_hertz
hunt-crossley, q = 0.8;hunt-crossley $curved -zeta 0.8;family 2.75e9 1.5 0.8
power, n = 2, q = 0.8;power -k 3e10 -n 2 -zeta 0.8;family 3e10 2 0.8
jankowski;jankowski $curved -e 0.65;jankowski 2.75e9 $zeta_jankowski
khatami;khatami $curved -e 0.65;khatami 2.75e9 $f_khatami
wang;wang $curved -zeta 2.75e9 -residual 0.25;wang 2.75e9 2.75e9 0.25
rubber, n = 2, q = 0.5;rubber -k 3e10 -n 2 -zeta 0.5;rubber 3e10 2 0.5
table;table -file $root/$here/curve.txt;table 90e6 0.74074074074074074
END
}

# The relations between e = 0.65 and the damping parameter, as published (docs/laws.md).
zeta_linear=$(awk 'BEGIN { l = log(0.65); printf "%.17g", -l / sqrt(atan2(0, -1) ^ 2 + l ^ 2) }')
zeta_2011=$(awk 'BEGIN {
    e = 0.65
    printf "%.17g", (1 - e ^ 2) / (e * (e * (atan2(0, -1) - 2) + 2)) }')
zeta_2008=$(awk 'BEGIN { e = 0.65; printf "%.17g", (1 - e ^ 2) / (atan2(0, -1) * e) }')
zeta_jankowski=$(awk 'BEGIN {
    e = 0.65
    printf "%.17g", 4.5 * sqrt(5) * (1 - e ^ 2) / (e * (e * (9 * atan2(0, -1) - 16) + 16)) }')
q_ye_kelvin=$(awk 'BEGIN { printf "%.17g", 1.5 * 0.35 / 0.65 }')
q_hertz_damp=$(awk 'BEGIN { printf "%.17g", 0.75 * (1 - 0.65 ^ 2) }')
q_ye_hertz=$(awk 'BEGIN { printf "%.17g", 1.6 * 0.35 / 0.65 }')
f_khatami=$(awk 'BEGIN { printf "%.17g", 0.01557 * 0.65 ^ 0.2706 * 0.5 * 0.35 }')

# Two free bodies, one impact under the law $1.
bodies() {
    cat <<END
building A -floors 1 -mass 25t -stiffness 0
building B -floors 1 -mass 40t -stiffness 0
initial A:1 -velocity 0.5m/s
contact A B -gap 1mm -law $1
step fixed $dt
duration 0.08s
END
}

# What `jostle run` and `jostle law` give under the law $2, rows of the label $1, quantity and both
# values.
computed() {
    bodies "$2" >"$work/impact.deck"
    simulate impact "$work/impact.deck"
    {
        awk -F '\t' '$1 == "impacts" { print $3 "\t" $5 }' "$work/impact.tsv"
        # shellcheck disable=SC2086  # options are one word each
        "$jostle" law $2 -m1 25t -m2 40t -v 0.5m/s --tsv </dev/null | sed 's/^/law /'
    } | awk -F '\t' -v label="$1" '
        function give(quantity, run, law) {
            printf "%s\t%s\t%.17g\t%.17g\n", label, quantity, run, law
        }
        { v[$1] = $2 }
        END {
            give("restitution", v["v_rebound"] / v["v_approach"], v["law achieved_restitution"])
            give("largest penetration", v["max_penetration"], v["law max_penetration"])
            give("peak force", v["peak_force"], v["law peak_force"])
            give("duration", v["t_end"] - v["t_start"], v["law duration"])
        }'
}

laws >"$work/laws"
rm -f "$work/formulas" "$work/computed"
while IFS=';' read -r label law formula; do
    printf '%s\t%s\n' "$label" "$(echo "$formula" | tr ' ' '\t')" >>"$work/formulas"
    computed "$label" "$law" >>"$work/computed"
done <"$work/laws"
awk -v m=15384.615384615385 -v v0=0.5 -f $here/formulas.awk "$work/formulas" >"$work/closed"
table -v errors="$work/errors" -f $here/impacts.awk "$work/computed" "$work/closed"
draw 560
