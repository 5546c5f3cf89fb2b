#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Studies in parts: --shard, merge and tasks. Parts of any division make the file of a study run as a
# whole; what does not belong together is refused.
. tests/support/cli.sh

study_of_records study.deck 9 300
cp study.deck kept.deck
"$jostle" run study.deck -q -o whole.h5

# parts N [OPTION]...: all parts of N into part/K.h5.
parts() {
    local n=$1 k
    shift
    rm -rf part
    mkdir part
    for k in $(seq "$n"); do
        "$jostle" run study.deck -q --shard "$k/$n" -o part/$k.h5 "$@" || return 1
    done
}

for word in 0/3 4/3 1/0 3 1/ /3 a/b 1/3x -1/3 '1 /3' 1/99999999999999999999; do
    run "$jostle" run study.deck --shard "$word"
    expect "--shard $word is refused" '[ $status -eq 2 ] && said "--shard takes K/N, part K of N, with 1 <= K <= N <= 10000000, not '"'\$word'"'"'
done
two_buildings one.deck
run "$jostle" run one.deck --shard 1/2
expect "an analysis has no parts" '[ $status -eq 2 ] && said "one.deck is not a study" && [ ! -e one.1-of-2.h5 ]'
for option in '--histories 1' '--retry' '--take two.h5' '--steps 9' '--seconds 9'; do
    # shellcheck disable=SC2086  # an option and its value
    run "$jostle" run one.deck $option
    expect "nor does it take $option" '[ $status -eq 2 ] && said "one.deck is not a study" && [ ! -e one.h5 ]'
