# SPDX-License-Identifier: GPL-3.0-or-later
# Peak force over four parameters, a line a record.
set multiplot layout 2, 2 margins 0.1, 0.97, 0.2, 0.97 spacing 0.12, 0.15
set ylabel 'peak force [MN]'
set yrange [0:*]
unset key
forces = work.'/forces'
array record[5] = ['El Centro', 'Napa HNE', 'Napa HNN', 'Ridgecrest 090', 'Ridgecrest 360']
set xtics 50
set xrange [0:150]
set ytics 2
set xlabel 'gap [mm]'
plot for [i = 0:4] forces index i using 3:($4 / 1000) with lines
set xtics 0.2
set xrange [*:*]
set ytics 10
set xlabel 'restitution e'
unset ylabel
plot for [i = 0:4] forces index i + 5 using 3:($4 / 1000) with lines
set ylabel 'peak force [MN]' offset 3
set xtics 10
set ytics 10
set logscale xy
set yrange [*:*]
set format x '10^{%T}'
set xlabel 'k [N/m^{3/2}]'
plot for [i = 0:4] forces index i + 10 using 3:($4 / 1000) with lines
unset logscale
unset ylabel
set yrange [0:*]
set format x '%g'
set xtics 0.5
set ytics 5
set xlabel 'period of B [s]'
set key at screen 0.97, 0.08 right maxrows 2 Left reverse samplen 2
plot for [i = 0:4] forces index i + 15 using 3:($4 / 1000) with lines title record[i + 1]
unset multiplot
