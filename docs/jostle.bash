# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of jostle for bash. Commands, options, kinds of pictures, laws and statements are asked
# of the program itself, so this file knows none of them.

# The options of a help text, a line each: the option, and what stands for its value.
_jostle_options() {
    awk '/^  -/ {
        sub(/^  /, "")
        sub(/  .*/, "")
        value = $NF ~ /^[A-Z]/ ? $NF : ""
        n = split($0, tag, /, /)
        for (i = 1; i <= n; i++) {
            split(tag[i], word, / /)
            print word[1], value
        }
    }' <<<"$1"
}

# The first words of the indented lines, but options.
_jostle_names() {
    sed -n 's/^  \([a-z][-a-z0-9]*\) .*/\1/p' <<<"$1"
}

# Names of laws, up to the heading that begins with the second word.
_jostle_laws() {
    "$1" laws --markdown | sed -n "/^## ${2-none}/q; s/^### //p"
}

# _jostle_files WORD [ENDING]: folders, and files with this ending.
_jostle_files() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(
        compgen -d -- "$1"
        if [ $# -gt 1 ]; then
            compgen -f -X "!*.$2" -- "$1"
        else
            compgen -f -- "$1" | while read -r name; do
                [ -d "$name" ] || echo "$name"
            done
        fi
    )
}

_jostle_words() {
    mapfile -t COMPREPLY < <(compgen -W "$2" -- "$1")
}

# What stands for an operand or the value of an option, by its name in the help text.
_jostle_value() {
    local word=$1 name=$2 program=$3 help=$4
    case $name in
    DECK) _jostle_files "$word" deck ;;
    *.h5) _jostle_files "$word" h5 ;;
    FILE* | RECORD) _jostle_files "$word" ;;
    DIR)
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -d -- "$word")
        ;;
    KIND) _jostle_words "$word" "$(_jostle_names "$help")" ;;
    STATEMENT) _jostle_words "$word" "$(_jostle_names "$("$program" deck)")" ;;
    EDP) _jostle_words "$word" "$(_jostle_names "$("$program" fragility --help)")" ;;
    LAW | LAWS) _jostle_words "$word" "$(_jostle_laws "$program" Storey)" ;;
    NAME) _jostle_words "$word" "$(_jostle_laws "$program")" ;;
    esac
}

_jostle() {
    local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]}
    local help options before name i n=0 operands form
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        _jostle_words "$word" "$(_jostle_names "$("$program" --help 2>/dev/null)") --help --version"
        return
    fi
    help=$("$program" "$command" --help 2>/dev/null) || return
    options=$(_jostle_options "$help")
    before=${COMP_WORDS[COMP_CWORD - 1]}
    name=$(awk -v option="$before" '$1 == option { print $2 }' <<<"$options")
    if [ -n "$name" ]; then
        _jostle_value "$word" "$name" "$program" "$help"
        return
    fi
    case $word in
    -*)
        if [ "$command" = law ]; then
            options+=$'\n'$(_jostle_options "$("$program" laws "${COMP_WORDS[2]}" 2>/dev/null)")
        fi
        _jostle_words "$word" "$(cut -d ' ' -f 1 <<<"$options")"
        return
        ;;
    esac
    # Operands stand in the usage in front of the options; the last one may be repeated.
    # A second line of the usage is another form, which begins with a word of its own.
    form=$(sed -n "2,/^$/s/^ *jostle $command //p" <<<"$help")
    operands=$(sed -n "1s/^usage: jostle $command //p" <<<"$help")
    [ "$COMP_CWORD" -eq 2 ] || [ "${COMP_WORDS[2]}" != "${form%% *}" ] || operands=$form
    operands=$(sed 's/ \[\{0,1\}-.*//; s/[][]//g; s/\.\.\.//' <<<"$operands")
    for ((i = 2; i < COMP_CWORD; i++)); do
        case ${COMP_WORDS[i]} in
        -*) awk -v option="${COMP_WORDS[i]}" '$1 == option && $2 { found = 1 } END { exit !found }' \
            <<<"$options" && i=$((i + 1)) ;;
        *) n=$((n + 1)) ;;
        esac
    done
    # shellcheck disable=SC2086  # names of operands are one word each
    set -- $operands
    [ "$n" -lt $# ] || n=$(($# - 1))
    shift "$n"
    _jostle_value "$word" "${1-}" "$program" "$help"
    if [ "$n" -eq 0 ] && [ -n "$form" ] && [[ ${form%% *} == "$word"* ]]; then
        COMPREPLY+=("${form%% *}")
    fi
}

complete -F _jostle jostle
