# SPDX-License-Identifier: GPL-3.0-or-later
# reference.awk REFERENCE RESULT: a row of errors, the largest over all floors or contacts, each
# over the largest value of its kind. The table of a result, `show --tsv`, has names in column 2.
function error(kind) {
    if (!(kind in most)) {
        return "-"
    }
    return small(worst[kind] / most[kind], 1e-12)
}

FNR == NR && $2 != "energy" {
    expected[$1, $2, $3] = $4
    if (!($1 in most) || size($4) > most[$1]) {
        most[$1] = size($4)
    }
    next
}

$1 == "buildings" || $1 == "contacts" {
    floor = $1 == "contacts" ? 0 : $4
    if (($3, $2, floor) in expected) {
        e = size($5 - expected[$3, $2, floor])
        worst[$3] = e > worst[$3] ? e : worst[$3]
        if ($3 == "impacts") {
            impacts += $5
            all += expected[$3, $2, floor]
        }
        if ($3 == "force" && $5 > force) {
            force = $5
        }
    }
}

END {
    printf "reference\t| %s | %s | %s | %s | %s | %s | %s | %s |\n", case,
        "force" in most ? number(most["force"], 5) : "-",
        "force" in most ? number(force, 5) : "-", error("force"), error("displacement"),
        error("acceleration"), error("impulse"), all ? all " / " impacts : "-"
}
