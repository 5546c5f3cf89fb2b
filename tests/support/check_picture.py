#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the numbers of pictures of runs against the result files that they show.

usage: check_picture.py KIND.gp FILE.h5 [OTHER.h5]   exit status 0: all good, 1: faults, 77: no h5py
What each curve of a panel is drawn through is found here anew, from the datasets; so are the
numbers in the texts and the units of the axes.
"""
import os
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

from picture import Picture, check_panels, check_text, Curve, number_of, Panel, run_check, same

class Run:
    """What is read of a result file."""

    def __init__(self, path):
        self.f = h5py.File(path, "r")
        self.time = self.f["time"][:]
        self.duration = self.time[-1]
        order = sorted(self.f["buildings"].values(), key=lambda b: b.attrs["position"])
        self.buildings = {b.name.split("/")[-1]: b for b in order}
        self.contacts = self.links("contacts")
        self.hits = self.f["contacts/envelope/impacts"][:]
        self.impact = {key: d[:] for key, d in self.f["impacts"].items()}

    def links(self, group):
        names = ("left", "left_floor", "right", "right_floor")
        columns = [self.f[f"{group}/{name}"][:] for name in names] if group in self.f else [[]]
        return [tuple(v.decode() if isinstance(v, bytes) else int(v) for v in row)
                for row in zip(*columns)]

    def struck(self, building, n_floor):
        """Which floors a contact force has acted on."""
        struck = np.zeros(n_floor, bool)
        force = self.f["contacts/envelope/force"][:]
        for (left, at_left, right, at_right), peak in zip(self.links("contacts"), force):
            for name, floor in ((left, at_left), (right, at_right)):
                if name == building and peak > 0:
                    struck[floor - 1] = True
        return struck

    def unit(self, dataset, factor=""):
        text = self.f[dataset].attrs["units"].replace("*", "·")
        return (factor + text).replace("^2", "²").replace("^3", "³")

    def blows(self, peak, impulse):
        """What tells the hardest: forces, or impulses where rigid bodies have none."""
        return impulse if np.all(np.isnan(peak)) else np.nan_to_num(peak, nan=-1)

    def hardest(self):
        e = self.f["contacts/envelope"]
        blows = self.blows(e["force"][:], e["impulse"][:]) * (self.hits > 0)
        return int(np.argmax(blows)) if self.hits.any() else None

    def impacts(self, contact, parts=None):
        """Indices of the contact's impacts; the hardest of each of `parts` equal parts."""
        own = np.flatnonzero(self.impact["contact"] == contact + 1)
        if parts is None:
            return own
        blows = self.blows(self.impact["peak_force"], self.impact["impulse"])
        best = {}
        for i in own:
            part = min(int(self.impact["t_start"][i] / self.duration * parts), parts - 1)
            if part not in best or blows[i] > blows[best[part]]:
                best[part] = i
        return np.array([best[part] for part in sorted(best)], dtype=int)

    def hardest_impact(self, contact):
        own = self.impacts(contact)
        return own[np.argmax(self.blows(self.impact["peak_force"], self.impact["impulse"])[own])]

    def rows_of(self, i):
        return (self.time >= self.impact["t_start"][i]) & (self.time <= self.impact["t_end"][i])

    def history(self, side, floor, name):
        """Of a floor, counted from 1; zeros of a wall."""
        wall = side not in self.buildings
        return 0 * self.time if wall else self.buildings[side][name][:, floor - 1]

    def ground(self, side):
        return self.f["ground"][side][:] if side in self.buildings else 0 * self.time


# --- what each kind shows ------------------------------------------------------------------------


def marks(run, contact, value, parts=400):
    i = run.impacts(contact, parts)
    t = run.impact["t_start"][i]
    return t, np.interp(t, run.time, value)


def side_text(side, floor):
    return f"{side}, floor {floor}" if floor else "wall"


