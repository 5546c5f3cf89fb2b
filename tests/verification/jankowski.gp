# SPDX-License-Identifier: GPL-3.0-or-later
# Peak forces against those that the paper prints.
set xlabel 'peak force against the paper [%]'
set xrange [-30:5]
set datafile separator '\t'
set yrange [8.7:-0.7]
unset key
set style fill solid noborder
set boxwidth 0.6
set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb '#404040' lw 0.8
plot work.'/against' using (0):0:(0):2:($0 - 0.3):($0 + 0.3):(int($0 / 3) + 1):ytic(1) \
    with boxxyerror lc variable
