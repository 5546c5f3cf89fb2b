#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks result files of jostle: layout, units, names, dimension scales, order.

usage: check_result.py FILE.h5 ...      exit status 0: all good, 1: faults, 77: no h5py
Where xarray can be imported, every group (of many, the first and the last)
must open with its dimensions and coordinates.
"""
import re
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

ROOT = ("format format_version title status program version deck_file deck parameters unit_force "
        "unit_length unit_time command_line created steps newton_iterations wall_seconds").split()
YIELDING = "residual_drift ductility hysteretic deterioration damage".split()
PEAKS = "displacement velocity acceleration drift storey_shear".split()
ENERGY = "input kinetic strain damping hysteretic contact residual".split()
CONTACT = "name left right law left_floor right_floor gap".split()
CONTACT_ENVELOPE = "force force_time penetration impulse impacts dissipated".split()
# Powers of force, length and time of what is measured, by the names of the datasets; in the group
# energy all is energy, in ground all is acceleration, a name that ends in _time is a time, and what
# is not named here is a plain number, a name or a text.
POWERS = {
    (1, 0, 0): "force peak_force storey_shear shear axial V N shear_below shear_above "
               "gravity_load sway_force",
    (0, 1, 0): "displacement drift residual_drift residual_deformation collapse_drift penetration "
               "max_penetration deformation gap height left_level right_level sway",
    (0, 0, 1): "time period t_start t_end duration step",
    (0, 1, -1): "velocity v_approach v_rebound",
    (0, 1, -2): "acceleration",
    (1, -1, 0): "stiffness",
    (1, -1, 2): "mass effective_mass",
    (1, 0, 1): "impulse",
    (1, 1, 0): "dissipated hysteretic work moment M_i M_j moment_below moment_point moment_above "
               "rocking_moment",
}
POWERS = {name: powers for powers, names in POWERS.items() for name in names.split()}
GROUPS_MAX = 12  # xarray reads the whole file anew for each group: only the first and last ones
IMPACT = ("contact t_start t_end v_approach v_rebound peak_force max_penetration impulse "
          "dissipated").split()


class Checker:
    def __init__(self, path):
        self.path = path
        self.faults = 0

    def expect(self, good, text):
        if not good:
            self.faults += 1
            print(f"{self.path}: {text}", file=sys.stderr)
        return good

    def dataset(self, group, name, dims):
        """The dataset exists, has these dimensions in this order, and says what it is."""
        where = f"{group.name}/{name}"
        if not self.expect(name in group, f"{where} is missing"):
            return None
        d = group[name]
        self.expect(d.ndim == len(dims), f"{where} has {d.ndim} dimensions, not {len(dims)}")
        for i, scale in enumerate(dims[:d.ndim]):
            keys = [s.name.split("/")[-1] for s in d.dims[i].values()]
            if not h5py.h5ds.is_scale(d.id):
                self.expect(keys == [scale], f"{where} has scales {keys} on dimension {i}")
                for s in d.dims[i].values():
                    self.expect(s.shape == (d.shape[i],), f"{where}: scale {scale} has another size")
                    self.expect(h5py.h5ds.is_attached(d.id, s.id, i),
                                f"{where} is not in the list of its scale {scale}")
        for attribute in ("units", "long_name"):
            text = d.attrs.get(attribute)
            self.expect(isinstance(text, str) and text, f"{where} has no {attribute}")
        return d

    def times(self, f):
        time = self.dataset(f, "time", ["time"])
        if time is None:
            return
        t = time[:]
        self.expect(h5py.h5ds.is_scale(time.id), "/time is no dimension scale")
        self.expect(time.dtype == np.float64, "/time is not of double precision")
        self.expect(t.size > 0 and t[0] == 0, "/time does not start at 0")
        self.expect(np.all(np.diff(t) > 0), "/time does not rise")

    def buildings(self, f):
        positions = []
        for name, group in f["buildings"].items():
            positions.append(int(group.attrs["position"]))
            floor = self.dataset(group, "floor", ["floor"])
            self.expect(list(floor[:]) == list(range(1, floor.size + 1)), f"{name}: floors")
            for key in ("mass", "stiffness", "height", "period"):
                self.dataset(group, key, ["floor"])
            if "residual_drift" in group["envelope"]:
                for key in YIELDING:
                    self.dataset(group["envelope"], key, ["floor"])
            for key in PEAKS:
                peak = self.dataset(group["envelope"], key, ["floor"])
                self.dataset(group["envelope"], key + "_time", ["floor"])
                if key in group:
                    d = self.dataset(group, key, ["time", "floor"])
                    rows = np.abs(d[:]).max(axis=0)
                    self.expect(np.all(np.isfinite(rows)), f"{d.name} has rows not written")
                    close = peak[:] * (1 + 1e-6) + 1e-300
                    self.expect(np.all(rows <= close), f"{d.name} exceeds its envelope")
            self.dataset(f["ground"], name, ["time"])
        self.expect(sorted(positions) == list(range(len(positions))), "positions of buildings")

    def contacts(self, f):
        group = f["contacts"]
        self.dataset(group, "contact", ["contact"])
        for key in CONTACT:
            self.dataset(group, key, ["contact"])
        for key in ("force", "penetration"):
            if key in group:
                self.dataset(group, key, ["time", "contact"])
        for key in CONTACT_ENVELOPE:
            self.dataset(group["envelope"], key, ["contact"])
        if "links" in f:
            self.dataset(f["links"], "link", ["link"])
            for key in CONTACT:
                self.dataset(f["links"], key, ["link"])

    def impacts(self, f):
        group = f["impacts"]
        self.dataset(group, "impact", ["impact"])
        for key in IMPACT:
            self.dataset(group, key, ["impact"])
        start, contact = group["t_start"][:], group["contact"][:]
        n_contact = f["contacts/contact"].size
        self.expect(np.all(np.diff(start) >= 0), "impacts are not in order of time")
        self.expect(np.all(group["t_end"][:] >= start), "an impact ends before it starts")
        self.expect(np.all((contact >= 1) & (contact <= n_contact)), "/impacts/contact")
        hits = np.bincount(contact, minlength=n_contact + 1)[1:]
        self.expect(np.array_equal(hits, f["contacts/envelope/impacts"][:]),
                    "impacts and /contacts/envelope/impacts differ")

    def powers(self, path):
        """The powers of force, length and time of a dataset, by its place."""
        *groups, name = path.split("/")
        if name == "time" or name.endswith("_time"):
            return (0, 0, 1)
        if groups and groups[-1] in ("energy", "ground"):
            return (1, 1, 0) if groups[-1] == "energy" else (0, 1, -2)
        return POWERS.get(re.sub("_(max|min)$", "", name), (0, 0, 0))

    def units(self, f):
        """All is in the units of force, length and time that the file names; sweeps are in theirs."""
        base = [f.attrs["unit_" + name] for name in ("force", "length", "time")]
        unit = dict(zip(base, ((1, 0, 0), (0, 1, 0), (0, 0, 1))))
        swept = list(f["sweep"]) if "sweep" in f else []

        def read(text):
            powers = np.zeros(3)
            for sign, name, power in re.findall(r"([*/]?)([^*/^]+)\^?(\d*)", text):
                times = int(power or 1) * (-1 if sign == "/" else 1)
                powers += times * np.array(unit.get(name, (1, -1, 2)))  # others name a mass
            return tuple(powers) if text != "1" else (0, 0, 0)

        def visit(path, item):
            if isinstance(item, h5py.Dataset) and path.split("/")[-1] not in swept:
                text = item.attrs.get("units", "")
                self.expect(read(text) == self.powers(path), f"/{path} is in '{text}'")

        f.visititems(visit)

    def hdf5(self):
        with h5py.File(self.path, "r") as f:
            self.units(f)
            if "sweep" in f:
                return []
            for key in ROOT:
                self.expect(key in f.attrs, f"attribute {key} is missing")
            self.expect(f.attrs["format"] == "jostle", "format is not jostle")
            self.expect(f.attrs["status"] == "complete", "status is not complete")
            self.times(f)
            self.buildings(f)
            self.contacts(f)
            self.impacts(f)
            for key in ENERGY:
                self.dataset(f["energy"], key, ["time"])
            names = ["/"]
            f.visititems(lambda n, o: names.append("/" + n) if isinstance(o, h5py.Group) else None)
            return names

    def xarray(self, groups):
        try:
            import xarray
        except ImportError:
            return
        for engine in xarray.backends.list_engines():
            if engine not in ("h5netcdf", "netcdf4"):
                continue
            for group in groups[:GROUPS_MAX] + groups[GROUPS_MAX:][-GROUPS_MAX:]:
                with xarray.open_dataset(self.path, group=group, engine=engine) as d:
                    d.load()
                    for dim in d.sizes:
                        where = f"{engine}: {group}: dimension {dim}"
                        self.expect(not dim.startswith("phony"), where + " has no name")
                        self.expect(dim in d.coords, where + " has no coordinates")


def main(paths):
    faults = 0
    for path in paths:
        checker = Checker(path)
        checker.xarray(checker.hdf5())
        faults += checker.faults
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
