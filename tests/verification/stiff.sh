# SPDX-License-Identifier: GPL-3.0-or-later
# Errors of Dormand & Prince's method over the tolerance, where something is stiff.

{
    echo 0
    yes -- -6e6 | head -14
} >"$work/press.txt"
record="ground record $root/input/records/ELCENTRO_1940_NS.AT2"
a='building A -floors 3 -mass 3e5 -stiffness 3e8'
b='building B -floors 2 -mass 2e5 -stiffness 4e8'

# stiff_deck WHAT: its deck, with the parameters k, tolerance and longest.
stiff_deck() {
    printf 'param %s 1e-3\n' k tolerance longest
    case $1 in
    link) printf '%s\n' "$a" "$b" 'link A:2 B:2 -stiffness $k' "$record" 'duration 6' ;;
    storey) printf '%s\n' "${a% *} 3e8 \$k 3e8" "$record" 'duration 6' ;;
    contact) printf '%s\n' "$a" "$b" 'contact A:2 B:2 -gap 0 -law linear -k $k' \
        'load B:2 history press.txt -dt 0.5' "$record -delay 1" 'duration 7' ;;
    esac
    echo 'damping A rayleigh 5%'
    [ "$1" = storey ] || echo 'damping B rayleigh 5%'
    echo 'integrator dormand-prince'
    echo 'step adaptive -tolerance $tolerance -max $longest'
}

# peaks RUN: the peaks of accelerations and shears of all floors, and of forces of links.
peaks() {
    awk -F '\t' '$3 == "acceleration" || $3 == "storey_shear" || $3 == "force" {
        print $2, $3, $4 "\t" $5 }' "$work/$1.tsv"
}

# error TOLERANCE: the largest error of a peak of the run over the tolerance.
error() {
    paste "$work/peaks" "$work/peaks_$1" | awk -F '\t' -v tolerance="$1" "$format"'
        $2 > 0 {
            this = relative($2, $4) / tolerance
            most = this > most ? this : most
        }
        END { print most < 1e-3 ? "< 0.001" : number(most, 2) }'
}

for what in link storey contact; do
    stiff_deck $what >"$work/$what.deck"
    for k in 1e9 1e10 1e11 1e12 1e13; do
        longest=$(awk -v k=$k 'BEGIN { print 0.15 / sqrt(k / 1.2e5) }')
        tight=$(awk -v k=$k 'BEGIN { print (k > 1e12 ? "1e-7" : k > 1e11 ? "1e-8" : "1e-10") }')
        simulate right "$work/$what.deck" -D k=$k -D tolerance="$tight" -D longest="$longest"
        peaks right >"$work/peaks"
        printf 'stiff\t| %s | %s' $what $k
        for tolerance in 1e-3 1e-4 1e-5 1e-6 1e-7 1e-8; do
            if simulate loose "$work/$what.deck" -D k=$k -D tolerance=$tolerance \
                -D longest=1 2>"$work/message"; then
                peaks loose >"$work/peaks_$tolerance"
                printf ' | %s' "$(error $tolerance)"
            elif grep -q 'use a larger -tolerance' "$work/message"; then
                printf ' | refused'
            else
                cat "$work/message" >&2
                exit 1
            fi
        done
        echo ' |'
    done
done
