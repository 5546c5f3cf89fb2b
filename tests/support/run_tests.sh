#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# run_tests.sh FOLDER TEST...: runs cmocka programs and shell tests (*.sh) side by side, JOBS at a
# time, each for LIMIT seconds at most and with a temporary folder of its own. One line each; the
# whole output of those that failed; at the end, alone on a line, `N passed, N failed`.
# A program without a result, or that ends badly although its tests passed, counts as one failure.
# Names its logs FOLDER/NAME.log.
set -u

# What a log says: "passed failed skipped".
count() {
    awk '
        /\[  PASSED  \] [0-9]+ test\(s\)/ { sub(/.*PASSED  \] /, ""); passed += $1; next }
        /\[  FAILED  \] [0-9]+ test\(s\)/ { sub(/.*FAILED  \] /, ""); failed += $1; next }
        /\[  SKIPPED \] [0-9]+ test\(s\)/ { sub(/.*SKIPPED \] /, ""); skipped += $1; next }
        /^ok .*# [Ss][Kk][Ii][Pp]/ { ++skipped; next }
        /^ok / { ++passed }
        /^not ok / { ++failed }
        END { print passed + 0, failed + 0, skipped + 0 }' "$1"
}

limited() {
    local tool
    for tool in timeout gtimeout; do
        if command -v "$tool" >/dev/null; then
            "$tool" -k 10 "${LIMIT:-600}" "$@"
            return
        fi
    done
    "$@"
}

run_one() {
    local folder=$1 test=$2 name log status passed failed skipped seconds word=ok
    name=$(printf '%s' "${test##*tests/}" | tr / _)
    log=$folder/$name.log
    mkdir -p "$folder/$name.tmp"
    seconds=$SECONDS
    case $test in
    *.sh) set -- bash "$test" ;;
    *) set -- "$test" ;;
    esac
    TMPDIR=$(cd "$folder/$name.tmp" && pwd) limited "$@" >"$log" 2>&1 </dev/null
    status=$?
    seconds=$((SECONDS - seconds))
    rm -rf "$folder/$name.tmp"
    read -r passed failed skipped < <(count "$log")
    if [ $status -eq 124 ]; then
        echo "stopped: over the limit of ${LIMIT:-600} s" >>"$log"
    fi
    if [ "$failed" -eq 0 ] && { [ $status -ne 0 ] || [ $((passed + skipped)) -eq 0 ]; }; then
        echo "ended with status $status after $passed passed tests" >>"$log"
        failed=1
    fi
    [ "$failed" -gt 0 ] && word=FAILED
    echo "$passed $failed $skipped" >"$folder/$name.count"
    printf '%-6s %-44s %4d passed, %d failed%s %4d s\n' "$word" "${test##*tests/}" "$passed" "$failed" \
        "$([ "$skipped" -gt 0 ] && echo ", $skipped skipped")" "$seconds"
}

if [ "${1-}" = --one ]; then
    run_one "$2" "$3"
    exit 0
fi

folder=$1
shift
rm -rf "$folder"
mkdir -p "$folder"
if [ $# -gt 0 ]; then
    printf '%s\n' "$@" | xargs -n 1 -P "${JOBS:-2}" bash "$0" --one "$folder"
fi

passed=0 failed=0 skipped=0
for file in "$folder"/*.count; do
    [ -e "$file" ] || break
    read -r p f s <"$file"
    passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
    if [ "$f" -gt 0 ]; then
        printf '\n--- %s\n' "${file%.count}.log"
        cat "${file%.count}.log"
    fi
done
rm -f "$folder"/*.count
tail=''
[ $skipped -gt 0 ] && tail=", $skipped skipped"
printf '\n%d passed, %d failed%s\n' $passed $failed "$tail"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
