# SPDX-License-Identifier: GPL-3.0-or-later
# What the account of energy misses, relative to the input, over the whole run.

# account LABEL METHOD DT CASE [LINE]...: the case with the step DT and with these lines at its end.
account() {
    label=$1 method=$2 dt=$3 from=$4
    shift 4
    {
        reference_deck "$from" "$dt"
        printf '%s\n' "$@"
    } >"$work/account.deck"
    simulate account "$work/account.deck"
    awk -v label="$label" -v method="$method" -v dt="$dt" -v input="$(value account energy input)" \
        -v missed="$(value account energy residual_peak)" \
        -v contact="$(value account energy contact)" \
        -v sum="$(awk -F '\t' '$1 == "contacts" && $3 == "dissipated" { s += $5 }
            END { printf "%.17g", s }' "$work/account.tsv")" "$format"'
        BEGIN {
            printf "energy\t| %s | %s | %s | %s | %s | %s |\n", label, method, dt, number(input, 4),
                small(missed / input, 1e-12), small(relative(contact, sum), 1e-9)
        }'
}

# residual NAME: rows `time, residual / input` of the last run, the largest of each ten rows of the
# data of a picture.
residual() {
    "$jostle" plot "$work/account.h5" energy --script "$work/account.script" --force
    awk -v input="$(value account energy input)" '
        /^[0-9]/ {
            missed = ($8 < 0 ? -$8 : $8) / input
            most = missed > most ? missed : most
            if (++n % 10 == 0) {
                print $1, most
                most = 0
            }
        }' "$work/account.script/energy.dat" >"$work/$1"
}

for dt in 0.1 1; do
    account '8 and 5 storeys, jankowski' '1/4, 1/2' $dt D_8v5_jankowski
done
residual average
account '8 and 5 storeys, jankowski' '1/4, 1/2' 10 D_8v5_jankowski
for dt in 0.5 5; do
    account 'yielding storeys, kelvin-voigt' '1/4, 1/2' $dt E2_elastoplastic_kelvin_voigt
done
account 'three in a row, jankowski' '1/4, 1/2' 1 E1_row3_jankowski
account 'towers, rigid impacts' '1/4, 1/2' 1 F_towers_stereo
for dt in 0.1 1; do
    account '8 and 5 storeys, jankowski' '1/6, 1/2' $dt D_8v5_jankowski \
        'integrator newmark -beta 0.16666666666666667'
    residual linear
    account '8 and 5 storeys, jankowski' '0.3025, 0.6' $dt D_8v5_jankowski \
        'integrator newmark -beta 0.3025 -gamma 0.6'
    residual damped
done
draw 330