def histories(runs):
    r, first = runs[0], runs[0]
    c = r.hardest()
    left, left_floor, right, right_floor = r.contacts[c]
    ground = ("ground acc.", r.unit(f"ground/{list(r.buildings)[0]}"))
    length = r.unit("contacts/gap")
    time = ("time", r.unit("time"))
    if len(runs) > 1:
        panels = []
        for side, floor in ((left, left_floor), (right, right_floor)):
            rows = [(run, run.history(side, floor, "displacement")) for run in runs]
            lines = [Curve(run.time, u, thinned=True, legend=run.name) for run, u in rows]
            dots = [Curve(*marks(run, c, u)) for run, u in rows]
            if floor:
                panels.append(Panel(None, ("displ.", length), lines + dots, side_text(side, floor)))
        panels.append(Panel(time, ("ground", ground[1]),
                            [Curve(r.time, r.ground(left), thinned=True)]))
        peaks = [run.f["contacts/envelope/force"][c] for run in runs]
        return panels, ("largest force {} and {} " + r.unit("contacts/envelope/force"), peaks)
    u = r.history(left, left_floor, "displacement")
    seen = u - r.f["contacts/penetration"][:, c]
    panels = [Panel(None, ("displacement", length),
                    [Curve(r.time, u, seen, thinned=True, legend="gap"),
                     Curve(r.time, seen, thinned=True,
                           legend=side_text(right, right_floor) + " + gap"),
                     Curve(r.time, u, thinned=True, legend=side_text(left, left_floor)),
                     Curve(*marks(r, c, u), legend="impacts")])]
    grounds = [Curve(r.time, first.ground(side), thinned=True) for side in (left, right)
               if side in r.buildings]
    same = len(grounds) > 1 and np.array_equal(r.ground(left), r.ground(right))
    panels.append(Panel(time, ground, grounds[:1] if same else grounds))
    many = ", {} impacts, " if r.hits[c] != 1 else ", {} impact, "
    force = "largest force {} " + r.unit("contacts/envelope/force")
    return panels, ("gap {} " + length + many + force,
                    [r.f["contacts/gap"][c], r.hits[c], r.f["contacts/envelope/force"][c]])


def strip(run, group, i):
    force = run.f[f"{group}/force"][:, i]
    curves = [Curve(run.time, force, thinned=True, legend=run.name if run.several else None)]
    if group == "links":
        return curves
    lost = []
    for k in run.impacts(i, 500):
        rows = run.rows_of(k) & (force > 0)
        seen = force[rows].max() if rows.any() else 0
        if seen < 0.98 * run.impact["peak_force"][k]:
            middle = (run.impact["t_start"][k] + run.impact["t_end"][k]) / 2
            lost.append((run.time[rows][np.argmax(force[rows])] if rows.any() else middle,
                         run.impact["peak_force"][k]))
    return curves + [Curve(*np.array(lost).reshape(-1, 2).T)]


def pulse(run, c):
    i = run.hardest_impact(c)
    start, end = run.impact["t_start"][i], run.impact["t_end"][i]
    rows = run.rows_of(i)
    peak = run.f["contacts/envelope/force_time"][c], run.f["contacts/envelope/force"][c]
    points = [(start, 0), *zip(run.time[rows], run.f["contacts/force"][rows, c]), peak]
    points = sorted(points, key=lambda p: p[0]) + ([(end, 0)] if end < run.duration else [])
    return Curve(*(np.array(points) - (start, 0)).T)


def contact(runs):
    r = runs[0]
    force = ("force", r.unit("contacts/envelope/force"))
    names = [("contacts", i, text.decode()) for i, text in enumerate(r.f["contacts/name"][:])
             if any(run.hits[i] for run in runs)]
    names += [("links", i, "link " + text.decode())
              for i, text in enumerate(r.f["links/name"][:] if "links" in r.f else [])]
    panels = [Panel(None, force, [curve for run in runs for curve in strip(run, group, i)], text)
              for group, i, text in names]
    panels[-1].x = ("time", r.unit("time"))
    c = r.hardest()
    panels.append(Panel(("time from closure", r.unit("time")), force,
                        [pulse(run, c) for run in runs],
                        "hardest: " + r.f["contacts/name"][c].decode()))
    return panels, None


