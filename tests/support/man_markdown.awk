# SPDX-License-Identifier: GPL-3.0-or-later
# A page of the documentation as a part of a man page. Headings down to depth `sections` open a
# section, deeper ones a subsection. Tables become lists: the first cell names what the others tell.

function end_code() {
    if (inside_code) {
        print ".fi\n.RE"
    }
    inside_code = 0
}

function end_table() {
    if (inside_table && !of_options) {
        print ".PD"
    }
    inside_table = 0
}

# "meaning [unit, range, default]" of the cells of an option.
function option_text() {
    return running(n_cell[3]) (n_cell[4] ? " [" plain(n_cell[4]) "]" : "")
}

function table_row(    i, text) {
    split($0, n_cell, / *\| */)
    gsub(/`/, "", n_cell[2])
    text = of_options ? option_text() : running(n_cell[3])
    for (i = 4; !of_options && n_cell[i] != ""; i++) {
        text = text ", " running(n_cell[i])
    }
    print ".TP"
    line(typed(n_cell[2]))
    line(text)
}

/^<!--/ || /^!\[/ { next }
/^    / && (blank || inside_code) && !inside_item {
    if (!inside_code) {
        print (heading ? "" : ".PP\n") ".RS 4\n.nf"
    } else if (blank) {
        print ""
    }
    inside_code = 1
    blank = heading = 0
    line(plain(substr($0, 5)))
    next
}
/^$/ { blank = 1; inside_item = 0; end_table(); next }
{ end_code() }
/^#+ / {
    depth = index($0, " ") - 1
    text = substr($0, depth + 2)
    gsub(/`/, "", text)
    heading = 1
    print (depth <= sections ? ".SH " plain(toupper(text)) : ".SS " plain(text))
    blank = 0
    next
}
/^\|/ {
    if (!inside_table) {
        inside_table = 1
        of_options = /^\| option /
        if (!of_options) {
            print ".PD 0"
        }
    } else if (!/^\| ---/) {
        table_row()
    }
    blank = 0
    next
}
/^- (what|usage|example|force|shear|features|source|remarks): / {
    label = $2
    sub(/:$/, "", label)
    sub(/^- [a-z]+: /, "")
    print ".TP\n" label
    line(running($0))
    blank = 0
    next
}
/^- / {
    print ".IP \\(bu 2"
    line(running(substr($0, 3)))
    inside_item = 1
    blank = 0
    next
}
{
    if (blank && !heading) {
        print ".PP"
    }
    blank = heading = 0
    sub(/^ +/, "")
    line(running($0))
}
END { end_code(); end_table() }
