# SPDX-License-Identifier: GPL-3.0-or-later
# conditioning.awk BEFORE AFTER: a row of the relative changes of the largest displacement, the
# largest force, the sum of the impulses, and the count of impacts.
FNR == 1 { file++ }
$3 == "displacement" && $5 > u[file] { u[file] = $5 }
$1 == "contacts" && $3 == "force" && $5 > f[file] { f[file] = $5 }
$1 == "contacts" && $3 == "impulse" { j[file] += $5 }
$1 == "contacts" && $3 == "impacts" { n[file] += $5 }

END {
    printf "%s\t| %s | %s | %s | %s | %d, %d |\n", name, label,
        small(relative(u[1], u[2]), 1e-12), small(relative(f[1], f[2]), 1e-12),
        small(relative(j[1], j[2]), 1e-12), n[1], n[2]
}
