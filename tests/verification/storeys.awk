# SPDX-License-Identifier: GPL-3.0-or-later
# storeys.awk REFERENCE RESULT: law, step, and the errors of the displacement of roof A, of the
# largest force and of the sum of all impulses; impacts of the reference and of jostle.
FNR == NR {
    if ($1 == "displacement" && $2 == "A" && $3 == 8) { roof = $4 }
    if ($1 == "force" && $4 > force) { force = $4 }
    if ($1 == "impulse") { impulse += $4 }
    if ($1 == "impacts") { impacts += $4 }
    next
}

$3 == "displacement" && $2 == "A" && $4 == 8 { u = $5 }
$1 == "contacts" && $3 == "force" && $5 > f { f = $5 }
$1 == "contacts" && $3 == "impulse" { j += $5 }
$1 == "contacts" && $3 == "impacts" { n += $5 }

END {
    printf "%s %s %.6g %.6g %.6g %d/%d\n", law, dt, relative(roof, u), relative(force, f),
        relative(impulse, j), impacts, n
}
