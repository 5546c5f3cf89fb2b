# SPDX-License-Identifier: GPL-3.0-or-later
# Five single-storey buildings in a row: largest displacements with pounding over those without.

# row T FACTOR...: five buildings of the periods T times the factors.
row() {
    base=$1
    shift
    i=0
    echo 'param gap 10mm'
    echo 'param record ""'
    for factor in "$@"; do
        i=$((i + 1))
        echo "building B$i -floors 1 -mass 300t" \
            "-stiffness \${300t * (2 * pi / ($factor * ${base}s))^2}"
        echo "damping B$i modal 5%"
    done
    while [ $i -gt 1 ]; do
        echo "contact B$((i - 1)) B$i -gap \$gap -law kelvin-voigt -k 4500MN/m -e 0.65"
        i=$((i - 1))
    done
    printf 'ground record $record\nstep fixed 0.5ms\n'
}

# displacements RUN: those of the five, and the count of impacts, on one line.
displacements() {
    awk -F '\t' '
        $1 == "buildings" && $3 == "displacement" { printf "%s ", $5 }
        $1 == "contacts" && $3 == "impacts" { n += $5 }
        END { print n }' "$work/$1.tsv"
}

while IFS=';' read -r factors; do
    for base in 0.3 0.5 0.8 1.2; do
        # shellcheck disable=SC2086  # one word a building
        row $base $factors >"$work/row.deck"
        for record in "$root"/input/records/*.AT2; do
            simulate close "$work/row.deck" -D record="$record"
            simulate apart "$work/row.deck" -D record="$record" -D gap=10m
            echo "$factors $(displacements close) $(displacements apart)"
        done
    done
done <<'END' >"$work/runs"
1 0.8 1 0.8 1
0.8 1 0.8 1 0.8
1 0.9 0.8 0.7 0.6
1 1 0.6 1 1
1 0.6 0.6 0.6 1
0.6 1 1 1 0.6
END
awk -f $here/row.awk "$work/runs" >"$work/ratios"
awk '{
    printf "row\t| %s, %s, %s, %s, %s | %.2f | %.2f | %.2f | %.2f | %.2f | %d of %d | %.0f |\n",
        $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13
}' "$work/ratios"
awk '{
    above += $11
    runs += $12
    for (i = 6; i <= 10; i++) {
        reduced += $i < 1
    }
}
END {
    print "above\t" above
    print "runs\t" runs
    print "reduced\t" reduced
}' "$work/ratios"
draw 300
