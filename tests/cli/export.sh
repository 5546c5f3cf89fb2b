#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# jostle export: scripts of OpenSees are Python and Tcl of the same commands, with the numbers of the
# model. OpenSees itself runs them in tests/peers/export.py.
. tests/support/cli.sh
check=$root/tests/support/check_opensees.py

if ! python3 -c 'import numpy' 2>"$err"; then
    skip "models are scripts of OpenSees" "python3 has no numpy"
    exit 0
fi

# The periods of the script beside those of jostle modes, both sorted: the largest relative difference.
apart() {
    "$jostle" export "$1" --opensees py >model.py 2>"$err" || return 1
    python3 "$check" periods model.py >theirs || return 1
    "$jostle" modes "$1" --tsv | awk -F '\t' 'NR > 1 && !seen[$1, $2]++ { print $3 }' | sort -rg >own
    paste theirs own | awk '{ d = $1 / $2 - 1; d = d < 0 ? -d : d; worst = d > worst ? d : worst }
        NF != 2 { exit 2 } END { exit !(NR > 0 && worst < 1e-8) }'
}

commands() {
    python3 "$check" commands "$1"
}

for deck in "$root"/tests/peers/models/{storeys,frames,hinges,wall,pdelta,foundations}.deck \
    "$root"/input/{multistorey,frame,frame_wall,isolated,wall,row_of_five}.deck; do
    name=${deck##*/}
    expect "the nodes and elements of $name have the periods of its buildings" 'apart "$deck"'
done

# Every example in both languages. A Tcl of its own stands in for that of OpenSees.
cat >echo.tcl <<'TCL'
proc put {args} { puts [regsub -all {[\s{}]+} [concat {*}$args] "\t"]; return 0 }
foreach name {wipe model node fix mass equalDOF geomTransf uniaxialMaterial element region
    timeSeries recorder record setNodeDisp setNodeVel setNodeAccel constraints numberer system test
    algorithm integrator analysis analyze load} {
    proc $name {args} "put $name \$args"
}
proc pattern {args} {
    if {[lindex $args 0] eq "Plain"} {
        put pattern [lrange $args 0 2]
        eval [lindex $args 3]
    } else {
        put pattern $args
    }
}
source model.tcl
TCL

# Numbers as numbers: 1e-05 and 1.0e-5 are one.
plain() {
    awk -F '\t' -v OFS='\t' '{
        for (i = 1; i <= NF; i++) if ($i ~ /^[-+.0-9]/) $i = sprintf("%.15g", $i)
        print
    }'
}

for deck in "$root"/input/*.deck "$root"/tests/peers/models/*.deck; do
    name=${deck##*/}
    run "$jostle" export "$deck" --opensees py
    cp "$out" model.py
    grep '^note: ' "$err" >notes
    expect "$name becomes Python" '[ $status -eq 0 ] && commands model.py | plain >py.txt && grep -q "^analyze" py.txt'
    expect "notes of $name are in the script" '[ "$(grep -c "^# note: " model.py)" -eq "$(grep -c . notes)" ]'
    if type tclsh >/dev/null 2>&1; then
        "$jostle" export "$deck" --opensees tcl >model.tcl 2>"$err"
        expect "$name has the same commands in Tcl" 'tclsh echo.tcl | plain >tcl.txt && cmp py.txt tcl.txt'
    else
        skip "$name in Tcl" "tclsh is not installed"
    fi
done

