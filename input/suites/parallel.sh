#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A study in parts by GNU parallel, on this machine or on several.
#
#   sh parallel.sh DECK [PARTS]
#   HOSTS=8/alpha,16/beta,: sh parallel.sh DECK 256
#
# HOSTS is for --sshlogin: jobs/host, comma, ...; `:` is this machine. Each needs ssh without a
# password, jostle on its PATH, and this folder under the same name (NFS, say). JOBS limits the jobs of
# hosts without a number; default: their cores.
#
# DECK.PARTS.joblog tells when, where and for how long each part ran. Run it again after whatever
# stopped it: parts in the joblog are left out, those that failed go on. To begin anew remove the
# joblog and the parts. Exit status as for loop.sh.
set -eu
deck=$1
parts=${2:-64}
joblog=$(basename "$deck").$parts.joblog
tasks=$(jostle tasks "$deck" -n "$parts")
merge=$(jostle tasks "$deck" -n "$parts" --merge)

# A task is a command for sh. Its exit status 1 says that runs have failed, which are recorded: no
# reason to run it again.
printf '%s\n' "$tasks" | sed 's/$/ || [ $? -eq 1 ]/' |
    parallel --joblog "$joblog" --resume-failed --jobs "${JOBS:-100%}" \
        ${HOSTS:+--sshlogin "$HOSTS" --workdir "$PWD"} || exit 3
eval "$merge"
