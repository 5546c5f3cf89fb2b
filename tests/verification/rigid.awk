# SPDX-License-Identifier: GPL-3.0-or-later
# rigid.awk TABLES: a row of the bouncing body. It meets the wall at t0 = 0.1 s with 1 m/s, rebounds
# the n-th time with e^n, and flies 2 e^n t0; the sum of all flights ends at t0 (1 + e) / (1 - e).
$1 == "impacts" {
    v[$4, $3] = $5
    n = $4
}

END {
    at = 0.1
    for (i = 1; i < n; i++) {
        late = size(v[i, "t_start"] - at)
        wrong = relative(e ^ i, v[i, "v_rebound"])
        latest = late > latest ? late : latest
        worst = wrong > worst ? wrong : worst
        at += 0.2 * e ^ i
    }
    rest = 0.1 * (1 + e) / (1 - e)
    printf "bounce\t| %s | %d | %s | %s | %s | %s | %s |\n", e, n - 1, small(latest, 1e-9),
        small(worst, 1e-6), number(rest, 5), number(v[n, "t_start"], 5),
        small(relative(rest, v[n, "t_start"]), 1e-12)
}
