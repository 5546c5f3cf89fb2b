#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A study in parts, several at a time, by xargs.
#
#   sh xargs.sh DECK [PARTS]          JOBS=8 sh xargs.sh DECK 64
#
# (On one machine `jostle run DECK` alone keeps all cores busy; this is for those who want small jobs,
# and a pattern for other launchers that take a list of commands.)
# Run it again after whatever stopped it. Exit status as for loop.sh.
set -eu
deck=$1
parts=${2:-16}
tasks=$(jostle tasks "$deck" -n "$parts")
merge=$(jostle tasks "$deck" -n "$parts" --merge)

# A task is a command for sh. Its exit status 1 says that runs have failed, which are recorded: no
# reason to stop.
printf '%s\n' "$tasks" | sed 's/$/ || [ $? -eq 1 ]/' | tr '\n' '\0' |
    xargs -0 -n 1 -P "${JOBS:-$(getconf _NPROCESSORS_ONLN)}" sh -c || exit 3
eval "$merge"
