# SPDX-License-Identifier: GPL-3.0-or-later
# Convergence with the step: the restitution of isolated impacts, law by law, and peaks of two
# buildings.

laws() {
    cat <<'END'
linear -k 93.5e6
hertz -k 2.75e9
bilinear -k1 560e6 -k2 60e6 -dy 0.5e-3
kelvin-voigt -k 93.5e6 -e 0.65
komodromos -k 93.5e6 -e 0.65
mahmoud-jankowski -k 93.5e6 -e 0.65
ye-kelvin -k 93.5e6 -e 0.65
hertz-damp -k 2.75e9 -e 0.65
ye-hertz-damp -k 2.75e9 -e 0.65
hunt-crossley -k 2.75e9 -e 0.65
jankowski -k 2.75e9 -e 0.65
khatami -k 2.75e9 -e 0.65 -calibrate
wang -k 2.75e9 -zeta 2.75e9 -residual 0.25
rubber -k 3e10 -n 2 -e 0.65
END
}

# Eight pairs of bodies at once, apart, each closing at another eighth of a step of $2 ms: one run
# for all phases.
pairs() {
    i=0
    while [ $i -lt 8 ]; do
        cat <<END
building A$i -floors 1 -mass 25t -stiffness 0
building B$i -floors 1 -mass 40t -stiffness 0
initial A$i:1 -velocity 0.5m/s
contact A$i B$i -gap \${10mm + 0.5m/s * ${2}ms * $i / 8} -law $1
END
        i=$((i + 1))
    done
    printf 'step fixed %sms\nduration 0.08s\n' "$2"
}

laws >"$work/laws"
rm -f "$work/errors"
while read -r law; do
    exact=$("$jostle" law $law -m1 25t -m2 40t -v 0.5m/s --tsv </dev/null |
        awk '$1 == "achieved_restitution" { print $2 }')
    for dt in 1 0.5 0.25 0.125 0.0625; do
        pairs "$law" $dt >"$work/pairs.deck"
        simulate pairs "$work/pairs.deck"
        awk -F '\t' -v exact="$exact" -v law="${law%% *}" -v dt=$dt '
            $1 == "impacts" { v[$2, $3] = $5; names[$2] = 1 }
            END {
                for (name in names) {
                    sum += (v[name, "v_rebound"] / v[name, "v_approach"] - exact) ^ 2 / 8
                }
                print law, dt, sqrt(sum)
            }' "$work/pairs.tsv" >>"$work/errors"
    done
done <"$work/laws"
awk "$format"'
    { error[$2] = $3 }
    $2 == 0.0625 {
        printf "laws\t| %s | %s | %s | %s | %s |\n", $1, small(error[1], 1e-11),
            small(error[0.25], 1e-11), small(error[0.0625], 1e-11),
            sprintf("%.2f", log(error[0.25] / error[0.0625]) / log(4))
    }' "$work/errors"

# 8 and 5 storeys: the deck of the reference solutions at other steps.
for law in kelvin_voigt jankowski; do
    for dt in 4 2 1 0.5 0.25 0.125; do
        reference_deck D_8v5_$law $dt >"$work/storeys.deck"
        simulate storeys "$work/storeys.deck"
        table -v law=$law -v dt=$dt -f $here/storeys.awk \
            tests/verify/reference/D_8v5_$law.tsv "$work/storeys.tsv"
    done
done >"$work/storeys"
awk "$format"'{
    law = $1 == "kelvin_voigt" ? "kelvin-voigt" : $1
    printf "storeys\t| %s | %s | %s | %s | %s | %s |\n", law, $2, small($3, 1e-12),
        small($4, 1e-12), small($5, 1e-12), $6
}' "$work/storeys"
draw 360
