# SPDX-License-Identifier: GPL-3.0-or-later
# Force between striker and bar over time: chains of masses and the theory of waves.
set xlabel 'time [µs]'
set ylabel 'contact force [kN]'
set xrange [0:150]
set yrange [0:250]
set key outside right center Left reverse samplen 2
speed = sqrt(210e9 / 7850)
plateau = 7850 * speed * 314.16e-6 * 25 / 2000
array steps[6] = [0, 4, 4, 4 + 2e6 * 0.3 / speed, 4 + 2e6 * 0.3 / speed, 150]
array force[6] = [0, 0, plateau, plateau, 0, 0]
plot work.'/force_15' using 0:($1 / 1000) with lines lt 2 title 'n = 15', \
    work.'/force_120' using 0:($1 / 1000) with lines lt 1 title 'n = 120', \
    steps using 2:(force[$1]) with lines lt 5 title 'theory'
