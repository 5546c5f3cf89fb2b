# SPDX-License-Identifier: GPL-3.0-or-later
# The experiments of Jankowski (2005) that can be run with what the paper prints: the ball and the
# striker.

# peak DECK: peak force of a reference deck.
peak() {
    simulate "$1" "tests/verify/reference/$1.deck"
    value "$1" contacts force
}

# ball LAW...: peak force of a 3/16 in ball at sqrt(2 g 2 in), steel of 7850 kg/m3.
ball() {
    mass=$(awk 'BEGIN { printf "%.17g", 7850 * atan2(0, -1) / 6 * (0.0254 * 3 / 16) ^ 3 }')
    "$jostle" law "$@" -m1 "$mass" -v 0.99817624 --tsv </dev/null |
        awk '$1 == "peak_force" { print $2 }'
}

# row TABLE LAW PRINTED COMPUTED [OTHER]: percents are of what the paper prints.
row() {
    awk -v name="$1" -v law="$2" -v paper="$3" -v computed="$4" -v other="${5-}" "$format"'
        function against(x) {
            return sprintf("%+.1f %%", 100 * (x - paper) / paper)
        }
        BEGIN {
            printf "%s\t| %s | %s | %s | %s |", name, law, paper, number(computed, 4),
                against(computed)
            if (other != "") {
                printf " %s | %s |", number(other, 4), against(other)
            }
            print ""
        }'
}

row ball 'kelvin-voigt, k = 2.07e7 N/m, ζ = 0.14' 80.7 "$(peak B1_ball_kelvin_voigt)" \
    "$(ball kelvin-voigt -k 2.07e7 -zeta 0.14)"
row ball 'hertz, k = 4.66e9 N/m^1.5' 80.7 "$(peak B1_ball_hertz)" "$(ball hertz -k 4.66e9)"
row ball 'jankowski, k = 1.03e10 N/m^1.5, ζ = 0.35' 80.7 "$(peak B1_ball_jankowski)" \
    "$(ball jankowski -k 1.03e10 -zeta 0.35)"
# striker LAW CASE: the same in kN.
striker() {
    row striker "$1" 102.5 "$(peak "B2_pendulum_$2_single" | awk '{ print $1 / 1000 }')"
}

striker 'kelvin-voigt, k = 9.35e7 N/m, ζ = 0.14' kelvin_voigt
striker 'hertz, k = 1.13e9 N/m^1.5' hertz
striker 'jankowski, k = 2.75e9 N/m^1.5, ζ = 0.35' jankowski

{
    pick ball 1 4 | sed 's/^/5\/32 in, /'
    pick ball 1 6 | sed 's/^/3\/16 in, /'
    pick striker 1 4 | sed 's/^/striker, /'
} | sed 's/, k = [^\t]*//' >"$work/against"
draw 330

# Closed form of the Hertz force, k^(2/5) (1.25 m v0^2)^(3/5).
awk "$format"'
BEGIN {
    print "hertz_ball\t" number(4.66e9 ^ 0.4 * (1.25 * 0.00025693869 * 0.99817616 ^ 2) ^ 0.6, 4)
    print "hertz_striker\t" number(1.13e9 ^ 0.4 * (1.25 * 570 * 0.25) ^ 0.6 / 1000, 4)
}'
