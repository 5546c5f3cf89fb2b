# SPDX-License-Identifier: GPL-3.0-or-later
# Closed form of the oscillator of chopra.sh: time and displacement. Under p0 sin(w t) from rest the
# steady part a sin + b cos and the free vibration that starts it (Chopra, section 3.2.1); free
# after 0.6 s.
function forced(t) {
    return a * sin(w * t) + b * cos(w * t) + \
        exp(-zeta * wn * t) * (c * cos(wd * t) + d * sin(wd * t))
}

function free(t, u, v) {
    return exp(-zeta * wn * t) * (u * cos(wd * t) + (v + zeta * wn * u) / wd * sin(wd * t))
}

BEGIN {
    m = 0.2533; k = 10; zeta = 0.05; p = 10; w = atan2(0, -1) / 0.6
    wn = sqrt(k / m)
    wd = wn * sqrt(1 - zeta ^ 2)
    r = w / wn
    whole = (1 - r ^ 2) ^ 2 + (2 * zeta * r) ^ 2
    a = p / k * (1 - r ^ 2) / whole
    b = -p / k * 2 * zeta * r / whole
    c = -b
    d = (zeta * wn * c - a * w) / wd
    printf "0.5 %.17g\n", forced(0.5)
    u = forced(0.6)
    decay = exp(-zeta * wn * 0.6)
    v = a * w * cos(w * 0.6) - b * w * sin(w * 0.6) + \
        decay * ((wd * d - zeta * wn * c) * cos(wd * 0.6) - \
        (wd * c + zeta * wn * d) * sin(wd * 0.6))
    printf "1.0 %.17g\n", free(0.4, u, v)
}
