# SPDX-License-Identifier: GPL-3.0-or-later
# Chopra's tables: the oscillator of chapter 5, the five storeys of chapter 13.

# at RUN TIME: displacement.
at() {
    history "$1" | awk -v time="$2" '($1 - time) ^ 2 < 1e-18 { print $2 }'
}

simulate central $here/oscillator.deck -D beta=0
simulate linear $here/oscillator.deck -D beta=0.16666666666666667
simulate average $here/oscillator.deck
simulate plastic $here/oscillator.deck -D yield=7.5kip
simulate fine $here/oscillator.deck -D dt=0.1ms
{
    while read -r table run time expected; do
        printf '%s, t = %s s\tin\t%s\t%s\n' "$table" "$time" "$expected" "$(at $run $time)"
    done <<'END'
E5.2 central 0.5 1.5808
E5.2 central 1.0 -1.3726
E5.3 average 0.5 1.4310
E5.3 average 1.0 -1.1442
E5.4 linear 0.5 1.4782
E5.4 linear 1.0 -1.2208
E5.5 plastic 0.7 2.0952
E5.5 plastic 1.0 1.1416
END
    awk -f $here/chopra.awk | while read -r time expected; do
        printf 'closed form, t = %s s\tin\t%s\t%s\n' "$time" "$expected" "$(at fine $time)"
    done
} | compare oscillator 5
for run in fine central average linear plastic; do
    history $run >"$work/$run"
done
pick oscillator 1 3 | sed -n 's/^E.*t = \(.*\) s\t/\1\t/p' >"$work/book"
draw 360

record=$(el_centro)
for dt in 0.02 0.01 0.001; do
    simulate five_$dt $here/five_storeys.deck -D record="$record" -D dt=${dt}s
done
for mode in 1 2 3 4 5; do
    printf '%s\t%s\n' $mode "$(value five_0.01 buildings period A $mode)"
done | awk -F '\t' "$format"'
    {
        period = atan2(0, -1) / sqrt(31.54 * 386.4 / 100) / sin((2 * $1 - 1) * atan2(0, -1) / 22)
        e = relative(period, $2)
        most = e > most ? e : most
    }
    END { print "modes\t" small(most, 1e-12) }'
{
    for dt in 0.02 0.01 0.001; do
        printf 'base shear, step %s s\tkip\t73.278\t' $dt
        value five_$dt buildings storey_shear A 1
        printf 'shear of storey 5, step %s s\tkip\t35.217\t' $dt
        value five_$dt buildings storey_shear A 5
        printf 'roof displacement, step %s s\tin\t6.847\t' $dt
        value five_$dt buildings displacement A 5
    done
} | compare five 5
