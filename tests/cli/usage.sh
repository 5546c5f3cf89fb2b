#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Help, version, and wrong usage.
. tests/support/cli.sh

run "$jostle" --version
expect "--version prints name and version" '[ $status -eq 0 ] && grep -qxE "jostle [0-9]+\.[0-9]+\.[0-9]+" "$out" && [ ! -s "$err" ]'
for word in --help -h help "help help" "help --help"; do
    run "$jostle" $word
    expect "$word explains the program" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^usage: jostle" "$out"'
done
run "$jostle" help check
expect "help COMMAND explains the command" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^usage: jostle check" "$out"'
run "$jostle" help chekc
expect "help of an unknown command is wrong usage" '[ $status -eq 2 ] && said "did you mean '"'check'"'"'
run "$jostle" --version now
expect "a word behind --version is wrong usage" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "'"'now' is not expected"'"'
run "$jostle" --help
commands=$(sed -n 's/^  \([a-z]*\)  .*/\1/p' "$out")
expect "the help names the commands" '[ "$(wc -w <<<"$commands")" -ge 5 ]'

run "$jostle"
expect "no command is wrong usage, explained on stderr" '[ $status -eq 2 ] && [ ! -s "$out" ] && grep -q "^usage: jostle" "$err"'
run "$jostle" chekc a.deck
expect "an unknown command is named, and the nearest" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "unknown command '"'chekc'; did you mean 'check'?"'"'
run "$jostle" --frob
expect "an unknown option in place of the command is named" '[ $status -eq 2 ] && said "unknown option '"'--frob'"'"'

for command in $commands; do
    for word in --help -h; do
        run "$jostle" "$command" $word
        expect "$command $word explains the command" '[ $status -eq 0 ] && [ ! -s "$err" ] && grep -q "^usage: jostle $command" "$out"'
    done
    run "$jostle" "$command" --frob
    expect "$command refuses an unknown long option" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "option '"'--frob'"'"'
    run "$jostle" "$command" -Z
    expect "$command refuses an unknown short option" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "option '"'-Z'"'"'
done
run "$jostle" run --force -Zq a.deck
expect "of letters in one word the unknown one is named, not the option before" '[ $status -eq 2 ] && said "option '"'-Z'"'"'
run "$jostle" run --force=yes a.deck
expect "a value of an option that takes none is named" '[ $status -eq 2 ] && said "option '"'--force=yes'"'"'
for word in --forc --threa=2 --f; do
    run "$jostle" run $word a.deck
    expect "$word is no option, though one begins so" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "unknown option '"'$word'"'"'
done
run "$jostle" run --forc a.deck
expect "a mistyped long option is told with the nearest" '[ $status -eq 2 ] && said "did you mean '"'--force'?"'"'
run "$jostle" spectrum a.AT2 --period 1:2:3
expect "the beginning of an option before its value is none" '[ $status -eq 2 ] && said "unknown option '"'--period'; did you mean '--periods'?"'"'
run "$jostle" spectrum a.AT2 -period 1:2:3
expect "nor is it behind one dash" '[ $status -eq 2 ] && said "unknown option '"'-period'; did you mean '--periods'?"'"'

for value in --force -q; do
    run "$jostle" run a.deck -o $value
    expect "-o $value lacks the name" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "option '"'-o' needs a value; '$value' is an option"'"'
done
run "$jostle" law hertz -k -m1 3
expect "-k -m1 lacks a number" '[ $status -eq 2 ] && said "needs a value"'

while read -r command first second names; do
    run "$jostle" "$command" a.file $first $second
    expect "$command $first $second says twice" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "$names is given twice"'
done <<'END'
run -j2 --threads=2 -j or --threads
run -oa.h5 -oa.h5 -o or --output
gap --threads=1 -j1 -j or --threads
tasks -n3 --parts=3 -n or --parts
converge --rtol=1e-3 --rtol=1e-4 --rtol
fragility --im=pga --im=pga --im
fragility --method=ida --method=ida --method
plot --against=pga --im=pga --im or --against
spectrum --output=a.png -oa.png -o or --output
END
run "$jostle" show a.h5 --json --tsv
expect "of options that exclude each other both are named" '[ $status -eq 2 ] && said "--tsv and --json exclude each other"'
run env POSIXLY_CORRECT=1 "$jostle" converge no_such_file --rtol 0
expect "options may stand behind the deck, whatever POSIXLY_CORRECT says" '[ $status -eq 2 ] && said "--rtol takes a number from 1e-12 to 1"'
run "$jostle" check -- -q
expect "behind -- there are no options" '[ $status -eq 2 ] && said "-q: No such file or directory"'
for command in run check modes show plot; do
    run "$jostle" "$command"
    expect "$command needs a file" '[ $status -eq 2 ] && [ ! -s "$out" ] && [ -s "$err" ]'
    run "$jostle" "$command" no_such_file
    expect "$command says that the file does not exist" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "no_such_file: No such file or directory"'
done
for command in run check modes; do
    run "$jostle" "$command" a.deck b.deck
    expect "$command refuses a second deck" '[ $status -eq 2 ] && said "one deck is expected, not 2"'
    run "$jostle" "$command" a.deck -D
    expect "$command -D needs a value" '[ $status -eq 2 ] && said "option '"'-D' needs a value"'"'
    run "$jostle" "$command" "$here"
    expect "$command refuses a folder" '[ $status -eq 2 ] && said "is a directory"'
done
for threads in 0 -1 two 1.5 99999 ''; do
    run "$jostle" run a.deck -j "$threads"
    expect "-j '$threads' is no number of threads" '[ $status -eq 2 ] && said "-j takes a number of threads"'
done
expect "nothing was written" '[ -z "$(ls -A)" ]'

run "$jostle" laws foo
expect "an unknown law is told, and where all are listed" '[ $status -eq 2 ] && said "unknown law '"'foo'; 'jostle laws'"' lists all"'
run "$jostle" laws herz
expect "or the nearest one is named" '[ $status -eq 2 ] && said "unknown law '"'herz'; did you mean 'hertz'?"'"'
run "$jostle" deck storey
expect "deck storey lists the laws of storeys" '[ $status -eq 0 ] && tr -s " \n" " " <"$out" | grep -qE " laws elastic, bilinear, .*, slip[,;]"'
run "$jostle" deck contact
expect "deck contact lists the laws of contacts" '[ $status -eq 0 ] && grep -qE "^ +laws +stereomechanical, linear," "$out" && ! grep -q takeda "$out"'
