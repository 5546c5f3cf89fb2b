# SPDX-License-Identifier: GPL-3.0-or-later
# Ratio of the displacements with and without pounding, by place in the row.
set key outside right center Left reverse samplen 2 title 'periods / T'
set xrange [0.7:5.3]
set xtics 1
set yrange [0.6:1.15]
set xlabel 'building, from left to right'
set ylabel 'ratio of displacements'
set arrow from 0.7,1 to 5.3,1 nohead lc rgb '#404040' dt 2
row(i) = "< awk 'NR == ".i." { for (k = 1; k <= 5; k++) print k, $(5 + k) }' ".work."/ratios"
name(i) = system("awk 'NR == ".i." { print $1, $2, $3, $4, $5 }' ".work."/ratios")
plot for [i = 1:6] row(i) with linespoints lt i ps 0.7 title name(i)
