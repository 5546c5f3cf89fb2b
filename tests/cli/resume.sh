#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Nothing is lost: a study that was killed, interrupted or ran into a full disk goes on where it
# was, and ends in the same file; one that has changed meanwhile is refused. JOSTLE_LONG=1 kills it
# 50 times.
. tests/support/cli.sh

if ! command -v h5diff >/dev/null; then
    skip "a killed study goes on" "no h5diff"
    exit 0
fi

study_of_records study.deck 60 2000
run "$jostle" run study.deck -q -o whole.h5
expect "a study of 180 runs ends" '[ $status -eq 0 ] && [ ! -s "$err" ]'

kills=5
[ -z "${JOSTLE_LONG-}" ] || kills=50
starts=0
killed=0
kept=0
tenths=0
# A thread enters its runs some at a time, and on a busy machine it takes a while until there are any:
# the next kill comes later where one was too early, and at once where the study had ended.
while { [ $killed -lt $kills ] || [ $kept -eq 0 ]; } && [ $starts -lt 500 ]; do
    "$jostle" run study.deck -q -o killed.h5 >"$out" 2>"$err" </dev/null &
    child=$!
    sleep $((tenths / 10)).$((tenths % 10))$((RANDOM % 10))$((RANDOM % 10))
    kill -s KILL $child 2>/dev/null
    wait $child 2>/dev/null
    status=$?
    starts=$((starts + 1))
    [ $status -ne 137 ] || killed=$((killed + 1))
    # A kill may come when all is done but the end of the process.
    if [ $status -eq 0 ] || [ -e killed.h5 ]; then
        same whole.h5 killed.h5 || break
        rm killed.h5
    fi
    size=$(stat -c %s killed.h5.runs 2>/dev/null || echo 0)
    if [ "$size" -gt 1500 ]; then
        kept=$((kept + 1))
    else
        tenths=$((status == 137 ? tenths + 1 : 0))
    fi
done
expect "it is killed $kills times, some of them amid its runs" '[ $killed -ge $kills ] && [ $kept -gt 0 ]'
run "$jostle" run study.deck -o killed.h5
expect "the same command ends it" '[ $status -eq 0 ] && [ ! -e killed.h5.runs ]'
expect "and its file is that of an uninterrupted one" 'same whole.h5 killed.h5'

# start_and_stop SIGNAL [FILE]: a study that is interrupted when some of its runs are done, and FILE
# removed before.
start_and_stop() {
    rm -f part.h5*
    "$jostle" run study.deck -j 1 -o part.h5 >"$out" 2>"$err" </dev/null &
    child=$!
    for _ in $(seq 200); do
        [ "$(stat -c %s part.h5.runs 2>/dev/null || echo 0)" -le 8000 ] || break
        sleep 0.005
    done
    rm -f "${@:2}"
    kill -s "$1" $child
    wait $child
    status=$?
}
# The runs in a journal: the entries of that kind.
entries() {
    grep -aoF 'run ' "$1" | wc -l
}

start_and_stop TERM part.h5.runs
expect "a journal that was removed is not said to keep runs" '[ $status -eq 3 ] && grep -qE "part.h5.runs is gone, and with it [0-9]+ of 180 runs" "$err" && ! said "are kept" && [ ! -e part.h5.runs ]'
start_and_stop TERM
expect "a signal ends it with 3 and says what is kept" '[ $status -eq 3 ] && said "interrupted by signal 15" && grep -qE "[0-9]+ of 180 runs are kept in part.h5.runs" "$err" && [ -s part.h5.runs ] && [ ! -e part.h5 ]'
cp part.h5.runs kept.runs

run "$jostle" run study.deck -q -o part.h5 -D gap=5mm
expect "another -D is refused" '[ $status -eq 2 ] && grep -qE "part.h5.runs holds [0-9]+ finished runs that this study does not have, as the deck or a file has changed; --restart discards them" "$err"'
cp study.deck kept.deck
sed -i 's/^step .*/step fixed 0.5ms/' study.deck
run "$jostle" run study.deck -q -o part.h5
expect "a changed deck is refused" '[ $status -eq 2 ] && said "finished runs that this study does not have, as the deck or a file has changed"'
mv kept.deck study.deck
cp records/1.txt kept.txt
echo 0.1 >>records/1.txt
run "$jostle" run study.deck -q -o part.h5
expect "a changed record is refused" '[ $status -eq 2 ] && said "finished runs that this study does not have, as the deck or a file has changed"'
mv kept.txt records/1.txt
expect "none of which harms the journal" 'cmp part.h5.runs kept.runs'
touch records/1.txt
cp study.deck kept.deck
cp study.deck kept2.deck
{
    printf '# a comment\n\n'
    sed '/^title/d; s/^param/   param   /; s/^step fixed /step \\\n  fixed  /; s/$/  # and more/; s/\\  # and more$/\\/' kept.deck
    echo 'title "another one"'
} >study.deck
cp "$jostle" other
printf x >>other
run ./other run study.deck -o part.h5
mv kept.deck study.deck
expect "another build and another layout of the deck go on" '[ $status -eq 0 ] && grep -qE "[0-9]+ runs computed, [0-9]+ taken" "$out" && same whole.h5 part.h5'

cp records/1.txt records/4.txt
run "$jostle" run study.deck -q -o more.h5
cp kept.runs part.h5.runs
run "$jostle" run study.deck --force -o part.h5
expect "so does a study that has grown" '[ $status -eq 0 ] && grep -qE "[0-9]+ runs computed, [1-9][0-9]* taken" "$out" && same more.h5 part.h5'
rm records/4.txt more.h5 part.h5

