#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle spectrum: tables, TSV, pictures, wrong usage, and records that cannot be used.
. tests/support/cli.sh

records=$root/input/records
cp "$records/ELCENTRO_1940_NS.AT2" centro.AT2
cp "$records/NAPA_2014_68150_HNE.AT2" napa.AT2

run "$jostle" spectrum centro.AT2
expect "one record gives its intensities and its spectrum" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "0.3188 .*centro$" "$out" && grep -q "^5 % damping$" "$out" && [ "$(wc -l <"$out")" -eq 38 ]'
expect "no line is wider than 100 characters" '! grep -qE "^.{101,}" "$out"'
run "$jostle" spectrum centro.AT2 napa.AT2 --damping 2%,0.05
expect "two records give mean and percentiles for each damping" '[ $status -eq 0 ] && grep -q "^2 % damping, 2 records$" "$out" && grep -q "^5 % damping, 2 records$" "$out" && [ "$(grep -c "mean PSA" "$out")" -eq 2 ]'
run "$jostle" spectrum centro.AT2 --periods 0.5,1,2s --damping 0.02
expect "periods may be listed" '[ $status -eq 0 ] && [ "$(tail -n 3 "$out" | awk "{ print \$1 }" | tr "\n" " ")" = "0.5 1 2 " ]'

run "$jostle" spectrum --tsv napa.AT2 centro.AT2 --periods 0,0.5 --damping 0.05,0.1
expect "--tsv prints lines of one length" '[ $status -eq 0 ] && [ "$(awk -F "\t" "{ print NF }" "$out" | sort -u)" = 9 ] && [ "$(wc -l <"$out")" -eq 25 ]'
expect "records come in the order given, then the statistics" '[ "$(cut -f 2 "$out" | uniq | tr "\n" " ")" = "name napa centro mean 16% 50% 84% " ]'
expect "period 0 is the peak ground acceleration" 'awk -F "\t" "\$2 == \"centro\" && \$4 == 0 && \$5 == \$9 && \$5 > 0.31879 && \$5 < 0.31883 { n++ } END { exit n != 2 }" "$out"'
run "$jostle" spectrum --tsv centro.AT2
expect "one record has no statistics, and 301 periods" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 302 ] && ! grep -q statistic "$out"'
run "$jostle" spectrum --tsv --intensities centro.AT2 napa.AT2
expect "--tsv --intensities prints a line each" '[ $status -eq 0 ] && [ "$(wc -l <"$out")" -eq 3 ] && [ "$(awk -F "\t" "{ print NF }" "$out" | sort -u | wc -l)" -eq 1 ]'
run "$jostle" spectrum --intensities centro.AT2 ./centro.AT2
expect "files of one name are shown with their folders" '[ $status -eq 0 ] && grep -q " \./centro.AT2$" "$out"'

run "$jostle" spectrum --intensities centro.AT2 napa.AT2 --pga 0.2g
expect "--pga scales every record" '[ $status -eq 0 ] && [ "$(tail -n 2 "$out" | awk "{ print \$1 }" | uniq)" = 0.2 ]'
run "$jostle" spectrum --intensities centro.AT2 --scale -2
expect "--scale multiplies" '[ $status -eq 0 ] && grep -q "0.6376 " "$out"'
printf '%s\n' 0 10 -20 30 0 >values.txt
run "$jostle" spectrum --intensities values.txt --dt 10ms --unit cm/s2
expect "--dt and --unit say what the file does not" '[ $status -eq 0 ] && grep -q "0.03059 .* 0.04  values$" "$out"'
run "$jostle" spectrum --intensities values.txt -dt 0.01 -unit gal
expect "they may be spelt as in a deck" '[ $status -eq 0 ] && grep -q "0.03059 .* 0.04  values$" "$out"'
cp "$root/tests/records/good/afad.txt" .
run "$jostle" spectrum --intensities afad.txt --channel 2
expect "--channel chooses one" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "0.49  afad$" "$out"'
run "$jostle" spectrum --intensities afad.txt
expect "without it the channels are listed" '[ $status -eq 2 ] && said "3 channels: 1 '"'N-S', 2 'E-W', 3 'U-D'"'; -channel chooses one"'
printf '%s\n' 100 110 80 130 100 >offset.txt
run "$jostle" spectrum --intensities offset.txt --dt 0.01 --unit gal --demean
expect "--demean subtracts the mean" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^ *0.02651 " "$out"'
run "$jostle" spectrum --intensities offset.txt --dt 0.01 --unit gal --demean --pga 0.5g
expect "--pga scales what --demean leaves" '[ $status -eq 0 ] && grep -q "^ *0.5 " "$out"'
run "$jostle" spectrum values.txt --dt 0.01
expect "without a unit the record is refused" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "values.txt: the file gives no unit"'
run "$jostle" spectrum values.txt --dt 0.01 --unit mg --format columns
expect "a unit must be one of acceleration" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "is not a unit of acceleration"'
run "$jostle" spectrum values.txt --dt 0.01 --unit g
expect "warnings about a record go to stderr" '[ $status -eq 0 ] && said "jostle: warning: values.txt:4: the largest acceleration is 30 g"'

