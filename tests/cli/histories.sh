#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Histories of the runs of a study: they are kept in the journal as runs finish, on any number of
# threads, and no run is made twice.
. tests/support/cli.sh

study_of_records study.deck 8 300
echo 'output -histories' >>study.deck
run "$jostle" run study.deck -q -j 1 -o whole.h5
expect "a study is written with the histories of its runs" '[ $status -eq 0 ] && only study.deck whole.h5 records/1.txt records/2.txt records/3.txt'
if ! command -v h5diff >/dev/null; then
    skip "they are the same whatever happens to the study" "no h5diff"
    exit 0
fi
run "$jostle" run study.deck -q -j 3 -o other.h5
expect "they are the same on three threads" '[ $status -eq 0 ] && [ "$(h5ls whole.h5/runs | wc -l)" -eq 24 ] && same whole.h5 other.h5'

# Where the kill comes too late the study has ended: once more.
for _ in $(seq 10); do
    rm -f part.h5*
    "$jostle" run study.deck -q -o part.h5 </dev/null 2>"$err" &
    child=$!
    until [ -e part.h5.part ] || ! kill -0 $child 2>/dev/null; do
        :
    done
    kill -s KILL $child 2>/dev/null
    wait $child 2>/dev/null
    status=$?
    [ -e part.h5 ] || break
done
expect "the study is killed while its file is written" '[ $status -eq 137 ] && [ ! -e part.h5 ]'
cp part.h5.runs kept.runs
run "$jostle" run study.deck -q -o part.h5
expect "and its file is written from the journal" '[ $status -eq 0 ] && h5dump -a runs_kept part.h5 | grep -q "(0): 24$" && same whole.h5 part.h5 && [ ! -e part.h5.part ] && [ ! -e part.h5.runs ]'
rm part.h5

# As a kill amid the runs leaves it.
head -c 1000000 kept.runs >part.h5.runs
run "$jostle" run study.deck -o part.h5
expect "a study that was killed amid its runs goes on" '[ $status -eq 0 ] && grep -qE "[0-9]+ runs computed, [0-9]+ taken" "$out" && ! said damaged && same whole.h5 part.h5'
rm part.h5
cp kept.runs part.h5.runs
printf '\377' | dd of=part.h5.runs bs=1 seek=700000 conv=notrunc 2>/dev/null
run "$jostle" run study.deck -o part.h5
expect "a run whose histories are damaged is made again" '[ $status -eq 0 ] && said "part.h5.runs is damaged in 1 place; of 24 runs 23 were found" && same whole.h5 part.h5'
rm part.h5