# Numbers of the script.
cat >two.deck <<'DECK'
title "two"
units kN m s
building A -floors 2 -mass 100t 80t -stiffness 50MN/m 40MN/m
storey A:1 bilinear -yield 300 -hardening 0.05
storey A:2 bilinear -yield 200 -yield-negative 150 -hardening -0.02
building B -floors 1 -mass 60t -stiffness 30MN/m
damping A rayleigh -alpha 0.3 -beta 0.002
damping B dashpot 120kN*s/m
link A:1 B:1 -law cable -stiffness 5MN/m -slack 8mm
link A:2 B:1 -dashpot 40kN*s/m -stiffness 2MN/m
contact A:1 B:1 -gap 15mm -law hunt-crossley -n 1 -k 70MN/m -zeta 0.4
contact A:2 wall -gap 90mm -law jankowski -k 5e5 -zeta 0.3
load B:1 constant 25
initial A:2 -displacement 1mm
ground sine -amplitude 1.5 -frequency 2 -cycles 3
step fixed 1ms
duration 0.5
DECK
run "$jostle" export two.deck --opensees tcl
# Numbers to 12 digits.
awk '{
    for (i = 1; i <= NF; i++) if ($i ~ /^-?[0-9.]+(e[-+][0-9]+)?$/) $i = sprintf("%.12g", $i)
    print
}' "$out" >lines
has() {
    grep -qE -- "^$1\$" lines
}
expect "an export says that it is done" '[ $status -eq 0 ]'
expect "masses and materials have the numbers of the deck" 'has "mass 1 100 0 0" && has "uniaxialMaterial Steel01 1 300 50000 0.05"'
expect "unequal yield becomes springs side by side" 'has "uniaxialMaterial ElasticPP 2 40800 0.005 -0.00375" && has "uniaxialMaterial Elastic 3 -800" && has "uniaxialMaterial Parallel 4 2 3"'
expect "Rayleigh damping has its coefficients" 'has "region 1 -node 4 1 2 -rayleigh 0.3 0 0.002 0"'
expect "a dashpot in the only storey is in proportion to it" 'has "region 2 -node 4 3 -rayleigh 0 0 0.004 0"'
expect "a cable is a gap in tension" 'has "uniaxialMaterial ElasticPPGap [0-9]+ 5000 1e\+20 0.008 0 damage"'
expect "a link with a dashpot keeps both numbers" 'has "uniaxialMaterial Elastic [0-9]+ 2000 40"'
expect "hysteresis damping keeps k, q and n" 'has "uniaxialMaterial Hertzdamp [0-9]+ 70000 0.4 -0.015 1"'
expect "the law of Jankowski has its mass" 'has "uniaxialMaterial JankowskiImpact [0-9]+ 500000 0.3 80 -0.09 1.5"'
expect "a load is there from t = 0" 'has "timeSeries Constant 2 -factor 25" && has "load 3 1 0 0"'
expect "the ground is the sine of the deck" 'has "timeSeries Trig 1 0 1.5 0.5 -shift 0 -factor 1.5"'
expect "the state at t = 0 is that of the deck" 'has "setNodeDisp 2 1 0.001 -commit"'
expect "steps and rows are those of the deck" 'grep -qF "if {[analyze 500 0.001] != 0} {" "$out" && grep -q -- "-dT 0.01 " "$out"'

# Texts that would run commands: titles and names of files stand in comments only.
hostile='x [exec touch evil] $y {.deck'
cat >"$hostile" <<'DECK'
title "]; exec touch evil; [exec touch evil] { \\"
building A -floors 1 -mass 1kg -stiffness 1N/m
initial A:1 -velocity 1m/s
step fixed 1ms
duration 0.01
DECK
run "$jostle" export "$hostile" --opensees py
cp "$out" model.py
expect "hostile texts stay in comments of Python" '[ $status -eq 0 ] && commands model.py >py.txt && ! grep -q evil py.txt && [ ! -e evil ]'
if type tclsh >/dev/null 2>&1; then
    "$jostle" export "$hostile" --opensees tcl >model.tcl 2>"$err"
    expect "hostile texts stay in comments of Tcl" 'tclsh echo.tcl | plain >tcl.txt && ! grep -q evil tcl.txt && [ ! -e evil ] && plain <py.txt | cmp - tcl.txt'
fi

run "$jostle" export "$root/input/girder.deck" --opensees py
expect "a gap of 0 is 0 and not -0" '[ $status -eq 0 ] && grep -q "uniaxialMaterial" "$out" && ! grep -qE "[ ,(]-0\.0[,) ]" "$out"'
run "$jostle" export two.deck
expect "the program must be named" '[ $status -eq 2 ] && grep -q -- "--opensees py" "$err"'
run "$jostle" export two.deck --opensees fortran
expect "the languages are Python and Tcl" '[ $status -eq 2 ] && grep -q "py" "$err"'
if [ -w /dev/full ]; then
    "$jostle" export two.deck --opensees py >/dev/full 2>"$err"
    status=$?
    expect "a full disk is an error" '[ $status -eq 3 ]'
fi

# What OpenSees gave for all of them.
table=$root/tests/peers/export.tsv
missing=
for deck in "$root"/input/*.deck "$root"/tests/peers/models/*.deck; do
    name=${deck#"$root"/input/}
    name=${name#"$root"/tests/peers/}
    grep -q "^${name%.deck}	linear	" "$table" || missing="$missing $name"
done
expect "OpenSees has run every example" '[ -z "$missing" ]'
expect "it differs by less than 1e-6 where the equations are the same" 'awk -F "\t" "!/^#/ && \$2 == \"linear\" && \$8 == \"\" { n++; if (!(\$4 <= 1e-6)) exit 1 } END { exit !(n > 20) }" "$table"'
expect "the page has the rows of the table" 'awk -F "\t" "!/^#/ { print \"| \" \$1 \" | \" \$2 \" | \" \$4 \" | \" \$5 \" |\" }" "$table" | while read -r row; do grep -qF "$row" "$root/docs/opensees.md" || exit 1; done'
