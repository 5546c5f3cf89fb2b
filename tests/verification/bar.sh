# SPDX-License-Identifier: GPL-3.0-or-later
# Hopkinson bar: a striker of 0.3 m hits a bar of 1.5 m of the same steel at 25 m/s.

# bar N: striker and bar as chains of free masses, N of them in the striker.
bar() {
    cat <<END
title "Hopkinson bar"
param modulus 210GPa
param density 7850kg/m^3
param area 314.16mm^2
param dx \${0.3m / $1}
param k \${\$modulus * \$area / \$dx}
building striker -floors $1 -mass \${\$density * \$area * \$dx} -stiffness 0 $(($1 - 1))*\$k
building bar -floors $((5 * $1)) -mass \${\$density * \$area * \$dx} -stiffness 0 $((5 * $1 - 1))*\$k
initial striker:all -velocity 25m/s
contact striker:$1 bar:1 -gap 0.1mm -law linear -k \$k
step fixed 0.05us
duration 150us
output -interval 1us
END
}

for n in 15 30 60 120; do
    bar $n >"$work/bar.deck"
    simulate bar_$n "$work/bar.deck"
    dataset bar_$n /contacts/force >"$work/force_$n"
    # The plateau without the ends: rows are 1 us apart, the contact begins at 4 us and lasts 116.
    awk -v n=$n -v closed="$(value bar_$n impacts t_start)" -v open="$(value bar_$n impacts t_end)" \
        -v impulse="$(value bar_$n impacts impulse)" "$format"'
        BEGIN {
            speed = sqrt(210e9 / 7850)
            plateau = 7850 * speed * 314.16e-6 * 25 / 2
            whole = 7850 * 314.16e-6 * 0.3 * 25
            duration = 2 * 0.3 / speed
        }
        NR > 31 && NR <= 101 { sum += $1; rows++ }
        END {
            printf "bar\t| %d | %s | %s | %s | %s | %s | %s |\n", n,
                number(sum / rows / 1000, 5), small(relative(plateau, sum / rows), 1e-12),
                number((open - closed) * 1e6, 5), small(relative(duration, open - closed), 1e-12),
                number(impulse, 5), small(relative(whole, impulse), 1e-12)
        }' "$work/force_$n"
done
awk "$format"'
BEGIN {
    speed = sqrt(210e9 / 7850)
    print "speed\t" number(speed, 5)
    print "plateau\t" number(7850 * speed * 314.16e-6 * 25 / 2000, 5)
    print "duration\t" number(2e6 * 0.3 / speed, 5)
    print "impulse\t" number(7850 * 314.16e-6 * 0.3 * 25, 5)
}'
value bar_120 contacts force | awk '{ printf "peak\t%.3g\n", $1 / 1000 }'
draw 330
