# SPDX-License-Identifier: GPL-3.0-or-later
# fill.awk VALUES PAGE: prints PAGE with each {{name}} replaced. A name that has no value, and a
# value that no name takes, are errors.
function fail(text) {
    print "fill.awk: " text >"/dev/stderr"
    failed = 1
    exit 1
}

function lookup(name) {
    if (!(name in value)) {
        fail("no value for " name)
    }
    used[name] = 1
    return value[name]
}

FNR == NR {
    tab = index($0, "\t")
    name = substr($0, 1, tab - 1)
    text = substr($0, tab + 1)
    if (name in value) {
        text = value[name] "\n" text
    }
    value[name] = text
    next
}

{
    while (match($0, /\{\{[a-z0-9_]+\}\}/)) {
        name = substr($0, RSTART + 2, RLENGTH - 4)
        $0 = substr($0, 1, RSTART - 1) lookup(name) substr($0, RSTART + RLENGTH)
    }
    print
}

END {
    for (name in value) {
        if (!failed && !(name in used)) {
            fail("nothing takes " name)
        }
    }
    exit failed
}
