# SPDX-License-Identifier: GPL-3.0-or-later
# Change of the approach velocity, impact by impact, under two laws.
set logscale y
set format y '10^{%T}'
set xlabel 'impact of the towers'
set xrange [0:41]
set xtics 10
set ytics 100
set yrange [1e-11:10]
array part[4] = ['10^{-8}', '10^{-6}', '10^{-4}', '10^{-2}']
set multiplot layout 1, 2 margins 0.13, 0.98, 0.33, 0.88 spacing 0.1
set label 'relative change of the gap:' at screen 0.13, 0.055
set key at screen 0.98, 0.085 right maxrows 1 Left reverse samplen 1.5
set title 'jankowski'
set ylabel 'change of approach velocity'
plot for [i = 1:4] work.'/impacts' index i - 1 with lines lt i title part[i]
set title 'kelvin-voigt'
unset label
unset ylabel
unset key
plot for [i = 1:4] work.'/impacts' index i + 3 with lines lt i
unset multiplot
