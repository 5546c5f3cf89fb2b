#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# One part of a study: a task of the job array that submit.sh submits.
#SBATCH --job-name=jostle
#SBATCH --output=jostle-%A_%a.log
#SBATCH --requeue
set -eu

status=0
jostle run "$1" --shard "$SLURM_ARRAY_TASK_ID/$2" -j "${SLURM_CPUS_PER_TASK:-1}" -q || status=$?
# 1: runs have failed. They are recorded, and the merge job must not be held up by them.
[ $status -le 1 ] || exit $status
