#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# accuracy.sh JOSTLE FOLDER: the error of the restitution of one impact against the number of steps in
# it, law by law. 25 t at 0.5 m/s hit 40 t at rest; each error is the root
# mean square over closures at eight phases of the step. What is right, and how long the impact
# lasts, is what `jostle law` finds.
set -eu
jostle=$1
folder=$2
deck=$folder/accuracy.deck
result=$folder/accuracy.h5

value() {
    "$jostle" law $1 -m1 25t -m2 40t -v 0.5 --tsv | awk -v key="$2" '$1 == key { print $2 }'
}

# measure LAW DT GAP: the restitution of an analysis.
measure() {
    cat >"$deck" <<END
building A -floors 1 -mass 25t -stiffness 0
building B -floors 1 -mass 40t -stiffness 0
initial A:1 -velocity 0.5
contact A B -gap $3 -law $1
duration 0.15
step fixed $2
output -every 1000000
END
    "$jostle" run -q --force -o "$result" "$deck"
    "$jostle" show "$result" --tsv |
        awk '$3 == "v_approach" { v = $5 } $3 == "v_rebound" { printf "%.17g\n", $5 / v }'
}

# A line of the table. Tables, contacts and quantities of show have no blanks, so awk need not know
# of tabs.
row() {
    law=$1
    duration=$(value "$law" duration)
    exact=$(value "$law" achieved_restitution)
    printf '%-20s' "${law%% *}"
    for n in 10 20 50 100; do
        for phase in 0 1 2 3 4 5 6 7; do
            dt=$(awk "BEGIN { printf \"%.17g\", $duration / $n }")
            gap=$(awk "BEGIN { printf \"%.17g\", 0.01 + 0.5 * $dt * $phase / 8 }")
            measure "$law" "$dt" "$gap"
        done | awk -v exact="$exact" -v n="$n" '
            { e = $1 / exact - 1; sum += e * e }
            END { printf "%s %.3g\n", n, 100 * sqrt(sum / NR) }'
    done | awk '
        { printf "%10s %%", $2; error[$1] = $2 }
        END { printf "%8.1f\n", log(error[50] / error[100]) / log(2) }'
}

printf '%-20s%12s%12s%12s%12s%8s\n' law "10 steps" "20 steps" "50 steps" "100 steps" order
# The examples of `jostle laws` are impacts of these two bodies, one for each law that takes steps.
mkdir -p "$folder/input"
cp input/pad.txt "$folder/input"
"$jostle" laws | awk '$1 == "example" && / -m1 / { sub(/.*jostle law /, ""); sub(/ -m1 .*/, ""); print }' \
    >"$folder/examples"
while read -r law; do
    row "$law" </dev/null
done <"$folder/examples"
