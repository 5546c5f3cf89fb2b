# SPDX-License-Identifier: GPL-3.0-or-later
# The experiments of Jankowski (2005): the peak forces of ball and striker, and how much the laws
# differ from each other in all four.

# force RUN CONTACT: its largest force.
force() {
    value "$1" contacts force "$2"
}

# stiffness PEAK OPTION... LAW...: the k with which an impact has this peak force, N.
stiffness() {
    peak=$1
    shift
    "$jostle" law "$@" --peak "$peak" --tsv </dev/null | awk -F '\t' 'NR == 2 { print $3 }'
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
        }'
}

# digits N X: with N significant digits, as tables have them.
digits() {
    awk -v n="$1" -v x="$2" "$format"'BEGIN { print number(x, n) }'
}

# ratio P FORCE PEAK: by how much the mass must grow, if the force goes with its power P.
ratio() {
    awk -v p="$1" -v force="$2" -v peak="$3" \
        'BEGIN { printf "%.17g\n", (peak / force) ^ (1 / p) }'
}

simulate ball input/ball.deck
simulate larger input/ball.deck -D diameter=0.1875in
simulate striker input/striker.deck
mass=$(value ball buildings mass)
velocity=$(value ball impacts v_approach)
masses=
while IFS=';' read -r contact ball striker options power; do
    ball_force=$(force ball "$contact")
    row ball "$ball" 80.7 "$ball_force" "$(force larger "$contact")"
    k=$(stiffness 80.7 $options -m1 "$mass" --over v="$velocity")
    echo " $(digits 3 "$k") |"
    masses="$masses $(digits 3 "$(ratio "$power" "$ball_force" 80.7)"),"
    striker_force=$(force striker "$contact" | awk '{ print $1 }')
    row striker "$striker" 102.5 "$striker_force"
    k=$(stiffness 102500 $options -m1 570 --over v=0.5)
    factor=$(ratio "$power" "$striker_force" 102.5)
    echo " $(digits 3 "$k") | $(awk -v x="$factor" 'BEGIN { printf "%.0f", 570 * x }') |"
done <<'END'
kelvin_voigt;kelvin-voigt, k = 2.07e7 N/m, ζ = 0.14;kelvin-voigt, k = 9.35e7 N/m, ζ = 0.14;kelvin-voigt -zeta 0.14;0.5
hertz;hertz, k = 4.66e9 N/m^1.5;hertz, k = 1.13e9 N/m^1.5;hertz;0.6
jankowski;jankowski, k = 1.03e10 N/m^1.5, ζ = 0.35;jankowski, k = 2.75e9 N/m^1.5, ζ = 0.35;jankowski -zeta 0.35;0.6
END
echo "ball_mass	$(echo "$masses" | sed -e 's/^ //' -e 's/,$//' -e 's/, \([^,]*\)$/ and \1/')"
awk "$format"'BEGIN { print "ball_cube\t" number((6 / 5) ^ 3, 3) }'

# Closed form of the Hertz force, k^(2/5) (1.25 m v0^2)^(3/5).
awk -v m="$mass" -v v="$velocity" "$format"'
BEGIN {
    print "hertz_ball\t" number(4.66e9 ^ 0.4 * (1.25 * m * v ^ 2) ^ 0.6, 4)
    print "hertz_striker\t" number(1.13e9 ^ 0.4 * (1.25 * 570 * 0.25) ^ 0.6 / 1000, 4)
}'

# columns RUN PATH UNIT [N I]: column I of the N columns of a dataset over time, as `jostle compare`
# reads a measurement.
columns() {
    dataset "$1" "$2" | awk -v n="${4-1}" -v i="${5-1}" 'NR % n == i % n' >"$work/column"
    echo "time [s], value [$3]"
    dataset "$1" /time | paste - "$work/column"
}

# error RUN QUANTITY: of the whole history, against that in the file `measured`, in percent.
error() {
    "$jostle" compare "$work/$1.h5" --measured "$work/measured" --quantity "$2" --tsv |
        awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
            NR == 2 { printf "%.1f %%\n", 100 * $at["error"] }'
}

columns striker /contacts/force kN 3 3 >"$work/measured"
while IFS=';' read -r contact law printed; do
    lasts=$(awk -F '\t' -v name="$contact" '$1 == "impacts" && $2 == name { x[$3] = $5 }
        END { printf "%.2f\n", 1000 * (x["t_end"] - x["t_start"]) }' "$work/striker.tsv")
    echo "errors	| $law | $printed | $(error striker "force:$contact") | $lasts |"
done <<'END'
kelvin_voigt;kelvin-voigt;23.8 %
hertz;hertz;97.6 %
jankowski;jankowski;22.9 %
END

# exact LAW...: the ratio that -calibrate finds.
exact() {
    "$jostle" law "$@" -k 1e9 -calibrate -m1 1 -v 1 </dev/null |
        sed -n 's/.*-zeta \([0-9.]*\) (calibrated)$/\1/p'
}

while IFS=';' read -r which law e zeta; do
    delivered=$("$jostle" law "$law" -k 1e9 -zeta "$zeta" -m1 1 -v 1 --tsv </dev/null |
        awk '$1 == "achieved_restitution" { print $2 }')
    echo "ratios	| $which | $law | $e | $zeta | $(digits 3 "$delivered") |" \
        "$(digits 3 "$(exact "$law" -e "$e")") |"
done <<'END'
ball, striker, towers;kelvin-voigt;0.65;0.14
ball, striker, towers;jankowski;0.65;0.35
girder;kelvin-voigt;0.4;0.28
girder;jankowski;0.4;0.99
END

# moving BODY LAW RUN BUILDING CONTACT FORCE ERROR: a row of what shakes.
moving() {
    peak=$(value "$3" buildings displacement "$4" | awk '{ print 1000 * $1 }')
    echo "moving	| $1 | $2 | $(digits 3 "$peak") | $6 | $7 |"
}

simulate girder input/girder.deck
columns girder /buildings/viscous/displacement m >"$work/measured"
while read -r law contact building; do
    moving girder "$law" girder "$building" "$contact" \
        "$(digits 3 "$(force girder "$contact")") N" "$(error girder displacement:"$building")"
done <<'END'
kelvin-voigt kelvin_voigt linear
hertz hertz elastic
jankowski jankowski viscous
END
for options in 'jankowski -k 9.90e10 -zeta 0.35' 'kelvin-voigt -k 1.40e9 -zeta 0.14' \
    'hertz -k 2.36e10'; do
    sed -e "s|-law jankowski.* -name|-law $options -name|" -e "s|records/|$root/input/records/|" \
        input/two_towers.deck >"$work/towers.deck"
    simulate "${options%% *}" "$work/towers.deck"
done
for tower in T1 T2; do
    columns jankowski "/buildings/$tower/displacement" m >"$work/measured"
    for law in kelvin-voigt hertz jankowski; do
        kilonewton=$(force $law top | awk '{ print $1 / 1000 }')
        moving "tower $tower" $law $law $tower top "$(digits 3 "$kilonewton") kN" \
            "$(error $law displacement:$tower)"
    done
done

{
    pick ball 1 4 | sed 's/^/5\/32 in, /'
    pick ball 1 6 | sed 's/^/3\/16 in, /'
    pick striker 1 4 | sed 's/^/striker, /'
} | sed 's/, k = [^\t]*//' >"$work/against"
draw 330
