#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle street: decks from tables, their periods, strengths and contacts, messages, and the map.
. tests/support/cli.sh

cat >row.csv <<'END'
# a comment
Name;Storeys;type;year;storey height [m];mass [t];gap [mm];k [GN/m];e;law;damping;period [s]

left;5;C1;1960;3;200;25;;;;;
mid;2;W1;1930;3;50 t;none;;;takeda;3%;
right;3;;;4;80000 kg;1 cm;2;0.5;;;0.4
last;1;MH;;3;20;;;;;;
END
run "$jostle" street row.csv --record q.txt --pga 0.2g
cp "$out" row.deck
expect "a table becomes a deck, with a warning about a gap of none" '[ $status -eq 0 ] && [ ! -s "$err" ]'
expect "types take the class of their storeys and the code of their year" 'grep -qx "# C1M, moderate code, T1 = 0.75 s" "$out" && grep -qx "# W1, moderate code, T1 = 0.7 s" "$out" && grep -qx "# T1 = 0.4 s" "$out"'
expect "the columns replace what the type gives" 'grep -q "^building mid -floors 2 -mass 50 -height 3 " "$out" && grep -qx "damping mid rayleigh 0.03 -tangent" "$out" && grep -q "^storey mid:all takeda " "$out" && grep -qx "damping right rayleigh 0.05" "$out" && ! grep -q "^storey right" "$out"'
expect "gaps become contacts, by levels where storeys differ, and none where there is none" '[ "$(grep -c ^contact "$out")" -eq 2 ] && grep -q "^contact left mid -gap 0.025 -law hunt-crossley -n 1 -k [0-9.e+]* -e 0.65$" "$out" && grep -qx "contact right last -by-level -gap 0.01 -law hunt-crossley -n 1 -k 2e+06 -e 0.5" "$out"'
# By hand: 5 equal floors, a = 1.5 6/11, A_y = 0.104 g, W = 1000 t g; V_i / V_1 = 1, 14/15, 12/15, 9/15, 5/15.
expect "storeys yield together at the base shear of the capacity curve" 'awk "/^storey left:all/ { want = 0.104 * 1.5 * 6 / 11 * 1000 * 9.80665; n = split(\"15 14 12 9 5\", s); for (i = 1; i <= n; i++) { x = \$(4 + i) / (want * s[i] / 15); bad = bad || x < 0.99999 || x > 1.00001 } found = \$10 == \"-hardening\" && \$11 == 0.181818 } END { exit bad || !found }" "$out"'
# k = 20 times the stiffer storey 1: that of left, (2 pi / 0.75 s)^2 200 t 15.
expect "contacts are 20 times as stiff as the stiffer storey" 'awk "/^contact left/ { x = \$11 / (20 * (2 * 3.14159265358979 / 0.75) ^ 2 * 200 * 15); found = x > 0.99999 && x < 1.00001 } END { exit !found }" "$out"'
printf '0 0\n0.5 1\n1 0\n' >q.txt
sed -i 's/"q.txt"/"q.txt" -unit g/' row.deck
run "$jostle" modes row.deck --tsv
expect "the first modes are straight lines with the periods that were wanted" '[ $status -eq 0 ] && awk -F "\t" "\$2 == 1 { n++; T = \$1 == \"left\" ? 0.75 : \$1 == \"mid\" ? 0.7 : \$1 == \"right\" ? 0.4 : 0.35; N = \$1 == \"left\" ? 5 : \$1 == \"mid\" ? 2 : \$1 == \"right\" ? 3 : 1; t = \$3 / T; u = \$9 / (\$8 / N); bad = bad || t < 0.99999 || t > 1.00001 || u < 0.9999 || u > 1.0001 } END { exit bad || n != 11 }" "$out"'
expect "and have the damping of the table, also where it is on the tangent stiffness" 'awk -F "\t" "NR > 1 && \$2 <= 2 { n++; want = \$1 == \"mid\" ? 3 : 5; x = \$6 / want; bad = bad || x < 0.99999 || x > 1.00001 } END { exit bad || n != 21 }" "$out"'
run "$jostle" run row.deck -q
expect "the deck runs" '[ $status -eq 0 ] && [ -s row.h5 ]'
run "$jostle" street row.csv
expect "without a record it is for another deck" '[ $status -eq 0 ] && ! grep -q "^ground\|^step" "$out" && tail -n 1 "$out" | grep -q "^# Add a ground motion"'
run "$jostle" street row.csv -o out.deck
expect "-o writes a file" '[ $status -eq 0 ] && [ ! -s "$out" ] && grep -q "^building last" out.deck'
run "$jostle" street row.csv -o out.deck
expect "but replaces none" '[ $status -eq 2 ] && said "out.deck"'
run "$jostle" street row.csv -o out.deck --force
expect "without --force" '[ $status -eq 0 ]'
run "$jostle" street --types --tsv
# HAZUS, table 5.7b, of C1M: D_y = 0.58 in, A_y = 0.104 g, D_u = 6.91 in, A_u = 0.312 g.
expect "types are those of HAZUS" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 145 ] && awk -F "\t" "\$1 == \"C1M\" && \$8 == \"moderate\" { dy = \$9 * 9.80665 * \$5 ^ 2 / 4 / 3.14159265358979 ^ 2 / 0.0254; du = \$7 * \$10 * dy; good = dy > 0.57 && dy < 0.59 && du > 6.84 && du < 6.98 } END { exit !good }" "$out"'

