#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The picture of members: the colours are the moments of the result file, the rings its plastic
# rotations, and what is not there is told.
. tests/support/cli.sh

cat >frame.deck <<'END'
units kN m s
building A -floors 2 -mass 50t -height 3.5m 3m
frame A -bays 6m 4m -modulus 200GPa -columns-inextensible
columns A:1:2 -I 0.0004 -lines 1 2 3
beams A:1 -I 0.0005
beams A:2 -I 0.0003
hinges A bases bilinear -yield 40kN*m -hardening 0.03 -stiffness 600MN*m
hinges A:2 beams bilinear -yield 1GN*m -hardening 0.03 -stiffness 500MN*m
building B -floors 3 -mass 50t -stiffness 50MN/m
building C -floors 2 -mass 50t -stiffness 20MN/m -height 3m
wall C:1:2 -EI 2e6
contact A:1 C:1 -gap 10mm -law linear -k 1e5
ground sine -amplitude 0.3g -frequency 1.5 -cycles 3
step fixed 1ms
END
run "$jostle" run -q frame.deck
expect "frame.deck runs" '[ $status -eq 0 ]'
run "$jostle" plot members frame.h5 --script drawn
expect "members are drawn, the kind in front of the file or behind it" '[ $status -eq 0 ] && "$jostle" plot frame.h5 members --script behind && cmp drawn/members.gp behind/members.gp'

# block NAME: the last column of a block.
block() {
    sed -n "/^\$$1 <</,/^EOD/p" drawn/members.dat | awk '/^[-0-9]/ { print $NF }'
}

# shares PATTERN: the moments of the ends i and j of the members in percent of the largest one.
shares() {
    "$jostle" show --tsv frame.h5 | awk -F '\t' -v p="$1" '
        $1 == "members" && $2 ~ p && $3 ~ /^M_[ij]_m/ {
            key = $2 substr($3, 3, 1)
            if (!(key in most)) order[n++] = key
            size = $5 < 0 ? -$5 : $5
            if (size > most[key]) most[key] = size
            if (size > all) all = size
        }
        END { for (i = 0; i < n; i++) printf "%.4f\n", 100 * most[order[i]] / all }'
}

# equal: the same number of numbers, equal to the digits of the data.
equal() {
    paste "$1" "$2" | awk '{ d = $1 - $2; if (NF != 2 || d > 1e-3 || d < -1e-3) bad = 1; n++ } END { exit bad || !n }'
}

for kind in column beam wall; do
    block ${kind}s >drawn.txt
    shares "/${kind}_" >wanted.txt
    expect "each half of a $kind has the share of its end moment" '[ "$(sort -n drawn.txt | tail -n 1)" = 100 ] && equal drawn.txt wanted.txt'
done
expect "rings are the bases, which have yielded, the largest with the largest rotation" '[ "$(block yielded | wc -l)" -eq 3 ] && [ "$(block yielded | sort -n | tail -n 1)" = 3 ]'
expect "hinges that have not yielded are there" '[ "$(block plain | wc -l)" -eq 4 ]'
plastic=$("$jostle" show --tsv frame.h5 | awk -F '\t' '$3 == "plastic_rotation" && $5 > m { m = $5 } END { printf "%.4g", m }')
moment=$("$jostle" show --tsv frame.h5 | awk -F '\t' '$2 ~ "A/beam" && $3 == "moment" && $5 > m { m = $5; n = substr($2, 8) } END { printf "%.4g at %s", m, n }')
expect "the largest values stand below" 'grep -q "^set label .$plastic. at" drawn/members.gp && grep -q "^set label .$moment. at" drawn/members.gp'
expect "a building without members is left out, and the picture says so" 'grep -q "not all buildings are drawn" drawn/members.gp && ! grep -q "^set label .B. at" drawn/members.gp'

two_buildings pair.deck
run "$jostle" run -q pair.deck
run "$jostle" plot pair.h5 members
expect "without frames there is nothing to draw" '[ $status -eq 2 ] && said "pair.h5 has no frames and no walls" && [ ! -e pair-members.png ]'
run "$jostle" plot frame.h5 members --compare frame.h5
expect "two runs are not compared" '[ $status -eq 2 ] && said "it shows one run, not two"'

# A run of a study has the sizes only.
sed 's/-amplitude 0.3g/-amplitude $a/; s/^units.*/&\nsweep a values 1 2\noutput -histories/' frame.deck >study.deck
run "$jostle" run -q study.deck
run "$jostle" plot study.h5#2 members --script study
expect "of a run of a study each half has the larger moment of both ends" '[ $status -eq 0 ] && grep -q "^.columns <<" study/members.dat'
if ! command -v gnuplot >/dev/null; then
    skip "pictures" "no gnuplot"
    exit
fi
for scripts in drawn study; do
    (cd $scripts && gnuplot members.gp) >words 2>&1
    expect "gnuplot draws $scripts without a word" '[ ! -s words ] && [ "$(wc -c <$scripts/members.png)" -gt 12000 ]'
done
for ending in png svg pdf; do
    run "$jostle" plot frame.h5 members -o members.$ending
    expect "it is drawn as $ending" '[ $status -eq 0 ] && [ "$(wc -c <members.$ending)" -gt 8000 ]'
done
