#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check_layers.sh refuses an include of a higher layer, and within src/solve of a higher group.
. tests/support/cli.sh

mkdir -p include/jostle src/core src/model src/solve/contact src/solve/event src/solve/newmark
echo '#include "solve/event/event.h"' >src/solve/newmark/flight.c
echo '#include "solve/state.h"' >src/solve/event/event.h
echo '#include "core/arena.h"' >src/solve/state.h
run bash "$root/tests/support/check_layers.sh"
expect "includes of lower groups are accepted" '[ $status = 0 ] && [ ! -s "$err" ]'

echo '#include "solve/event/event.h"' >src/solve/state.h
run bash "$root/tests/support/check_layers.sh"
expect "a state that includes an event is refused" '[ $status = 1 ] &&
    grep -q "^src/solve/state.h:1: group .state. includes \"solve/event/event.h\" of .event., which" "$err"'

echo '#include "solve/dormand_prince/dp.h"' >src/solve/newmark/flight.c
echo >src/solve/state.h
run bash "$root/tests/support/check_layers.sh"
expect "a method that includes another one is refused" '[ $status = 1 ] &&
    grep -q "group .newmark. includes .* of .dormand_prince." "$err"'

echo >src/solve/newmark/flight.c
echo '#include "model/part.h"' >src/core/arena.h
run bash "$root/tests/support/check_layers.sh"
expect "a lower layer that includes a higher one is refused" '[ $status = 1 ] &&
    grep -q "^src/core/arena.h:1: .core. includes .* of .model." "$err"'
