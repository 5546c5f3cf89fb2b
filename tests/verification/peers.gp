# SPDX-License-Identifier: GPL-3.0-or-later
# What jostle differs from OpenSees with either step.
set xlabel 'relative difference'
set logscale x
set xrange [1e-6:1e-1]
set xtics 10
set format x '10^{%T}'
set datafile separator '\t'
set yrange [11.7:-0.7]
set key at screen 0.98, 0.970 right maxrows 1 Left reverse samplen 1
set tmargin at screen 0.900
plot work.'/differences' using 2:0:ytic(1) with points lt 1 ps 0.7 title 'OpenSees, 10 µs', \
    work.'/differences' using 3:0:ytic(1) with points lt 2 ps 0.7 title 'OpenSees, 2.5 µs'
