#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The program of docs/library.md, with the library as it is installed.
. tests/support/cli.sh
. "$root/tests/support/make.sh"
if ! is_ordinary; then
    skip "the program of the page on the library" "not an ordinary build"
    exit
fi
compiler=${flags%% -*}
make_here -o "$jostle" install prefix="$here/usr"
expect "the library is installed" '[ $status -eq 0 ] && [ -s usr/lib/libjostle.a ] && [ ! -s "$err" ]'
awk '/^<!-- file / { file = $3 } /^```/ { inside = !inside && file; if (!inside) file = ""; next }
     inside { print > file }' "$root/docs/library.md"
ln -s "$root/input/records" records
read -r -a link < <(PKG_CONFIG_PATH=usr/lib/pkgconfig pkg-config --cflags --libs jostle)
run $compiler -Wall -Wextra -Werror best_damper.c "${link[@]}" -o best_damper
expect "a program is built with what pkg-config says" '[ $status -eq 0 ] && [ ! -s "$err" ]'
if command -v c++ >/dev/null; then
    for header in usr/include/jostle/*.h; do
        echo "#include \"jostle/${header##*/}\""
    done >every.cc
    echo 'int main() { return contact_law_find("hertz") && n_storey_law > 0 ? 0 : 1; }' >>every.cc
    run c++ -std=c++17 -Wall -Wextra -Wpedantic -Werror every.cc "${link[@]}" -o every
    expect "a C++ program includes every header and links" '[ $status -eq 0 ] && ./every'
else
    skip "a C++ program includes every header and links" "no C++ compiler"
fi
expect "every symbol of the library has the prefix jostle_" \
    '! nm -P -g --defined-only usr/lib/libjostle.a 2>/dev/null | awk "NF > 1 { print \$1 }" | grep -v "^jostle_"'
run ./best_damper best_damper.deck 0 20000
expect "it finds a damper" '[ $status -eq 0 ] && grep -q "^c = [1-9][0-9.]*, largest drift 0.01" "$out"'
read -r _ _ c _ _ drift <"$out"
drift_at() {
    "$jostle" run best_damper.deck -D c="$1" -q --force && "$jostle" show best_damper.h5 --tsv |
        awk -F '\t' '$1 ~ /^buildings/ && $3 == "drift" && $5 > most { most = $5 } END { printf "%.9g", most }'
}
expect "jostle has the same drift with it" '[ "$(drift_at "${c%,}")" = "$drift" ]'
expect "and larger ones with half and twice of it" \
    'awk -v best="$drift" -v half="$(drift_at "\${${c%,} / 2}")" -v twice="$(drift_at "\${2 * ${c%,}}")" "BEGIN { exit !(half > best && twice > best) }"'
run ./best_damper best_damper.deck 0 x
expect "an interval without a minimum is told" '[ $status -eq 1 ] && said "no value in the middle"'
sed -i 's/-gap 20mm/-gap/' best_damper.deck
run ./best_damper best_damper.deck 0 20000
expect "errors of a deck are told with their place" '[ $status -ne 0 ] && said "best_damper.deck:8:13: error"'
