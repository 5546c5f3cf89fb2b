# SPDX-License-Identifier: GPL-3.0-or-later
# The towers of tests/peers/opensees.py by jostle, beside what OpenSees gave on the date in its
# file.

peers=tests/peers/opensees.tsv

# towers LAW...: the deck of both towers.
towers() {
    cat <<END
building T1 -floors 1 -mass 204kg -stiffness \${204 * (2 * pi * 2.31)^2}
building T2 -floors 1 -mass 146.5kg -stiffness \${146.5 * (2 * pi * 2.90)^2}
damping T1 dashpot \${2 * 0.014 * 204 * 2 * pi * 2.31}
damping T2 dashpot \${2 * 0.016 * 146.5 * 2 * pi * 2.90}
contact T1 T2 -gap 11mm -law $1
ground record $root/input/records/ELCENTRO_1940_NS.AT2
step fixed 10e-6s
duration 6s
END
}

while read -r law; do
    towers "$law" >"$work/towers.deck"
    simulate towers "$work/towers.deck"
    {
        value towers buildings displacement T1
        value towers buildings displacement T2
        value towers contacts force
        value towers contacts impacts
    } >"$work/jostle"
    awk -F '\t' -v law="${law%% *}" '$1 == law' $peers | paste - "$work/jostle" |
        awk -F '\t' "$format"'{
        if ($2 == "impacts") {
            printf "peers\t| %s | %s | %d | %d | %d | %d | %d |\n", $1, $2, $3, $4, $5,
                $5 - $3, $5 - $4
            next
        }
        printf "peers\t| %s | %s | %s | %s | %s | %s | %s |\n", $1, $2, number($3, 5),
            number($4, 5), number($5, 5), small(relative($3, $5), 1e-12),
            small(relative($4, $5), 1e-12)
    }'
done <<'END'
jankowski -k 9.9e10 -zeta 0.35
hertz-damp -k 2.36e10 -zeta 0.8
kelvin-voigt -k 1.4e9 -zeta 0.14
bilinear -k1 1.4e9 -k2 0.2e9 -dy 0.05e-3
END
pick peers 1 2 6 7 | grep -v impacts | sed 's/\t/, /' >"$work/differences"
draw 400
sed -n 's/^# /version\t/p' $peers
