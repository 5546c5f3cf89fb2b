# SPDX-License-Identifier: GPL-3.0-or-later
"""peak.py COMMAND...: runs it and prints the largest memory that it had [KiB]."""
import resource
import subprocess
import sys

subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
