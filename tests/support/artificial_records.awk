# SPDX-License-Identifier: GPL-3.0-or-later
# awk -v folder=DIR -v n=44 -f artificial_records.awk: writes n artificial accelerograms, DIR/NN.AT2.
# White noise passes the filters of Kanai-Tajimi and of Clough & Penzien (1993, Dynamics of
# Structures, 2nd edition, section 26-6), and an envelope that grows for 2 s, stays for 8 s and decays. Frequency
# and damping of the ground vary from record to record. The same numbers come out everywhere: the generator is
# the linear congruential one of Park & Miller (1988), Communications of the ACM 31, 1192-1201.

function uniform() {
    seed = (16807 * seed) % 2147483647
    return seed / 2147483647
}

function normal() {
    return sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform())
}

function envelope(t) {
    return t < 2 ? (t / 2) ^ 2 : t < 10 ? 1 : exp(-0.35 * (t - 10))
}

BEGIN {
    step = 0.02
    steps = 1200
    seed = 20261126
    for (record = 1; record <= n; record++) {
        ground = 6.283185307179586 * (1.5 + 2.5 * uniform())  # rad/s
        damping = 0.4 + 0.3 * uniform()
        low = 0.15 * ground
        x = v = y = w = 0
        largest = 0
        for (i = 0; i <= steps; i++) {
            # Two oscillators one behind the other, by steps a tenth as long (symplectic Euler's method).
            noise = envelope(i * step) * normal() / sqrt(step)
            for (k = 0; k < 10; k++) {
                h = step / 10
                v += h * (-noise - 2 * damping * ground * v - ground ^ 2 * x)
                x += h * v
                first = -2 * damping * ground * v - ground ^ 2 * x
                w += h * (-first - 1.2 * low * w - low ^ 2 * y)
                y += h * w
            }
            value[i] = first + 1.2 * low * w + low ^ 2 * y
            size = value[i] < 0 ? -value[i] : value[i]
            largest = size > largest ? size : largest
        }
        file = sprintf("%s/%02d.AT2", folder, record)
        printf "ARTIFICIAL ACCELEROGRAM %02d\nKanai-Tajimi, Clough-Penzien\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= %d, DT= %.4f SEC\n", record, steps + 1, step >file
        for (i = 0; i <= steps; i++) {
            printf "%15.7E%s", 0.3 * value[i] / largest, i % 5 == 4 || i == steps ? "\n" : "" >file
        }
        close(file)
    }
}
