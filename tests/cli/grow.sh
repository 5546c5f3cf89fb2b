#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A study that grows computes what is new and takes the rest, by the keys of its runs: with one more
# gap, record or intensity it is the study made anew, bit by bit, also where it is killed while it
# grows. Parts are taken as files are. JOSTLE_LONG=1 takes 44 records and 20 intensities, and kills it
# 50 times.
. tests/support/cli.sh

if ! command -v h5diff >/dev/null; then
    skip "a study that grows" "no h5diff"
    exit 0
fi

records=11 levels=5 more=6 seconds=30 kills=5 tenths=3
[ -z "${JOSTLE_LONG-}" ] || records=44 levels=20 more=25 seconds=8 kills=50 tenths=10
now=$((records * levels * 3))         # runs of the first study
next=$(((records + 1) * more * 4))    # with one more gap, one more record and more intensities
fewer=$(((records + 1) * more * 2))   # with half as many gaps as that
part=$(((records + 1) * levels * 2))  # of the study in parts

# grown GAPS INTENSITIES [LINE]...: study.deck with so many values; lines are added to it.
grown() {
    {
        echo 'units kN m s'
        echo "sweep gap values$(seq 1 "$1" | awk '{ printf " %dmm", 2 * $1 }')"
        echo 'sweep record files "records/*.txt"'
        echo "sweep pga values$(seq 1 "$2" | awk '{ printf " %gm/s^2", 0.3 * $1 }')"
        cat <<'END'
building A -floors 2 -mass 300t -stiffness 345MN/m
building B -floors 1 -mass 300t -stiffness 345MN/m
damping A rayleigh 5%
damping B rayleigh 5%
contact A B -gap $gap -law hunt-crossley -n 1.5 -k 1GN/m^1.5 -e 0.65
ground record $record -unit m/s2 -dt 0.01 -pga $pga
step fixed 2ms
END
        printf '%s\n' "${@:3}"
    } >study.deck
}
# counts FILE: runs of a study, and how many of them were taken.
counts() {
    echo "$(h5dump -a runs "$1" | sed -n 's/.*(0): //p') $(h5dump -a runs_kept "$1" | sed -n 's/.*(0): //p')"
}

mkdir records
for i in $(seq -w $records); do
    awk -v i="$i" 'BEGIN { for (k = 0; k < 60; k++) print sin((0.05 + 0.02 * i) * k) }' >"records/$i.txt"
done
grown 3 $levels
run "$jostle" run study.deck -q -o grow.h5
expect "$records records, $levels intensities and 3 gaps" '[ $status -eq 0 ] && [ "$(counts grow.h5)" = "$now 0" ]'
cp grow.h5 first.h5
run "$jostle" run study.deck -o grow.h5
expect "the same again computes and writes nothing" '[ $status -eq 0 ] && cmp -s first.h5 grow.h5 && [ ! -e grow.h5.runs ] && said "all $now runs were there; none was computed"'

cp records/10.txt records/10b.txt
sed -i 's/1/2/' records/10b.txt
grown 4 $more '# a comment' 'param unused 3'
run "$jostle" run study.deck -o grow.h5
expect "one more gap, one more record, more intensities, a comment, an unused param" '[ $status -eq 0 ] && [ "$(counts grow.h5)" = "$next $now" ] && grep -q "$((next - now)) runs computed, $now taken" "$out"'
run "$jostle" run study.deck -q -o anew.h5 -j 1
expect "which is the study made anew" '[ $status -eq 0 ] && same grow.h5 anew.h5'

