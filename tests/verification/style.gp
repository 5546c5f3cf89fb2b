# SPDX-License-Identifier: GPL-3.0-or-later
# The look of the pictures of the verification manual: colours of Okabe and Ito, as in src/plot.
set encoding utf8
set terminal svg size 736,height font 'sans-serif,16' linewidth 1 background '#ffffff'
set output picture
set border 3 lc rgb '#404040' lw 0.8
set tics nomirror out scale 0.5 textcolor rgb '#202020'
set xtics offset 0,0.4  # as src/plot/figure.c
set xlabel offset 0,0.8
set ylabel offset 1,0
set title offset 0,-0.5
unset mxtics
unset mytics
set grid lc rgb '#e4e4e4' lt 1 lw 0.6
array colour[7] = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#000000', '#e69f00', '#56b4e9']
do for [i = 1:7] {
    set linetype i lc rgb colour[i] lw 1.6 pt 7 ps 0.4
}