def loops(runs):
    r = runs[0]
    c = r.hardest()
    sides = r.contacts[c]
    curves = []
    for run in runs:
        i, d, f = run.impacts(c), run.f["contacts/penetration"][:, c], run.f["contacts/force"][:, c]
        peak = run.impact["peak_force"]
        i = np.array([k for k in i if (peak[i] > peak[k]).sum() < 12])
        blocks = [np.flatnonzero(run.rows_of(k)) for k in i]
        shown, hard = np.concatenate(blocks), run.rows_of(run.hardest_impact(c))
        curves += [Curve(d[shown], f[shown]), Curve(d[hard], f[hard]),
                   Curve(run.impact["max_penetration"][i], peak[i])]
    panels = [Panel(("penetration", r.unit("contacts/gap")),
                    ("contact force", r.unit("contacts/envelope/force")), curves,
                    r.f["contacts/name"][c].decode())]
    for side in (sides[0], sides[2]):
        if side in r.buildings and r.buildings[side]["stiffness"][0] > 0:
            storey = int(np.argmax(r.buildings[side]["envelope/drift"][:]))
            curves = [Curve(run.buildings[side]["drift"][:, storey],
                            run.buildings[side]["storey_shear"][:, storey], thinned=True)
                      for run in runs]
            panels.append(Panel(("drift", r.unit("contacts/gap")),
                                ("storey shear", r.unit("contacts/envelope/force")), curves,
                                f"{side}, storey {storey + 1}"))
    if "links/force" in r.f:
        lost, force = r.f["links/envelope/dissipated"][:], r.f["links/envelope/force"][:]
        i = max(range(lost.size), key=lambda k: (lost[k], force[k]))
        curves = [Curve(run.f["links/deformation"][:, i], run.f["links/force"][:, i], thinned=True)
                  for run in runs]
        panels.append(Panel(("shortening", r.unit("contacts/gap")),
                            ("link force", r.unit("contacts/envelope/force")), curves,
                            r.f["links/name"][i].decode()))
    return panels, None


def profile_row(run, b, value):
    """Of a building of one floor: a line from zero to its point, a second run below the first."""
    order = list(run.buildings.values())
    row = len(order) - order.index(b) + 0.15 * run.several * (1 if run.first else -1)
    return [Curve(0 * value, row, value, 0), Curve(value, row)]


def profiles(runs):
    r = runs[0]
    heights = all((b["height"][:] > 0).all() for b in r.buildings.values())
    rows = all(b["floor"].size == 1 for b in r.buildings.values())
    kinds = [("displacement", "displacement"), ("drift", "storey drift"),
             ("acceleration", "acceleration"), ("storey_shear", "storey shear")]
    panels = []
    for name, text in kinds:
        curves, rings = [], []
        for run in runs:
            for building, b in run.buildings.items():
                storeys = b["height"][:] if heights else np.ones(b["floor"].size)
                level = np.concatenate([[0], np.cumsum(storeys)])
                ratio = heights and name == "drift"
                value = b["envelope"][name][:] / (storeys / 100 if ratio else 1)
                free = b["stiffness"][:] == 0
                value = np.where(free & (name in ("drift", "storey_shear")), np.nan, value)
                struck = run.struck(building, value.size)
                if rows:
                    curves += profile_row(run, b, value)
                    rings.append(Curve(value[struck], curves[-1].rows[:, 1][struck]))
                    continue
                rings.append(Curve(value[struck], level[1:][struck]))
                line = (np.repeat(value, 2), np.repeat(level, 2)[1:-1])
                base = np.nan if name == "acceleration" or free[0] else 0
                points = (np.concatenate([[base], value]), level)
                curves.append(Curve(*(line if name in ("drift", "storey_shear") else points),
                                    legend=building))
        if name == "acceleration" and any(ring.rows.size for ring in rings):
            curves += rings
        x = (text, r.unit(f"buildings/{building}/envelope/{name}"))
        x = ("drift / height", "%") if heights and name == "drift" else x
        if any(curve.rows.size for curve in curves):
            panels.append(Panel(x, None, curves))
    height = ("height", r.unit("contacts/gap")) if heights else ("floor", None)
    panels[0].y = None if rows else height
    return panels, None


def check_profiles(picture, runs):
    """Rows have the names of their buildings."""
    names = list(runs[0].buildings)
    if all(b["floor"].size == 1 for b in runs[0].buildings.values()):
        rows = [(name, len(names) - i) for i, name in enumerate(names)]
        assert picture.panels[0].y.tics == rows, f"rows {picture.panels[0].y.tics}"


