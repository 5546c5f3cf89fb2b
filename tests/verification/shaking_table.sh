# SPDX-License-Identifier: GPL-3.0-or-later
# Two towers on a shaking table: impacts and closing displacements over the frequency of a sine.

# Closing displacements grow with the amplitude of the sine: one study tells them all [mm].
"$jostle" run input/shaking_table.deck -D gap=1m -o "$work/free.h5" -q --force
"$jostle" show "$work/free.h5" --wide --edp penetration |
    awk -F '\t' 'NR > 1 { printf "%.2f %.17g\n", $2, 1000 * (1 + $4) }' >"$work/closing"

# sine AMPLITUDE: rows of frequency, largest impact velocity, impacts in a cycle.
sine() {
    cut -d ' ' -f 1 "$work/closing" | while read -r frequency; do
        simulate hit input/shaking_table.deck -D amplitude="$1m/s^2" -D f="${frequency}Hz"
        awk -F '\t' -v f="$frequency" '
            $1 == "impacts" && $3 == "v_approach" { n++; if ($5 > most) most = $5 }
            END { print f, most + 0, n / (30 * f) }' "$work/hit.tsv"
    done
}

fastest='the impact velocity is largest between both frequencies |'
cycles='impacts occur once in a cycle, or in every other one |'
for amplitude in 0.3 0.5 1; do
    sine $amplitude >"$work/sine_$amplitude"
    most=$(sort -k 2,2g "$work/sine_$amplitude" | tail -n 1)
    fastest="$fastest $(echo "$most" | awk '{ printf "%.2f Hz, %.2f m/s |", $1, $2 }')"
    cycles="$cycles $(echo "$most" | awk '{ printf "%.2f in a cycle at %.2f Hz |", $3, $1 }')"
done
echo "sines	| $fastest"
echo "sines	| $cycles"
widest=$(sort -k 2,2g "$work/closing" | tail -n 1)
for amplitude in 0.3 0.5 1; do
    echo "$widest" | awk -v a=$amplitude '{ printf "%.2f Hz, %.0f mm |\n", $1, $2 * a / 0.5 }'
done | awk '{ line = line " " $0 }
    END { print "sines\t| the gap that avoids impacts is largest near the flexible tower |" line }'

simulate hit input/two_towers.deck
simulate free input/two_towers.deck -D gap=1m
while read -r tower measured; do
    awk -v tower="$tower" -v measured="$measured" \
        -v free="$(value free buildings displacement "$tower")" \
        -v hit="$(value hit buildings displacement "$tower")" '
        BEGIN {
            printf "towers\t| %s | %s | %.1f | %.1f | %+.0f %% |\n", measured, tower, 1000 * free,
                1000 * hit, 100 * (hit - free) / free
        }'
done <<'END'
T1 contact reduces the response of the flexible tower
T2 contact increases the response of the stiff tower
END
draw 330