done
run "$jostle" run study.deck --shard 1/4 --shard 2/4
expect "one part is named" '[ $status -eq 2 ] && said "--shard is given twice" && [ ! -s "$out" ]'
run "$jostle" run study.deck --shard 2/4
expect "a part is run and says which it is" '[ $status -eq 0 ] && grep -q "^part 2 of 4: 6 of the 27 runs of a study, 0 failed" "$out"'
expect "it has a name of its own" '[ -s study.2-of-4.h5 ] && [ ! -e study.2-of-4.h5.runs ]'
run "$jostle" show study.2-of-4.h5 --tsv
expect "its table has the numbers of the runs in the study" '[ "$(tail -n +2 "$out" | cut -f 1 | uniq | tr "\n" " ")" = "2 5 12 15 18 21 " ]'
"$jostle" show whole.h5 --tsv >whole.tsv
expect "and their values" 'awk -F "\t" "\$1 == 2 && \$7 == \"drift\"" "$out" | cmp - <(awk -F "\t" "\$1 == 2 && \$7 == \"drift\"" whole.tsv)'
cp study.2-of-4.h5 kept.h5
run "$jostle" run study.deck --shard 2/4
expect "a part that is done is not run again" '[ $status -eq 0 ] && grep -q "^part 2 of 4" "$out" && cmp study.2-of-4.h5 kept.h5'
run "$jostle" run study.deck --shard 2/4 -D gap=5mm
expect "of another study it is not taken" '[ $status -eq 2 ] && said "study.2-of-4.h5 holds 6 finished runs that this part of the study does not have, as the deck or a file has changed; --force overwrites it"'
run "$jostle" run study.deck --shard 3/4 -o study.2-of-4.h5
expect "nor of another part" '[ $status -eq 2 ] && grep -qE "study.2-of-4.h5 holds [0-9]+ finished runs that this part of the study does not have" "$err"'
echo 0.1 >>records/1.txt
run "$jostle" run study.deck --shard 2/4
expect "nor with a record that was another one" '[ $status -eq 2 ] && grep -qE "study.2-of-4.h5 holds [0-9]+ finished runs that this part of the study does not have" "$err"'
expect "none of which touches it" 'cmp study.2-of-4.h5 kept.h5'
sed -i '$d' records/1.txt
run "$jostle" run study.deck --shard 2/4 --force -q
expect "--force runs it again" '[ $status -eq 0 ] && ! cmp -s study.2-of-4.h5 kept.h5'
run "$jostle" plot study.2-of-4.h5
expect "a part is drawn with a warning of what is not there" '[ $status -eq 0 ] && said "runs are not in"'
rm -f ./*.png
run "$jostle" run study.deck --shard 40/50
expect "a part without runs is a file too" '[ $status -eq 0 ] && grep -q "^part 40 of 50: 0 of the 27 runs" "$out" && "$jostle" show study.40-of-50.h5 --tsv | cmp - <(head -n 1 whole.tsv)'
empty=$PWD/study.40-of-50.h5

sed 's/-mass 80t/-mass $m/; 3i sweep m values 80t 90t 100t' study.deck >three.deck
run "$jostle" run three.deck --shard 1/2 -q -D gap=5mm -D record=records/2.txt
expect "a part with two -D" '[ $status -eq 0 ] && [ -s three.1-of-2.h5 ]'
run "$jostle" run three.deck --shard 1/2 -q -D record=2 -D gap=5mm
expect "is the same one with both in another order, and a short name" '[ $status -eq 0 ]'
run "$jostle" run three.deck --shard 1/2 -q -D record=3 -D gap=5mm
expect "but not with another record" '[ $status -eq 2 ] && grep -qE "three.1-of-2.h5 holds [0-9]+ finished runs that this part of the study does not have" "$err"'
rm three.deck three.1-of-2.h5

if python3 -c 'import xarray, netCDF4' 2>/dev/null; then
    run python3 - <<'END'
import xarray
root = xarray.open_dataset("study.2-of-4.h5")
assert list(root.run.values) == [2, 5, 12, 15, 18, 21] and root.status.dims == ("run",)
drift = xarray.open_dataset("study.2-of-4.h5", group="/buildings/B/envelope").drift
assert drift.dims == ("run", "floor") and drift.sel(run=12).shape == (3,)
END
    expect "xarray selects by the numbers of its runs" '[ $status -eq 0 ]'
else
    skip "xarray selects by the numbers of its runs" "no xarray"
fi

if ! command -v h5diff >/dev/null; then
    skip "merged parts equal one run" "no h5diff"
    exit $failed
fi
for n in 1 3 30 16; do
    parts $n -j 1
    run "$jostle" merge part/*.h5 -o merged.h5
    expect "the summary of $n parts is that of the whole" 'diff <(grep -v -e "^wall" -e "^results" "$out") <("$jostle" show whole.h5 | grep -v -e "^wall" -e "^results")'
    expect "merged they equal one run ($n)" '[ $status -eq 0 ] && [ ! -s "$err" ] && same whole.h5 merged.h5'
    rm merged.h5
done
ls part/*.h5 | sort -R >order
# shellcheck disable=SC2046  # the names have no blanks
run "$jostle" merge $(cat order) "$empty" study.2-of-4.h5 part/3.h5 -o merged.h5 -q
expect "in any order, of any division, one of them twice" '[ $status -eq 0 ] && [ ! -s "$out" ] && same whole.h5 merged.h5'
run "$jostle" merge part/*.h5 -o merged.h5
expect "an existing file is refused" '[ $status -eq 2 ] && said "merged.h5 exists; --force overwrites it"'
run "$jostle" merge part/*.h5 -o merged.h5 -q --force
expect "--force overwrites it" '[ $status -eq 0 ] && same whole.h5 merged.h5'
run "$jostle" merge part/*.h5 -o part/../part/1.h5 --force
expect "but no part" '[ $status -eq 2 ] && said "is one of the parts"'
rm merged.h5

# Part 9 of 16 has the runs 9 and 24, which are in part 1 of 2; part 7 has 7 and 22, which are not.
"$jostle" run study.deck -q --shard 1/2 -o one-of-2.h5
mv part/9.h5 away.h5
run "$jostle" merge part/*.h5 one-of-2.h5 -o merged.h5 -q
expect "parts of two divisions, neither of which is whole, cover the study together" '[ $status -eq 0 ] && same whole.h5 merged.h5'
rm merged.h5
mv away.h5 part/9.h5
mv part/7.h5 away.h5
run "$jostle" merge part/*.h5 one-of-2.h5 -o merged.h5
expect "where they do not, the runs are named" '[ $status -eq 1 ] && said "2 of 27 runs are missing: runs 7, 22 of 27; --partial" && [ ! -e merged.h5 ]'
rm one-of-2.h5
run "$jostle" merge part/*.h5 -o merged.h5
expect "a missing part is named and nothing is written" '[ $status -eq 1 ] && said "2 of 27 runs are missing: part 7 of 16; --partial" && [ ! -s "$out" ] && [ ! -e merged.h5 ]'
rm part/9.h5 part/10.h5 part/11.h5
run "$jostle" merge part/*.h5 -o merged.h5
expect "or several" '[ $status -eq 1 ] && said "missing: parts 7, 9-11 of 16"'
run "$jostle" merge part/*.h5 study.2-of-4.h5 -o merged.h5
expect "of parts of different divisions, the runs" '[ $status -eq 1 ] && said "runs are missing: runs " && said " of 27; --partial"'
run "$jostle" merge part/*.h5 -o merged.h5 --partial
expect "--partial writes the others; exit status 1" '[ $status -eq 1 ] && said "8 of 27 runs are missing in merged.h5: parts 7, 9-11 of 16" && grep -q "^study of 27 runs, 0 failed, 8 missing" "$out"'
"$jostle" show merged.h5 --tsv >partial.tsv
expect "with the values that are there" '[ "$(cut -f 1,4 partial.tsv | sort -u | grep -c missing)" -eq 8 ] && grep "	done	" partial.tsv | cmp - <(grep "	done	" whole.tsv | grep -f <(grep "	done	" partial.tsv | cut -f 1 | sort -u | sed "s/.*/^&	/"))'
run "$jostle" merge merged.h5 part/*.h5 -o other.h5
expect "which is no part itself" '[ $status -eq 2 ] && said "merged.h5 is a whole study, not a part of one"'
run "$jostle" merge study.deck -o other.h5
expect "nor is a deck" '[ $status -eq 2 ] && said "study.deck is not the file of a part of a study"'
run "$jostle" merge nothing.h5 -o other.h5
expect "nor what is not there" '[ $status -eq 2 ] && said "cannot open nothing.h5: No such file"'
head -c 20000 away.h5 >torn.h5
run "$jostle" merge torn.h5 -o other.h5
expect "nor a torn file" '[ $status -eq 2 ] && said "torn.h5" && [ ! -e other.h5 ]'
run "$jostle" merge -o other.h5
expect "parts must be named" '[ $status -eq 2 ] && said "the files of the parts are expected"'
run "$jostle" merge part/1.h5
expect "and the result" '[ $status -eq 2 ] && said "-o FILE.h5 is expected"'

# refused CAUSE: part 7, made again as things are now, does not fit the others.
refused() {
    what=$1
    "$jostle" run study.deck -q --shard 7/16 -o part/7.h5 --force "${@:2}"
    run "$jostle" merge part/*.h5 -o merged.h5 --force
    expect "parts are refused where $what differs" '[ $status -eq 2 ] && said "are parts of different studies: $what differs"'
}
refused '-D' -D gap=5mm
sed -i 's/^step .*/step fixed 0.5ms/' study.deck
refused 'the deck'
cp kept.deck study.deck
cp records/1.txt records/4.txt
refused "the list of values of 'record'"
rm records/4.txt
echo 0.1 >>records/1.txt
refused 'the file records/1.txt'
sed -i '$d' records/1.txt
cp "$jostle" other
printf x >>other
./other run study.deck -q --shard 7/16 -o part/7.h5 --force
run "$jostle" merge part/*.h5 -o merged.h5 --force --partial
expect "but not where another build made one, which is noted" \
    '[ $status -eq 1 ] && [ "$(h5dump -a /origin/program_sha256 merged.h5 | grep -oE "[0-9a-f]{64}" | sort -u | wc -l)" -eq 2 ]'
mkdir elsewhere
cp -r records study.deck elsewhere
(cd elsewhere && "$jostle" run ./study.deck -q --shard 7/16 -o "$here/part/7.h5" --force)
(cd elsewhere && "$jostle" run "$PWD/study.deck" -q --shard 9/16 -o "$here/part/9.h5" --force)
"$jostle" run study.deck -q --shard 10/16 -o part/10.h5 --force
"$jostle" run elsewhere/study.deck -q --shard 11/16 -o part/11.h5 --force
run "$jostle" merge part/*.h5 -o merged.h5 --force -q
expect "but not where the deck lies" '[ $status -eq 0 ] && same whole.h5 merged.h5'
rm -rf merged.h5 elsewhere

# Killed before its result has a name: on a loaded machine it may be too late for that.
for _ in $(seq 20); do
    rm -f half.h5 half.h5.runs
    "$jostle" run study.deck -j 1 --shard 1/2 -o half.h5 >"$out" 2>"$err" </dev/null &
    child=$!
    for _ in $(seq 200); do
        [ "$(stat -c %s half.h5.runs 2>/dev/null || echo 0)" -le 1500 ] || break
        sleep 0.002
    done
    kill -s KILL $child 2>/dev/null
    wait $child 2>/dev/null
    [ -e half.h5 ] || break
done
if [ -s half.h5.runs ]; then
    run "$jostle" run study.deck --shard 2/2 -o half.h5
    expect "the journal of another part is refused" '[ $status -eq 2 ] && said "finished runs that this part of the study does not have"'
    cp half.h5.runs kept.runs
    run "$jostle" run study.deck -q -o half.h5
    expect "the whole study goes on with it" '[ $status -eq 0 ] && same whole.h5 half.h5'
    rm half.h5
    mv kept.runs half.h5.runs
fi
run "$jostle" run study.deck --shard 1/2 -q -o half.h5
expect "a killed part goes on" '[ $status -eq 0 ] && [ ! -e half.h5.runs ]'
"$jostle" run study.deck --shard 2/2 -q -o other.h5
run "$jostle" merge half.h5 other.h5 -o merged.h5 -q
expect "and is what it would have been" '[ $status -eq 0 ] && same whole.h5 merged.h5'
rm -f merged.h5

failing_study fails.deck
"$jostle" run fails.deck -q -o fails.h5 2>"$err"
codes=
for k in 1 2 3; do
    run "$jostle" run fails.deck --shard $k/3 -q
    codes="$codes $status"
done
expect "a part with failed runs ends with 1, and has its file" '[ "$codes" = " 1 1 1" ] && [ -s fails.3-of-3.h5 ]'
run "$jostle" run fails.deck --shard 2/3 -q
expect "and again with 1 when it is there" '[ $status -eq 1 ] && said "runs failed; /message in fails.2-of-3.h5 says why"'
run "$jostle" merge fails.?-of-3.h5 -q -o merged.h5
expect "so ends merge, and failed runs are in its file" '[ $status -eq 1 ] && said "5 of 9 runs failed" && same fails.h5 merged.h5'
sed -i 's/sweep e/sweep force/; s/\$e/$force/' fails.deck
run "$jostle" run fails.deck --shard 1/3 -q -o names.h5
expect "names that cannot stand in the whole file are refused in a part" '[ $status -eq 2 ] && said "sweep '"'force'"' has the name of a result"'

run "$jostle" tasks study.deck
expect "tasks prints 16 commands" '[ $status -eq 0 ] && [ $(wc -l <"$out") -eq 16 ] && [ "$(sed -n 3p "$out")" = "jostle run --shard 3/16 -j 1 -q -o study.3-of-16.h5 study.deck" ]'
run "$jostle" tasks study.deck -D gap=5mm
expect "or as many as there are runs" '[ $status -eq 0 ] && [ $(wc -l <"$out") -eq 3 ] && grep -q -- "-D gap=5mm" "$out"'
run "$jostle" tasks study.deck -D gap=5mm -D record=records/1.txt
expect "but none of an analysis" '[ $status -eq 2 ] && said "study.deck is not a study: it has no sweep that -D leaves open" && [ ! -s "$out" ]'
for words in "-n 0" "-n x" "-j 0" "-n" "study.deck"; do
    # shellcheck disable=SC2086
    run "$jostle" tasks study.deck $words
    expect "tasks $words is refused" '[ $status -eq 2 ] && said "jostle tasks: error:" && [ ! -s "$out" ]'
done
run "$jostle" tasks study.deck -o $'two\nlines.h5'
expect "so is a name with a line break" '[ $status -eq 2 ] && said "line break"'

# Names that a shell would take apart.
odd="it's a \"test\" \$HOME;"
mkdir "$odd"
cp -r records study.deck "$odd"
cp records/1.txt "$odd/records/it's one.txt"
one="record=records/it's one.txt"
mkdir bin
ln -s "$jostle" bin/jostle
PATH=$PWD/bin:$PATH
"$jostle" tasks "$odd/study.deck" -n 3 -o "$odd/-the result.h5" -D "$one" >lines
"$jostle" run "$odd/study.deck" -q -D "$one" -o odd.h5
expect "tasks takes a deck with such a name" '[ $(wc -l <lines) -eq 3 ]'
while IFS= read -r line; do
    run sh -c "$line"
    expect "sh runs: $line" '[ $status -eq 0 ] && [ ! -s "$out" ] && [ ! -s "$err" ]'
done <lines
run sh -c "$("$jostle" tasks "$odd/study.deck" -n 3 -o "$odd/-the result.h5" -D "$one" --merge)"
expect "and the merge command" '[ $status -eq 0 ] && same odd.h5 "$odd/-the result.h5"'
cd "$odd" || exit 1
rm "records/it's one.txt"
cp study.deck ./-study.deck
"$jostle" tasks -n 2 -o -x.h5 -- -study.deck >lines
"$jostle" tasks -n 2 -o -x.h5 --merge -- -study.deck >>lines
run sh -e lines
expect "names that begin with a dash too" '[ $status -eq 0 ] && same ../whole.h5 ./-x.h5'
