#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# restitution.sh JOSTLE: prints a section of docs/laws.md, the coefficient of restitution that each
# law delivers for a requested one, by its published relation and with -calibrate. The laws and
# their other options are those of the examples in `jostle laws`.
set -eu
jostle=$1
requested='0.10 0.30 0.50 0.65 0.80 0.90'
body='-m1 25t -m2 40t -v 0.5m/s'

# "LAW -k K" for every law whose example has an e.
laws() {
    "$jostle" laws --markdown |
        sed -n 's/^- example: `jostle law \(.*\) -e [0-9.]*\( .*\)* -m1 .*/\1\2/p'
}

# Other relations and exponents of the same laws, and laws whose example has no e.
variants() {
    echo 'mahmoud-jankowski -k 93.5MN/m -relation 2008'
    echo 'hunt-crossley -k 93.5MN/m -n 1'
    echo 'stereomechanical'
    echo 'wang -k 2.75e9N/m^1.5 -residual 0'
    recipe
}

recipe() {
    echo 'bilinear -kh 2.75e9N/m^1.5 -v0 0.5m/s'
}

name() {
    case $1 in
    *-relation*) echo "${1%% *}, 2008" ;;
    *' -n 1') echo "${1%% *}, n = 1" ;;
    *-kh*) echo "${1%% *}, from Hertz k, e, v0" ;;
    *) echo "${1%% *}" ;;
    esac
}

# delivered LAW [-calibrate]: one number a line.
delivered() {
    law=$1
    shift
    for e in $requested; do
        # shellcheck disable=SC2086  # options are one word each
        "$jostle" law $law -e "$e" $body "$@" --tsv </dev/null |
            awk -v e="$e" '$1 == "achieved_restitution" { print $2, e }'
    done
}

table() {
    { laws && variants; } | sort | while read -r law; do
        delivered "$law" | awk -v name="$(name "$law")" '
            { cells = cells sprintf(" %.4f |", $1); d = $1 - $2; far = far || d * d > 1e-8 }
            END { print far ? "far" : "exact", "| " name " |" cells }'
    done
}

rows=$(table)
cat <<'END'
## Requested and delivered restitution

Each law turns the requested restitution `-e` into a damping parameter by its published relation. Many of these
relations are approximations. The table has the restitution that an isolated impact delivers, here of 25 t
against 40 t at 0.5 m/s. Under khatami and bilinear it depends on masses, velocity and stiffness too.

END
echo "| requested e | $(echo "$requested" | sed 's/ / | /g') |"
echo "| --- | $(echo "$requested" | sed 's/[0-9.]*/---/g; s/ / | /g') |"
echo "$rows" | sed -n 's/^far //p'
echo
echo "$rows" | awk -F ' *[|] *' '
    /^exact/ { list = list (list ? "; " : "") $2 }
    END { print "These laws deliver e, to 1e-4 or better: " list "." }'
cat <<'END'

With `-calibrate` jostle solves for the damping parameter that delivers e
([theory](theory.md#delivered-restitution)). Over these values of e, the largest difference is then

END
{ laws && recipe; } | sort | while read -r law; do
    delivered "$law" -calibrate | awk -v name="$(name "$law")" '
        { d = $1 > $2 ? $1 - $2 : $2 - $1; if (d > most) most = d }
        END { for (n = 9; n > 1 && most > 10 ^ -n; n--); print "below 1e-" n ": " name }'
done | sort -s -k 1,2 | awk -F ': ' '
    $1 != limit { printf "%s- %s: %s", limit ? "\n" : "", $1, $2; limit = $1; next }
    { printf "; %s", $2 }
    END { print "" }'