refused() {
    local place=$1 text=$2
    run "$jostle" street bad.csv
    expect "refused: $text" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "bad.csv:$place: error: $text"'
}
table() { printf "$1\n" >bad.csv; }
table 'name,storeys [m]\nA,1'
refused 1:15 "'m' is not a unit of storeys; SI has 1"
table 'name,type\nA,C1'
refused 1:1 "the headings have no column 'storeys'"
table 'storeys,storeys\n1,1'
refused 1:9 "a second column storeys"
table 'storeys,type,gap\n3,C1,20'
refused 2:6 "gap has no unit; write it in the heading, as in 'gap [mm]', or behind the number"
table 'storeys,type,gap [mm]\n3,C1,x'
refused 2:6 "gap is 'x'; it must be a number"
table 'storeys,type,gap [mm]\n3,C1,2 kg'
refused 2:6 "'2 kg' is not gap with its unit"
table 'storeys,type,gap [mm]\n3,C1,-20'
refused 2:6 "gap is -20; it must be >= 0 and <= 1000 m"
table 'storeys,type\n2.5,C1'
refused 2:1 "storeys is 2.5; it must be whole, >= 1 and <= 1000"
table 'storeys,type\n2,Q7'
refused 2:3 "unknown type 'Q7' with 2 storeys; types are those of HAZUS, such as W1, S1, C1 and URM: see jostle street --types"
table 'storeys,type\n5,C1L'
refused 2:3 "type C1L has 1 to 3 storeys, not 5"
table 'storeys,type,code\n2,C1,new'
refused 2:6 "code is 'new'; it must be high, moderate, low or pre"
table 'storeys,type,code,year\n2,C1,low,1990'
refused 2:10 "year is given beside code; give one of both"
table 'storeys,type,law\n2,C1,plastic'
refused 2:6 "law is 'plastic'; it must be elastic, bilinear, clough or takeda"
table 'storeys,period [s],law\n2,0.3,takeda'
refused 2:7 "law takeda needs a type or a yield"
table 'storeys,type,law,yield\n2,C1,elastic,0.2'
refused 2:14 "yield has no meaning for the law elastic"
table 'storeys,mass [t]\n2,10'
refused 2:1 "the building needs a type, a period or a stiffness"
table 'storeys,type\n2,C1\n3,C1'
refused 2:1 "the building has no gap to the next one; give a length or none"
table 'name,storeys,type,gap [mm]\nA,2,C1,1\nA,3,C1,'
refused 3:1 "a second building A; the first is number 1"
table 'name,storeys,type\nmy house,2,C1'
refused 2:1 "'my house' cannot name a building; use up to 64 letters, digits, _ and -"
table 'name,storeys,type\n"A",2,C1'
refused 2:1 "quotation marks are not read; leave them out"
table 'storeys,type\n2,C1,5'
refused 2:6 "a cell without a heading; there are 2 headings"
table 'storeys,type\n,C1'
refused 2:1 "the building has no number of storeys"
table 'storeys,type'
refused 1:1 "the table has no building"
table '# nothing'
refused 1:1 "the file has no headings"
table 'storeys,type,hight\n2,C1,3'
run "$jostle" street bad.csv
expect "a column that is not known is told" '[ $status -eq 0 ] && said "bad.csv:1:14: warning: column '"'hight'"' is not used; did you mean '"'height'"'?"'
table 'storeys,type,gap [mm],k [MN/m]\n2,C1,none,30\n2,C1,5,'
run "$jostle" street bad.csv
expect "and so is what has no effect" '[ $status -eq 0 ] && said "bad.csv:2:11: warning: k is not used, because no gap to a next building is given" && said "bad.csv:3:6: warning: the gap is not used: no building follows"'
refuses() {
    local text=$1
    shift
    run "$jostle" street "$@"
    expect "refused: $text" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "jostle street: error: $text"'
}
refuses "one table is expected, not 0"
refuses "one table is expected, not 2" row.csv row.csv
refuses "--types takes no table" --types row.csv
refuses "--tsv, --csv and --json go with --types" row.csv --tsv
refuses "--pga goes with --record" row.csv --pga 1g
refuses "--pga takes an acceleration > 0 with its unit, not '3'" row.csv --record q.txt --pga 3
refuses "--zone is 0 or 1 or 2A or 2B or 3 or 4, not '5'" row.csv --zone 5
refuses "a deck cannot quote the name of the record" row.csv --record 'a"b'
run "$jostle" street no.csv
expect "a table that is not there is told" '[ $status -eq 2 ] && said "no.csv: No such file or directory"'

