# SPDX-License-Identifier: GPL-3.0-or-later
# What the cases of the verification manual share; sourced by case.sh.

# simulate RUN DECK [-D NAME=VALUE]...: runs a deck, and keeps its tables in RUN.tsv of the work
# folder.
simulate() {
    run=$work/$1
    deck=$2
    shift 2
    "$jostle" run "$deck" -o "$run.h5" -q --force "$@" &&
        "$jostle" show "$run.h5" --tsv >"$run.tsv"
}

# reference_deck CASE STEP: a deck of the reference solutions with another step [ms], to be run
# from any folder.
reference_deck() {
    sed -e "s|\.\./\.\./\.\./input|$root/input|" -e "s/^step fixed .*/step fixed ${2}ms/" \
        "tests/verify/reference/$1.deck"
}

# el_centro: writes El Centro with a first sample of 0 in front, as columns, and prints its path. The
# record of the project begins with the sample at 0.02 s.
el_centro() {
    awk 'BEGIN { print 0 } FNR > 4 { for (i = 1; i <= NF; i++) print $i }' \
        "$root/input/records/ELCENTRO_1940_NS.AT2" >"$work/el_centro.txt"
    echo "$(cd "$work" && pwd)/el_centro.txt"
}

# value RUN TABLE QUANTITY [NAME [LOCATION]]: one value of a run, all digits; of the first name and
# location if these are not given.
value() {
    awk -F '\t' -v table="$2" -v quantity="$3" -v name="${4-}" -v location="${5-}" '
        $1 == table && $3 == quantity && (name == "" || $2 == name) &&
            (location == "" || $4 == location) { print $5; found = 1; exit }
        END { if (!found) { print "no " quantity " of " name >"/dev/stderr"; exit 1 } }
    ' "$work/$1.tsv"
}

# largest RUN TABLE QUANTITY: the largest value over all names and locations.
largest() {
    awk -F '\t' -v table="$2" -v quantity="$3" '
        $1 == table && $3 == quantity && (!n++ || $5 > most) { most = $5 }
        END { print most }' OFMT=%.17g CONVFMT=%.17g "$work/$1.tsv"
}

# table WORD...: awk with the functions of format.awk, columns separated by tabs. Programs that
# stand in a script put "$format" in front instead.
table() {
    awk -F '\t' -f $here/format.awk "$@"
}
format=$(cat $here/format.awk)

# compare NAME DIGITS: rows `what TAB unit TAB expected TAB computed` become rows of the table NAME,
# with the relative error.
compare() {
    table -v name="$1" -v digits="$2" -f $here/compare.awk
}

# history RUN: rows `time, displacement` of the first building's roof, from the data of a picture.
history() {
    "$jostle" plot "$work/$1.h5" histories --script "$work/$1.script" --force
    awk '/^EOD/ { inside = 0 }
         inside && !/^#/ { print $1, $2 }
         /^\$rows0/ { inside = 1 }' "$work/$1.script/histories.dat"
}

# dataset RUN PATH: the values of a dataset of the result file, one a line, all digits.
dataset() {
    h5dump -d "$2" -y -w 1 -m %.17g "$work/$1.h5" |
        awk '/}/ && inside { exit } inside { sub(",", ""); print $1 } /DATA {/ { inside = 1 }'
}

# draw HEIGHT: draws verification_CASE.svg by CASE.gp, which finds its data in the work folder;
# nothing with PICTURES=0.
draw() {
    [ "${PICTURES-1}" = 0 ] || gnuplot -e "work = '$work'; height = $1" \
        -e "picture = '$folder/verification_$name.svg'" $here/style.gp "$here/$name.gp"
}

# pick TABLE COLUMN...: these columns of the rows of a table that are written by now, with tabs
# between, bare numbers.
pick() {
    awk -F ' *[|] *' -v table="$1" -v columns="$(shift && echo "$*")" '
        BEGIN { n = split(columns, column, " ") }
        $1 == table "\t" {
            for (i = 1; i <= n; i++) {
                text = $(column[i] + 1)
                sub(/^< /, "", text)
                sub(/ %$/, "", text)
                printf "%s%s", text, i < n ? "\t" : "\n"
            }
        }' "$work/values"
}
