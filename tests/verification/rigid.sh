# SPDX-License-Identifier: GPL-3.0-or-later
# Rigid impacts: a body that bounces to rest, and two bodies that collide.

# A body of 2 kg is pressed by 20 N towards a wall 50 mm away; it arrives after 0.1 s with 1 m/s.
for e in 0.3 0.65 0.9; do
    cat >"$work/bounce.deck" <<END
building A -floors 1 -mass 2kg -stiffness 0
load A:1 constant 20N
contact A wall -gap 50mm -law stereomechanical -e $e
duration 3s
step fixed 1ms
END
    simulate bounce "$work/bounce.deck"
    table -v e=$e -f $here/rigid.awk "$work/bounce.tsv"
    awk -F '\t' '$1 == "impacts" { v[$3, $4] = $5; n = $4 }
        END { for (i = 1; i < n; i++) print i, v["v_rebound", i] }' "$work/bounce.tsv" \
        >"$work/rebounds_$e"
done

cat >"$work/bodies.deck" <<END
building A -floors 1 -mass 25t -stiffness 0
building B -floors 1 -mass 40t -stiffness 0
initial A:1 -velocity 0.5m/s
contact A B -gap 10mm -law stereomechanical -e 0.65
duration 0.1s
step fixed 3ms
END
simulate bodies "$work/bodies.deck"
{
    printf 'instant of impact\ts\t0.02\t%s\n' "$(value bodies impacts t_start)"
    printf 'velocity of rebound\tm/s\t0.325\t%s\n' "$(value bodies impacts v_rebound)"
    printf 'impulse, m* (1 + e) v\tN s\t%s\t%s\n' 12692.307692307692 \
        "$(value bodies impacts impulse)"
    printf 'dissipated, m* (1 - e²) v² / 2\tN m\t%s\t%s\n' 1110.5769230769231 \
        "$(value bodies impacts dissipated)"
} | compare bodies 6
draw 330
