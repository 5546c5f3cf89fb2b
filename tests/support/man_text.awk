# SPDX-License-Identifier: GPL-3.0-or-later
# Text for man pages: what the two writers, man_help.awk and man_markdown.awk, share.

# Characters that groff would take for its own; dashes stay what is typed.
function plain(text) {
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    gsub(/'/, "\\(aq", text)
    gsub(/\^/, "\\(ha", text)
    gsub(/~/, "\\(ti", text)
    return text
}

# What is typed: options and small words bold, what stands for something else italic.
function typed(text,    done, word) {
    while (match(text, /--?[A-Za-z][-A-Za-z0-9]*|[A-Z][A-Za-z0-9.]*|[a-z][a-z0-9]*/)) {
        word = substr(text, RSTART, RLENGTH)
        done = done plain(substr(text, 1, RSTART - 1)) (word ~ /^[A-Z]/ ? "\\fI" : "\\fB") \
            plain(word) "\\fR"
        text = substr(text, RSTART + RLENGTH)
    }
    return done plain(text)
}

# Running text: `code` and **bold** are bold; of a link its text is left.
function running(text,    done, part) {
    while (match(text, /`[^`]*`|\*\*[^*]*\*\*|\[[^]]*\]\([^)]*\)/)) {
        part = substr(text, RSTART, RLENGTH)
        done = done plain(substr(text, 1, RSTART - 1))
        text = substr(text, RSTART + RLENGTH)
        if (part ~ /^`/) {
            done = done "\\fB" plain(substr(part, 2, length(part) - 2)) "\\fR"
        } else if (part ~ /^\*/) {
            done = done "\\fB" plain(substr(part, 3, length(part) - 4)) "\\fR"
        } else {
            sub(/\]\(.*/, "", part)
            done = done running(substr(part, 2))
        }
    }
    return done plain(text)
}

# A line that is text whatever it begins with.
function line(text) {
    print (text ~ /^[.']/ ? "\\&" : "") text
}
