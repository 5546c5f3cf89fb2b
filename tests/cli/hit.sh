#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Peak accelerations of floors that were hit are marked in the tables and pictures of runs and studies.
. tests/support/cli.sh

cat >two.deck <<'END_DECK'
units kN m s
sweep pga values 0.1g 0.5g
building A -floors 2 -mass 300t -stiffness 545MN/m -height 3m
building B -floors 3 -mass 300t -stiffness 345MN/m -height 3m
damping A rayleigh 5%
damping B rayleigh 5%
contact A B -gap 20mm -law hunt-crossley -n 1 -k 9000MN/m -e 0.65 -name seam
ground sine -amplitude $pga -frequency 2 -cycles 4
duration 3
step fixed 0.5ms
END_DECK
note='* this floor was hit: its peak depends on the contact stiffness'
# hits TABLE: quantity, place and mark of the values that have a mark
hits() {
    awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["hit"] != "" { printf "%s:%s=%s ", $at["name"], $at["location"], $at["hit"] }' "$1"
}

run "$jostle" run two.deck
expect "the largest values of a study mark accelerations of floors that were hit" '[ $status -eq 0 ] && grep -qE "^A +acceleration +2 .* [0-9.]+\* 2 \(pga 4.903\)$" "$out" && [ "$(grep -c "\* 2 (pga" "$out")" -eq "$(grep -cE "^[AB] +acceleration.*\*" "$out")" ] && grep -qxF "$note" "$out"'
cp "$out" first
run "$jostle" show two.h5
expect "show marks them, too" 'cmp -s first "$out"'
run "$jostle" show two.h5 --tsv
expect "--tsv of a study has a column for them" '[ "$(hits "$out")" = "A:1=0 A:2=0 B:1=0 B:2=0 B:3=0 A:1=0 A:2=1 B:1=0 B:2=1 B:3=0 " ]'
run "$jostle" show two.h5 --long --edp acceleration:A --edp drift --edp acceleration:B:3
expect "--long has it" '[ "$(cut -f 2,7 "$out" | tr "\t\n" "= ")" = "edp=hit acceleration:A=0 drift= acceleration:B:3=0 acceleration:A=1 drift= acceleration:B:3=0 " ]'
run "$jostle" run two.deck -D pga=0.5g -o one.h5
expect "the summary of a run explains its mark with the same words" 'grep -qxF "$note" "$out"'
run "$jostle" show one.h5 --tsv
expect "--tsv of a run has the column" '[ "$(hits "$out")" = "A:1=0 A:2=1 B:1=0 B:2=1 B:3=0 " ]'

for kind in response ida fragility; do
    limit=$([ $kind = fragility ] && echo "--limit 0.3g")
    run "$jostle" plot two.h5 $kind --edp acceleration:A $limit --script $kind
    expect "$kind says how many accelerations are of floors that were hit" '[ $status -eq 0 ] && grep -q "in 1 of 2 runs of a floor that was hit" $kind/*.gp'
done
expect "response and ida have rings" 'for kind in response ida; do grep -q "\$hit using" $kind/*.gp && [ "$(sed -n "/^\$hit/,/^EOD/p" $kind/*.dat $kind/*.gp 2>/dev/null | grep -c "^[0-9]")" -eq 1 ] || return 1; done'
run "$jostle" plot two.h5 response --edp acceleration:B:3 --script far
expect "other floors have none" '[ $status -eq 0 ] && ! grep -q "hit" far/*.gp'

# Rigid contacts have no force, and what they do to accelerations is not in them.
sed 's/-law .* -name/-law stereomechanical -e 0.65 -name/' two.deck >rigid.deck
run "$jostle" run rigid.deck
expect "rigid contacts leave no mark" '[ $status -eq 0 ] && ! grep -q "\*  *[0-9]* (pga\|was hit" "$out"'
