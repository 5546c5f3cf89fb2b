#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The buildings of tests/peers/models by OpenSeesPy, whose models are written here by hand from
nodes, elements and materials. Both programs take the same Newmark steps. Prints the rows of
buildings.tsv: model, building, floor, time [s], displacement [m].
tests/verification/buildings.sh runs the same by jostle. From the project's folder, where
OpenSeesPy is installed:

    python3 tests/peers/buildings.py >tests/peers/buildings.tsv
"""
import datetime

import openseespy.opensees as ops

STEP, EVERY, DURATION = 0.5e-3, 200, 5.0  # s, steps between two samples, s
MODULUS = 30e6  # kN/m2

tags = {}


def tag(kind):
    """The next number of a kind of objects."""
    tags[kind] = tags.get(kind, 0) + 1
    return tags[kind]


def node(x, y, fixed=(0, 0, 0)):
    """A node, and the directions in which it is held."""
    number = tag("node")
    ops.node(number, float(x), float(y))
    if any(fixed):
        ops.fix(number, *fixed)
    return number


def spring(left, right, material, direction=1, damped=True):
    """A material between two nodes."""
    options = ["-doRayleigh", 1] if damped else []
    ops.element("zeroLength", tag("element"), left, right, "-mat", material, "-dir", direction,
                *options)


def elastic(k, dashpot=0.0):
    """A spring with a dashpot beside it."""
    number = tag("material")
    ops.uniaxialMaterial("Elastic", number, k, dashpot)
    return number


def yielding(k, force, hardening):
    """A bilinear spring."""
    number = tag("material")
    ops.uniaxialMaterial("Steel01", number, force, k, hardening)
    return number


def beam(lower, upper, inertia, area=1e6, transformation=1):
    ops.element("elasticBeamColumn", tag("element"), lower, upper, area, MODULUS, inertia,
                transformation)


def contact(left, right, gap, k):
    """A linear contact: OpenSees shortens the material between the nodes as they approach."""
    number = tag("material")
    ops.uniaxialMaterial("ElasticPPGap", number, k, -1e20, -gap)
    spring(left, right, number, damped=False)


def shear_building(storeys, masses, held=None):
    """Nodes that only move sideways, with a material in each storey. Base first."""
    base = held if held is not None else node(0, 0, (1, 1, 1))
    floors = [base]
    for material, mass in zip(storeys, masses):
        floor = node(0, 0, (0, 1, 1))
        ops.mass(floor, mass, 0, 0)
        spring(floors[-1], floor, material)
        floors.append(floor)
    return floors


def frame(widths, heights, columns, beams, mass, base=None, transformation=1):
    """A frame; columns are (I, A) of each storey, beams I of each floor. Gives the nodes of its
    floors from left to right, the floor at the ground first. A floor moves as a whole."""
    x = [sum(widths[:i]) for i in range(len(widths) + 1)]
    lines = [node(at, 0, (1, 1, 0 if base else 1)) for at in x]
    if base:
        for foot in lines:
            ground = node(0, 0, (1, 1, 1))
            spring(ground, foot, elastic(base), 6)
    floors = [lines]
    for storey, height in enumerate(heights):
        y = sum(heights[:storey + 1])
        joints = [node(at, y) for at in x]
        ops.mass(joints[0], mass, 0, 0)
        for joint in joints[1:]:
            ops.equalDOF(joints[0], joint, 1)
        for lower, upper in zip(floors[-1], joints):
            beam(lower, upper, columns[storey][0], columns[storey][1], transformation)
        for left, right in zip(joints, joints[1:]):
            beam(left, right, beams[storey])
        floors.append(joints)
    return floors


def hinged(joint, floor, material):
    """A node that turns against a joint by a hinge. It moves sideways with the first node of its
    floor, as a constraint must not follow from another one, and is held vertically by a spring that
    is ten million times as stiff as a column. Without a floor both are held."""
    end = node(*ops.nodeCoord(joint), fixed=(0, 0, 0) if floor else (1, 1, 0))
    if floor:
        ops.equalDOF(floor, end, 1)
        spring(joint, end, elastic(1e13), 2, damped=False)
    spring(joint, end, material, 6, damped=False)
    return end


def hinges():
    """A frame of steel; hinges stand between its joints and its beams, and below its columns."""
    global MODULUS
    concrete, MODULUS = MODULUS, 200e6
    heights = [4, 3.2, 3.2]
    x = [0, 6, 11]
    floors = [[hinged(node(at, 0, (1, 1, 1)), None, yielding(800e3, 400, 0.03)) for at in x]]
    for storey, height in enumerate(heights):
        joints = [node(at, sum(heights[:storey + 1])) for at in x]
        ops.mass(joints[0], 90, 0, 0)
        for joint in joints[1:]:
            ops.equalDOF(joints[0], joint, 1)
        for lower, upper in zip(floors[-1], joints):
            beam(lower, upper, 4e-4, 0.02)
        for left, right in zip(joints, joints[1:]):
            beam(hinged(left, joints[0], yielding(600e3, 300, 0.03)),
                 hinged(right, joints[0], yielding(600e3, 300, 0.03)), 3e-4)
        floors.append(joints)
    MODULUS = concrete
    b = shear_building([elastic(60e3)] * 2, 2 * [70])
    for left, right in zip(floors[1:], b[1:]):
        contact(left[0], right, 0.020, 500e3)
    ops.rayleigh(0.4, 0, 0, 0)
    return [floor[0] for floor in floors], b, (4.0, 1.1)


def frames():
    column = 2 * [(5.2e-3, 0.25)] + 2 * [(2.1e-3, 0.16)]
    a = frame([6, 5], [4, 3.2, 3.2, 3.2], column, 4 * [3.6e-3], 90)
    b = frame([5], [4, 3.2, 3.2], 3 * [(5.2e-3, 0.25)], 3 * [4.5e-3], 70)
    for left, right in zip(a[1:], b[1:]):
        contact(left[0], right[0], 0.010, 500e3)
    ops.rayleigh(0.4, 0, 0.002, 0)
    return [floor[0] for floor in a], [floor[0] for floor in b], (1.0, 1.3)


def wall():
    a = frame([6], 4 * [3.2], 4 * [(2.1e-3, 0.16)], 4 * [3.6e-3], 120, base=3e6)
    lower = node(0, 0, (1, 1, 0))
    spring(node(0, 0, (1, 1, 1)), lower, elastic(3e6), 6)
    shear_modulus, area = MODULUS / 2.4, 8e6 / (MODULUS / 2.4)
    for floor, joints in enumerate(a[1:], 1):
        upper = node(0, 3.2 * floor)
        ops.equalDOF(joints[0], upper, 1)
        ops.element("ElasticTimoshenkoBeam", tag("element"), lower, upper, MODULUS, shear_modulus,
                    1e6, 20e6 / MODULUS, area, 1)
        lower = upper
    b = shear_building([elastic(k) for k in (90e3, 80e3, 70e3)], 3 * [80])
    for left, right in zip(a[1:], b[1:]):
        contact(left[0], right, 0.010, 500e3)
    ops.rayleigh(0.4, 0, 0.002, 0)
    return [floor[0] for floor in a], b, (4.0, 1.6)


def pdelta():
    """Weights stand on the joints of the left line, before the motion begins."""
    a = frame([6, 5], [4, 3.2, 3.2], 3 * [(2.1e-3, 0.16)], 3 * [2.6e-3], 90, transformation=2)
    ops.timeSeries("Constant", 10)
    ops.pattern("Plain", 10, 10)
    for floor, load in zip(a[1:], (2400, 2100, 1700)):
        for joint in floor:
            ops.load(joint, 0, -load / len(floor), 0)
    b = shear_building([elastic(60e3)] * 2, 2 * [70])
    for left, right in zip(a[1:], b[1:]):
        contact(left[0], right, 0.020, 500e3)
    ops.rayleigh(0.4, 0, 0.002, 0)
    return [floor[0] for floor in a], b, (1.0, 0.8)


def column():
    """The struck column is made of two members. The springs of its storey are those of the others."""
    inertia, height, level = 60e3 / MODULUS, 3.5, 5.3 - 3.5
    one_column = 12 * MODULUS * inertia / height**3
    a = shear_building([elastic(40e3)], [200])
    b = shear_building([elastic(k) for k in (200e3, 180e3 - one_column, 160e3)], 3 * [300])
    ends = [node(0, y, (0, 1, 1)) for y in (height, 2 * height)]
    point = node(0, height + level, (0, 1, 0))
    ops.mass(point, 0.6, 0, 0)
    for floor, end in zip(b[1:], ends):
        ops.equalDOF(floor, end, 1)
    beam(ends[0], point, inertia)
    beam(point, ends[1], inertia)
    contact(a[1], point, 0.010, 200e3)
    ops.region(1, "-node", *a[1:], *b[1:], "-rayleigh", 0.4, 0, 0, 0)
    return a, b, (4.0, 2.2)


def founded(storeys, mass, slab, sway, rocking):
    """A shear building whose floors all turn with the slab below them; its storeys are beams that
    end without a rotation of their own. Slab: mass and inertia; springs: k and c."""
    height = 3.2
    ground, base = node(0, 0, (1, 1, 1)), node(0, 0, (0, 1, 0))
    ops.mass(base, slab[0], 0, slab[1])
    spring(ground, base, elastic(*sway), 1, damped=False)
    spring(ground, base, elastic(*rocking), 6, damped=False)
    floors = [base]
    for number, k in enumerate(storeys, 1):
        floor = node(0, height * number, (0, 1, 0))
        ops.mass(floor, mass, 0, 0)
        ops.equalDOF(base, floor, 3)
        beam(floors[-1], floor, k * height**3 / (12 * MODULUS))
        floors.append(floor)
    return floors


def foundations():
    a = founded((240e3, 220e3, 180e3, 140e3), 120, (150, 4000), (600e3, 6e3), (12e6, 60e3))
    b = founded((360e3, 320e3, 260e3), 90, (120, 3000), (800e3, 7e3), (16e6, 70e3))
    for left, right in zip(a[1:], b[1:]):
        contact(left, right, 0.010, 500e3)
    ops.rayleigh(0, 0, 0.002, 0)
    return a, b, (4.0, 1.5)


def storeys():
    a = shear_building([yielding(*row) for row in
                        ((80e3, 700, 0.05), (70e3, 600, 0.05), (60e3, 400, 0.05))], 3 * [100])
    b = shear_building([yielding(160e3, force, 0.02) for force in (900, 600)], 2 * [120])
    for left, right in zip(a[1:], b[1:]):
        contact(left, right, 0.010, 500e3)
    ops.rayleigh(0.4, 0, 0.001, 0)
    return a, b, (4.0, 1.5)


def solver(integrator):
    ops.wipeAnalysis()
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-13, 100)
    ops.algorithm("Newton")
    ops.integrator(*integrator)


def run(model):
    ops.wipe()
    tags.clear()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    ops.geomTransf("PDelta", 2)
    a, b, (amplitude, frequency) = model()
    solver(("LoadControl", 1.0))
    ops.analysis("Static")
    if ops.analyze(1) != 0:
        raise RuntimeError("OpenSees did not find the equilibrium under weights")
    ops.loadConst("-time", 0.0)
    ops.timeSeries("Trig", 1, 0.0, 5 / frequency, 1 / frequency, "-factor", amplitude)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    solver(("Newmark", 0.5, 0.25))
    ops.analysis("Transient")
    for step in range(1, round(DURATION / STEP) + 1):
        if ops.analyze(1, STEP) != 0:
            raise RuntimeError(f"OpenSees did not converge in {model.__name__}")
        if step % EVERY:
            continue
        for building, floors in (("A", a), ("B", b)):
            for number, floor in enumerate(floors[1:], 1):
                print(model.__name__, building, number, f"{step * STEP:g}",
                      f"{ops.nodeDisp(floor, 1):.12g}", sep="\t")


def main():
    print(f"# OpenSees {ops.version()}, {datetime.date.today()}")
    for model in (frames, wall, pdelta, column, foundations, storeys, hinges):
        run(model)


if __name__ == "__main__":
    main()
