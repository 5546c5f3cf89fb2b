# SPDX-License-Identifier: GPL-3.0-or-later
# The buildings of tests/peers/models by jostle, beside what OpenSees gave for its own models of
# them: the largest difference at any floor and instant, over the largest displacement of the floor.

peers=tests/peers/buildings.tsv

for deck in tests/peers/models/*.deck; do
    model=${deck##*/}
    model=${model%.deck}
    simulate "$model" "$deck"
    for building in A B; do
        dataset "$model" /buildings/$building/displacement >"$work/displacement"
        awk -F '\t' -v model="$model" -v building=$building '
            NR == FNR { value[n++] = $1; next }
            $1 == model && $2 == building {
                floors = $3 > floors ? $3 : floors
                row[++rows] = $3 SUBSEP $4 SUBSEP $5
            }
            END {
                for (i = 1; i <= rows; i++) {
                    split(row[i], column, SUBSEP)  # floor, time, displacement; a sample every 0.1 s
                    floor = column[1]
                    mine = value[int(column[2] * 10 + 0.5) * floors + floor - 1]
                    difference = mine > column[3] ? mine - column[3] : column[3] - mine
                    size = column[3] < 0 ? -column[3] : column[3]
                    worst[floor] = difference > worst[floor] ? difference : worst[floor]
                    peak[floor] = size > peak[floor] ? size : peak[floor]
                }
                for (floor = 1; floor <= floors; floor++) {
                    printf "%s\t%d\t%d\t%.17g\t%.17g\n", model, floors, rows / floors, peak[floor],
                        worst[floor] / peak[floor]
                }
            }' "$work/displacement" "$peers" >"$work/floors"
        title=$(sed -n 's/^title "\(.*\)"/\1/p' "$deck")
        awk -F '\t' -v title="$title" -v building=$building "$format"'
            $4 > most { most = $4 }
            $5 > worst { worst = $5 }
            { samples = $2 * $3 }
            END {
                if (!NR) { print "no samples of " title >"/dev/stderr"; exit 1 }
                printf "buildings\t| %s | %s | %d | %s | %s |\n", title, building, samples,
                    number(most, 5), small(worst, 1e-11)
            }' "$work/floors"
    done
done
sed -n 's/^# /version\t/p' $peers
