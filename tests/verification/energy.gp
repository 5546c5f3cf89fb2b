# SPDX-License-Identifier: GPL-3.0-or-later
# Residual over time, 8 and 5 storeys with steps of 1 ms.
set xlabel 'time [s]'
set ylabel '|residual| / input'
set logscale y
set format y '10^{%T}'
set yrange [1e-18:1]
set ytics 1e3
set key at screen 0.98, 0.965 right maxrows 1 Left reverse samplen 2
set tmargin at screen 0.88
array run[3] = ['average', 'linear', 'damped']
array name[3] = ['β, γ = 1/4, 1/2', '1/6, 1/2', '0.3025, 0.6']
plot for [i = 1:3] work.'/'.run[i] with lines lt i lw 1 title name[i]
