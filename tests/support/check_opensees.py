#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a script of OpenSeesPy without OpenSees.

    check_opensees.py commands SCRIPT   prints its commands, a line each, with arguments in tabs
    check_opensees.py periods SCRIPT    prints the periods of its nodes, elements and materials [T],
                                        the longest first: linear, without contacts
"""
import sys
import types

import numpy as np

commands = []
SHIFT = 3  # directions of a node


class Recorder(types.ModuleType):
    """In place of openseespy.opensees: notes each command."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)

        def command(*words):
            commands.append((name, *words))
            return 0

        return command


def initial(materials, words):
    """The initial tangent of a material; 0: a gap, or a damper."""
    kind, _, *number = words
    if kind in ("Elastic", "ElasticPP", "SelfCentering"):
        return number[0]
    if kind == "Steel01":
        return number[1]
    if kind in ("BoucWen",):
        return number[1]
    if kind == "Hysteretic":
        return number[0] / number[1]
    if kind == "Parallel":
        return sum(materials[tag] for tag in number)
    return 0.0


def beam(start, end, ea, ei, ga):
    """The stiffness of a member on (u, v, turn) of both ends."""
    along = np.subtract(end, start)
    length = np.hypot(*along)
    c, s = along / length
    phi = 12.0 * ei / (ga * length**2) if ga else 0.0
    a, b = ea / length, ei / length**3 / (1.0 + phi)
    local = np.zeros((6, 6))
    local[np.ix_([0, 3], [0, 3])] = a * np.array([[1, -1], [-1, 1]])
    bend = b * np.array([
        [12, 6 * length, -12, 6 * length],
        [6 * length, (4 + phi) * length**2, -6 * length, (2 - phi) * length**2],
        [-12, -6 * length, 12, -6 * length],
        [6 * length, (2 - phi) * length**2, -6 * length, (4 + phi) * length**2]])
    local[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = bend
    turn = np.kron(np.eye(2), np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
    return turn.T @ local @ turn


class Model:
    def __init__(self):
        self.place, self.mass, self.free, self.materials = {}, {}, {}, {}
        self.master = {}
        self.parts = []

    def take(self, name, *words):
        if name == "node":
            self.place[words[0]] = words[1:]
        elif name == "mass":
            self.mass[words[0]] = words[1]
        elif name == "fix":
            for i, held in enumerate(words[1:]):
                self.free[words[0], i] = not held
        elif name == "equalDOF":
            self.master[words[1], words[2] - 1] = (words[0], words[2] - 1)
        elif name == "uniaxialMaterial":
            self.materials[words[1]] = initial(self.materials, words)
        elif name == "element":
            self.element(*words)

    def element(self, kind, _, i, j, *rest):
        if kind == "zeroLength":
            direction = {1: 0, 2: 1, 6: 2}[rest[3]]
            k = self.materials[rest[1]]
            self.parts.append(([(i, direction), (j, direction)],
                               k * np.array([[1.0, -1.0], [-1.0, 1.0]])))
            return
        if kind == "elasticBeamColumn":
            area, modulus, inertia, _ = rest
            ea, ei, ga = area * modulus, modulus * inertia, 0.0
        else:
            modulus, shear, area, inertia, sheared, _ = rest
            ea, ei, ga = area * modulus, modulus * inertia, shear * sheared
        where = [(node, direction) for node in (i, j) for direction in range(SHIFT)]
        self.parts.append((where, beam(self.place[i], self.place[j], ea, ei, ga)))

    def periods(self):
        unknown = {}
        for node in self.place:
            for direction in range(SHIFT):
                at = (node, direction)
                if self.free.get(at, True) and at not in self.master:
                    unknown[at] = len(unknown)
        k = np.zeros((len(unknown), len(unknown)))
        for where, part in self.parts:
            index = [unknown.get(self.master.get(at, at), -1) for at in where]
            for p, row in enumerate(index):
                for q, column in enumerate(index):
                    if row >= 0 and column >= 0:
                        k[row, column] += part[p, q]
        heavy = [i for (node, direction), i in unknown.items()
                 if direction == 0 and self.mass.get(node)]
        mass = np.array([self.mass[node] for (node, direction), i in unknown.items()
                         if i in heavy])
        light = [i for i in range(len(unknown)) if i not in heavy]
        k = k[np.ix_(heavy, heavy)] - k[np.ix_(heavy, light)] @ np.linalg.solve(
            k[np.ix_(light, light)], k[np.ix_(light, heavy)]) if light else k
        omega2 = np.linalg.eigvalsh(k / np.sqrt(np.outer(mass, mass)))
        return sorted((2.0 * np.pi / np.sqrt(omega2)), reverse=True)


def main():
    what, path = sys.argv[1:]
    sys.modules["openseespy"] = types.ModuleType("openseespy")
    sys.modules["openseespy"].opensees = Recorder("openseespy.opensees")
    sys.modules["openseespy.opensees"] = sys.modules["openseespy"].opensees
    with open(path, encoding="utf-8") as script:
        exec(compile(script.read(), path, "exec"), {})  # pylint: disable=exec-used
    if what == "commands":
        for command in commands:
            print(*command, sep="\t")
        return
    model = Model()
    for command in commands:
        model.take(*command)
    for period in model.periods():
        print(f"{period:.12g}")


if __name__ == "__main__":
    main()
