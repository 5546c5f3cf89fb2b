#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check_shell.sh: shellcheck on all scripts, its errors and warnings. Left out are
#   SC2034, SC2154: variables that no line of the file uses or sets. Many scripts are parts that
#       others read with `.`: cli.sh sets $status for the conditions of `expect`, which are words.
set -euo pipefail
files=(.ci/run)
parts=()
while IFS= read -r file; do
    if head -n 1 "$file" | grep -q '^#!'; then
        files+=("$file")
    else
        parts+=("$file")
    fi
done < <(find tests -name '*.sh' | sort)
options=(--external-sources --severity=warning --exclude=SC2034 --exclude=SC2154)
shellcheck "${options[@]}" "${files[@]}"
bash_parts=() sh_parts=()
for file in "${parts[@]}"; do
    # What the tests of the command line read is bash; the cases of the manual are run by sh.
    case $file in
    tests/verification/*) sh_parts+=("$file") ;;
    *) bash_parts+=("$file") ;;
    esac
done
shellcheck "${options[@]}" --shell=sh "${sh_parts[@]}"
shellcheck "${options[@]}" --shell=bash "${bash_parts[@]}"