PARTS = "damping hysteretic contact strain kinetic".split()


def energy(runs):
    unit = runs[0].unit("energy/input")
    upper, lower = [], []
    for run in runs:
        e = {name: d[:] for name, d in run.f["energy"].items()}
        work = "contacts and links" if "links" in run.f else "contacts"
        names = ["damping", "yielding", work, "strain", "kinetic"]
        names = [text if any(r.f[f"energy/{part}"][:].any() for r in runs) else None
                 for part, text in zip(PARTS, names)]
        total = np.cumsum([0 * run.time] + [e[name] for name in PARTS], axis=0)
        curves = [Curve(run.time, total[i], total[i + 1], thinned=True, legend=names[i])
                  for i in range(5)]
        entered = run.f["energy"].attrs["initial"] + e["input"]
        first = run is runs[0]
        upper.append(Panel(None, ("energy", unit) if first else None,
                           curves + [Curve(run.time, entered, thinned=True)]))
        lower.append(Panel(("time", run.unit("time")), ("residual", unit) if first else None,
                           [Curve(run.time, e["residual"], thinned=True)]))
    if len(runs) > 1:  # the scale of the residual is told at the first one only
        lower[1].curves = []
        return [upper[0], lower[0], upper[1], lower[1]], None
    return [upper[0], lower[0]], (f"energy: {{}} {unit} in, {{}} into ",
                                  [entered[-1], e["contact"][-1]])


def check_energy(picture, runs):
    """Parts that nothing ever goes into are not in the legend."""
    parts = [part for part in PARTS if any(run.f[f"energy/{part}"][:].any() for run in runs)]
    assert len(picture.legend) == len(parts) + 1, f"legend {picture.legend}"


def impacts(runs):
    """Places are told by the numbers of the floors; sizes must grow by the root of the force."""
    return [Panel(("time", runs[0].unit("time")), ("floor", None), [])], None


def check_impacts(picture, runs):
    panel = picture.panels[0]
    pairs = []
    for link in runs[0].contacts:
        floor = link[1] or link[3]
        pairs.append((link[0], link[2], floor))
    pair_order = list(dict.fromkeys(p[:2] for p in pairs))
    order = sorted(range(len(pairs)), key=lambda i: (pair_order.index(pairs[i][:2]), pairs[i][2]))
    tics = sorted(panel.y.tics, key=lambda tic: tic[1])
    assert [int(text) for text, _ in tics] == [pairs[i][2] for i in order], f"floors {tics}"
    place = {i: tic[1] for i, tic in zip(order, tics)}
    unit = runs[0].unit("impacts/peak_force")
    marks_of = [(number_of(text.split()[0]), size) for text, (_, size) in picture.legend.items()
                if text.endswith(" " + unit)]
    area = {round((size - 0.4) ** 2 / value, 12) for value, size in marks_of}
    assert len(marks_of) == 3 and max(area) < 1.01 * min(area), f"legend {picture.legend}"
    for run, curve in zip(runs, panel.curves):
        rows = []
        for c in range(len(pairs)):
            i = run.impacts(c, 300)
            size = 0.4 + np.sqrt(max(area) * run.impact["peak_force"][i])
            rows.append(np.array([run.impact["t_start"][i], place[c] + 0 * size, size]).T)
        same(curve.columns, np.concatenate(rows), 0.01, curve.block)  # sizes in four digits


def modes(runs):
    r = runs[0]
    heights = all((b["height"][:] > 0).all() for b in r.buildings.values())
    panels = []
    for m in range(min(4, max(b["floor"].size for b in r.buildings.values()))):
        curves = []
        for run in runs:
            for b in run.buildings.values():
                n, k = b["floor"].size, np.append(b["stiffness"][:], 0)
                root = np.sqrt(b["mass"][:])
                matrix = np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)
                shape = np.linalg.eigh(matrix / np.outer(root, root))[1] / root[:, None]
                column = shape[:, m] if m < n else np.full(n, np.nan)
                column = column / column[np.argmax(np.abs(column))]
                level = np.cumsum([0, *(b["height"][:] if heights else np.ones(n))])
                base = np.nan if k[0] == 0 and m == 0 else 0 * column[0]
                curves.append(Curve(np.append(base, column), level))
        panels.append(Panel(("shape", None), None, curves, f"mode {m + 1}"))
    return panels, None


