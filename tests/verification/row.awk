# SPDX-License-Identifier: GPL-3.0-or-later
# For each arrangement: its factors, the geometric means of the five ratios, in how many of the runs
# the mean of the end buildings was above that of the three within, the runs, and the mean count of
# impacts.
{
    key = $1 " " $2 " " $3 " " $4 " " $5
    if (!(key in runs)) {
        order[++n] = key
    }
    runs[key]++
    impacts[key] += $11
    ends = within = 0
    for (i = 1; i <= 5; i++) {
        ratio = log($(5 + i) / $(11 + i))
        sum[key, i] += ratio
        if (i == 1 || i == 5) {
            ends += ratio / 2
        } else {
            within += ratio / 3
        }
    }
    above[key] += ends > within
}

END {
    for (k = 1; k <= n; k++) {
        key = order[k]
        printf "%s", key
        for (i = 1; i <= 5; i++) {
            printf " %.6g", exp(sum[key, i] / runs[key])
        }
        printf " %d %d %.6g\n", above[key], runs[key], impacts[key] / runs[key]
    }
}
