#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A study in parts as a Slurm job array, and a job that joins them when all have ended well.
#
#   sh submit.sh DECK PARTS [OPTION of sbatch]...
#   sh submit.sh suite.deck 64 --partition=short --time=30 --cpus-per-task=4
#
# Prints the numbers of the array and of the merge job. Submit it again after whatever stopped it: parts
# that are done are not run again, others go on where they were.
set -eu
deck=$1
parts=$2
shift 2
here=$(dirname "$0")

jostle tasks "$deck" -n "$parts" --merge >/dev/null # a deck that is wrong is told now
array=$(sbatch --parsable --array="1-$parts" "$@" "$here/part.sh" "$deck" "$parts")
array=${array%%;*} # without the name of the cluster
merge=$(sbatch --parsable --dependency="afterok:$array" --kill-on-invalid-dep=yes "$@" \
    "$here/merge.sh" "$deck" "$parts")
echo "$array ${merge%%;*}"
