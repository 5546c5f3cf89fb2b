#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# restitution.sh JOSTLE: prints docs/restitution.md, the coefficient of restitution that each law
# delivers when it is asked for one, by its published relation and with -calibrate. The laws, and
# what they need besides, are those of the examples in `jostle laws`.
set -eu
jostle=$1
asked='0.10 0.20 0.30 0.40 0.50 0.60 0.65 0.70 0.80 0.90 0.95'
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
    for e in $asked; do
        # shellcheck disable=SC2086  # options are one word each
        "$jostle" law $law -e "$e" $body "$@" --tsv </dev/null |
            awk -v e="$e" '$1 == "achieved_restitution" { print $2, e }'
    done
}

cat <<'END'
<!-- SPDX-License-Identifier: GPL-3.0-or-later -->
<!-- Printed by tests/support/restitution.sh; `make docs` writes it anew. -->

# Restitution asked for and delivered

A contact law takes a coefficient of restitution e and turns it into a damping parameter by the relation
that was published with it. Few of these relations are exact. The table shows what comes out of an
isolated impact of 25 t against 40 t at 0.5 m/s, as `jostle law` runs it to about twelve digits. Under all laws
but khatami and bilinear it depends neither on the masses, the velocity nor the stiffness.

END
echo "| e asked for | $(echo "$asked" | sed 's/ / | /g') |"
echo "| --- | $(echo "$asked" | sed 's/[0-9.]*/---/g; s/ / | /g') |"
{ laws && variants; } | sort | while read -r law; do
    delivered "$law" | awk -v name="$(name "$law")" '
        { cells = cells sprintf(" %.4f |", $1) }
        END { print "| " name " |" cells }'
done
cat <<'END'

With `-calibrate` the damping parameter is not taken from the published relation but solved for, so that e is
delivered. The largest difference between what is asked for and delivered over the same values of e is then

END
echo '| law | difference |'
echo '| --- | --- |'
{ laws && recipe; } | sort | while read -r law; do
    delivered "$law" -calibrate | awk -v name="$(name "$law")" '
        { d = $1 > $2 ? $1 - $2 : $2 - $1; if (d > most) most = d }
        END { for (n = 9; n > 1 && most > 10 ^ -n; n--); print "| " name " | below 1e-" n " |" }'
done
cat <<'END'

[laws.md](laws.md) has the relations, [theory.md](theory.md) how they are solved.
END
