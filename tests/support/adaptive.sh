#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# adaptive.sh JOSTLE FOLDER: the runs, the median and the dispersion of adaptive searches of a pair
# under 44 artificial records, beside those of a grid of 200 intensities. Works in FOLDER.
set -eu
jostle=$1
folder=$2/adaptive

mkdir -p "$folder/records"
awk -v folder="$folder/records" -v n=44 -f tests/support/artificial_records.awk
cat >"$folder/pair.deck" <<'DECK'
units kN m s
sweep record files "records/*.AT2"
sweep sa range 0.1m/s^2 20m/s^2 200
building A -floors 1 -mass 100t -stiffness 4MN/m -height 3m
building B -floors 1 -mass 80t -stiffness 9MN/m -height 3m
storey A:1 clough -yield 120kN -hardening 3%
damping A rayleigh -alpha 0.6 -beta 0
damping B rayleigh -alpha 1 -beta 0
contact A B -gap 20mm -law linear -k 100MN/m
ground record $record -sa $sa -building A
step fixed 5ms
DECK

# line NAME SEARCH...: a line of the table.
line() {
    name=$1
    shift
    "$jostle" ida "$folder/pair.deck" --limit drift-ratio:A=2% --tsv "$@" |
        awk -F '\t' -v name="$name" -v grid="$grid" '
            NR == 1 { for (i = 1; i <= NF; i++) { sub(/ \[.*/, "", $i); at[$i] = i }; next }
            { n += $at["runs"]; median = $at["median"]; beta = $at["dispersion"] }
            END { printf "%-38s %6d %9.4f %11.4f %+8.2f %%\n", name, n, median, beta, 100 * (median / grid - 1) }'
}

"$jostle" run "$folder/pair.deck" -o "$folder/pair.h5" -q --force
"$jostle" fragility "$folder/pair.h5" --edp drift-ratio:A --limit 2% --method ida --tsv |
    awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        NR == 2 { print $at["median"], $at["dispersion"] }' >"$folder/grid"
read -r grid scatter <"$folder/grid"
printf '%-38s %6s %9s %11s %10s\n' search runs median dispersion difference
printf '%-38s %6d %9.4f %11.4f\n' 'grid of 200 intensities' 8800 "$grid" "$scatter"
line 'factor 1.3, to 1 %'
line 'factor 1.3, to 10 %' --tolerance 10%
line 'factor 1.3, to 10 %, middle' --tolerance 10% --curve middle
line 'steps from 0.1g by 0.05g, to 10 %' --step 0.1g:0.05g --tolerance 10%
line 'the same, 12 runs a record' --step 0.1g:0.05g --tolerance 10% --runs 12
