# SPDX-License-Identifier: GPL-3.0-or-later
# Published fragility data: studies whose demands are made so that the counts, or the capacities, are
# those of the publication. The demand is the displacement at t = 0.

# body: a storey with that displacement.
body() {
    cat <<'END'
building A -floors 1 -mass $im -stiffness $number
initial A:1 -displacement $demand
step fixed 1ms
duration 1ms
END
}

# fitted NAME MEDIAN DISPERSION OPTION...: the rows of a fit of study.h5 at the limit 1.
fitted() {
    title=$1
    median=$2
    dispersion=$3
    shift 3
    "$jostle" fragility "$work/study.h5" --edp displacement:A --limit 1 --im im \
        --over number --tsv "$@" 2>/dev/null |
        awk -F '\t' -v title="$title" -v median="$median" -v dispersion="$dispersion" '
            NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i }
            NR == 2 {
                printf "%s: median\t-\t%s\t%s\n", title, median, $column["median"]
                printf "%s: dispersion\t-\t%s\t%s\n", title, dispersion, $column["dispersion"]
            }'
}

# counts N INTENSITIES EXCEEDED: run number i of N at an intensity exceeds the limit if i is at most
# the number that shall.
counts() {
    {
        echo "sweep im values $2 -as stripe"
        echo "sweep exceeded values $3 -as stripe"
        echo "sweep number range 1 $1 $1"
        echo 'param demand ${1 + ($exceeded + 0.5 - $number) / 1000}'
        body
    } >"$work/study.deck"
    "$jostle" run "$work/study.deck" -o "$work/study.h5" -q --force
}

# capacities HIGHEST N: the demand is the intensity over the capacity, so it is 1 at the capacity;
# N intensities up to HIGHEST.
capacities() {
    {
        echo 'sweep capacity values .49 .62 .63 .63 .65 .70 .71 .72 .77 .79 .80 .84 .91 .92 .93 .97' \
            '1.04 1.04 1.05 1.08 1.08 1.09 1.12 1.13 1.22 1.32 1.33 1.34 1.40 1.40 1.47 1.72 1.76' \
            '2.15 2.31 2.42 2.50 -as record'
        echo 'sweep number range 1 37 37 -as record'
        echo "sweep im range 0.1 $1 $2"
        echo 'param demand ${$im / $capacity}'
        body
    } >"$work/study.deck"
    "$jostle" run "$work/study.deck" -o "$work/study.h5" -q --force
}

{
    counts 40 '.2 .3 .4 .6 .7 .8 .9 1' '0 0 0 4 6 13 12 16'
    fitted 'Baker, multiple stripes' 1.076116 0.429237
    capacities 2.6 26
    fitted 'Baker, incremental dynamic analysis' 1.069226 0.408075 --method ida
    capacities 1.3 13
    fitted 'Baker, truncated at 1.3' 1.058222 0.382139 --method ida
    counts 45 '.178 .274 .444 .56 .652 .79 .982 1.246 1.564 2.014 2.417 3.021 3.625 4.028 4.431 5.035' \
        '0 0 0 0 0 4 13 23 38 41 44 45 45 45 45 45'
    fitted 'pyFragility' 1.219447 0.310066
} | compare fragility 7
