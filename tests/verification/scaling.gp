# SPDX-License-Identifier: GPL-3.0-or-later
# Peak force of an isolated impact over velocity, restitution and stiffness, law by law.
set multiplot layout 1, 3 margins 0.1, 0.97, 0.2, 0.95 spacing 0.06, 0
set yrange [0:*]
set key top center Left reverse samplen 1
array name[3] = ['kelvin-voigt', 'jankowski', 'hunt-crossley']
set ylabel 'peak force [MN]'
set xlabel 'velocity [m/s]'
set xtics 0.2
set xrange [0:1]
plot for [i = 1:3] work.'/over_v' index i - 1 with lines lt i notitle
unset ylabel
set xlabel 'restitution'
set yrange [0:24]
plot for [i = 1:3] work.'/over_e' index i - 1 with lines lt i title name[i]
unset key
set yrange [0:*]
set xlabel 'k [10^9 N/m or N/m^{3/2}]'
set xtics 2
set xrange [0:10]
plot for [i = 1:3] work.'/over_k' index i - 1 using ($1 / 1e9):2 with lines lt i
unset multiplot
