# SPDX-License-Identifier: GPL-3.0-or-later
# Errors of `jostle run`, a line of dots for each law.
set xlabel 'relative error'
set logscale x
set xrange [1e-10:1e-3]
set xtics 10
set format x '10^{%T}'
set yrange [18.7:-0.7]
set key at screen 0.98, 0.979 right maxrows 1 Left reverse samplen 1
set tmargin at screen 0.929
array quantity[4] = ['restitution', 'largest penetration', 'peak force', 'duration']
array name[4] = ['restitution', 'penetration', 'force', 'duration']
of(i) = "< awk -F '\t' '$1 == \"".quantity[i]."\"' ".work."/errors"
set datafile separator '\t'
plot for [i = 1:4] of(i) using 3:2:ytic(4) with points lt i ps 0.7 title name[i]
