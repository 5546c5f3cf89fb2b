#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle sensitivity: which random parameters matter. The demand is known: a building of one storey
# that is let go, in its first instant.
. tests/support/cli.sh

# column NAME: the values of a column of the table in $out.
column() {
    awk -F '\t' -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i; next } { print $at }' "$out"
}

cat >ishigami.deck <<'END'
param n 8192
sweep x1 random uniform ${-pi} ${pi} -n $n -seed 1
sweep x2 random uniform ${-pi} ${pi} -n $n -seed 1
sweep x3 random uniform ${-pi} ${pi} -n $n -seed 1
building A -floors 1 -mass 1 -stiffness 1
initial A:1 -displacement ${0.05 * (20 + sin(x1) + 7 * sin(x2)^2 + 0.1 * x3^4 * sin(x1))}
step fixed 0.1
duration 0.1
END
run "$jostle" sensitivity ishigami.deck --edp displacement --variance --tsv
# Shares of Ishigami's function: 0.3139, 0.4424, 0 alone and 0.5576, 0.4424, 0.2437 in all. Each is
# within 0.01, with 4096 points of Sobol's sequence, and no farther from its interval of 95 % than half of its
# width.
cat >want.tsv <<'END'
x1 0.3139 0.5576
x2 0.4424 0.4424
x3 0 0.2437
END
paste <(column parameter) <(column first) <(column first_low) <(column first_high) <(column total) \
    <(column total_low) <(column total_high) | sort | join - want.tsv >both
expect "the shares are those of Ishigami's function" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ "$(awk "{ d = \$2 - \$8; t = \$5 - \$9; n += d * d < 1e-4 && t * t < 1e-4 && d * d < (\$4 - \$3) ^ 2 && t * t < (\$7 - \$6) ^ 2 } END { print n }" both)" = 3 ]'
expect "the largest total share comes first" '[ "$(column parameter | tr "\n" " ")" = "x1 x2 x3 " ]'
for method in "--variance --samples 100" "--morris 100"; do
    # shellcheck disable=SC2086  # several words
    "$jostle" sensitivity ishigami.deck --edp displacement $method --tsv -j 1 >one.tsv
    # shellcheck disable=SC2086
    run "$jostle" sensitivity ishigami.deck --edp displacement $method --tsv -j 3
    expect "threads change nothing: $method" '[ $status -eq 0 ] && cmp one.tsv "$out"'
done
run "$jostle" sensitivity ishigami.deck --edp displacement --variance --samples 100
expect "--samples sets the number of points" '[ $status -eq 0 ] && grep -q "; 500 runs$" "$out"'

# On the levels -pi, -pi/3, pi/3 and pi the effects have these means of their sizes, and these
# standard deviations (tests/unit/test_morris.c derives them); that of x2 has always the same size.
run "$jostle" sensitivity ishigami.deck --edp displacement --morris 2000 --share 0 --tsv
cat >want.tsv <<'END'
x1 7.704 6.249
x2 7.875 7.875
x3 6.249 8.837
END
paste <(column parameter) <(column "mu_star [m]") <(column "sigma [m]") | sort | join - want.tsv |
    awk '{ d = $2 / 0.05 - $4; s = $3 / 0.05 - $5; n += d * d < 0.6 && s * s < 0.6; if ($1 == "x2") exact = d * d < 1e-20 } END { print n, exact }' >both
expect "effects are those of Ishigami's function" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ "$(cat both)" = "3 1" ]'
run "$jostle" sensitivity ishigami.deck --edp displacement --morris 10 --levels 2
expect "two levels are the quantiles 1/4 and 3/4" '[ $status -eq 0 ] && grep -q "between the 25 % and 75 % quantiles; 40 runs$" "$out"'

# Twice the mass moves as far; k does nothing to the first displacement, x and y do, under each g.
cat >swing.deck <<'END'
units kN m s
sweep g values 1 2
sweep k random uniform 300kN/m 400kN/m -n 101 -seed 1 -lhs
sweep x random uniform 10mm 20mm -n 101 -seed 2 -lhs
sweep y random normal 1 0.1 -n 101 -seed 3 -lhs
building A -floors 1 -mass 1t -stiffness $k
initial A:1 -displacement ${g * x * y}
step fixed 1ms
duration 1ms
END
run "$jostle" sensitivity swing.deck --edp displacement --tsv
expect "one at a time: a line for each parameter and combination" '[ $status -eq 0 ] && [ "$(column parameter | tr "\n" " ")" = "x y k x y k " ] && [ "$(column g | tr "\n" " ")" = "1 1 1 2 2 2 " ] && [ "$(column unit | tr "\n" " ")" = "m  kN/m m  kN/m " ]'
# The demand is g x y, with what is not varied at its median, some 15 mm and 1.
expect "demands are those at the quantiles" '[ "$(paste <(column g) <(column parameter) <(column low) <(column high) <(column "at_low [m]") <(column "at_high [m]") <(column "at_medians [m]") | awk "\$2 == \"x\" { y = \$7 / (\$1 * 0.015); d = \$5 / (\$1 * \$3) - \$6 / (\$1 * \$4); n += d * d < 1e-20 && \$3 > 0.0108 && \$3 < 0.0112 && \$4 > 0.0188 && \$4 < 0.0192 && y > 0.99 && y < 1.01 } \$2 == \"k\" { n += \$5 == \$6 } END { print n }")" = 4 ]'
run "$jostle" sensitivity swing.deck --edp displacement --share 25% -D g=1 -D k=350kN/m
expect "other quantiles, and what -D fixes is no parameter" '[ $status -eq 0 ] && grep -q "at its 25 % and 75 % quantiles" "$out" && [ "$(grep -c "^[xy] " "$out")" -eq 2 ] && ! grep -q "^k " "$out"'

