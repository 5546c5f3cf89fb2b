#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_street.py RESULT.h5 STREET.dat: the data of the map along a street are those of the result."""
import sys

import h5py
import numpy as np


def blocks(path):
    found, name = {}, None
    for line in open(path, encoding="utf-8"):
        if line.startswith("$"):
            name = line.split()[0][1:]
            found[name] = []
        elif line.startswith("EOD"):
            name = None
        elif name and not line.startswith("#"):
            found[name].append([float(x) for x in line.split()])
    return {name: np.array(rows) for name, rows in found.items()}


def main(result, data):
    f, drawn = h5py.File(result, "r"), blocks(data)
    names = sorted(f["buildings"], key=lambda n: int(n[1:]))
    rows = []
    for i, name in enumerate(names):
        b = f["buildings"][name]
        height = b["height"][:]
        top = np.cumsum(height)
        for k, drift in enumerate(b["envelope/drift"][:]):
            rows.append([i + 1, top[k] - height[k] / 2, i + 0.55, i + 1.45, top[k] - height[k],
                         top[k], 100 * drift / height[k]])
    np.testing.assert_allclose(drawn["storeys"], rows, rtol=2e-6, atol=1e-6)
    c, shown = f["contacts"], drawn["contacts"][1:]
    gap = [names.index(left.decode()) + 1.5 for left in c["left"][:]]
    closed = c["envelope/impacts"][:] > 0
    assert closed.sum() > 10
    np.testing.assert_allclose(shown[:, 0], gap)
    np.testing.assert_array_equal(np.isfinite(shown[:, 1]), closed)
    np.testing.assert_allclose(shown[:, 2], c["envelope/force"][:], rtol=1e-8)


main(*sys.argv[1:])
