#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A study in parts, one after the other: the bare pattern, for launchers of your own.
#
#   sh loop.sh DECK [PARTS]
#
# Run it again after whatever stopped it: parts that are done are not run again, others go on.
# Exit status: 0 all runs are done, 1 some runs have failed and the result says which, others: an
# error, there is no result.
set -eu
deck=$1
parts=${2:-4}
merge=$(jostle tasks "$deck" -n "$parts" --merge)

k=1
while [ "$k" -le "$parts" ]; do
    status=0
    jostle run "$deck" --shard "$k/$parts" -q || status=$?
    # 1: runs of this part have failed. They are recorded, and no reason to stop.
    [ $status -le 1 ] || exit $status
    k=$((k + 1))
done
eval "$merge"
