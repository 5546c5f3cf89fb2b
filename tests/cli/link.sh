#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Where the archives of the libraries, or that of the C library, are missing, the program is linked
# with what is shared. Links what has been compiled once more, with an archive that is nowhere.
. tests/support/cli.sh
. "$root/tests/support/make.sh"

link() {
    make_here -o "$build/object/src/main.o" PROGRAM="$here/jostle" "$here/jostle" "$@"
}

if is_ordinary; then
    link ARCHIVES=-lno_such_archive
    expect "without archives the program is linked with what is shared" '[ $status -eq 0 ] && [ ! -s "$err" ]'
    run ./jostle check "$root/input/wall.deck"
    cp "$out" shared
    run "$jostle" check "$root/input/wall.deck"
    expect "and does the same" '[ $status -eq 0 ] && [ ! -s "$err" ] && [ -s shared ] && cmp shared "$out"'
    rm jostle
    link ARCHIVES=-lno_such_archive LIBS=-lno_such_library
    expect "what is missing altogether is named" '[ $status -ne 0 ] && said no_such_library && ! said no_such_archive && [ ! -e jostle ]'
else
    skip "the program is linked without archives" "not an ordinary build"
fi
