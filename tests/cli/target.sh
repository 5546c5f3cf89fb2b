#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle spectrum --target: factors, what is scaled by them, lines of a deck, pictures, wrong usage.
. tests/support/cli.sh

cp "$root/input/records/ELCENTRO_1940_NS.AT2" centro.AT2
cp "$root/input/records/NAPA_2014_68150_HNE.AT2" napa.AT2
cp "$root/input/en1998.txt" code.txt
match=0.2:2:50

# factors FILE: name, factor and misfit of each record in a table for programs.
factors() {
    awk -F '\t' 'NR > 1 { print $1, $4, $NF }' "$1"
}

# A target that is twice the spectrum of a record.
"$jostle" spectrum centro.AT2 --periods $match --tsv |
    awk -F '\t' 'NR == 1 { print "T [s], PSA [g]" } NR > 1 { printf "%.17g, %.17g\n", $4, 2 * $5 }' >twice.txt
run "$jostle" spectrum centro.AT2 --target twice.txt --match $match --tsv --intensities
factors "$out" >got
expect "a record half its target has the factor 2 and no misfit" '[ $status -eq 0 ] && [ ! -s "$err" ] && awk "{ exit !(\$2 > 2 - 1e-12 && \$2 < 2 + 1e-12 && \$3 < 1e-12) }" got'

# The same from spectra of the records as they are and the formulas of the code.
"$jostle" spectrum centro.AT2 napa.AT2 --periods $match --tsv >plain.tsv
awk -F '\t' '$1 == "record" {
    T = $4
    goal = 0.25 * 1.2 * 2.5 * (T <= 0.5 ? 1 : 0.5 / T)
    ratio = log(goal / $5); n[$2]++; sum[$2] += ratio; squares[$2] += ratio * ratio
} END {
    for (name in n) {
        mean = sum[name] / n[name]
        printf "%s %.10g %.10g\n", name, exp(mean), sqrt(squares[name] / n[name] - mean * mean)
    }
}' plain.tsv | sort >want
run "$jostle" spectrum centro.AT2 napa.AT2 --target code.txt --match $match --tsv --intensities
factors "$out" >got
expect "factors are geometric means of target over PSA" '[ $status -eq 0 ] && paste -d " " got want | awk "{ n += \$1 == \$4 && (\$2 / \$5 - 1)^2 < 1e-12 && (\$3 / \$6 - 1)^2 < 1e-12 } END { exit n != 2 }"'
expect "so is what a table of one line a record shows" '[ "$(awk -F "\t" "{ print NF }" "$out" | sort -u)" = 18 ] && [ "$(head -n 1 "$out" | cut -f 18)" = misfit ]'

run "$jostle" spectrum centro.AT2 napa.AT2 --target code.txt --match $match --periods $match --tsv
cp "$out" scaled.tsv
expect "spectra are those of the scaled records" '[ $status -eq 0 ] && awk -F "[\t ]" "
    FILENAME == \"got\" { f[\$1] = \$2; next }
    FILENAME == \"plain.tsv\" { psa[\$2, \$4] = \$5; next }
    \$1 == \"record\" { n++; off += (\$5 / (f[\$2] * psa[\$2, \$4]) - 1)^2 > 1e-20 }
    END { exit !(n == 100 && !off) }" got plain.tsv scaled.tsv'
expect "the target is beside them" '[ "$(grep -c "^target	code	0.05	" scaled.tsv)" -eq 50 ] && grep -q "^target	code	0.05	2	0.1875	*$" scaled.tsv'
least=$(awk -F '\t' '$1 == "target" { goal[$4] = $5 } $2 == "mean" { mean[$4] = $5 } END {
    for (T in goal) if (!at || mean[T] / goal[T] < least) { least = mean[T] / goal[T]; at = T }
    printf "%.4g at %.4g s", least, at }' scaled.tsv)
