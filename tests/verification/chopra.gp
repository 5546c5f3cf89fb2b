# SPDX-License-Identifier: GPL-3.0-or-later
# The oscillator: what the methods give with steps of 0.1 s, the exact solution and the book.
set xlabel 'time [s]'
set ylabel 'displacement [in]'
set key outside right center Left reverse samplen 2 spacing 1.3
set xrange [0:1.02]
array run[4] = ['central', 'average', 'linear', 'plastic']
array name[4] = ['E5.2, central', 'E5.3, average', 'E5.4, linear', 'E5.5, yielding']
plot work.'/fine' with lines lc rgb '#808080' lw 1.2 title 'step 0.1 ms', \
    for [i = 1:4] work.'/'.run[i] with linespoints lt i dt 3 title name[i], \
    work.'/book' with points pt 6 ps 1 lw 1.6 lc rgb '#000000' title 'book'
