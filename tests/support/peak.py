# SPDX-License-Identifier: GPL-3.0-or-later
"""peak.py COMMAND...: runs it and prints the largest memory [KiB] and the CPU time [s] that it took."""
import resource
import subprocess
import sys

subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(usage.ru_maxrss, f"{usage.ru_utime + usage.ru_stime:.1f}")
