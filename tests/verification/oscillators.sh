# SPDX-License-Identifier: GPL-3.0-or-later
# Numbers that OpenSeismoMatlab prints and that OpenSees gives: five storeys in SI, one storey that
# yields, a friction pendulum. In all of them El Centro begins with a sample of 0.

record=$(el_centro)

# base_moment RUN: the largest moment at the base [kN m], the shears of five storeys of 4 m at each
# instant.
base_moment() {
    dataset "$1" /buildings/A/storey_shear | awk '
        { moment += 4 * $1 }
        NR % 5 == 0 {
            if (moment < 0) { moment = -moment }
            if (moment > largest) { largest = moment }
            moment = 0
        }
        END { printf "%.17g\n", largest }'
}

# five RUN PRINTED...: rows of the roof, the shear of storey 5, the base shear and the base moment.
five() {
    printf 'roof displacement\tcm\t%s\t%s\n' "$2" "$(value "$1" buildings displacement A 5)"
    printf 'shear of storey 5\tkN\t%s\t%s\n' "$3" "$(value "$1" buildings storey_shear A 5)"
    printf 'base shear\tkN\t%s\t%s\n' "$4" "$(value "$1" buildings storey_shear A 1)"
    [ -z "${5-}" ] || printf 'base moment\tkN m\t%s\t%s\n' "$5" "$(base_moment "$1")"
}

simulate si $here/five_storeys_si.deck -D record="$record"
five si 17.3303 153.6139 323.5612 3800.1874 | compare five_si 7
simulate si_fine $here/five_storeys_si.deck -D record="$record" -D dt=0.1ms
five si_fine 17.39480 155.52899 323.05147 | compare five_fine 7

# storey NAME PEAK END SCALE SHARE HARDENING: the peak, and the displacement at the end where END is
# not empty.
storey() {
    simulate storey $here/storey.deck -D record="$record" -D scale="$4" -D share="$5" -D hardening="$6"
    printf '%s, El Centro x %s: peak\tm\t%s\t%s\n' "$1" "$4" "$2" \
        "$(value storey buildings displacement)"
    [ -z "$3" ] || printf '%s, El Centro x %s: end\tm\t%s\t%s\n' "$1" "$4" "$3" \
        "$(dataset storey /buildings/A/displacement | tail -n 1)"
}
{
    storey elastic 0.113026 '' 1 100 0
    storey elastic 0.226051 '' 2 100 0
    storey 'elastic-perfectly plastic' 0.103346 -0.00299 1 0.1 0
    storey 'elastic-perfectly plastic' 0.205325 -0.13951 2 0.1 0
    storey 'bilinear, 5 %' 0.099577 0.01397 1 0.1 0.05
    storey 'bilinear, 5 %' 0.184408 -0.00727 2 0.1 0.05
    simulate pendulum $here/pendulum.deck -D record="$record"
    printf 'friction pendulum, El Centro x 2: peak\tm\t0.248632\t%s\n' \
        "$(value pendulum buildings displacement)"
} | compare storeys 6
