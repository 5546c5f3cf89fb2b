# SPDX-License-Identifier: GPL-3.0-or-later
# Peak forces of isolated impacts over velocity, stiffness, mass and restitution.

# force LAW K M V OPTION...: the peak force of two bodies of the mass M.
force() {
    law=$1 k=$2 m=$3 v=$4
    shift 4
    "$jostle" law "$law" -k "$k" -m1 "$m" -m2 "$m" -v "$v" "$@" --tsv </dev/null |
        awk '$1 == "peak_force" { print $2 }'
}

# exponent FORCE LARGER: of a power law, if ten times the parameter gives the larger force.
exponent() {
    awk -v a="$1" -v b="$2" 'BEGIN { printf "%.3f", log(b / a) / log(10) }'
}

while IFS=';' read -r law k options closed; do
    # shellcheck disable=SC2086  # options of the law
    set -- $options
    plain=$(force "$law" "$k" 300t 0.1 "$@")
    echo "scaling	| $law | $(exponent "$plain" "$(force "$law" "$k" 300t 1 "$@")") |" \
        "$(exponent "$plain" "$(force "$law" "${k}0" 300t 0.1 "$@")") |" \
        "$(exponent "$(force "$law" "$k" 30t 0.1 "$@")" "$plain") | $closed |"
done <<'END'
linear;1000000000;;1, 1/2, 1/2
kelvin-voigt;1000000000;-e 0.65;1, 1/2, 1/2
hertz;2750000000;;6/5, 2/5, 3/5
jankowski;2750000000;-e 0.65;6/5, 2/5, 3/5
hunt-crossley;2750000000;-e 0.65;6/5, 2/5, 3/5
END
for law in kelvin-voigt jankowski hunt-crossley; do
    "$jostle" law $law -k 2.75e9 -calibrate -m1 300t -m2 300t -v 0.5 --tsv \
        --over e=0.65,0.2,0.3,0.4,0.5,0.65,0.8,1 </dev/null |
        awk -F '\t' -v law=$law "$format"'
            NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
            NR == 2 { whole = $at["peak_force [N]"] }
            NR > 2 { line = line " " number($at["peak_force [N]"] / whole, 3) " |" }
            END { print "restitution\t| " law " |" line }'
done
simulate soft $here/study.deck -D k=1e8N/m^1.5
simulate hard $here/study.deck -D k=1e11N/m^1.5
soft=$(value soft contacts force)
hard=$(value hard contacts force)
awk -v soft="$soft" -v hard="$hard" "$format"'
BEGIN {
    print "times\t" number(hard / soft, 2)
    print "power\t" number(log(hard / soft) / log(1000), 2)
}'

# For the picture: forces [MN] over velocity, restitution and stiffness, a block a law.
over() {
    while IFS=';' read -r law k; do
        "$jostle" law $law -k "$k" -e 0.65 -calibrate -m1 300t -m2 300t -v 0.5 --over "$1" --tsv \
            </dev/null | awk -F '\t' '
                NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
                NR > 1 { print $2, $at["peak_force [N]"] / 1e6 }
                END { printf "\n\n" }'
    done <<'END'
kelvin-voigt;1e9
jankowski;2.75e9
hunt-crossley;2.75e9
END
}

if [ "${PICTURES-1}" != 0 ]; then
    over v=0.05:1:20 >"$work/over_v"
    over e=0.1:0.95:18 >"$work/over_e"
    over k=1e9,2e9,3e9,4e9,5e9,6e9,7e9,8e9,9e9,10e9 >"$work/over_k"
fi
draw 330