def pseudo_acceleration(time, ground, period):
    """Of 5 % damped oscillators under grounds, a row each, that are straight between the rows and
    then at rest: steps of the closed form, so short that peaks are missed by (w dt)^2 / 8 < 1e-4."""
    zeta, w = 0.05, 2 * np.pi / period
    parts = int(np.ceil((time[1] - time[0]) * w.max() / 0.025))
    wd, dt = w * np.sqrt(1 - zeta**2), (time[1] - time[0]) / parts

    def free(u, v, t):
        decay, cos, sin = np.exp(-zeta * w * t), np.cos(wd * t), np.sin(wd * t) / wd
        return (decay * (u * cos + (v + zeta * w * u) * sin),
                decay * (v * cos - (w**2 * u + zeta * w * v) * sin))

    at = np.arange((time.size - 1) * parts + 1) / parts
    fine = np.array([np.interp(at, np.arange(time.size), g) for g in ground])[:, :, None]
    u = v = most = np.zeros((len(ground), period.size))
    for i in range(at.size - 1):
        c = -(fine[:, i + 1] - fine[:, i]) / dt / w**2  # u = b + c t and a free vibration
        b = -(fine[:, i] + 2 * zeta * w * c) / w**2
        u, v = free(u - b, v - c, dt)
        u, v = u + b + c * dt, v + c
        most = np.maximum(most, np.abs(u))
    for t in np.linspace(0, 1, 400):
        most = np.maximum(most, np.abs(free(u, v, t * 2 * np.pi / w)[0]))
    return w**2 * most


def spectrum(runs):
    r = runs[0]
    second = {"s": 1, "ms": 1000}[r.f.attrs["unit_time"]]
    period = second * 0.02 * 250 ** (np.arange(100) / 99)
    left, left_floor, right, right_floor = r.contacts[r.hardest()]
    sides = [(left, left_floor), (right, right_floor)]
    sides += [(side, r.buildings[side]["floor"].size) for side, _ in sides if side in r.buildings]
    sides = [side for side in dict.fromkeys(sides) if side[0] in r.buildings]
    grounds = [side for side in (left, right) if any(run.ground(side).any() for run in runs)]
    if all(np.array_equal(run.ground(left), run.ground(right)) for run in runs):
        grounds = grounds[:1]
    curves = []
    for run in runs:
        dt = run.time[1] - run.time[0]
        even = np.abs(run.time - dt * np.arange(run.time.size)) < 1e-6 * dt
        ground = [run.history(*side, "acceleration")[even] for side in sides]
        ground += [run.ground(side)[even] for side in grounds]
        names = [side_text(*side) for side in sides]
        names += [f"{side}, ground" if len(grounds) > 1 else "ground" for side in grounds]
        for text, values in zip(names, pseudo_acceleration(run.time[even], ground, period)):
            curves.append(Curve(period, values, legend=text, digits=2e-4))
    unit = r.unit(f"buildings/{sides[0][0]}/acceleration")
    return ([Panel(("period", r.unit("time")), ("pseudo-acceleration", unit), curves)],
            ("of rows every {} " + r.unit("time"), [r.time[1] - r.time[0]]))


KINDS = {f.__name__: f for f in (histories, contact, loops, profiles, energy, impacts, modes,
                                 spectrum)}
CHECKS = {"energy": check_energy, "impacts": check_impacts, "profiles": check_profiles}


def main(script, *results):
    runs = [Run(path) for path in results]
    for run, path in zip(runs, results):
        run.name, run.several = os.path.basename(path)[:-3], len(runs) > 1
        run.first = run is runs[0]
    kind = os.path.basename(script)[:-3]
    picture = Picture(script)
    panels, text = KINDS[kind](runs)
    check_panels(picture, panels)
    if kind in CHECKS:
        CHECKS[kind](picture, runs)
    if text:
        check_text(picture.texts[1], *text)


if __name__ == "__main__":
    run_check(main)
