# SPDX-License-Identifier: GPL-3.0-or-later
# Error of free vibration against the step.
set logscale xy
set xlabel 'step over period'
set ylabel 'error / initial displacement'
set format y '10^{%T}'
set format x '%g'
set key outside right center Left reverse samplen 2
set xrange [0.001:0.05]
array method[5] = ['0, 1/2', '1/12, 1/2', '1/6, 1/2', '1/4, 1/2', '0.3025, 0.6']
plot for [i = 1:5] work.'/errors' index i - 1 using (1.3 / $3):5 with linespoints lt i \
    title 'β, γ = '.method[i]
