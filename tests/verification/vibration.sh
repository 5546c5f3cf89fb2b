# SPDX-License-Identifier: GPL-3.0-or-later
# Free vibration, logarithmic decrement, resonance, and the order of Newmark's method.

# distance RUN: |u| at the end, from the energy in the spring, k u^2 / 2.
distance() {
    value "$1" energy strain | awk '{ printf "%.17g", sqrt(2 * $1 / (4 * atan2(0, -1) ^ 2)) }'
}

pi=3.141592653589793
for zeta in 0.01 0.05 0.2; do
    period=$(awk -v zeta=$zeta 'BEGIN { printf "%.17g", 1 / sqrt(1 - zeta ^ 2) }')
    simulate decay $here/vibration.deck -D zeta=$zeta \
        -D end="$(echo "$period" | awk '{ printf "%.17g", 5 * $1 }')" \
        -D dt="$(echo "$period" | awk '{ printf "%.17g", $1 / 2000 }')"
    distance decay | awk -v zeta=$zeta -v pi=$pi '{
        printf "logarithmic decrement at %g %%\t-\t%.17g\t%.17g\n", 100 * zeta,
            2 * pi * zeta / sqrt(1 - zeta ^ 2), log(1 / $1) / 5 }'
    # At resonance from rest the peaks grow towards A / (omega^2 2 zeta).
    simulate resonance $here/vibration.deck -D zeta=$zeta -D start=0 -D shake=1m/s2 -D dt=0.5ms \
        -D end="$(awk -v zeta=$zeta 'BEGIN { print 3 / zeta + 1 }')"
    value resonance buildings displacement | awk -v zeta=$zeta -v pi=$pi '{
        printf "amplitude at resonance, %g %%\tm\t%.17g\t%s\n", 100 * zeta,
            1 / (8 * pi ^ 2 * zeta), $1 }'
done | compare vibration 6

# Errors of |u| at 1.3 s from 1 m without damping, at n = 32, 64, ... steps.
for method in '0 0.5' '0.083333333333333333 0.5' '0.16666666666666667 0.5' '0.25 0.5' \
    '0.3025 0.6'; do
    set -- $method
    for n in 32 64 128 256 512 1024; do
        simulate order $here/vibration.deck -D beta=$1 -D gamma=$2 -D end=1.3 \
            -D dt="$(awk -v n=$n 'BEGIN { printf "%.17g", 1.3 / n }')"
        printf '%s %s %s %s\n' "$1" "$2" $n "$(distance order)"
    done
    echo
    echo
done >"$work/order"
awk -v pi=$pi 'NF {
    error = $4 - sqrt(cos(2.6 * pi) ^ 2)
    $5 = error < 0 ? -error : error
} { print }' "$work/order" >"$work/errors"
awk "$format"'
    NF { error[$3] = $5; beta = $1; gamma = $2 }
    !NF && beta != "" {
        printf "order\t| %.4g | %g | %s | %s | %s | %.2f | %d |\n", beta, gamma,
            small(error[64], 1e-12), small(error[256], 1e-12), small(error[1024], 1e-12),
            log(error[256] / error[1024]) / log(4),
            (gamma > 0.5 ? 1 : beta < 0.1 && beta > 0 ? 4 : 2)
        beta = ""
    }' "$work/errors"
draw 330