rm ./*.h5*

# Chosen runs: their histories are added to the finished study.
sed -i '/^output/d' study.deck
run "$jostle" run study.deck -q -j 2 --histories 7,worst:1:floors
expect "a choice is read before the runs are made" '[ $status -eq 2 ] && said "unknown EDP '"'floors'"'" && [ ! -e study.h5 ]'
"$jostle" run study.deck -q
"$jostle" show study.h5 --tsv >values
run "$jostle" run study.deck -j 2 --histories worst:2:drift,7,11-12
expect "chosen runs of a finished study get histories" '[ $status -eq 0 ] && grep -qE "; [345] runs computed, (19|2[01]) taken$" "$out" && grep -qE "^histories   of runs .*7, 11, 12" "$out" && [ ! -e study.h5.runs ]'
run "$jostle" show study.h5 --tsv
expect "the values of the study stay" 'cmp "$out" values && "$jostle" verify study.h5 >/dev/null'
if python3 -c 'import h5py' 2>/dev/null; then
    run python3 - <<'END'
import h5py, numpy
with h5py.File("study.h5") as f:
    drift = [f["buildings/%s/envelope/drift" % b][...].max(-1).ravel() for b in "AB"]
    worst = numpy.maximum(*drift).argsort()[-2:] + 1
    assert set(map(int, f["runs"])) == set(worst) | {7, 11, 12}, (set(f["runs"]), worst)
END
    expect "they are the worst two and the three that are named" '[ $status -eq 0 ]'
else
    skip "they are the worst two and the three that are named" "no h5py"
fi
for number in 7 12; do
    define=$(awk -v n=$number 'NR == 1 { a = $2; b = $3 }
        $1 == n { print "-D " a "=" $2, "-D " b "=" $3; exit }' values)
    # shellcheck disable=SC2086
    "$jostle" run study.deck -q --force $define -o one.h5
    run="runs/$(printf %06d $number)"
    for name in buildings/A/displacement buildings/B/acceleration contacts/force impacts/t_end time; do
        h5diff study.h5 one.h5 "$run/$name" "$name" >>differences 2>&1 || echo "$name differs" >>differences
    done
done
expect "their histories are those of -D, bit for bit" '[ ! -s differences ] || ! cat differences'
run "$jostle" run study.deck -q --histories collapsed
expect "where no run is chosen, the file stays" '[ $status -eq 0 ] && [ "$(h5ls study.h5/runs | wc -l)" -ge 3 ]'
run "$jostle" run study.deck --histories 25
expect "a run must be there" '[ $status -eq 2 ] && said "study.deck has no run 25; its study has the runs 1 to 24"'
cp records/1.txt records/4.txt
run "$jostle" run study.deck -q
expect "a study that grows says that it drops the histories" '[ $status -eq 0 ] && said "the histories of single runs in study.h5 are gone" && ! h5ls study.h5/runs >/dev/null'
rm records/4.txt
echo 'output -histories' >>study.deck
run "$jostle" run study.deck -q --histories 7 --force
expect "with output -histories there is nothing to choose" '[ $status -eq 2 ] && said "--histories is for decks without"'

# A run that reaches the limit of steps has histories up to then.
cat >limit.deck <<'END'
sweep end values 1 20
building A -floors 2 -mass 1 -stiffness 400
contact A wall -gap 0.01 -law linear -k 1000
ground sine -amplitude 1 -frequency 1
step fixed 1ms
duration $end
output -interval 0.1
END
run "$jostle" run limit.deck -q --steps 10000 --histories failed
expect "a run that fails is chosen" '[ $status -eq 1 ] && [ "$(h5ls limit.h5/runs)" = "000002                   Group" ]'
"$jostle" run limit.deck -D end=20 -q -o one.h5 --force
if python3 -c 'import h5py' 2>/dev/null; then
    run python3 - <<'END'
import h5py, numpy
with h5py.File("limit.h5") as limit, h5py.File("one.h5") as whole:
    got = limit["runs/000002/buildings/A/displacement"][...]
    want = whole["buildings/A/displacement"][...][:len(got)]
assert 80 <= len(got) < 200
# The last step ends at the end of the shorter run, to rounding.
assert (got[:-1] == want[:-1]).all() and numpy.allclose(got, want, rtol=1e-9, atol=0)
END
    expect "its rows are those of the run without a limit" '[ $status -eq 0 ]'
else
    skip "its rows are those of the run without a limit" "no h5py"
fi
run "$jostle" show limit.h5#2
expect "its contacts are summed over its impacts" '[ $status -eq 0 ] && grep -q "^2 contacts, [12] hit, " "$out" && ! grep -q nan "$out"'
rm ./*.h5*

# A run takes some room besides its rows: 301 of two histories of five floors, of the time, the
# ground, seven energies and two contacts. HDF5 allots 2048 bytes at once, of which a file may have
# just begun some, and another file not.
sed 's/^output/& -fields displacement force/' study.deck >size.deck
"$jostle" run size.deck -q
sed '/^output/d' study.deck >none.deck
"$jostle" run none.deck -q
size=$((($(stat -c %s size.h5) - $(stat -c %s none.h5) - 2048) / 24 - 301 * 8 * 16))
expect "a run takes $size bytes besides its rows, 26000 at most" '[ $size -le 26000 ]'
if python3 -c 'import xarray, netCDF4' 2>/dev/null; then
    run python3 - <<'END'
import xarray
run = xarray.open_dataset("size.h5", group="runs/000007/buildings/B")
assert run.displacement.dims == ("time", "floor") and run.displacement.shape == (301, 3)
assert run.displacement.attrs["units"] == "m" and float(run.time[-1]) == 3.0
force = xarray.open_dataset("size.h5", group="runs/000007/contacts").force
peak = xarray.open_dataset("size.h5", group="contacts/envelope").force
assert force.dims == ("time", "contact")
assert (force.max("time").values <= peak.isel(record=0, gap=6).values).all()
END
    expect "the histories of a run open in xarray with their axes" '[ $status -eq 0 ]'
else
    skip "the histories of a run open in xarray with their axes" "no xarray"
fi
rm ./*.h5

# The decks are of one length, as their text is in the file.
for fields in 'displacement' 'displacement velocity acceleration'; do
    for interval in 50ms 10ms; do
        for level in 0 1 9; do
            option="# out: -compress 9"
            [ $level -eq 0 ] || option="-compress $level  # out"
            sed "s/^output.*/output -histories -fields $fields -interval $interval $option/" study.deck >size.deck
            "$jostle" run size.deck -q -o size$level.h5
        done
        expect "-compress makes no file of $fields every $interval larger" '[ $(stat -c %s size1.h5) -le $(stat -c %s size0.h5) ] && [ $(stat -c %s size9.h5) -le $(stat -c %s size0.h5) ]'
        rm size?.h5
    done
