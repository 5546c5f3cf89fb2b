# SPDX-License-Identifier: GPL-3.0-or-later
# How much a small change of the input moves the results.

# variant RUN CASE STEP SCRIPT: a reference deck changed by sed.
variant() {
    reference_deck "$2" "$3" | sed "$4" >"$work/$1.deck"
    simulate "$1" "$work/$1.deck"
}

# change CASE LABEL STEP SCRIPT: a row of relative changes against the run as it is.
change() {
    variant changed "$1" "$3" "$4"
    table -v name="$(echo "$1" | tr A-Z a-z)" -v label="$2" -f $here/conditioning.awk \
        "$work/$1.tsv" "$work/changed.tsv"
}

for case in B4_towers_jankowski B4_towers_kelvin_voigt D_8v5_jankowski; do
    gap=$(sed -n 's/.* -gap \([0-9.]*\).*/\1/p' tests/verify/reference/$case.deck | head -n 1)
    dt=0.01 half=0.005
    [ $case = D_8v5_jankowski ] && dt=0.1 half=0.05
    variant $case $case $dt ''
    for part in 1e-8 1e-6 1e-4 1e-2; do
        moved=$(awk -v gap="$gap" -v part=$part 'BEGIN { printf "%.17g", gap * (1 + part) }')
        change $case "gap × (1 + $part)" $dt "s/-gap $gap/-gap $moved/"
        mv "$work/changed.tsv" "$work/$case.$part.tsv"
    done
    change $case 'record × (1 + 1e-6)' $dt 's/^ground record.*/& -scale 1.000001/'
    change $case 'record × (1 + 1e-2)' $dt 's/^ground record.*/& -scale 1.01/'
    change $case 'step / 2' $half ''
done

# Change of the approach velocity of each impact of the towers, over the largest.
for case in B4_towers_jankowski B4_towers_kelvin_voigt; do
    for part in 1e-8 1e-6 1e-4 1e-2; do
        awk -F '\t' '
            $3 != "v_approach" { next }
            FNR == NR { v[$4] = $5; most = $5 > most ? $5 : most; next }
            $4 in v { d = $5 - v[$4]; print $4, (d < 0 ? -d : d) / most }
        ' "$work/$case.tsv" "$work/$case.$part.tsv"
        echo
        echo
    done
done >"$work/impacts"
draw 330
