# SPDX-License-Identifier: GPL-3.0-or-later
# Left: error of the restitution law by law. Right: of the largest displacement of two buildings.
set logscale xy
set format y '10^{%T}'
set format x '%g'
set ytics 100
set yrange [1e-7:0.1]
set xlabel 'step [ms]'
set ylabel 'error'
set multiplot layout 1, 2 margins 0.12, 0.98, 0.35, 0.88 spacing 0.1
set key at screen 0.98, 0.135 right maxrows 2 Left reverse samplen 2
set title 'restitution of an impact'
set xrange [0.05:1.3]
law(name) = "< awk '$1 == \"".name."\"' ".work."/errors"
plot for [name in 'linear hertz kelvin-voigt hertz-damp jankowski'] law(name) using 2:3 \
    with linespoints title name
set title 'roof of 8 and 5 storeys, relative'
unset ylabel
unset key
set xrange [0.1:5]
plot "< grep kelvin ".work."/storeys" using 2:3 with linespoints lt 3, \
    "< grep jankowski ".work."/storeys" using 2:3 with linespoints lt 5
unset multiplot
