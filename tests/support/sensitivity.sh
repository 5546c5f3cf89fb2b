#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# sensitivity.sh JOSTLE FOLDER: what the results of two buildings depend on. In the first table, each
# column changes the stiffness, the restitution or the law of the contacts, or the gap. In the second
# one, the columns are contact stiffnesses as multiples of the storey stiffness, and the ratios are
# those to 100 storeys. A number is the geometric mean of the ratios over five records; below it stand
# the smallest and the largest ratio.
set -eu
jostle=$1
folder=$2/sensitivity
mkdir -p "$folder"

# run NAME GAP LAW: the demands of all records, a line each: NAME RECORD EDP VALUE.
run() {
    cat >"$folder/$1.deck" <<END
units kN m s
sweep record files "$PWD/input/records/*.AT2"
building A -floors 8 -mass 300t -stiffness 345MN/m -height 3m
building B -floors 5 -mass 300t -stiffness 345MN/m -height 3m
damping A rayleigh 5%
damping B rayleigh 5%
contact A B -gap $2 -law $3
ground record \$record -pga 0.35g
step fixed 0.05ms
END
    "$jostle" run "$folder/$1.deck" -o "$folder/$1.h5" -q --force
    for edp in drift:A drift:B storey-shear:A:6 acceleration:A:8 acceleration:B:5 force impulse \
        impacts; do
        "$jostle" show "$folder/$1.h5" --long --edp "$edp" |
            awk -F '\t' -v name="$1" -v edp="$edp" '
                NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
                { print name, $column["record"], edp, $column["value"] }'
    done
}

{
    run reference 20mm 'hunt-crossley -n 1 -k 2250MN/m -e 0.65'
    run fifth 20mm 'hunt-crossley -n 1 -k 450MN/m -e 0.65'
    run five 20mm 'hunt-crossley -n 1 -k 11250MN/m -e 0.65'
    run less 20mm 'hunt-crossley -n 1 -k 2250MN/m -e 0.5'
    run more 20mm 'hunt-crossley -n 1 -k 2250MN/m -e 0.75'
    run hertz 20mm 'jankowski -k 2.75e9N/m^1.5 -e 0.65 -calibrate'
    run hertz10 20mm 'jankowski -k 2.75e10N/m^1.5 -e 0.65 -calibrate'
    run wider 21mm 'hunt-crossley -n 1 -k 2250MN/m -e 0.65'
    for storeys in 1 3 6 10 30 100; do
        run "storeys$storeys" 20mm "hunt-crossley -n 1 -k $((345 * storeys))MN/m -e 0.65"
    done
} >"$folder/values"

# table REFERENCE NAMES HEADS: heads are separated by commas.
table() {
    awk -v reference="$1" -v names="$2" -v heads="$3" '
        !($3 in seen) { seen[$3]; edp[++n_edp] = $3 }
        { record[$2]; value[$1, $2, $3] = $4 }
        END {
            n = split(names, name, " ")
            split(heads, head, ",")
            printf "%-18s", "ratio of"
            for (j = 1; j <= n; j++) printf "%12s", head[j]
            print ""
            for (i = 1; i <= n_edp; i++) {
                means = sprintf("%-18s", edp[i])
                ranges = sprintf("%-18s", "")
                for (j = 1; j <= n; j++) {
                    sum = count = high = 0
                    low = 1e300
                    for (r in record) {
                        ratio = value[name[j], r, edp[i]] / value[reference, r, edp[i]]
                        sum += log(ratio)
                        count++
                        if (ratio < low) low = ratio
                        if (ratio > high) high = ratio
                    }
                    means = means sprintf("%12.2f", exp(sum / count))
                    ranges = ranges sprintf("%12s", sprintf("%.2f-%.2f", low, high))
                }
                print means "\n" ranges
            }
        }' "$folder/values"
}

table reference 'fifth five less more hertz hertz10 wider' \
    'k/5,5 k,e = 0.5,e = 0.75,J 2.75e9,J 2.75e10,gap + 1 mm' >"$folder/choices"
table storeys100 'storeys1 storeys3 storeys6 storeys10 storeys30' '1,3,6,10,30' >"$folder/storeys"
