#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the numbers of a picture against tables that the same command prints.

usage: check_table_picture.py impact.gp VALUES.tsv HISTORY.tsv...   of jostle law
       check_table_picture.py pounding.gp TABLE.tsv                 of jostle spectrum --pounding
                                               exit status 0: all good, 1: faults, 77: no numpy
"""
import os
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)

from picture import check_panels, check_text, Curve, Panel, Picture, run_check, same

PREFIX = {"": 1, "m": 1e-3, "µ": 1e-6, "k": 1e3, "M": 1e6}


def scale(unit, base):
    """What stands before the unit."""
    assert unit.endswith(base), f"unit {unit} of {base}"
    return PREFIX[unit[:-len(base)]]


def impact(picture, values, *histories):
    left, right = picture.panels
    time, force, length = scale(left.x.unit, "s"), scale(left.y.unit, "N"), scale(right.x.unit, "m")
    curves = []
    for path in histories:
        t, d, _, f = np.loadtxt(path, skiprows=1).T
        drawn = picture.panels[0].curves[len(curves)].columns
        assert drawn[0, 1] == 0 and drawn[-1, 1] == 0, "a force begins and ends at 0"
        curves.append((t / time, d / length, f / force))
    for panel in picture.panels:  # the ends, where the force may jump, stand there twice
        for curve in panel.curves:
            curve.columns = curve.columns[1:-1]
    check_panels(picture, [
        Panel(("time", left.x.unit), ("contact force", left.y.unit),
              [Curve(t, f, thinned=True) for t, d, f in curves]),
        Panel(("penetration", right.x.unit), None,
              [Curve(d, f, thinned=True) for t, d, f in curves])])
    if len(curves) == 1:
        with open(values, encoding="utf-8") as f:
            of = {name: float(value) for name, value in (line.split("\t") for line in f)}
        check_text(left.texts[0], f"largest {{}} {left.y.unit}, over {{}} {left.x.unit}",
                   [of["peak_force"] / force, of["duration"] / time])
        asked = [of["nominal_restitution"]] if np.isfinite(of["nominal_restitution"]) else []
        check_text(right.texts[0], f"e {{}}{' (asked {})' if asked else ''}, {{}} {right.x.unit}",
                   [of["achieved_restitution"], *asked, of["max_penetration"] / length])


def pounding(picture, table):
    with open(table, encoding="utf-8") as f:
        unit = f.readline().rstrip("\n]").split("[")[-1]
    left, right, force = np.loadtxt(table, skiprows=1).T
    boxes, shades = picture.panels
    drawn = boxes.curves[0].columns
    same(drawn[:, [0, 1, 6]], np.array([left, right, force]).T, 1e-6, "boxes")
    period = np.unique(left)
    inner = np.sqrt(period[1:] * period[:-1])
    for column, low, high in ((0, 2, 3), (1, 4, 5)):
        for row in drawn:
            i = np.argmin(np.abs(period - row[column]))
            assert i == 0 or abs(row[low] - inner[i - 1]) < 1e-6 * row[low], f"box {row}"
            # A box reaches 1 % under the next one.
            assert i + 1 == len(period) or abs(row[high] / 1.01 - inner[i]) < 1e-6 * row[high], row
    assert shades.y.unit == unit, f"{shades.y.unit}, not {unit}"
    assert abs(shades.y.span[1] - force.max()) < 1e-6 * force.max(), f"{shades.y.span}"


def main(script, *tables):
    check = {"impact": impact, "pounding": pounding}[os.path.basename(script)[:-3]]
    check(Picture(script), *tables)


if __name__ == "__main__":
    run_check(main)