# How the deck is called does not matter, nor where it is with its records.
cp study.deck other.deck
mkdir elsewhere
cp -r study.deck records elsewhere
for deck in ./study.deck "$PWD/study.deck" ../here/study.deck other.deck elsewhere/study.deck; do
    rm -f part.h5
    cp kept.runs part.h5.runs
    run "$jostle" run "$deck" -o part.h5
    files=$(h5dump -d /origin/file part.h5 | grep -oE '"[^"]*/[0-9].txt"' | tr -d '\n')
    expect "the runs of study.deck are found by $deck" \
        '[ $status -eq 0 ] && grep -qE "[0-9]+ runs computed, [0-9]+ taken" "$out" && same whole.h5 part.h5'
    expect "and each record is listed once ($deck)" \
        '[ "$files" = "\"records/1.txt\"\"records/2.txt\"\"records/3.txt\"" ]'
done
rm part.h5
cp kept.runs part.h5.runs
echo 0.1 >>elsewhere/records/1.txt
run "$jostle" run elsewhere/study.deck -q -o part.h5
expect "elsewhere a changed record is refused too" '[ $status -eq 2 ] && said "finished runs that this study does not have"'
rm -r part.h5.runs other.deck elsewhere

cp kept.runs part.h5.runs
run "$jostle" run study.deck --force -q -o part.h5 -D gap=5mm --restart
expect "--restart begins another one" '[ $status -eq 0 ] && [ ! -e part.h5.runs ] && ! same whole.h5 part.h5'

rm part.h5
head -c $(($(stat -c %s kept.runs) - 100)) kept.runs >part.h5.runs
run "$jostle" run study.deck -q -o part.h5
expect "a torn entry at the end is dropped" '[ $status -eq 0 ] && same whole.h5 part.h5'
rm part.h5
cp kept.runs part.h5.runs
printf '\377' | dd of=part.h5.runs bs=1 seek=5000 conv=notrunc 2>/dev/null
run "$jostle" run study.deck -q -o part.h5
expect "a damaged one amid the others is made again" '[ $status -eq 0 ] && [ ! -s "$err" ] && same whole.h5 part.h5'
rm part.h5
kept=$(entries kept.runs)
cp kept.runs part.h5.runs
printf '\377' | dd of=part.h5.runs bs=1 seek=5000 conv=notrunc 2>/dev/null
run "$jostle" run study.deck -o part.h5
expect "which is told, and costs no other one" '[ $status -eq 0 ] && said "jostle: warning: part.h5.runs is damaged in 1 place; of 180 runs $((kept - 1)) were found in it, the others are run again" && same whole.h5 part.h5'
rm part.h5
for at in 8 12 13 16 40; do
    cp kept.runs part.h5.runs
    printf '\377' | dd of=part.h5.runs bs=1 seek=$at conv=notrunc 2>/dev/null
    cp part.h5.runs damaged.runs
    run "$jostle" run study.deck -q -o part.h5
    expect "byte $at of the head damaged: the runs are not thrown away" '[ $status -eq 2 ] && said "part.h5.runs is damaged and may hold finished runs; --restart discards them" && cmp part.h5.runs damaged.runs && [ ! -e part.h5 ]'
done
run "$jostle" run study.deck -q -o part.h5 --restart
expect "but with --restart" '[ $status -eq 0 ] && same whole.h5 part.h5'
for n in 0 5 8 12 30 100; do
    rm part.h5
    head -c $n kept.runs >part.h5.runs
    run "$jostle" run study.deck -q -o part.h5
    expect "a head torn at byte $n is begun anew" '[ $status -eq 0 ] && same whole.h5 part.h5'
done
rm part.h5
echo 'not a journal' >part.h5.runs
run "$jostle" run study.deck -q -o part.h5
expect "a file of another kind is left alone" '[ $status -eq 2 ] && said "part.h5.runs is not the journal of a study" && [ "$(cat part.h5.runs)" = "not a journal" ]'
rm part.h5.runs
cp kept.runs part.h5.runs
printf 1 | dd of=part.h5.runs bs=1 seek=6 conv=notrunc 2>/dev/null
run "$jostle" run study.deck -q -o part.h5
expect "what an earlier program has left is not gone on with" '[ $status -eq 2 ] && said "part.h5.runs was written by another version of jostle, or on another kind of machine; --restart begins anew" && [ ! -e part.h5 ]'
run "$jostle" run study.deck -q -o part.h5 --restart
expect "but begun anew" '[ $status -eq 0 ] && same whole.h5 part.h5 && [ ! -e part.h5.runs ]'
rm part.h5

run limited -f 40 "$jostle" run study.deck -q -o part.h5
expect "a limit to the size of files ends it with 3" '[ $status -eq 3 ] && said "cannot write part.h5.runs: File too large" && said "runs are kept" && [ ! -e part.h5 ]'
run "$jostle" run study.deck -q -o part.h5
expect "from where it goes on" '[ $status -eq 0 ] && same whole.h5 part.h5'

mkdir small
if mount -t tmpfs -o size=64k tmpfs small 2>/dev/null; then
    run "$jostle" run study.deck -q -o small/part.h5
    expect "a full disk ends it with 3" '[ $status -eq 3 ] && said "No space left on device" && said "runs are kept" && [ ! -e small/part.h5 ] && [ ! -e small/part.h5.part ]'
    mount -o remount,size=4m small
    run "$jostle" run study.deck -q -o small/part.h5
    expect "and it goes on when there is room" '[ $status -eq 0 ] && same whole.h5 small/part.h5'
    umount small
else
    skip "a full disk ends it with 3" "no disk can be mounted here"
fi
