#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The two towers of Jankowski (2005) by OpenSeesPy, under its impact materials, with Newmark's
average acceleration and two steps. Prints the rows of opensees.tsv: law, quantity, value in SI for
either step.
tests/verification/peers.sh runs the same by jostle. From the project's folder, where OpenSeesPy is
installed:

    python3 tests/peers/opensees.py >tests/peers/opensees.tsv
"""
import datetime
import math

import openseespy.opensees as ops

STEPS = (10e-6, 2.5e-6)
DURATION = 6.0
GAP = 0.011
G = 9.80665
MASS = (204.0, 146.5)
FREQUENCY = (2.31, 2.90)
RATIO = (0.014, 0.016)
RECORD = "input/records/ELCENTRO_1940_NS.AT2"
EFFECTIVE = MASS[0] * MASS[1] / sum(MASS)

# Law of jostle, material of OpenSees and its parameters. Stiffnesses are positive, gaps negative.
# The parameter of Hertzdamp is q = zeta v0 / k.
LAWS = {
    "jankowski": ("JankowskiImpact", 9.9e10, 0.35, EFFECTIVE, -GAP, 1.5),
    "hertz-damp": ("Hertzdamp", 2.36e10, 0.8, -GAP, 1.5),
    "kelvin-voigt": ("ViscoelasticGap", 1.4e9, 2 * 0.14 * math.sqrt(1.4e9 * EFFECTIVE), -GAP),
    "bilinear": ("ImpactMaterial", 1.4e9, 0.2e9, -0.05e-3, -GAP),
}


def record():
    """Values of a PEER file in g."""
    with open(RECORD, encoding="utf-8") as lines:
        return [float(word) for line in list(lines)[4:] for word in line.split()]


def towers(material):
    """Two masses on springs and dashpots, the contact between them, and the ground."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for tower in range(2):
        base, top = 10 + tower, 1 + tower
        omega = 2 * math.pi * FREQUENCY[tower]
        ops.node(base, 0.0)
        ops.node(top, 0.0)
        ops.fix(base, 1)
        ops.mass(top, MASS[tower])
        ops.uniaxialMaterial("Elastic", base, MASS[tower] * omega**2)
        ops.uniaxialMaterial("Viscous", 20 + tower, 2 * RATIO[tower] * MASS[tower] * omega, 1.0)
        ops.element("zeroLength", base, base, top, "-mat", base, "-dir", 1)
        ops.element("zeroLength", 20 + tower, base, top, "-mat", 20 + tower, "-dir", 1)
    ops.uniaxialMaterial(material[0], 30, *material[1:])
    ops.element("zeroLength", 30, 1, 2, "-mat", 30, "-dir", 1)
    ops.timeSeries("Path", 1, "-dt", 0.02, "-values", *record(), "-factor", G)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)


def analyse(step):
    """Peaks of displacement and force, and the count of impacts."""
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-14, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    peak = {"displacement T1": 0.0, "displacement T2": 0.0, "force": 0.0, "impacts": 0}
    was_closed = False
    for _ in range(round(DURATION / step)):
        if ops.analyze(1, step) != 0:
            raise RuntimeError("OpenSees did not converge")
        left, right = ops.nodeDisp(1, 1), ops.nodeDisp(2, 1)
        force = -ops.eleResponse(30, "material", 1, "stress")[0]
        closed = left - right > GAP
        peak["impacts"] += closed and not was_closed
        was_closed = closed
        peak["displacement T1"] = max(peak["displacement T1"], abs(left))
        peak["displacement T2"] = max(peak["displacement T2"], abs(right))
        peak["force"] = max(peak["force"], force)
    return peak


def main():
    print(f"# OpenSees {ops.version()}, {datetime.date.today()}")
    for law, material in LAWS.items():
        peaks = []
        for step in STEPS:
            towers(material)
            peaks.append(analyse(step))
        for quantity in peaks[0]:
            print(law, quantity, *(f"{peak[quantity]:.10g}" for peak in peaks), sep="\t")


if __name__ == "__main__":
    main()