cp "$root/input/street.csv" .
run awk -f "$root/tests/support/street.awk"
expect "the example is what its script prints" 'cmp -s "$out" street.csv'
run "$jostle" street street.csv --record "$root/input/records/ELCENTRO_1940_NS.AT2" --pga 0.2g -o street.deck
expect "200 houses become a deck without a word" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ "$(grep -c ^building street.deck)" -eq 200 ] && [ "$(grep -c ^contact street.deck)" -eq 192 ]'
echo "duration 2.5" >>street.deck
run "$jostle" run street.deck -q
expect "which runs without a warning" '[ $status -eq 0 ] && [ ! -s "$err" ]'
sed 's/ -tangent//' street.deck >balance.deck
run "$jostle" run balance.deck
# Contacts close in a step in which others of the same two houses, and of others, act already.
expect "and whose energy is balanced, with floors in several blocks" '[ $status -eq 0 ] && awk "/^residual/ { found = \$(NF - 3) < 1e-11 } END { exit !found }" "$out"'
run "$jostle" plot street.h5 street --script scripts
expect "and has a map" '[ $status -eq 0 ] && [ -s scripts/street.dat ]'
run "$jostle" plot row.h5 street --compare row.h5 -o two.png
expect "of one run" '[ $status -eq 2 ] && said "street cannot be drawn: it shows one run, not two"'
if python3 -c 'import h5py' 2>/dev/null; then
    run python3 "$root/tests/support/check_street.py" street.h5 scripts/street.dat
    expect "whose drifts, forces and points are those of the results" '[ $status -eq 0 ]'
else
    skip "numbers of the map" "no h5py"
fi
