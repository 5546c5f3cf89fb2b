# SPDX-License-Identifier: GPL-3.0-or-later
# Impact velocity, and closing displacement without contact, over the frequency of the table.
set xlabel 'frequency of the table [Hz]'
set ylabel 'impact velocity [m/s]'
set y2label 'closing displacement [mm]'
set y2tics
set xrange [1.8:3.4]
set yrange [0:*]
set y2range [0:*]
set key outside top center horizontal samplen 2
set arrow from 2.31, graph 0 to 2.31, graph 1 nohead lc rgb '#404040' dt 2 lw 0.8
set arrow from 2.90, graph 0 to 2.90, graph 1 nohead lc rgb '#404040' dt 2 lw 0.8
set label 'T1' at 2.32, graph 0.95
set label 'T2' at 2.91, graph 0.95
plot work.'/sine_0.5' using 1:2 with linespoints lt 1 title 'impact velocity', \
    work.'/closing' using 1:2 axes x1y2 with linespoints lt 2 title 'closing, without contact'
