# SPDX-License-Identifier: GPL-3.0-or-later
# Frames and walls: published numbers, and closed forms of walls and of the shear-flexure beam.

# period DECK MODE: of the first building, without warnings about periods that no building has.
period() {
    "$jostle" modes "$1" --tsv 2>"$work/warnings" | awk -F '\t' -v mode="$2" '
        NR > 1 && $2 == mode { print $3; exit }'
}

simulate frame $here/frames.deck
{
    mode=0
    for expected in 1.2732 0.4313 0.2420 0.1602 0.1190 0.0951 0.0795; do
        mode=$((mode + 1))
        printf 'period %d\ts\t%s\t%s\n' $mode $expected "$(period $here/frames.deck $mode)"
    done
    printf 'displacement of the roof\tin\t1.45076\t%s\n' \
        "$(dataset frame /buildings/A/displacement | tail -1)"
    printf 'axial force of column_1_1\tkip\t69.99\t%s\n' \
        "$(dataset frame /buildings/A/members/N | tail -35 | head -1)"
    printf 'base moment of column_1_1\tkip in\t2324.68\t%s\n' \
        "$(dataset frame /buildings/A/members/M_i | tail -35 | head -1)"
} | compare frame 6

# A wall of 12 x 120 in, storeys of 120 in, 100 kip at its top, with the answer of SAP2000.
while read -r storeys published; do
    cat >"$work/wall.deck" <<END
units kip in s
building A -floors $storeys -mass 0.1 -height 120
wall A -EI \${3000 * 12 * 120^3 / 12} -GA \${3000 / 2.4 * 12 * 120 * 5 / 6}
damping A rayleigh 50%
load A:$storeys constant 100
step fixed 2ms
duration 20
END
    simulate wall "$work/wall.deck"
    dataset wall /buildings/A/displacement | tail -1 | awk -v n="$storeys" -v published="$published" "$format"'{
        h = 120 * n
        expected = 100 * h ^ 3 / (3 * 5.184e9) + 100 * h / 1.5e6
        printf "wall\t| %d | %s | %s | %s | %s |\n", n, published, number(expected, 6),
            number($1, 6), small(relative(expected, $1), 1e-12)
    }'
done <<'END'
6 2.4287
3 0.3205
1 0.0185
END

# A wall that only bends beside storeys that only shear, 200 of them, alpha = H sqrt(GA / EI).
while read -r alpha second third; do
    awk -v alpha="$alpha" 'BEGIN {
        printf "building A -floors 200 -mass 199*1 0.5 -height 0.005 -stiffness %.17g\n",
            200e6 * alpha ^ 2
        print "wall A -EI 1e6\ninitial A:200 -velocity 1\nstep fixed 1ms\nduration 1"
    }' >"$work/beam.deck"
    for mode in 1 2 3; do
        period "$work/beam.deck" $mode
    done | tr '\n' ' ' | awk -v alpha="$alpha" -v second="$second" -v third="$third" "$format"'{
        error = relative(second, $1 / $2)
        other = relative(third, $1 / $3)
        error = other > error ? other : error
        printf "beam\t| %s | %s | %.5g | %s | %.6g | %s |\n", alpha, second, $1 / $2, third,
            $1 / $3, small(error, 1e-12)
    }'
done <<'END'
1 5.5366 15.1622
2 4.5705 11.8345
5 3.5353 7.5910
10 3.2083 5.9908
20 3.0649 5.3164
50 3.0114 5.0566
END
