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

# levels DECK N: the table of `jostle converge`; its exit status 1 says that something has not
# converged.
levels() {
    "$jostle" converge "input/$1.deck" -n "$2" --tsv >"$work/levels.$2" || [ $? -eq 1 ]
}

# How often an error bar of 3, 4 and 5 levels is too small, held against the finest of 7 levels.
# Counts of impacts, and what stays 0, are left out.
for deck in multistorey two_towers row_of_five elastoplastic dampers bumper; do
    for n in 7 3 4 5; do
        levels $deck $n
    done
    awk -F '\t' -v deck=$deck '
        FNR == 1 { n++; error = NF - 2; next }
        $3 == "impacts" || $(error - 3) == 0 { next }
        n == 1 { truth[$2, $3] = $(error - 3); next }
        {
            off = $(error - 3) - truth[$2, $3]
            bars++
            small += (off < 0 ? -off : off) > $error
        }
        END { print deck, bars, small + 0 }' \
        "$work/levels.7" "$work/levels.3" "$work/levels.4" "$work/levels.5"
done | awk '
    { bars += $2; small += $3; printf "bars\t| %s | %d | %d |\n", $1, $2, $3 }
    END { printf "bars\t| all | %d | %d, %.0f %% |\n", bars, small, 100 * small / bars }'
