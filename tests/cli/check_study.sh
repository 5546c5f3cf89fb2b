#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle check of a study looks at all its files, and advises on the step for its strongest run.
. tests/support/cli.sh

mkdir records
for i in 1 2 3 4 5 6; do
    awk -v i=$i 'BEGIN {
        print "made up\ntime (s) acceleration (g)"
        for (k = 0; k < 200; k++) printf "%.2f %.6f\n", k * 0.01, i * 0.02 * sin(k * (0.1 + 0.1 * i)) }' \
        >records/r$i.txt
done
cat >study.deck <<'END'
units kN m s
sweep record files "records/*.txt"
sweep pga values 0.1g 0.9g 0.3g
sweep gap values 10mm 20mm
building A -floors 2 -mass 100t -stiffness 90MN/m
building B -floors 1 -mass 80t -stiffness 30MN/m
contact A B -gap $gap -law hertz -k 2e6
ground record $record -pga $pga
step fixed 0.5ms
END
run "$jostle" check study.deck
expect "check of a study ends with 0 and warns about its soft contact only" '[ $status -eq 0 ] && [ "$(grep -c warning: "$err")" -eq 1 ] && said "contact A:1-B:1 is only 1.6 times as stiff as the stiffest storey beside it in run 33 (record = r6, pga = 8.82598, gap = 0.01);"'
expect "it says how many runs and files it looked at" \
    'grep -qx "checked the models of 9 of 36 runs, which read 6 files" "$out"'
lasts() {
    awk '$1 == "A:1-B:1" && NF == 4 && $3 < 1 { print $3 }' "$1"
}
strongest=$(sed -n 's/^run \([0-9]*\) (record = \(r[1-6]\), pga = 8.82[0-9]*, gap = 0.0[12]) is the strongest run checked:$/\2/p' "$out")
expect "it names the strongest run" '[ -n "$strongest" ]'
lasts "$out" >found
for record in r1 r2 r3 r4 r5 r6; do
    for pga in 0.1g 0.3g 0.9g; do
        "$jostle" check -D record=$record -D pga=$pga -D gap=10mm study.deck >single 2>"$err"
        lasts single
    done
done | sort -g >all
expect "its contact is the shortest of all runs" '[ -s found ] && [ "$(cat found)" = "$(head -n 1 all)" ] && [ "$(head -n 1 all)" != "$(tail -n 1 all)" ]'

: >records/r4.txt
run "$jostle" check study.deck
expect "an empty record among six is an error with its run" '[ $status -eq 2 ] && said "run 21 (record = r4, pga = 8.82598, gap = 0.01): study.deck:8:15: records/r4.txt: the file is empty"'
expect "the error comes once" '[ $(grep -c "the file is empty" "$err") -eq 1 ]'
printf '0 .1\n.01 ****\n.02 .1\n' >records/r6.txt
sed -i 's/10mm 20mm/10mm -20mm 20mm/' study.deck
run "$jostle" check study.deck
expect "all errors are reported" '[ $status -eq 2 ] && said "records/r4.txt: the file is empty" && said "records/r6.txt:2:5: value 2" && said "gap = -0.02"'

cat >big.deck <<'END'
units kN m s
sweep m random uniform 50t 100t -n 500 -seed 1
sweep pga range 0.01g 2g 200
building A -floors 1 -mass $m -stiffness 90MN/m
building B -floors 1 -mass 80t -stiffness 30MN/m
contact A B -gap 1cm -law hertz -k 2e6
ground sine -amplitude $pga -frequency 1 -cycles 2
duration 1
step fixed 0.5ms
END
run timeout 20 "$jostle" check big.deck
expect "a study of 100,000 runs is checked within seconds" '[ $status -eq 0 ] && grep -qE "^checked the models of 1[0-9][0-9] of 100000 runs" "$out"'
expect "the strongest intensity is among them" 'grep -q "pga = 19.6133) is the strongest run checked:" "$out"'

# The contact of the last run is stiff, that of the first is not.
cat >stiff.deck <<'END'
units kN m s
sweep k values 9e5 9e9
building A -floors 1 -mass 100t -stiffness 90MN/m
building B -floors 1 -mass 80t -stiffness 30MN/m
contact A B -gap 1cm -law linear -k $k
ground sine -amplitude 0.3g -frequency 1 -cycles 2
duration 1
step fixed 0.5ms
END
run "$jostle" check stiff.deck
expect "warnings are those of the strongest run, once" '[ $status -eq 0 ] && [ $(grep -c "warning: step 0.0005 s covers contact" "$err") -eq 1 ] && grep -q "^run 2 (k = 9e+09) is the strongest run checked:" "$out"'

# The contact is stiff in the first run, stiffest in the strongest run, and soft between them.
sed 's/^sweep k .*/sweep k values 9e6 2e5 9e9/' stiff.deck >soft.deck
run "$jostle" check soft.deck
expect "a contact that is soft in one run only is warned about, with the run" '[ $status -eq 0 ] && said "soft.deck:5:9: warning: contact A:1-B:1 is only 2.2 times as stiff as the stiffest storey beside it in run 2 (k = 200000); below 10" && [ "$(grep -c "as stiff as the stiffest storey" "$err")" -eq 1 ]'
sed -i 's/9e6 2e5 9e9/9e6 9e9/' soft.deck
run "$jostle" check soft.deck
expect "contacts that are stiff in all runs are not warned about" '[ $status -eq 0 ] && ! said "as stiff as the stiffest storey"'
