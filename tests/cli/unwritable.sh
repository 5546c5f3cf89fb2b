#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Where nothing can be written: a message that names file and cause, exit status 3, nothing left behind.
. tests/support/cli.sh

two_buildings pair.deck
for words in "check pair.deck" "modes pair.deck" "--help" "run pair.deck -o full.h5"; do
    # shellcheck disable=SC2086
    "$jostle" $words >/dev/full 2>"$err" </dev/null
    status=$?
    : >"$out"
    expect "$words > /dev/full ends with 3" '[ $status -eq 3 ] && said "cannot write to the standard output: No space left on device"'
done
run "$jostle" run pair.deck -o ''
expect "a result file without a name is refused" '[ $status -eq 2 ] && said "is empty"'
sed 's/^param gap .*/sweep gap values 5mm 6mm/' pair.deck >study.deck
run "$jostle" run study.deck --shard 1/1 -o part.h5 -q
for words in "run pair.deck -o -" "run study.deck -o -" "tasks study.deck -o -" "merge part.h5 -o -" "law hertz -k 1 -m1 1 -v 1 --history -"; do
    # shellcheck disable=SC2086
    run "$jostle" $words
    expect "${words%% *} writes no file to the standard output" '[ $status -eq 2 ] && [ ! -s "$out" ] && said "jostle cannot write a file to standard output; ./- is a file called -" && [ ! -e ./- ]'
done
run "$jostle" plot full.h5 --script -
expect "nor does plot its script" '[ $status -eq 2 ] && said "./- is one called -" && [ ! -e ./- ]'
run "$jostle" run -
expect "and a deck is not read from the standard input" '[ $status -eq 2 ] && said "the standard input is not read"'
run "$jostle" run pair.deck -o ./- -q
expect "a file can have this name all the same" '[ $status -eq 0 ] && [ -s ./- ]'
rm ./- study.deck part.h5
expect "the result file is complete all the same" '"$jostle" show full.h5 >/dev/null'

"$jostle" check pair.deck 2>"$err" | true
expect "a reader that goes away does no harm" '! grep -qi "signal" "$err"'

mkfifo pipe
for command in "show pipe" "plot pipe" "merge pipe full.h5 -o whole.h5"; do
    # shellcheck disable=SC2086
    run timeout 10 "$jostle" $command
    expect "${command%% *} does not wait for a pipe" '[ $status -eq 2 ] && said "pipe is no"'
done
# Shared libraries are files, too: without one to spare, such a program does not even start.
(ulimit -n 3 && "$jostle" --version) >"$out" 2>&1 && starts=1
for command in "run pair.deck -o few.h5" "show full.h5" "merge full.h5 -o whole.h5"; do
    [ -n "${starts-}" ] || break
    # shellcheck disable=SC2086
    run limited -n 3 "$jostle" $command
    expect "${command%% *} without a file to spare ends with 3" '[ $status -eq 3 ] && said "Too many open files" && [ ! -e few.h5 ] && [ ! -e whole.h5 ]'
done
rm pipe

for command in "run pair.deck -o full.h5/x.h5" "plot full.h5 -o full.h5/x.png" "plot full.h5 --script full.h5"; do
    # shellcheck disable=SC2086
    run "$jostle" $command
    expect "${command%% *} into a file in place of a folder ends with 3 and the cause" '[ $status -eq 3 ] && said "cannot write full.h5/" && said ": Not a directory" && ! said "in the way"'
done
ln -s nowhere linked.h5.part
run "$jostle" run -q pair.deck -o linked.h5
expect "a link in the place of a file that is being made is not another run, and stays" '[ $status -eq 3 ] && said "cannot write linked.h5: linked.h5.part is a symbolic link" && [ -L linked.h5.part ] && [ ! -e linked.h5 ]'
mkdir held.h5.part
run "$jostle" run -q pair.deck -o held.h5
expect "a folder there is in the way" '[ $status -eq 3 ] && said "cannot write held.h5: held.h5.part is a directory" && [ -d held.h5.part ]'
rmdir held.h5.part
rm linked.h5.part

mkdir locked
chmod a-w locked
if touch locked/probe 2>/dev/null; then
    rm locked/probe
    run "$jostle" run pair.deck -o /proc/result.h5
    expect "a folder that takes no file ends with 3" '[ $status -eq 3 ] && said "/proc/result.h5" && [ ! -s "$out" ]'
else
    run "$jostle" run pair.deck -o locked/result.h5
    expect "a folder that takes no file ends with 3" '[ $status -eq 3 ] && said "locked/result.h5" && said "Permission denied" && [ ! -s "$out" ]'
fi

mkdir small
if mount -t tmpfs -o size=64k tmpfs small 2>/dev/null; then
    for times in 1 200; do
        two_buildings long.deck "duration $((4 * times))s"
        run "$jostle" run long.deck -o small/result.h5
        expect "a full disk ends a run of $((4 * times)) s with 3" '[ $status -eq 3 ] && said "small/result.h5" && said "No space left on device" && [ ! -s "$out" ]'
        expect "and leaves nothing on the disk ($times)" '[ -z "$(ls -A small)" ]'
    done
    umount small
    if command -v gnuplot >/dev/null; then
        # Room for the script and its data, and for some of the picture: gnuplot does not say so.
        for picture in cut.png cut.svg cut.pdf; do
            mount -t tmpfs -o size=80k tmpfs small
            run env TMPDIR="$PWD/small" "$jostle" plot full.h5 overview -o $picture
            umount small
            expect "a picture that is cut off on a full disk does not get its name ($picture)" '[ $status -eq 3 ] && said "could not write the whole" && [ ! -e $picture ] && [ ! -e $picture.part ]'
        done
    fi
else
    skip "a full disk ends a run with 3" "no disk can be mounted here"
fi

run limited -f 16 "$jostle" run pair.deck -o limited.h5
expect "a limit to the size of files ends with 3" '[ $status -eq 3 ] && said "limited.h5" && [ ! -e limited.h5 ] && [ ! -e limited.h5.part ]'

if [ -n "${JOSTLE_SANITIZED-}" ]; then
    skip "too little memory ends with 3 and a message" "the sanitizers need terabytes of addresses"
    exit
fi
run limited -v 60000 "$jostle" run pair.deck -o little.h5
case $status in
0) expect "little memory is enough for a small deck" '[ -s little.h5 ]' ;;
*) expect "too little memory ends with 3 and a message" '{ [ $status -eq 3 ] && said "out of memory"; } || [ $status -eq 127 ]' ;;
esac

# Several at once: one writes, whoever comes upon its file or its name ends, and nothing is lost.
two_buildings once.deck 'duration 2'
lost=0
for _ in $(seq 12); do
    for i in 1 2 3; do
        ("$jostle" run -q once.deck >"$out.$i" 2>&1 </dev/null; echo $? >>"$out.$i") &
    done
    wait
    [ "$(cat "$out".[123] | grep -c '^0$')" -eq 1 ] || lost=$((lost + 1))
    [ "$(cat "$out".[123] | grep -cE 'another run is writing once.h5.part|once.h5 exists')" -eq 2 ] || lost=$((lost + 1))
    "$jostle" show once.h5 >"$out" 2>"$err" || lost=$((lost + 1))
    [ ! -e once.h5.part ] || lost=$((lost + 1))
    rm once.h5
done
expect "of runs that write one file at once one does, and the others say so" '[ $lost -eq 0 ]'
