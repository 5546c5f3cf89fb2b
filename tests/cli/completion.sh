#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The completion for bash knows every command and every option that the help texts name, and what
# stands behind them.
. tests/support/cli.sh
. "$root/docs/jostle.bash"

# complete_line WORD...: what is proposed for the last word.
complete_line() {
    COMP_WORDS=("$jostle" "$@")
    COMP_CWORD=$#
    _jostle
    proposed=" ${COMPREPLY[*]-} "
}

proposes() {
    local word
    for word; do
        [[ $proposed == *" $word "* ]] || return 1
    done
}

commands=$("$jostle" --help | sed -n 's/^  \([a-z]*\)  .*/\1/p')
complete_line ""
expect "every command is proposed" '[ "$(wc -w <<<"$commands")" -ge 9 ] && proposes $commands --help --version'
expect "none is missing in the man page" '[ "$(grep -c "^\.SS jostle " "$root/docs/jostle.1")" -eq "$(grep -c "^COMMAND(" "$root/src/command/command_list.inc")" ]'
complete_line sp
expect "those that begin so, where something stands" '[ "$proposed" = " spectrum " ]'
for command in $commands; do
    long=$("$jostle" "$command" --help | grep -o -e '--[a-z][a-z]*' | sort -u)
    complete_line "$command" --
    expect "every option of $command is proposed" '[ -n "$long" ] && proposes $long'
done
complete_line run -
expect "letters are options too" 'proposes -o -D -j -q'
complete_line law hertz -
expect "a law's options stand beside those of the command" 'proposes -k -n -m1 -m2 -v --plot'

mkdir decks
touch a.deck b.h5 c.txt
complete_line run ""
expect "run takes decks and folders" '[ "$proposed" = " decks a.deck " ]'
complete_line run -D gap=1m -q ""
expect "behind options and their values as well" '[ "$proposed" = " decks a.deck " ]'
complete_line show ""
expect "show takes results" '[ "$proposed" = " decks b.h5 " ]'
complete_line spectrum c.txt ""
expect "spectrum takes one file after another" 'proposes a.deck b.h5 c.txt decks'
complete_line plot b.h5 --script ""
expect "--script takes a folder" '[ "$proposed" = " decks " ]'
complete_line plot b.h5 en
expect "plot takes a kind behind the file" '[ "$proposed" = " energy " ]'
complete_line plot deck ""
expect "behind plot deck stand decks" '[ "$proposed" = " decks a.deck " ]'
complete_line plot ""
expect "plot takes results, and the word deck" '[ "$proposed" = " decks b.h5 deck " ]'
complete_line fragility b.h5 --edp drif
expect "--edp takes a demand" '[ "$proposed" = " drift drift-ratio " ]'
complete_line plot b.h5 ida --edp imp
expect "of plot too" '[ "$proposed" = " impacts impulse " ]'
complete_line law hert
expect "law takes a contact law" '[ "$proposed" = " hertz hertz-damp " ]'
complete_line law elas
expect "and none of a storey" '[ -z "${proposed// /}" ]'
complete_line laws elas
expect "laws takes both" '[ "$proposed" = " elastic " ]'
complete_line deck "sto"
expect "deck takes a statement" '[ "$proposed" = " storey " ]'
complete_line nothing ""
expect "an unknown command has nothing" '[ -z "${proposed// /}" ]'
complete_line merge b.h5 ""
expect "merge takes one result after another" '[ "$proposed" = " decks b.h5 " ]'
complete_line tasks ""
expect "tasks takes decks" '[ "$proposed" = " decks a.deck " ]'
