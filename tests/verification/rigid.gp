# SPDX-License-Identifier: GPL-3.0-or-later
# Velocities of the bouncing body, dots, on their closed forms e^n.
set xlabel 'rebound'
set ylabel 'velocity [m/s]'
set logscale y
set format y '10^{%T}'
set ytics 10
set xrange [0:95]
set key outside right center Left reverse samplen 2 spacing 1.3
array e[3] = ['0.3', '0.65', '0.9']
plot for [i = 1:3] work.'/rebounds_'.e[i] with points lt i title 'e = '.e[i], \
    for [i = 1:3] work.'/rebounds_'.e[i] using 1:(real(e[i]) ** $1) with lines lc rgb '#808080' \
        lw 0.8 title i == 1 ? 'e^n' : ''
