# SPDX-License-Identifier: GPL-3.0-or-later
# impacts.awk COMPUTED CLOSED: rows of the table of impacts, closed forms beside what was computed.
FNR == NR { run[$1, $2] = $3; law[$1, $2] = $4; next }

{
    printf "impacts\t| %s | %s | %s | %s | %s | %s | %s |\n", $1, $2, $3, number($4, 5),
        number(run[$1, $2], 5), small(relative($4, run[$1, $2]), 1e-9),
        small(relative($4, law[$1, $2]), 1e-9)
}