wrong() {
    local sentence=$1 words=$2
    shift 2
    run "$jostle" spectrum "$@"
    expect "$sentence" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "$words"'
}
wrong "a record is needed" "a record is expected"
wrong "a file that is not there is named" "no.AT2: No such file or directory" centro.AT2 no.AT2
wrong "a folder is no record" "is a directory" .
wrong "an option needs its value" "option '-dt' needs a value" centro.AT2 -dt
wrong "damping in per cent needs its sign" "a damping ratio is 5; it must be >= 0 and < 1" centro.AT2 --damping 5
wrong "a negative damping is refused" "a damping ratio is -0.1" centro.AT2 --damping -0.1
wrong "channels are counted from 1" "--channel takes a number from 1 to 2147483647, not '0'" centro.AT2 --channel 0
wrong "a file of one has none to choose" "a file of format peer has one channel" centro.AT2 --channel 1
wrong "a list has no empty places" "not '0.1,,0.2'" centro.AT2 --damping 0.1,,0.2
wrong "there are at most 7 dampings" "at most 7 are taken" centro.AT2 --damping 0,.1,.2,.3,.4,.5,.6,.7
wrong "a damping has no unit of time" "not '1s'" centro.AT2 --damping 1s
wrong "periods are positive" "a period is -1 s" centro.AT2 --periods -1,1
wrong "periods ascend" "periods must ascend: 1 s follows 2 s" centro.AT2 --periods 2,1
wrong "ranges ascend" "they must ascend" centro.AT2 --periods 2:1:5
wrong "a range has two periods at least" "1 periods; 2 to" centro.AT2 --periods 1:2:1
wrong "a range has three words" "not '1:2'" centro.AT2 --periods 1:2
wrong "a number has a known unit" "not '1parsec'" centro.AT2 --periods 1parsec
wrong "a peak has its unit" "with its unit" centro.AT2 --pga 0.3
wrong "a peak is positive" "> 0" centro.AT2 --pga -0.3g
wrong "--scale and --pga exclude each other" "give one of --scale, --pga and --target" centro.AT2 --scale 2 --pga 0.3g
wrong "a scale of 0 is refused" "a factor other than 0" centro.AT2 --scale 0
wrong "a picture has an ending" "must end in .png, .svg or .pdf" centro.AT2 -o picture.gif
wrong "a picture needs periods" "three periods" centro.AT2 -o picture.png --periods 0,1,2
wrong "intensities have no damping" "--intensities" centro.AT2 --intensities --damping 0.1
for option in --damping=0 --periods=1 --scale=2 --pga=1g --dt=1 --unit=g --format=peer --script=folder; do
    wrong "$option stands once" "${option%=*} is given twice" centro.AT2 $option $option
