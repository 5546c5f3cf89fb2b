# SPDX-License-Identifier: GPL-3.0-or-later
# awk -f street.awk: prints the table of a made-up street of 200 houses, input/street.csv. A linear
# congruential generator with a fixed seed draws types, storeys, years, areas and gaps.
function draw(n) {
    seed = (16807 * seed) % 2147483647
    return int(n * seed / 2147483647)
}
BEGIN {
    seed = 1940
    n_type = split("URM W1 C1 URM C3 W1 S1 RM1 C2 URM", type, " ")
    print "# A made-up street: see docs/street.md. Printed by tests/support/street.awk."
    print "name,storeys,type,year,area [m2],gap [mm]"
    for (i = 1; i <= 200; i++) {
        kind = type[1 + draw(n_type)]
        storeys = kind == "W1" ? 1 + draw(2) : kind == "C1" || kind == "C2" || kind == "S1" ? 2 + draw(6) : 2 + draw(3)
        year = kind == "URM" || kind == "C3" ? 1890 + draw(50) : 1925 + draw(85)
        gap = i % 25 == 0 ? "none" : 10 * draw(7)
        printf "N%d,%d,%s,%d,%d,%s\n", i, storeys, kind, year, 80 + 10 * draw(18), gap
    }
}
