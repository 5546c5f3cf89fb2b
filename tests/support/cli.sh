# SPDX-License-Identifier: GPL-3.0-or-later
# What the tests of the command line share; sourced by tests/cli/*.sh from the project's folder. Goes
# to an empty folder, which is removed at the end.
set -u
# Where no locale is set, as on a bare system, gnuplot warns of a degree sign that no script asks for.
export LC_ALL=C.UTF-8
root=$PWD
jostle=$(realpath "${JOSTLE:-build/jostle}")
export jostle  # for commands in words of their own
folder=$(mktemp -d "${TMPDIR:-/tmp}/jostle-cli-XXXXXX")
here=$folder/here
out=$folder/out
err=$folder/err
failed=0
mkdir "$here"
cd "$here" || exit 1
unset JOSTLE NO_COLOR

finish() {
    cd "$root" || exit 1
    chmod -R u+w "$folder"
    rm -rf "$folder"
    exit $failed
}
trap finish EXIT

# run WORD...: runs the command; $status, and its words in the files $out and $err.
run() {
    "$@" >"$out" 2>"$err" </dev/null
    status=$?
}

# limited FLAG N WORD...: the command under this limit of ulimit.
limited() (
    ulimit "$1" "$2"
    shift 2
    exec "$@"
)

# expect SENTENCE CONDITION: a line of the result; CONDITION is shell.
expect() {
    if eval "$2"; then
        echo "ok $1"
    else
        failed=1
        echo "not ok $1"
        echo "failed: $2; exit status ${status-none}; stdout, stderr, files:"
        head -n 20 "$out" "$err"
        ls -la
    fi
}

skip() {
    echo "ok $1 # SKIP $2"
}

# Whether there are pseudo-terminals, and script(1) to run commands on one; some containers have none.
has_terminal() {
    script -qec true /dev/null >"$out" 2>&1 </dev/null
}

# Nothing in this folder but these files.
only() {
    [ "$(find . -mindepth 1 -type f -printf '%P\n' | sort)" = "$(printf '%s\n' "$@" | sort)" ]
}

said() {
    grep -qF -- "$1" "$err"
}

# same ONE.h5 OTHER.h5: every dataset is equal. Attributes may differ, because some tell of the run.
# h5diff is called once, since a process for each dataset takes long.
same() {
    h5diff "$1" "$2" >"$out.diff" 2>&1
    ! grep -E '^dataset|error' "$out.diff" && [ "$(h5ls -r "$1")" = "$(h5ls -r "$2")" ] &&
        [ "$(h5ls -r "$1" | grep -c Dataset)" -gt 40 ]
}

# two_buildings FILE [LINE]...: a deck that runs within a blink, with impacts and one warning.
two_buildings() {
    local file=$1
    shift
    cat >"$file" <<'END'
title "two buildings"
units kN m s
param gap 5mm
building A -floors 2 -mass 100t -stiffness 50MN/m
building B -floors 3 -mass 80t -stiffness 20MN/m
damping A rayleigh 5%
damping B rayleigh 1% 9%
contact A B -gap $gap -law jankowski -k 1e6 -e 0.65
ground sine -amplitude 0.3g -frequency 1.5 -cycles 4
step fixed 1ms
END
    [ $# -eq 0 ] || printf '%s\n' "$@" >>"$file"
}

# study_of_records FILE GAPS VALUES: a study of that many gaps and three records of so many values,
# records/1.txt and on.
study_of_records() {
    local i
    mkdir records
    for i in 1 2 3; do
        awk -v i=$i -v n="$3" 'BEGIN { for (k = 0; k < n; k++) print i * sin((0.05 + 0.05 * i) * k) }' \
            >records/$i.txt
    done
    two_buildings "$1"
    sed -i "s/^param gap .*/sweep gap range 2mm 20mm $2/; /^ground/d; /^damping B/d" "$1"
    sed -i '3i sweep record files "records/*.txt"' "$1"
    echo 'ground record $record -unit m/s2 -dt 0.01' >>"$1"
}

# failing_study FILE: a study of 9 runs, of which 5 fail.
failing_study() {
    cat >"$1" <<'END'
sweep m values 1 1e-300 2
sweep e values 0.5 1.5 0.7
building A -floors 1 -mass $m -stiffness 1
contact A wall -gap 1 -law stereomechanical -e $e
load A:1 constant ${min(1e300, 1 + 1e300 * (1 - min(1, $m)))}
step fixed 0.01
duration 1
END
}
