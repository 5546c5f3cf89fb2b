# SPDX-License-Identifier: GPL-3.0-or-later
# How the tables of the verification manual write numbers.
function size(x) {
    return x < 0 ? -x : x
}

# `digits` significant digits, zeros at the end kept. What is no number stops the manual.
function number(x, digits,    text) {
    if (x !~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/) {
        print "'" x "' is no number in: " $0 >"/dev/stderr"
        exit 1
    }
    if (x != 0 && (size(x) >= 1e5 || size(x) < 1e-3)) {
        return scientific(x, digits)
    }
    text = sprintf("%#." digits "g", x)
    sub(/\.$/, "", text)
    return text
}

# An error with two digits; below `floor` it is rounding, and differs from machine to machine.
function small(x, floor) {
    x = size(x)
    return x < floor ? "< " scientific(floor, 1) : scientific(x, 2)
}

function scientific(x, digits,    text) {
    text = sprintf("%." (digits - 1) "e", x)
    sub(/e\+0*/, "e", text)
    sub(/e-0*/, "e-", text)
    return text
}

function relative(expected, computed) {
    return expected == 0 ? size(computed) : size((computed - expected) / expected)
}
