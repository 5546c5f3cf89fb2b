# SPDX-License-Identifier: GPL-3.0-or-later
# Two buildings of 8 and 5 storeys: storey shears above the contacts, and contact forces.

# increases RUN: of the shear of storeys 6, 7 and 8 against the run `free`, in percent.
increases() {
    for storey in 6 7 8; do
        awk -v a="$(value free buildings storey_shear A $storey)" \
            -v b="$(value "$1" buildings storey_shear A $storey)" \
            'BEGIN { printf " %+.0f %% |", 100 * (b - a) / a }'
    done
}

sed "s|records/|$root/input/records/|" input/multistorey.deck >"$work/slabs.deck"
for record in NAPA_2014_68150_HNE NAPA_2014_68150_HNN RIDGECREST_2019_CLC_090 \
    RIDGECREST_2019_CLC_360 ELCENTRO_1940_NS; do
    sed "s|ELCENTRO_1940_NS|$record|" "$work/slabs.deck" >"$work/record.deck"
    simulate slabs "$work/record.deck"
    simulate jankowski $here/pair.deck -D record=$record.AT2
    simulate free $here/pair.deck -D record=$record.AT2 -D gap=10m
    # El Centro comes last, so that its runs stay, and first in the table.
    for run in jankowski slabs; do
        title=$(echo $record | sed -E 's/_(1940|2014_68150|2019_CLC)_/ /')
        echo "$run;$title;$(increases $run)"
    done
done >"$work/increases"
for run in jankowski slabs; do
    law=$(echo $run | sed 's/slabs/hunt-crossley, slabs/')
    {
        grep "^$run;ELCENTRO" "$work/increases"
        grep "^$run;[NR]" "$work/increases"
    } | awk -F ';' -v law="$law" '{ print "records\t| " law " | " $2 " |" $3 }'
done
while read -r storey quoted; do
    awk -v storey="$storey" -v quoted="$quoted" \
        -v free="$(value free buildings storey_shear A "$storey")" \
        -v hit="$(value jankowski buildings storey_shear A "$storey")" "$format"'
        BEGIN {
            printf "shear\t| %d | %s | %s | %+.1f %% | +%d %% |\n", storey,
                number(free / 1000, 3), number(hit / 1000, 3), 100 * (hit - free) / free, quoted
        }'
done <<'END'
6 79
7 91
8 122
END
for run in jankowski slabs; do
    awk -F '\t' "$format"'
        $1 == "contacts" && $3 == "force" { force[$2] = number($5 / 1000, 3) }
        $1 == "contacts" && $3 == "impacts" { impacts[$2] = $5 }
        $1 == "contacts" && $3 == "left_floor" { floor[$2] = $5 }
        END { for (name in force) print floor[name], "| " force[name] " | " impacts[name] " |" }
    ' "$work/$run.tsv" | sort -n >"$work/$run.height"
done
join "$work/jankowski.height" "$work/slabs.height" | sed -e 's/ | | / | /' -e 's/^/height	| /'