done

# CPU seconds of a study of long runs with few rows. Under a load no runs go in lockstep, neither with
# histories nor without.
cat >long.deck <<'END'
sweep amplitude range 1 2 20
building A -floors 8 -mass 1 -stiffness 400
contact A wall -gap 0.1 -law linear -k 1000
load A:all sine -amplitude $amplitude -frequency 1
step fixed 1ms
duration 300
END
cpu() {
    local TIMEFORMAT='%U'
    { time "$jostle" run long.deck -q --force >/dev/null 2>&1; } 2>&1
}
echo 'output -interval 1' >>long.deck
without=$(cpu)
sed -i 's/^output/output -histories/' long.deck
with=$(cpu)
if [ -n "${JOSTLE_SANITIZED-}" ]; then
    skip "no run is made twice for its histories" "the sanitizers change what takes time"
else
    # Twice is twice the time, or more; a half more is for what else the machine does.
    expect "no run is made twice for its histories: $with s of CPU time with them, $without s without" 'awk "BEGIN { exit !($with < 1.5 * $without) }"'
fi

# The library keeps decoded what it knows of each compressed history, unless it is told not to.
cat >few.deck <<'END'
units kN m s
sweep a range 0.1 1 40
sweep b values 10mm
building A -floors 3 -mass 100t -stiffness 50MN/m
building B -floors 3 -mass 80t -stiffness 20MN/m
contact A B -gap $b -law linear -k 1e6
ground sine -amplitude $a -frequency 1 -cycles 2
step fixed 2ms
duration 14
output -histories -interval 50ms -compress 1
END
sed 's/^sweep b.*/sweep b range 10mm 20mm 8/' few.deck >many.deck
if [ -n "${JOSTLE_SANITIZED-}" ] || ! command -v python3 >/dev/null; then
    skip "320 compressed runs need no more memory than 40" "the sanitizers keep what is freed, or no python3"
else
    read -r few _ < <(python3 "$root/tests/support/peak.py" "$jostle" run few.deck -q)
    read -r many _ < <(python3 "$root/tests/support/peak.py" "$jostle" run many.deck -q)
    expect "320 compressed runs need $many KiB, 40 need $few: 8 MiB more at most" '[ "$many" -lt $((few + 8 * 1024)) ]'
fi