sed 's/^building .*/building A -floors 1 -mass ${(x - 12mm) * 1000t\/m} -stiffness $k/' swing.deck >failing.deck
run "$jostle" sensitivity failing.deck --edp displacement
expect "a run that fails is told with its values and its message, and ends with status 1" '[ $status -eq 1 ] && said "2 of 14 runs failed, 0 collapsed; the first: k = 350, x = 0.011, y = 1, g = 1: failing.deck:6:28: mass is -1 t; it must be > 0"'
for method in "--morris 20" "--variance --samples 20"; do
    # shellcheck disable=SC2086  # several words
    run "$jostle" sensitivity failing.deck --edp displacement $method -D g=1
    expect "so it is with $method" '[ $status -eq 1 ] && grep -q "failing.deck:6:28: mass is -" "$err"'
done
sed 's/^step/collapse drift 1e-9m\nstep/; s/ -mass/ -height 3m -mass/; s/-displacement/-velocity/' swing.deck >collapsing.deck
run "$jostle" sensitivity collapsing.deck --edp drift:A -D g=1
expect "a collapse is told" '[ $status -eq 1 ] && said "0 of 7 runs failed, 7 collapsed; the first: k = 350, x = 0.015, y = 1: it collapsed"'

sed 's/^sweep y.*/& -correlated x:0.5/' swing.deck >correlated.deck
for method in "" "--morris 2" "--variance"; do
    # shellcheck disable=SC2086  # several words
    run "$jostle" sensitivity correlated.deck --edp displacement $method
    expect "correlated parameters are refused: $method" '[ $status -eq 2 ] && said "'"'y' is correlated with 'x'"': it does not change alone; fix one of them with -D, or leave out -correlated"'
done
run "$jostle" sensitivity correlated.deck --edp displacement -D x=12mm
expect "but not where one of them is fixed" '[ $status -eq 0 ]'

sed '/random/d; s/\$k/350kN\/m/; s/g \* x \* y/g * 1mm/' swing.deck >none.deck
run "$jostle" sensitivity none.deck --edp displacement
expect "without random sweeps there is nothing to rank" '[ $status -eq 2 ] && said "the deck has no parameter that is random: sweep NAME random ..."'
sed 's/-n 101/-n 3/' swing.deck >few.deck
run "$jostle" sensitivity few.deck --edp displacement --variance
expect "a few values are too few for shares" '[ $status -eq 2 ] && said "'"'k'"' has 3 values (-n); at least 4 are needed"'
run "$jostle" sensitivity few.deck --edp displacement --variance --samples 8 -D g=1
expect "unless --samples gives their number" '[ $status -eq 0 ]'
run "$jostle" sensitivity swing.deck --edp displacement --share 0
expect "a normal distribution has no ends" '[ $status -eq 2 ] && said "'"'y'"' is infinite at the probability 0; --share must be > 0"'
sed 's/^sweep g values 1 2/sweep g values 1 2 3 4 5 -as pair/; s/-n 101/-n 5 -as pair/' swing.deck >paired.deck
run "$jostle" sensitivity paired.deck --edp displacement
expect "what is paired with texts or values cannot change alone" '[ $status -eq 2 ] && grep -q "which is not random: it cannot change alone" "$err"'
for wrong in "" "--edp nothing" "--edp drift --share 0.5" "--edp drift --share x" "--edp drift --variance --share 10%" \
    "--edp drift --share -1" "--edp drift --morris 1" "--edp drift --morris 4 --variance" "--edp drift --levels 4" \
    "--edp drift --morris 4 --levels 3" "--edp drift --morris 4 --samples 8"; do
    # shellcheck disable=SC2086  # several words
    run "$jostle" sensitivity swing.deck $wrong
    expect "refused: sensitivity $wrong" '[ $status -eq 2 ] && [ ! -s "$out" ] && [ -s "$err" ]'
done
