# SPDX-License-Identifier: GPL-3.0-or-later
# Left: error of the restitution law by law. Right: of the largest displacement of two buildings.
set logscale xy
set format y '10^{%T}'
set format x '%g'
set ytics 100
set xlabel 'step, ms'
set multiplot layout 1, 2
set key bottom right Left reverse samplen 1.5 font ',13'
set title 'restitution of an impact' font ',15'
set xrange [0.05:1.3]
set yrange [1e-14:0.1]
law(name) = "< awk '$1 == \"".name."\"' ".work."/errors"
plot for [name in 'linear hertz kelvin-voigt hertz-damp jankowski'] law(name) using 2:3 \
    with linespoints title name
set title 'roof of 8 and 5 storeys'
set xrange [0.1:5]
set yrange [1e-10:0.1]
plot "< grep kelvin ".work."/storeys" using 2:3 with linespoints lt 3 title 'kelvin-voigt', \
    "< grep jankowski ".work."/storeys" using 2:3 with linespoints lt 5 title 'jankowski'
unset multiplot
