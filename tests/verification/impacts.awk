# SPDX-License-Identifier: GPL-3.0-or-later
# impacts.awk COMPUTED CLOSED: a row of the table for each law, with its closed forms and the errors
# of `jostle run`; the largest error of `jostle law`; and the errors for the plot in the file
# `errors`, rows `quantity TAB row TAB error TAB law`.
BEGIN { n_quantity = split("restitution;largest penetration;peak force;duration", quantity, ";") }

FNR == NR { run[$1, $2] = $3; law[$1, $2] = $4; next }

{
    if (!($1 in row)) {
        row[$1] = n_label
        label[n_label++] = $1
    }
    error = small(relative($4, run[$1, $2]), 1e-9)
    cell[$1, $2] = number($4, 5) " | " error
    sub(/^< /, "", error)
    printf "%s\t%d\t%s\t%s\n", $2, row[$1], error, $1 >errors
    e = relative($4, law[$1, $2])
    most = e > most ? e : most
}

END {
    for (i = 0; i < n_label; i++) {
        line = label[i]
        for (j = 1; j <= n_quantity; j++) {
            line = line " | " ((label[i], quantity[j]) in cell ? cell[label[i], quantity[j]] : "- | -")
        }
        printf "impacts\t| %s |\n", line
    }
    printf "law_error\t%s\n", small(most, 1e-9)
}
