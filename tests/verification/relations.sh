# SPDX-License-Identifier: GPL-3.0-or-later
# The restitution that published relations deliver, and that of khatami with its factor in other
# units.

# delivered V LAW...: the restitution of impacts at V under e = 0.4, 0.65 and 0.9, a line each.
delivered() {
    at=$1
    shift
    "$jostle" law "$@" -m1 25t -m2 40t -v "$at" --over e=0.4,0.65,0.9 --tsv </dev/null |
        awk -F '\t' "$format"'
            NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
            NR > 1 { print number($at["restitution"], 4) }'
}

while IFS=';' read -r paper law; do
    # shellcheck disable=SC2086  # options of the law
    echo "relations	| $paper | ${law%% *} |$(delivered 0.5m/s $law | sed 's/.*/ & |/' | tr -d '\n')"
done <<'END'
Jankowski (2006);jankowski -k 2.75e9
Mahmoud, Chen & Jankowski (2008);mahmoud-jankowski -k 93.5e6 -relation 2008
Mahmoud & Jankowski (2011);mahmoud-jankowski -k 93.5e6
END
for velocity in 0.1 0.3 0.5 1; do
    delivered ${velocity}m/s khatami -k 2.75e9 >"$work/metres"
    delivered ${velocity}m/s khatami -k 2.75e9 -alpha 15.57s/m >"$work/millimetres"
    echo "khatami	| $velocity m/s |" \
        "$(paste -d ' ' "$work/metres" "$work/millimetres" | tr '\n' ' ' | sed 's/ / | /g')" |
        sed 's/ *$//'
done
delivered 0.3m/s khatami -k 2.75e9 -alpha 15.57s/m |
    awk 'NR == 2 { printf "guess\t%.3f\n", $1 }'
