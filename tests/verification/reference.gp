# SPDX-License-Identifier: GPL-3.0-or-later
# Errors against the reference solutions, a line of dots for each case.
set xlabel 'error over the largest value of the kind'
set logscale x
set xrange [1e-11:1e-2]
set xtics 100
set format x '10^{%T}'
set datafile separator '\t'
set datafile missing '-'
stats work.'/errors' using 0 nooutput
set yrange [STATS_records - 0.3:-0.7]
set key at screen 0.98, 0.984 right maxrows 1 Left reverse samplen 1
set tmargin at screen 0.947
array kind[4] = ['force', 'displacement', 'acceleration', 'impulse']
plot for [i = 1:4] work.'/errors' using i + 1:0:ytic(1) with points lt i ps 0.7 title kind[i]
