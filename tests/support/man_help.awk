# SPDX-License-Identifier: GPL-3.0-or-later
# The help text of a command as a part of a man page: usage, paragraphs, and lists of options.

/^usage: / { inside_usage = 1; sub(/^usage: /, "") }
inside_usage && /^$/ { inside_usage = 0 }
inside_usage {
    # Each way to call the command begins with its name.
    again = usage && /^ +jostle /
    sub(/^ +/, "")
    usage = usage (usage ? again ? "\n" : " " : "") $0
    next
}
/^$/ { due = 1; next }
!named {
    print ".SS jostle " plain(command)
    n_usage = split(usage, way, /\n/)
    for (i = 1; i <= n_usage; i++) {
        if (i > 1) {
            print ".br"
        }
        line(typed(way[i]))
    }
    print ".PP"
    named = 1
    due = 0
}
/^  [^ ]/ {
    text = substr($0, 3)
    tag = text
    if (match(text, /  +/)) {
        tag = substr(text, 1, RSTART - 1)
        text = substr(text, RSTART + RLENGTH)
    } else {
        text = ""
    }
    print ".TP"
    line(typed(tag))
    if (text) {
        line(running(text))
    }
    due = 0
    next
}
{
    sub(/^ +/, "")
    if (due) {
        print ".PP"
    }
    due = 0
    line(running($0))
}
