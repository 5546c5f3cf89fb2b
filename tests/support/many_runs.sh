# SPDX-License-Identifier: GPL-3.0-or-later
# many_runs N [M]: prints a study of N x M runs (M: N), each of which takes next to no time: what is
# left is the study itself. Sourced by tests/cli/many_runs.sh and tests/bench/studies.sh.
many_runs() {
    cat <<END
units kN m s
sweep gap range 1mm 20mm $1
sweep amplitude range 0.5m/s^2 5m/s^2 ${2:-$1}
building A -floors 8 -mass 300t -stiffness 345MN/m
building B -floors 5 -mass 300t -stiffness 345MN/m
contact A B -gap \$gap -law linear -k 1e6kN/m
ground sine -amplitude \$amplitude -frequency 1.5 -cycles 1
step fixed 10ms
duration 0.5
END
}