# What changes the runs: nothing is thrown away, and what is the same is taken.
grown 2 $more
run "$jostle" run study.deck -q -o grow.h5
expect "a smaller study does not replace it" '[ $status -eq 2 ] && said "grow.h5 holds $fewer finished runs that this study does not have" && same grow.h5 anew.h5'
run "$jostle" run study.deck -q -o small.h5 --take grow.h5
expect "but takes its runs" '[ $status -eq 0 ] && [ "$(counts small.h5)" = "$fewer $fewer" ]'
run "$jostle" run study.deck -q -o small2.h5
expect "which are those made anew" 'same small.h5 small2.h5'
rm -f small*.h5
run "$jostle" run study.deck -q -D gap=2mm -D record=07 -o line.h5 --take grow.h5
expect "a study with fewer dimensions takes them too" '[ $status -eq 0 ] && [ "$(counts line.h5)" = "$more $more" ]'
run "$jostle" run study.deck -q -D gap=2mm -D record=07 -o line2.h5
expect "with the gap that the other file has as a sweep" 'same line.h5 line2.h5'
echo 0.5 >>records/07.txt
run "$jostle" run study.deck -q -o other.h5 --take grow.h5
expect "of a record that has changed no run is taken" '[ $status -eq 0 ] && [ "$(counts other.h5)" = "$fewer $((fewer - 2 * more))" ]'
sed -i '$d' records/07.txt
sed -i 's/0.65/0.66/' study.deck
run "$jostle" run study.deck -q -o other.h5 --force --take grow.h5
expect "of another contact none at all" '[ $status -eq 0 ] && [ "$(counts other.h5)" = "$fewer 0" ]'
run "$jostle" run study.deck -q -o none.h5 --take records/07.txt
expect "a file of another kind is refused" '[ $status -eq 2 ] && said "records/07.txt"'

# Parts are files of finished runs like others.
rm -f other.h5
grown 2 $levels
for k in 1 2 3; do
    "$jostle" run study.deck -q --shard $k/3 -o part$k.h5
done
run "$jostle" run study.deck -q -o whole.h5 --take part1.h5 --take part2.h5 --take part3.h5
run2=$(counts whole.h5)
run "$jostle" merge part1.h5 part2.h5 part3.h5 -q -o merged.h5
expect "parts are taken as merge joins them" '[ "$run2" = "$part $part" ] && same whole.h5 merged.h5'
grown 3 $levels
run "$jostle" run study.deck -q -o whole.h5
expect "and what they make grows" '[ $status -eq 0 ] && [ "$(counts whole.h5)" = "$((part * 3 / 2)) $part" ]'

# Killed again and again while it grows, nothing is lost: the old file is there until the new one is.
grown 4 $more "duration $seconds"
mv grow.h5 short.h5
"$jostle" run study.deck -q -D gap=2mm -o short.h5 --force
grown 3 $levels "duration $seconds"
"$jostle" run study.deck -q -o grow.h5
cp grow.h5 first.h5
grown 4 $more "duration $seconds"
"$jostle" run study.deck -q -o anew.h5 --force
killed=0
starts=0
lost=0
while [ $killed -lt $kills ] && [ $starts -lt 500 ]; do
    before=$(stat -c %s grow.h5.runs 2>/dev/null || echo 0)
    "$jostle" run study.deck -j 1 -q -o grow.h5 >/dev/null 2>&1 </dev/null &
    child=$!
    sleep 0.$((RANDOM % tenths))$((RANDOM % 10))
    kill -s KILL $child 2>/dev/null
    wait $child 2>/dev/null && ended=1 || ended=0
    starts=$((starts + 1))
    if cmp -s first.h5 grow.h5; then
        after=$(stat -c %s grow.h5.runs 2>/dev/null || echo 0)
        # An entry that the kill has torn is cut off by the next start.
        [ "$after" -ge $((before - 2000)) ] || lost=$((lost + 1))
    elif same grow.h5 anew.h5; then
        rm -f grow.h5.runs
        cp first.h5 grow.h5
    else
        lost=$((lost + 1))
    fi
    killed=$((killed + 1 - ended))
done
run "$jostle" run study.deck -q -o grow.h5
expect "killed $kills times while it grows, it loses nothing" '[ $killed -ge $kills ] && [ $lost -eq 0 ] && [ $status -eq 0 ] && same grow.h5 anew.h5 && [ ! -e grow.h5.runs ]'

# Failed runs are taken as others are, unless they are wanted again.
failing_study fails.deck
"$jostle" run fails.deck -q -o fails.h5
run "$jostle" run fails.deck -q -o fails.h5
expect "failed runs are results" '[ $status -eq 1 ] && said "5 of 9 runs failed" && [ "$(counts fails.h5)" = "9 0" ]'
run "$jostle" run fails.deck -q -o fails.h5 --retry
expect "which are computed again if that is wanted" '[ $status -eq 1 ] && [ "$(counts fails.h5)" = "9 4" ]'
