#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A run that is stopped by a signal says so, writes nothing and leaves nothing.
. tests/support/cli.sh

# appears FILE: waits until it is there and has content, up to 5 s.
appears() {
    for _ in $(seq 100); do
        [ -s "$1" ] && break
        sleep 0.05
    done
}

two_buildings long.deck 'duration 1000000s'
for signal in INT TERM HUP USR1; do
    # A shell makes its background jobs ignore SIGINT.
    env --default-signal=INT "$jostle" run long.deck >"$out" 2>"$err" </dev/null &
    child=$!
    appears long.h5.part
    expect "a run keeps its rows in a .part file ($signal)" '[ -e long.h5.part ] && [ ! -e long.h5 ]'
    "$jostle" show long.h5.part >/dev/null 2>"$out.reader"
    expect "who reads that file meanwhile is told why it cannot be read ($signal)" 'grep -q "cannot read long.h5.part: another run is writing it" "$out.reader"'
    sleep 0.2
    kill -s $signal $child
    wait $child
    status=$?
    expect "SIG$signal ends the run with 3" '[ $status -eq 3 ]'
    expect "SIG$signal is told, with the time reached" 'grep -qE "interrupted by signal [0-9]+ at t = [0-9.e+]+; nothing was written" "$err" && [ ! -s "$out" ]'
    expect "SIG$signal leaves no file" 'only long.deck'
done

# Signals that were ignored before the program stay ignored, so as not to end background jobs.
for signal in INT TERM HUP XCPU USR1; do
    (trap '' $signal; exec "$jostle" run long.deck) >"$out" 2>"$err" </dev/null &
    child=$!
    appears long.h5.part
    kill -s $signal $child
    sleep 0.3
    expect "SIG$signal that is ignored stays ignored" 'kill -0 $child && [ -e long.h5.part ] && ! said interrupted'
    kill -s KILL $child
    wait $child 2>/dev/null
    rm -f long.h5.part
done

# What is opened where a standard stream is closed would get what is printed there.
sed 's/^param gap.*/sweep gap values 4mm 5mm/' long.deck >study.deck
"$jostle" run study.deck >&- 2>&- <&- &
child=$!
appears study.h5.runs
sleep 0.2
kill -s ABRT $child
wait $child
expect "closed streams do not turn messages into the journal" '[ "$(head -c 8 study.h5.runs | tr "\n" .)" = jostle7. ]'
rm -f study.h5.runs

# As a damaged HDF5 file may end it; under the sanitizers the signal is theirs.
if [ -z "${JOSTLE_SANITIZED-}" ]; then
    "$jostle" run long.deck >"$out" 2>"$err" </dev/null &
    child=$!
    appears long.h5.part
    kill -s SEGV $child
    wait $child
    status=$?
    expect "a crash is an error with a message, and leaves no result" '[ $status -eq 3 ] && said "ended by a segmentation fault" && [ ! -e long.h5 ]'
    rm -f long.h5.part
fi

nohup "$jostle" run study.deck >"$out" 2>"$err" </dev/null &
child=$!
for _ in $(seq 100); do
    [ -s study.h5.runs ] && break
    sleep 0.05
done
kill -s HUP $child
sleep 0.2
expect "under nohup a study does not end with its terminal" 'kill -0 $child'
kill -s TERM $child
wait $child
rm -f study.h5.runs study.deck

# timeout(1) signals twice at once.
run timeout 1 "$jostle" run -q long.deck
expect "a run that timeout ends tells of it, and leaves no file" '[ $status -eq 124 ] && said "interrupted by signal 15" && only long.deck'

run limited -St 1 "$jostle" run -q long.deck
expect "a run whose time is up tells of it, and leaves no file" '[ $status -eq 3 ] && said "interrupted by signal" && only long.deck'

# Bodies that touch and rattle: a step takes many impacts.
cat >rattle.deck <<END
building B0 -floors 5 -mass 187214 -stiffness 1.2348e+08 -height 3
damping B0 rayleigh 0.07486
storey B0:all bouc-wen -yield 3.16113e+06 -hardening 0.1
building B1 -floors 8 -mass 59422.1 -stiffness 3.36876e+07 -height 3
building B2 -floors 10 -mass 11562.9 16679.3 18328.4 10929.3 10655.8 10311.3 10378.5 13245.5 13176 13389.9 -stiffness 1.08202e+07 -height 3
damping B2 rayleigh 0.06998
building B3 -floors 6 -mass 609533 -stiffness 4.30095e+08 -height 3
building B4 -floors 6 -mass 111480 130068 155399 130518 190438 139337 -stiffness 3.51474e+07 -height 3
damping B4 modal 0.04569
storey B4:all bouc-wen -yield 644007 -hardening 0.02
contact B0 B1 -gap 0.0067111 -law stereomechanical -e 0.14
contact B1 B2 -gap 0 -law stereomechanical -e 0.575
contact B2 B3 -gap 0.0021123 -law stereomechanical -e 0.243
contact B3 B4 -gap 0 -law stereomechanical -e 0.593
contact B4 wall -gap 0 -law stereomechanical -e 0.681
ground record $root/input/records/ELCENTRO_1940_NS.AT2 -pga 0.498g
step fixed 0.00453779
duration 25
END
run timeout -k 4 1 "$jostle" run -q rattle.deck
expect "so does one between two of many impacts" '[ $status -eq 124 ] && said "interrupted by signal 15" && only long.deck rattle.deck'
rm rattle.deck

echo 'kept' >long.h5
"$jostle" run long.deck --force >"$out" 2>"$err" </dev/null &
child=$!
sleep 0.5
kill -s TERM $child
wait $child
status=$?
expect "an existing file outlives an interrupted --force" '[ $status -eq 3 ] && [ "$(cat long.h5)" = kept ] && only long.deck long.h5'
