#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# man.sh JOSTLE FOLDER: writes the man pages jostle.1 and jostle-deck.5 into FOLDER, from the help
# texts of the program, docs/deck.md, the record formats of docs/ground-motions.md, and the pages of
# statements and laws that the program prints.
set -eu
jostle=$1
folder=$2
support=tests/support
version=$("$jostle" --version)

mkdir -p "$folder"
commands=$("$jostle" --help | sed -n 's/^  \([a-z][a-z]*\)  .*/\1/p')

part() {
    writer=$1
    shift
    awk -f $support/man_text.awk -f "$support/man_$writer.awk" "$@"
}

{
    cat <<END
.\\" SPDX-License-Identifier: GPL-3.0-or-later
.\\" Written by \`make docs\` from the help texts.
.TH JOSTLE 1 "" "$version" "User Commands"
.SH NAME
jostle \\- simulates the earthquake pounding of multistorey buildings
.SH SYNOPSIS
.B jostle
.I COMMAND
\\&...
.SH DESCRIPTION
Buildings that stand too close hit each other at their floors.
.B jostle
reads a text deck with shear buildings, gaps, a contact law and a ground motion, integrates the
equations of motion by Newmark's method, and writes an HDF5 file with histories, envelopes, every
impact and an energy balance. The deck is described in
.BR jostle\\-deck (5).
.SH COMMANDS
END
    for command in $commands; do
        "$jostle" "$command" --help | part help -v command="$command"
    done
    cat <<END
.SH EXIT STATUS
END
    "$jostle" --help | sed -n '/^Exit status: /,$ { s/^Exit status: //; p; }'
    cat <<END
.SH ENVIRONMENT
.TP
.B NO_COLOR
If set, messages have no colour.
.TP
.B TMPDIR
Folder for temporary files of plots; default: /tmp.
.SH EXAMPLES
.TP
.B jostle run two_towers.deck
Runs the deck into two_towers.h5 and prints a summary.
.TP
.B jostle plot two_towers.h5 energy \\-o energy.pdf
Draws the energy components.
.TP
.B jostle run two_towers.deck \\-D gap=1m \\-o apart.h5
Runs the deck with another value of a parameter.
.SH SEE ALSO
.BR jostle\\-deck (5),
.BR gnuplot (1),
.BR h5dump (1)
END
} >"$folder/jostle.1"

{
    cat <<END
.\\" SPDX-License-Identifier: GPL-3.0-or-later
.\\" Written by \`make docs\` from docs/deck.md, \`jostle deck\` and \`jostle laws\`.
.TH JOSTLE\\-DECK 5 "" "$version" "File Formats"
.SH NAME
jostle\\-deck \\- the text that jostle reads: buildings, contacts, laws, ground motions
END
    sed -e 's/^# .*/# Description/' -e 's/\[deck-statements.md\]([^)]*)/STATEMENTS OF A DECK below/' \
        docs/deck.md | part markdown -v sections=2
    sed -n '/^## Record files/,/^## Scaling/ { /^## Scaling/d; p; }' docs/ground-motions.md |
        part markdown -v sections=2
    "$jostle" deck --markdown | sed 's/\[deck.md\]([^)]*) explains/The sections above explain/' |
        part markdown -v sections=1
    "$jostle" laws --markdown | part markdown -v sections=2
    cat <<END
.SH SEE ALSO
.BR jostle (1)
END
} >"$folder/jostle-deck.5"
