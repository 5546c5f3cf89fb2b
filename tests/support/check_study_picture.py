#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the numbers of pictures of studies against the file that they show.

usage: check_study_picture.py KIND.gp FILE.h5 EDP ABSCISSA [NAME=VALUE | LIMIT]...
                                               exit status 0: all good, 1: faults, 77: no h5py
The sweep `record` makes samples; of other sweeps NAME=VALUE chooses a value, else each is a group.
"""
import os
import sys
from statistics import NormalDist

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

from picture import check_panels, check_text, Curve, Panel, Picture, run_check


def largest(f, name, divisor=None, buildings=None):
    """Over all floors, for each run, and the unit."""
    values = []
    for building, b in f["buildings"].items():
        d = b["envelope"][name]
        if building == (buildings or building):
            values.append(np.max(d[:] / (b[divisor][:] if divisor else 1), axis=-1))
    return np.max(values, axis=0), d.attrs["units"]


def demand(f, edp):
    """Values of all runs, in what they are drawn, with the unit."""
    name, _, building = edp.partition(":")
    if name == "drift-ratio":
        return 100 * largest(f, "drift", "height", building)[0], "%"
    if name in ("force", "impacts"):
        d = f["contacts/envelope"][name]
        values = d[:].sum(axis=-1) if name == "impacts" else d[:].max(axis=-1)
        return values.astype(float), None if name == "impacts" else d.attrs["units"]
    return largest(f, name, buildings=building)


class Suite:
    """Values (group, sample, point), the points ascending; a failed run is above every value."""

    def __init__(self, path, edp, abscissa, chosen):
        f = h5py.File(path, "r")
        names = [f["status"].dims[i].keys()[0] for i in range(f["status"].ndim)]
        names = [name.split("/")[-1] for name in names]
        values, self.unit = demand(f, edp)
        values = np.where(f["status"][:] == 0, values, np.inf)
        sweep = {name: f["sweep"][name][:] for name in names}
        for name, value in chosen.items():
            values = np.take(values, list(sweep[name]).index(value), axis=names.index(name))
            names.remove(name)
        groups = [name for name in names if name not in ("record", abscissa)]
        values = values.transpose([names.index(n) for n in groups + ["record", abscissa]])
        order = np.argsort(sweep[abscissa])
        self.point = sweep[abscissa][order]
        self.value = values.reshape(-1, *values.shape[-2:])[:, :, order]
        self.group = [f"{groups[0]} = {v:g}" for v in sweep[groups[0]]] if groups else [None]
        self.edp = edp.replace("-", " ").replace(":", ", ")
        self.axis = (abscissa, f["sweep"][abscissa].attrs["units"].replace("^2", "²"))
        self.demand_axis = (self.edp, self.unit and self.unit.replace("^2", "²"))

    def percentile(self, group, part):
        """On straight lines between the sorted values; NaN where that is above every value."""
        rows = np.sort(self.value[group], axis=0)
        at = part * (len(rows) - 1)
        low, high = rows[int(at)], rows[int(np.ceil(at))]
        with np.errstate(invalid="ignore"):
            value = low if at == int(at) else low + (at - int(at)) * (high - low)
        return np.where(np.isfinite(value), value, np.nan)


def ida(s, _):
    rows = [(x, y) for sample in s.value[0] for x, y in zip(sample, s.point) if np.isfinite(x)]
    curves = [Curve(*np.array(rows).T, legend="each record")]
    curves += [Curve(s.percentile(0, p), s.point, legend=f"{100 * p:.0f} %")
               for p in (0.16, 0.5, 0.84)]
    last = [(a, y) for sample in s.value[0] for a, b, y in zip(sample, sample[1:], s.point)
            if np.isfinite(a) and not np.isfinite(b)]
    if last:
        curves.append(Curve(*np.array(last).T, legend="the next run failed"))
    return [Panel(s.demand_axis, s.axis, curves)]


def response(s, _):
    if len(s.group) == 1:
        band = Curve(s.point, s.percentile(0, 0.16), s.percentile(0, 0.84), legend="16 to 84 %")
        curves = [band, Curve(s.point, s.percentile(0, 0.5), legend="median")]
    else:
        curves = [Curve(s.point, s.percentile(g, 0.5), legend=text)
                  for g, text in enumerate(s.group)]
    return [Panel(s.axis, s.demand_axis, curves)]


def cloud(s, _):
    """The runs, the regression of their logarithms, and the scatter about it."""
    y = s.value[0].T.ravel()
    x = np.repeat(s.point, len(s.value[0]))
    slope, offset = np.polyfit(np.log(x), np.log(y), 1)
    rest = np.log(y) - offset - slope * np.log(x)
    scatter = np.sqrt(np.sum(rest ** 2) / (len(x) - 2))
    at = np.geomspace(x[0], x[-1], 101)
    line = np.exp(offset + slope * np.log(at))
    return [Panel(s.axis, s.demand_axis,
                  [Curve(x, y), Curve(at, line, legend="regression"),
                   Curve(at, line * np.exp(-scatter)), Curve(at, line * np.exp(scatter))])]


def fragility(s, limits):
    """Shares only; check_curve looks at the curves."""
    curves = [Curve(s.point, np.mean(s.value[g] > limit, axis=0))
              for limit in limits for g in range(len(s.group))]
    return [Panel(s.axis, ("probability of exceedance", None), curves)]


def check_curve(curve, values, point, limit):
    """It is lognormal, and none near it is more likely."""
    normal = NormalDist()
    inside = (curve[:, 1] > 1e-3) & (curve[:, 1] < 1 - 1e-3)
    x, z = np.log(curve[inside, 0]), np.array([normal.inv_cdf(p) for p in curve[inside, 1]])
    slope, offset = np.polyfit(x, z, 1)
    assert inside.sum() > 20 and np.abs(slope * x + offset - z).max() < 1e-3, "it is not lognormal"
    exceeded = (values > limit).sum(axis=0)

    def likelihood(median, dispersion):
        p = np.array([normal.cdf((np.log(y) - median) / dispersion) for y in point])
        return np.sum(exceeded * np.log(p) + (len(values) - exceeded) * np.log1p(-p))

    median, dispersion = -offset / slope, 1 / slope
    best = likelihood(median, dispersion)
    for a, b in ((1e-2, 0), (-1e-2, 0), (0, 1e-2), (0, -1e-2)):
        assert best > likelihood(median + a * dispersion, dispersion * (1 + b)), "not most likely"


def main(script, path, edp, abscissa, *words):
    chosen = dict(word.split("=") for word in words if "=" in word)
    limits = [float(word) for word in words if "=" not in word]
    s = Suite(path, edp, abscissa, {name: float(value) for name, value in chosen.items()})
    kind = os.path.basename(script)[:-3]
    picture = Picture(script)
    panel = picture.panels[0]
    if kind == "fragility":
        fitted = [curve for curve in panel.curves if curve.block.startswith("$curve")]
        panel.curves = [curve for curve in panel.curves if curve not in fitted]
        for curve in fitted:
            g = int(curve.block[6:])
            n = len(s.group)
            check_curve(curve.columns, s.value[g % n], s.point, limits[g // n])
        assert fitted, "no curve"
        check_text(picture.texts[1], "shares of {} runs", [s.value.shape[1]])
    else:
        assert np.allclose(panel.limits, limits), f"limits {panel.limits}"
    failed = np.isinf(s.value).sum()
    if failed:
        check_text(picture.texts[1], "{} of {} runs failed", [failed, s.value.size])
    panels = {"ida": ida, "response": response, "fragility": fragility, "cloud": cloud}
    check_panels(picture, panels[kind](s, limits))


if __name__ == "__main__":
    run_check(main)