run "$jostle" spectrum centro.AT2 napa.AT2 --target code.txt --match $match
expect "the least ratio of the mean and its period are told" 'grep -q "^mean of the scaled spectra over the target: from $least to " "$out"'
expect "and the mean PGA over that of the target" 'grep -q "^mean PGA over the target at 0 s: $(awk "/ centro\$| napa\$/ && NF == 9 { sum += \$1 } END { printf \"%.3f\", sum / 2 / 0.3 }" "$out")" "$out"'
expect "no line is wider than 100 characters" '[ "$(wc -l <"$out")" -gt 30 ] && ! grep -qE "^.{101,}" "$out"'
common=$(sed -n 's/.* with all factors times //p' "$out")
awk -v f="$common" '/^[0-9]/ { $2 *= f } 1' code.txt >higher.txt
run "$jostle" spectrum centro.AT2 napa.AT2 --match $match --periods $match --target higher.txt --tsv
cp "$out" higher.tsv
expect "the factor told brings the mean to 90 % everywhere, and hardly further" 'awk -F "\t" "
    FILENAME == \"scaled.tsv\" { if (\$1 == \"target\") goal[\$4] = \$5; next }
    \$2 == \"mean\" { r = \$5 / goal[\$4]; n++; least = n == 1 || r < least ? r : least }
    END { exit !(n == 50 && least >= 0.9 && least < 0.9002) }" scaled.tsv higher.tsv'

run "$jostle" spectrum centro.AT2 --target code.txt --periods 0,0.1,1,5
expect "by default the whole target is compared" '[ $status -eq 0 ] && grep -q "compared at 301 periods from 0.05 to 4 s$" "$out"'
expect "beside PSA stand the target and the ratio" 'awk "/^ +0.1 / { at = \$5; over = \$2 / \$5 - \$6 } /^ +0 / { zero = \$5 } /^ +5 / { none = \$5 \$6 } END { exit !(at == 0.6 && over^2 < 1e-6 && zero == 0.3 && none == \"--\") }" "$out"'
run "$jostle" spectrum centro.AT2 --target code.txt --intensities
expect "--intensities leaves out the spectra" '[ $status -eq 0 ] && grep -q "factor" "$out" && ! grep -q "PSV" "$out"'

run "$jostle" spectrum centro.AT2 ./napa.AT2 --target code.txt --match $match --deck
factors=$(awk '{ printf " %.6g", $2 }' got)
expect "--deck prints two sweeps and no more" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ "$(cat "$out")" = "sweep record values \\
    \"centro.AT2\" \\
    \"./napa.AT2\" -as motion
sweep factor values$factors -as motion" ]'
cp "$out" study.deck
cat >>study.deck <<'END'
ground record $record -scale $factor
building A -floors 1 -mass 100t -stiffness 50MN/m
contact wall A -gap 20mm -law linear -k 1e6kN/m
step fixed 1ms
END
run "$jostle" check study.deck
expect "which a deck reads" '[ $status -eq 0 ] && grep -q "2 runs" "$out"'
mkdir -p elsewhere/records
cp centro.AT2 napa.AT2 elsewhere/records
sed '1i param record none
s/"centro.AT2"/"records\/centro.AT2"/; s/".\/napa.AT2"/"records\/napa.AT2"/' study.deck >elsewhere/study.deck
"$jostle" run elsewhere/study.deck -q -D motion=2 -o second.h5
for name in napa napa.AT2 records/napa.AT2; do
    run "$jostle" run elsewhere/study.deck -q -D record=$name -o short.h5 --force
    expect "-D record=$name chooses the record and its factor" '[ $status -eq 0 ] && same second.h5 short.h5'
done
sed '/^sweep factor/d; s/ -as motion//; s/ -scale $factor//' elsewhere/study.deck >elsewhere/alone.deck
run "$jostle" run elsewhere/alone.deck -q -D record=napa -o alone.h5
expect "a sweep of its own takes the short name too" '[ $status -eq 0 ]'
run "$jostle" check elsewhere/study.deck -D record=nappa
expect "another name is a file that is not there" '[ $status -eq 2 ] && said "nappa: No such file"'
sed 's/records\/napa.AT2/.\/centro.AT2/' elsewhere/study.deck >elsewhere/twins.deck
run "$jostle" check elsewhere/twins.deck -D record=centro
expect "a name of two files chooses none" '[ $status -eq 2 ] && said "centro: No such file"'

