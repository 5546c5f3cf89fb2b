#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Joins the parts: the job that waits for the array of submit.sh. Its exit status is that of the
# study: 0 all runs are done, 1 some have failed and the result says which.
#SBATCH --job-name=jostle-merge
#SBATCH --output=jostle-%j.log
set -eu

merge=$(jostle tasks "$1" -n "$2" --merge)
eval "$merge"