done
wrong "-o stands once" "-o or --output is given twice" centro.AT2 -o one.png -o two.png
for file in "$root"/tests/records/bad/*; do
    case $file in
    */dt_missing.AT2) word="dt" ;;
    *) word=${file##*/} ;;
    esac
    run "$jostle" spectrum "$file" --intensities
    expect "$(basename "$file") is refused" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "$word"'
done
run "$jostle" spectrum "$root/tests/records/good/all_zero.AT2" --periods 0,0.1,1
expect "a record of zeros has spectra of zeros" '[ $status -eq 0 ] && ! grep -qi nan "$out" && [ "$(tail -n 3 "$out" | awk "{ s += \$2 + \$3 + \$4 } END { print s }")" = 0 ]'
run "$jostle" spectrum "$root/tests/records/good/all_zero.AT2" --pga 0.1g
expect "and cannot be scaled to a peak" '[ $status -eq 2 ] && said "every value is 0"'

run env PATH= "$jostle" spectrum centro.AT2 napa.AT2 -o picture.png --script scripts
expect "without gnuplot the command ends with 3, the script is there all the same" '[ $status -eq 3 ] && [ ! -s "$out" ] && said "gnuplot" && [ -s scripts/spectrum.gp ] && [ -s scripts/spectrum.dat ] && [ ! -e picture.png ]'
# The values that the script in `scripts` draws at a period of 0.5 s, in the order of its curves.
curves() {
    for column in $(grep -o 'using 1[:0-9]*' scripts/spectrum.gp | cut -d : -f 2- | tr : ' '); do
        LC_ALL=C awk -v c="$column" '$1 == 0.5 { printf "%.7g\n", $c }' scripts/spectrum.dat
    done
}

# printed NAME DAMPING...: the PSA of that record or statistic there, for each ratio.
printed() {
    local name=$1 ratio
    shift
    for ratio in "$@"; do
        LC_ALL=C awk -F '\t' -v n="$name" -v z="$ratio" '$2 == n && $3 == z && $4 == 0.5 { printf "%.7g\n", $5 }' printed.tsv
    done
}

run "$jostle" spectrum centro.AT2 --damping 0.05 --periods 0.1,0.7 --tsv
expect "damping and period are printed as they were given" '[ "$(cut -f 3,4 "$out" | tail -n 2)" = "$(printf "0.05\t0.1\n0.05\t0.7")" ]'
"$jostle" spectrum centro.AT2 napa.AT2 --damping 0.125,0.25 --periods 0.25,0.5,1 --tsv >printed.tsv
run "$jostle" spectrum centro.AT2 napa.AT2 --damping 0.125,0.25 --periods 0.25,0.5,1 --script scripts --force
expect "of several damping ratios the means are drawn" '[ $status -eq 0 ] && [ "$(curves)" = "$(printed mean 0.125 0.25)" ]'
run "$jostle" spectrum centro.AT2 napa.AT2 --damping 0.25 --periods 0.25,0.5,1 --script scripts --force
expect "of one the band, the records and the mean" '[ $status -eq 0 ] && [ "$(curves)" = "$(for n in 16% 84% centro napa mean; do printed $n 0.25; done)" ]'
if command -v gnuplot >/dev/null; then
    for ending in png svg pdf; do
        run "$jostle" spectrum centro.AT2 napa.AT2 -o picture.$ending
        expect "a picture is drawn, $ending" '[ $status -eq 0 ] && [ "$(wc -c <picture.$ending)" -gt 5000 ] && grep -q PGA "$out"'
    done
    run "$jostle" spectrum centro.AT2 -o picture.png
    expect "a picture is not overwritten" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "picture.png exists; --force overwrites it"'
    run "$jostle" spectrum centro.AT2 --damping 0.02,0.05 -o picture.png --force
    expect "unless it is forced" '[ $status -eq 0 ]'
    run bash -c 'cd scripts && gnuplot spectrum.gp && [ -s spectrum.png ]'
    expect "the script stands alone" '[ $status -eq 0 ]'
else
    skip "pictures are drawn" "no gnuplot"
fi
expect "nothing is left behind but what was asked for" '! ls | grep -q part'