run "$jostle" spectrum centro.AT2 --target en1998:ground=B,ag=0.25g --match $match --tsv --intensities
cp "$out" of_code
run "$jostle" spectrum centro.AT2 --target code.txt --match $match --tsv --intensities
expect "the file is the spectrum of the code" '[ $status -eq 0 ] && paste <(factors of_code) <(factors "$out") | awk "{ exit !((\$2 / \$5 - 1)^2 < 1e-24 && \$1 == \$4) }"'
run "$jostle" spectrum centro.AT2 --target en1998:ground=B,ag=0.25g --periods 0,1,5 --damping 2% --tsv
expect "and its damping is that of the spectra" '[ $status -eq 0 ] && awk -F "\t" "\$1 == \"target\" && \$2 == \"en1998\" { n++; if (\$4 == 1) ok = (\$5 / (0.375 * sqrt(10 / 7)) - 1)^2 < 1e-20 } END { exit !(ok && n == 2) }" "$out"'

for name in NAPA_2014_68150_HNN RIDGECREST_2019_CLC_090 RIDGECREST_2019_CLC_360; do
    cp "$root/input/records/$name.AT2" .
done
all="centro.AT2 napa.AT2 NAPA_2014_68150_HNN.AT2 RIDGECREST_2019_CLC_090.AT2 RIDGECREST_2019_CLC_360.AT2"
# shellcheck disable=SC2086  # several records
run "$jostle" spectrum $all --target code.txt --match $match --select 2 --factors 0.5:1.1 --deck
expect "the two best records with a factor within the limits are chosen" '[ $status -eq 0 ] && [ "$(grep -o "\"[^\"]*\"" "$out" | tr -d "\"\n")" = centro.AT2napa.AT2 ]'
# shellcheck disable=SC2086
run "$jostle" spectrum $all --target code.txt --match $match --select 3 --factors 0.8:3 --intensities
expect "how many there were is told" '[ $status -eq 0 ] && grep -q "^3 of 5 records chosen; 1 record has a factor outside 0.8 to 3$" "$out"'
# shellcheck disable=SC2086
run "$jostle" spectrum $all --target code.txt --match $match --select 3 --improve --intensities
expect "so is what exchanges did for the mean" '[ $status -eq 0 ] && grep -q "^misfit of the mean of the scaled spectra: 0.1454; 0.1718 before 1 exchange$" "$out" && [ "$(awk "/factor +misfit/ { inside = 1; next } inside && NF == 3 { printf \"%s \", \$3 } !NF { inside = 0 }" "$out")" = "centro napa RIDGECREST_2019_CLC_360 " ]'
# shellcheck disable=SC2086
run "$jostle" spectrum ${all#* } --target code.txt --match $match --pairs --deck
cp "$out" pairs.deck
awk '$1 == "sweep" && $2 == "factor" { exit !($4 == $5 && $6 == $7 && $4 != $6) }' pairs.deck
status=$?
expect "a pair has one factor" '[ $status -eq 0 ]'
sed -n '/^ground/,$p' study.deck >>pairs.deck
run "$jostle" check pairs.deck
expect "which a deck reads, too" '[ $status -eq 0 ] && grep -q "4 runs" "$out" && [ ! -s "$err" ]'

wrong() {
    local sentence=$1 words=$2
    shift 2
    run "$jostle" spectrum "$@"
    expect "$sentence" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "$words"'
}
printf 'T [s]  PSA\n1 1\n2 1\n' >bare.txt
printf 'T [s]  PSA [g]\n1 1\n2 -1\n' >negative.txt
printf '%s\n' 0 0 0 0 >zero.txt
cp centro.AT2 'a"b.AT2'
wrong "a target that is not there is named" "no.txt: No such file" centro.AT2 --target no.txt
wrong "a target must say its unit" "bare.txt:2: the unit of PSA is not given" centro.AT2 --target bare.txt
wrong "faults have their place" "negative.txt:3:3: PSA is -1; it must be > 0" centro.AT2 --target negative.txt
wrong "a word of a code is named" "ground takes A, B, C, D or E, not 'F'" centro.AT2 --target en1998:ground=F
wrong "the target must reach over the periods" "code.txt goes from 0 to 4 s, without 5 s of --match" centro.AT2 --target code.txt --match 1,5
wrong "periods of --match ascend" "periods must ascend" centro.AT2 --target code.txt --match 2,1
wrong "it takes periods" "--match takes FROM:TO:N or a list" centro.AT2 --target code.txt --match wide
wrong "there is one way to scale" "one of --scale, --pga and --target" centro.AT2 --target code.txt --scale 2
wrong "of the three" "one of --scale, --pga and --target" centro.AT2 --target code.txt --pga 1g
wrong "a target has one damping" "takes one damping ratio" centro.AT2 --target code.txt --damping 2%,5%
wrong "--match is for a target" "--match needs --target" centro.AT2 --match 1,2
wrong "for the deck of --pounding there is none" "--match needs --target" --pounding some.deck --match 1,2
wrong "and so is --deck" "--deck needs --target" centro.AT2 --deck
wrong "--select is for a target" "--select needs --target" centro.AT2 --select 1
wrong "so are --pairs" "--pairs needs --target" centro.AT2 napa.AT2 --pairs
wrong "--factors are for a choice" "--factors needs --select" centro.AT2 --target code.txt --factors 0.5:2
wrong "so is --improve" "--improve needs --select" centro.AT2 --target code.txt --improve
wrong "--factors takes two" "--factors takes two factors > 0 such as 0.5:2, not '2:1'" centro.AT2 --target code.txt --factors 2:1 --select 1
wrong "a pair has two records" "--pairs takes an even number of records, not 1" centro.AT2 --target code.txt --pairs
wrong "too few records are told" "2 of 2 records have a factor from 0 to inf; 3 are to be chosen" centro.AT2 napa.AT2 --target code.txt --select 3
wrong "one form is printed" "--deck and --tsv exclude each other" centro.AT2 --target code.txt --deck --tsv
wrong "a path with a line end cannot stand in a deck" "cannot stand in a deck" $'a\nb.AT2' --target code.txt --deck
wrong "nor can one with a quote" "cannot stand in a deck" 'a"b.AT2' --target code.txt --deck
wrong "a target is for records" "takes records and damping from the deck" --pounding some.deck --target code.txt
wrong "a record of zeros has no factor" "it cannot be scaled to a target" zero.txt --dt 0.01 --unit g --target code.txt
for option in --target=code.txt --match=1,2; do
    wrong "$option stands once" "${option%=*} is given twice" centro.AT2 $option $option
done

run "$jostle" spectrum centro.AT2 napa.AT2 --target code.txt --match 0.2:2:50 --periods 0.1,0.5,1,5 --script scripts
cp "$out" text
"$jostle" spectrum centro.AT2 napa.AT2 --target code.txt --match 0.2:2:50 --periods 0.1,0.5,1,5 --tsv >drawn.tsv
# At 0.5 s: the last column that the script draws, and what the table says.
column=$(grep -o 'using 1:[0-9]*' scripts/spectrum.gp | tail -n 1 | cut -d : -f 2)
expect "the target is drawn behind all others" '[ $status -eq 0 ] && [ "$(awk -v c="$column" "\$1 == 0.5 { print \$c }" scripts/spectrum.dat)" = 0.75 ]'
expect "and ends where it ends" '[ "$(awk -v c="$column" "\$1 == 5 { print \$c }" scripts/spectrum.dat)" = nan ]'
expect "the mean is that of the scaled records" '[ "$(awk "\$1 == 0.5 { printf \"%.6g\", \$4 }" scripts/spectrum.dat)" = "$(awk -F "\t" "\$2 == \"mean\" && \$4 == 0.5 { printf \"%.6g\", \$5 }" drawn.tsv)" ]'
expect "lines stand at the ends of what is compared" 'grep -q "^set arrow from first 0.2, graph 0" scripts/spectrum.gp && grep -q "^set arrow from first 2, graph 0" scripts/spectrum.gp'
if command -v gnuplot >/dev/null; then
    for records in "centro.AT2" "centro.AT2 napa.AT2"; do
        # shellcheck disable=SC2086  # one file or two
        run "$jostle" spectrum $records --target code.txt -o picture.png --force
        expect "a picture of $records is drawn" '[ $status -eq 0 ] && [ "$(wc -c <picture.png)" -gt 5000 ] && [ ! -s "$err" ]'
    done
else
    skip "pictures are drawn" "no gnuplot"
fi
