# SPDX-License-Identifier: GPL-3.0-or-later
# Closed forms of an isolated impact of the effective mass `m` at `v0`. Rows `label TAB kind TAB
# parameter...` give rows `label TAB quantity TAB unit TAB value`. docs/theory.md, section 5,
# derives them.
function give(quantity, unit, x) {
    printf "%s\t%s\t%s\t%.17g\n", $1, quantity, unit, x
}

function outcome(e, depth) {
    give("restitution", "-", e)
    give("largest penetration", "m", depth)
}


# Largest penetration under k d^n without loss.
function elastic_depth(k, n) {
    return ((n + 1) * m * v0 ^ 2 / (2 * k)) ^ (1 / (n + 1))
}

# Largest penetration under k d^n (1 + q v / v0): k d^(n+1) / (n+1) = m v0^2 (1/q - ln(1+q) / q^2).
function damped_depth(k, n, q) {
    return ((n + 1) * m * v0 ^ 2 * (q - log(1 + q)) / q ^ 2 / k) ^ (1 / (n + 1))
}

# e of k d^n (1 + q v / v0): the root of q (1 + e) = ln((1 + q) / (1 - e q)) in (0, min(1, 1/q)).
function family_e(q,    low, high, e, i) {
    low = 0
    high = q < 1 ? 1 : 1 / q
    for (i = 0; i < 200; i++) {
        e = (low + high) / 2
        if (e * q < 1 && q * (1 + e) > log((1 + q) / (1 - e * q))) {
            low = e
        } else {
            high = e
        }
    }
    return e
}

# Peak of k d + c v during approach, in units of v0 sqrt(k m).
function dashpot_peak(zeta,    s) {
    s = sqrt(1 - zeta ^ 2)
    return exp(-zeta / s * atan2(s * (1 - 4 * zeta ^ 2), zeta * (3 - 4 * zeta ^ 2)))
}

# Linear dashpot: 1 with tension, 2 without, 3 during approach only.
function dashpot(k, zeta, sort,    omega, s, e, rise) {
    omega = sqrt(k / m)
    s = sqrt(1 - zeta ^ 2)
    rise = atan2(s, zeta)
    e = exp(-zeta / s * (sort == 1 ? pi : sort == 2 ? atan2(2 * zeta * s, 2 * zeta ^ 2 - 1) : rise))
    outcome(e, v0 / omega * exp(-zeta / s * rise))
    give("peak force", "N", v0 * sqrt(k * m) * dashpot_peak(zeta))
    if (sort == 1) {
        give("duration", "s", pi / (omega * s))
    } else if (sort == 2) {
        give("duration", "s", (atan2(2 * zeta * s, 2 * zeta ^ 2 - 1) / s + 2 * zeta) / omega)
    } else {
        give("duration", "s", (rise / s + pi / 2) / omega)
    }
}

# With y = d^(5/4) Jankowski's law is a linear oscillator with the ratio 2 zeta / sqrt(5).
function jankowski(k, zeta,    ratio, s, e) {
    ratio = 2 * zeta / sqrt(5)
    s = sqrt(1 - ratio ^ 2)
    e = exp(-ratio / s * atan2(s, ratio))
    outcome(e, (1.25 * m * (e * v0) ^ 2 / k) ^ 0.4)
}

# Release under f (1 + q v / v0) of an elastic approach: ln(1 - e q) + e q + q^2 / 2 = 0.
function rubber_e(q,    low, high, e, i) {
    low = 0
    high = 1 / q
    for (i = 0; i < 200; i++) {
        e = (low + high) / 2
        if (e * q < 1 && log(1 - e * q) + e * q + q ^ 2 / 2 > 0) {
            low = e
        } else {
            high = e
        }
    }
    return e
}

# k1 to dy, then k2: m v0^2 / 2 = k1 dy^2 / 2 + k1 dy x + k2 x^2 / 2; lost is (k1 - k2) dy x.
function bilinear(k1, k2, dy,    x, energy) {
    energy = m * v0 ^ 2 / 2
    x = (sqrt((k1 * dy) ^ 2 - 2 * k2 * (k1 * dy ^ 2 / 2 - energy)) - k1 * dy) / k2
    outcome(sqrt(1 - (k1 - k2) * dy * x / energy), dy + x)
    give("peak force", "N", k1 * dy + k2 * x)
}

# k d^1.5, stiffer by the factor 1 + f during approach; duration of half a Hertz impact each.
function khatami(k, f,    depth) {
    depth = elastic_depth(k * (1 + f), 1.5)
    outcome(1 / sqrt(1 + f), depth)
    give("peak force", "N", k * (1 + f) * depth ^ 1.5)
    give("duration", "s", HERTZ / 2 * depth / v0 * (1 + sqrt(1 + f)))
}

BEGIN {
    FS = "\t"
    pi = atan2(0, -1)
    HERTZ = 2.94327518432471  # 2 sqrt(pi) Gamma(7/5) / Gamma(9/10)
}

$2 == "power" {
    depth = elastic_depth($3, $4)
    outcome(1, depth)
    give("peak force", "N", $3 * depth ^ $4)
    if ($4 == 1 || $4 == 1.5) {
        give("duration", "s", ($4 == 1 ? pi : HERTZ) * depth / v0)
    }
}
$2 == "dashpot" { dashpot($3, $4, $5) }
$2 == "family" { outcome(family_e($5), damped_depth($3, $4, $5)) }
$2 == "jankowski" { jankowski($3, $4) }
$2 == "bilinear" { bilinear($3, $4, $5) }
$2 == "khatami" { khatami($3, $4) }
$2 == "wang" {
    q = $4 * v0 / $3
    outcome(sqrt(2 * (1 - $5) * (q - log(1 + q)) / q ^ 2), damped_depth($3, 1.5, q))
}
$2 == "rubber" {
    depth = elastic_depth($3, $4)
    outcome(rubber_e($5), depth)
    give("peak force", "N", $3 * depth ^ $4)
}
$2 == "table" {
    depth = elastic_depth($3, 1)
    outcome(sqrt($4), depth)
    give("peak force", "N", $3 * depth)
}
