#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle compare: a run beside another one, beside columns of text and beside measurements.
. tests/support/cli.sh

deck() {
    cat <<DECK
title "two"
units kN m s
building A -floors 2 -mass 100t -stiffness $1
building B -floors 1 -mass 80t -stiffness 30MN/m
contact A:1 B:1 -gap 10mm -law linear -k 200MN/m -name c
ground sine -amplitude 2 -frequency 2 -cycles 4
step fixed 1ms
duration 4s
DECK
}
deck 50MN/m >one.deck
deck 50.5MN/m >two.deck
for name in one two; do
    "$jostle" run $name.deck -q >"$out" 2>"$err" || exit 1
done

run "$jostle" compare one.h5 one.h5 --tolerance 0
expect "a run does not differ from itself" '[ $status -eq 0 ] && grep -q "^0 of 3 differ" "$out" && grep -qE "^displacement:B:1 .* 1$" "$out"'
run "$jostle" compare one.h5 two.h5 --tolerance 1e-3
expect "another stiffness is a difference, and the exit status 1" '[ $status -eq 1 ] && grep -q "^3 of 3 differ by more than 0.001" "$out"'
run "$jostle" compare one.h5 two.h5
expect "without a tolerance a difference is no failure" '[ $status -eq 0 ]'
run "$jostle" compare one.h5 two.h5 --quantity force:c --tsv
expect "forces of a contact are compared" '[ $status -eq 0 ] && [ "$(grep -c "^force:c" "$out")" -eq 1 ] && grep -q "peak \[kN\]" "$out"'
run "$jostle" compare one.h5 two.h5 --quantity storey-shear:A
expect "all storeys of a building are compared" '[ "$(grep -c "^storey_shear:A:" "$out")" -eq 2 ]'

# Columns of text: those of the run itself, with one value changed. 17 digits are exact.
python3 - <<'PY' 2>"$err" || { skip "columns" "python3 has no h5py"; exit; }
import h5py
with h5py.File("one.h5") as f:
    time = f["time"][:]
    roof = f["buildings/A/displacement"][:]
    other = f["buildings/B/displacement"][:]
rows = [[t, *a, *b] for t, a, b in zip(time, roof.reshape(len(time), -1), other.reshape(len(time), -1))]
with open("same.txt", "w") as to:
    to.writelines(" ".join(f"{x:.17g}" for x in row) + "\n" for row in rows)
peak = max(abs(row[3]) for row in rows)
rows[200][3] += peak / 2
with open("changed.txt", "w") as to:
    to.writelines(" ".join(f"{x:.17g}" for x in row) + "\n" for row in rows)
with open("late.txt", "w") as to:
    to.write("time [ms], displacement [mm]\n")
    to.writelines(f"{row[0] * 1e3 - 30:.9g}, {row[2] * 1e3:.12g}\n" for row in rows)
PY
run "$jostle" compare one.h5 same.txt --tolerance 1e-14
expect "columns are the floors in the order of the run" '[ $status -eq 0 ] && grep -q "^0 of 3 differ" "$out"'
run "$jostle" compare one.h5 changed.txt --tolerance 0.1 --tsv
expect "the difference has its place, size and time" '[ $status -eq 1 ] && awk -F "\t" "/^displacement:B:1/ { exit !(\$6 > 0.33 && \$6 < 0.51 && \$7 > 1.99 && \$7 < 2.01 && \$8 == \$7) }" "$out" && awk -F "\t" "/^displacement:A:2/ { exit !(\$6 == 0) }" "$out"'
awk '{ print $1, $2 }' same.txt >few.txt
run "$jostle" compare one.h5 few.txt
expect "missing columns are an error with the line" '[ $status -eq 2 ] && grep -q "few.txt:1: 2 columns; 4 are read: the time and 3" "$err"'
printf '0 1 2 3\n1 2 x 4\n' >bad.txt
run "$jostle" compare one.h5 bad.txt
expect "a word is no number" '[ $status -eq 2 ] && grep -q "^jostle: error: bad.txt:2" "$err"'
printf '0 1 2 3\n0 2 3 4\n' >still.txt
run "$jostle" compare one.h5 still.txt
expect "times must increase" '[ $status -eq 2 ] && grep -q "still.txt:2: times must increase" "$err"'

# A measurement in other units, which begins 30 ms earlier: the run is late.
run "$jostle" compare two.h5 one.h5 --measured late.txt --quantity displacement:A:2 --tsv
expect "runs are ranked by their errors" '[ $status -eq 0 ] && [ "$(sed -n 2p "$out" | cut -f 1)" != "$(sed -n 3p "$out" | cut -f 1)" ] && awk -F "\t" "NR > 2 && \$9 < e { exit 1 } { e = \$9 }" "$out"'
expect "the shift is that of the measurement" 'awk -F "\t" "/^one.h5/ { exit !(\$10 > 0.0298 && \$10 < 0.0302) }" "$out"'
run "$jostle" compare one.h5 --measured late.txt --quantity displacement
expect "a measurement is one history" '[ $status -eq 2 ] && grep -q "names 3 histories" "$err"'
run "$jostle" compare one.h5 --measured late.txt
expect "the quantity must be named" '[ $status -eq 2 ] && grep -q -- "--quantity" "$err"'
run "$jostle" compare one.h5
expect "two files are compared" '[ $status -eq 2 ]'
run "$jostle" compare one.h5 two.h5 --quantity drifts
expect "an unknown quantity has a near one" '[ $status -eq 2 ] && grep -q "did you mean .drift.?" "$err"'
run "$jostle" compare one.h5 two.h5 --quantity drift:A:9
expect "a floor that is not there is an error" '[ $status -eq 2 ] && grep -q "has no drift:A:9" "$err"'
deck 50MN/m | sed 's/-floors 2/-floors 3/' >three.deck
"$jostle" run three.deck -q >"$out" 2>"$err"
run "$jostle" compare one.h5 three.h5
expect "other buildings cannot be compared" '[ $status -eq 2 ] && grep -q "cannot be compared" "$err"'

if type gnuplot >/dev/null 2>&1; then
    run "$jostle" compare one.h5 two.h5 -o two.svg --script .
    expect "a picture has both histories" '[ $status -eq 0 ] && grep -q "displacement:A:2" two.svg && grep -q "computed0 using" compare.gp'
    run "$jostle" compare one.h5 two.h5 --measured late.txt --quantity displacement:A:2 -o measured.svg
    expect "a picture has all runs and the measurement" '[ $status -eq 0 ] && grep -q "measured" measured.svg && grep -q "two.h5" measured.svg'
    run "$jostle" compare one.h5 two.h5 -o two.svg
    expect "an existing picture is kept" '[ $status -eq 2 ] && grep -q "exists" "$err"'
else
    skip "pictures" "gnuplot is not installed"
fi
