#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Only regular files are replaced. A link, a pipe, a device or a folder in place of a file is refused by
# whatever writes files, with --force too, and stays as it was, as does the file behind a link.
. tests/support/cli.sh

two_buildings pair.deck
sed 's/^param gap .*/sweep gap values 5mm 6mm/' pair.deck >study.deck
"$jostle" run -q pair.deck -o done.h5
"$jostle" run -q study.deck --shard 1/1 -o part.h5
mkdir other
law='law hertz -k 1e6 -m1 1 -v 1'
gnuplot=$(command -v gnuplot)

# place KIND NAME: something that is not a regular file.
place() {
    case $1 in
    linked) echo precious >other/target && ln -s other/target "$2" ;;
    empty) : >other/target && ln -s other/target "$2" ;;
    dangling) ln -s other/none "$2" ;;
    linked-folder) ln -s other "$2" ;;
    pipe) mkfifo "$2" ;;
    folder) mkdir "$2" ;;
    device) mknod "$2" c 1 3 2>/dev/null ;;
    esac
}

# What is there now, with what is behind links.
state() {
    find . -printf '%p %y %l %i\n' | sort
    cat other/target 2>/dev/null
}

# refuses NAME WORD...: the command ends with 2 or 3 because of NAME, and leaves all as it was.
refuses() {
    local name=$1 before
    shift
    before=$(state)
    run timeout 20 "$jostle" "$@"
    [ $status -ge 2 ] && [ $status -le 3 ] && said "$name is $says" && [ "$(state)" = "$before" ]
}

for kind in linked empty dangling linked-folder pipe folder device; do
    case $kind in
    pipe | device) says='not a regular file' ;;
    folder) says='a directory' ;;
    *) says='a symbolic link' ;;
    esac
    if ! place $kind probe; then
        skip "a $kind is not replaced" "none can be made here"
        continue
    fi
    rm -rf probe
    for force in '' --force; do
        place $kind out.h5
        expect "run does not replace a $kind $force" 'refuses out.h5 run -q pair.deck -o out.h5 $force'
        expect "nor does a study ($kind $force)" 'refuses out.h5 run -q study.deck -o out.h5 $force'
        expect "nor merge ($kind $force)" 'refuses out.h5 merge -q part.h5 -o out.h5 $force'
        mv out.h5 history.tsv
        expect "nor law --history ($kind $force)" 'refuses history.tsv $law --history history.tsv $force'
        mv history.tsv out.png
        if [ -n "$gnuplot" ]; then
            expect "nor plot ($kind $force)" 'refuses out.png plot done.h5 -o out.png $force'
            expect "nor law --plot ($kind $force)" 'refuses out.png $law --plot out.png $force'
            expect "nor spectrum -o ($kind $force)" 'refuses out.png spectrum "$root/input/records/ELCENTRO_1940_NS.AT2" -o out.png $force'
        fi
        mkdir script
        for ending in gp dat; do
            mv out.png script/energy.$ending
            expect "nor plot --script its .$ending ($kind $force)" 'refuses script/energy.$ending plot done.h5 energy --script script $force'
            mv script/energy.$ending out.png
        done
        rm -r out.png script
    done
    place $kind out.h5
    expect "tasks refuses such a name ($kind)" 'refuses out.h5 tasks study.deck -o out.h5'
    for name in out.h5.part history.tsv.part; do
        mv out.h5* $name
        words='run -q pair.deck -o out.h5'
        [ $name = out.h5.part ] || words="$law --history history.tsv"
        expect "what is made on the way is not made in place of it, either ($name, $kind)" 'refuses $name $words'
        mv $name out.h5
    done
    mv out.h5 out.h5.runs
    expect "nor is the journal of a study ($kind)" 'refuses out.h5.runs run -q study.deck -o out.h5 && refuses out.h5.runs run -q study.deck -o out.h5 --restart'
    rm -rf out.h5.runs other/target
done

# As root, with the standard output in a file, /dev/stdout is a link to a link to a regular file.
ln -s /proc/self/fd/1 stdout
"$jostle" run -q pair.deck -o stdout --force >printed 2>"$err"
status=$?
expect "a link to the standard output stays, and so does the file there" '[ $status -eq 2 ] && said "stdout is a symbolic link" && [ -L stdout ] && [ ! -s printed ]'
rm stdout printed

ln -s other here
run "$jostle" run -q pair.deck -o here/out.h5
expect "a link to the folder is followed" '[ $status -eq 0 ] && [ -L here ] && [ -s other/out.h5 ]'
run "$jostle" run -q pair.deck -o here/out.h5 --force
expect "with --force as well" '[ $status -eq 0 ] && [ -L here ] && [ "$(ls other)" = out.h5 ]'
