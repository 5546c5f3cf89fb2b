# SPDX-License-Identifier: GPL-3.0-or-later
# For tests that call make for the build they belong to. They source cli.sh first.
#   is_ordinary     is it a build for users, in a folder that has rules in the Makefile?
#   make_here ...   make with what is there: with another compiler or other flags it would compile
#                   everything again
build=$(dirname "$jostle")
flags=$(cat "$build/flags" 2>/dev/null)
unset MAKEFLAGS MAKELEVEL MFLAGS

is_ordinary() {
    case $build$here in
    *[[:space:]:%\']*) return 1 ;;  # such names make has no rules for
    esac
    case $flags in
    '' | *fsanitize* | *coverage* | *profile*) return 1 ;;
    esac
}

make_here() {
    local strict=
    case $flags in
    *-Werror*) strict=1 ;;
    esac
    run make -C "$root" --no-print-directory CC="${flags%% -*}" WERROR="$strict" BUILD="$build" \
        -o "$build/libjostle.a" "$@"
}
