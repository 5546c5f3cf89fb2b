# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a script and its data as gnuplot does: what each curve of each panel is drawn through, what
the numbers and names of the axes say of it, and the legend. Compares that with what is wanted.
"""
import re
import sys

import numpy as np

RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
TEXT = r"'((?:[^']|'')*)'"
DIGITS = 1e-6  # of the largest value: the data has seven digits
TEXT_DIGITS = 6e-4  # texts have four, and a last one that is rounded


def power_of(text):
    """1000 of '10³'."""
    return 10.0 ** int(text[2:].translate(RAISED))


def number_of(text):
    """A number of a text, '4.417·10⁶'."""
    value, _, power = text.partition("·")
    return float(value) * (power_of(power) if power else 1)


def size_in_g(unit):
    """Of a unit of acceleration, such as mm/s²."""
    length, time = unit.removesuffix("²").split("/")
    metres = {"m": 1, "mm": 1e-3, "cm": 1e-2, "in": 0.0254, "ft": 0.3048}[length]
    return metres / {"s": 1, "ms": 1e-3}[time] ** 2 / 9.80665


class Axis:
    """`name [10³ unit]` or `name [unit = 0.102 g]`, and the tics ('text', place) where they are
    listed."""

    def __init__(self):
        self.label, self.tics, self.span, self.logarithmic = None, None, None, False

    def read_label(self):
        part = re.fullmatch(r"(.*?)(?: \[(10[⁻⁰¹²³⁴-⁹]+)? ?(.*?)(?: = (\S+) g)?\])?",
                            self.label or "")
        self.name, power, self.unit, in_g = part.groups()
        scale = power_of(power) if power else 1
        assert not in_g or abs(float(in_g) / (scale * size_in_g(self.unit)) - 1) < 5e-3, self.label
        self.power = scale
        # Listed tics stand at the places of the values; otherwise the values themselves are drawn
        # in the power of ten.
        self.factor = self.power if self.tics is None else 1


class Drawn:
    def __init__(self, block, columns, style):
        self.block, self.columns, self.style = block, columns, style
        colour = re.search(r"rgb '(#\w+)'", style)
        self.colour = colour.group(1) if colour else None


class DrawnPanel:
    def __init__(self):
        self.limits = []
        self.x, self.y, self.curves, self.texts = Axis(), Axis(), [], []


class Picture:
    def __init__(self, script):
        self.blocks = self.read_data(script[:-3] + ".dat")
        self.texts, self.legend, self.panels = [], {}, []
        self.upright = None  # the name of an axis that several panels share
        self.point, self.mark, self.panel = 1, None, None
        with open(script, encoding="utf-8") as f:
            for line in f.read().replace("\\\n", " ").split("\n"):
                self.read_line(line)
        for panel in self.panels:
            panel.y.label = panel.y.label or self.upright
            panel.x.read_label()
            panel.y.read_label()

    @staticmethod
    def read_data(path):
        blocks, rows = {}, None
        with open(path, encoding="utf-8") as f:
            for line in f:
                if line.startswith("$"):
                    assert line.split()[0] not in blocks, f"two blocks {line}"
                    rows = blocks[line.split()[0]] = []
                elif line.strip() == "EOD":
                    rows = None
                elif rows is not None and line.strip() and not line.startswith("#"):
                    rows.append([float(word) for word in line.split()])
        return {name: np.array(rows) for name, rows in blocks.items()}

    def read_line(self, line):
        if line == "unset logscale":
            self.panel = DrawnPanel()
            self.panels.append(self.panel)
        elif line.startswith("point = "):
            self.point = float(line[8:])
        elif line.startswith("set label"):
            self.read_text(line)
        elif re.match("set (arrow|object)", line) and not self.panel:
            self.mark = (re.search(r"rgb '(#\w+)'", line).group(1), 0)
        elif limit := re.match(r"set arrow from first ([-+.\de]+), graph 0", line):
            self.panel.limits.append(float(limit.group(1)))
        elif line.startswith("plot"):
            self.read_plot(line[4:])
        elif self.panel and (scale := re.match(r"set ([xy])(range|tics) (?!rot|norot)(.*)", line)):
            self.read_scale(getattr(self.panel, scale.group(1)), *scale.groups()[1:])
        elif self.panel and line.startswith("set logscale"):
            getattr(self.panel, line[-1]).logarithmic = True

    def read_text(self, line):
        text = re.match("set label " + TEXT, line).group(1).replace("''", "'")
        upright = re.search(" rotate by 90( font small_font)?$", line)
        if not text:
            mark = re.search(r"ps ([\d.]+)\*point lc rgb '(#\w+)'", line)
            self.mark = (mark.group(2), float(mark.group(1))) if mark else None
        elif upright and self.panel:
            label = self.panel.y.label
            self.panel.y.label = f"{label} {text}" if label else text
        elif upright:
            self.upright = f"{self.upright} {text}" if self.upright else text
        elif self.panel and re.search(" center( font small_font)?$", line):
            self.panel.x.label = text
        elif self.panel:
            self.panel.texts.append(text)
        elif self.mark:
            self.legend[text], self.mark = self.mark, None
        else:
            self.texts.append(text)

    @staticmethod
    def read_scale(axis, what, text):
        if what == "range":
            axis.span = [float(end) for end in text[1:-1].split(":")]
        elif text.startswith("("):
            axis.tics = [(label, float(place))
                         for label, place in re.findall(TEXT + r" ([-+.\de]+)", text)]

    def read_plot(self, text):
        for block, using, style in re.findall(r"(\$\w+) using (\S+) with (.*?)(?=, +\$|$)", text):
            rows = self.blocks[block]
            columns = [self.evaluate(word, rows) for word in using.split(":")]
            values = np.array(np.broadcast_arrays(*columns), dtype=float).T
            self.panel.curves.append(Drawn(block, values[~np.isnan(values).any(axis=1)], style))

    def evaluate(self, word, rows):
        if word.isdigit():
            return rows[:, int(word) - 1] if rows.size else np.zeros(0)
        words = re.sub(r"\$(\d+)", r"rows[:, \1 - 1]", word)
        return eval(words, {"rows": rows, "point": self.point})  # pylint: disable=eval-used


# --- what is wanted ------------------------------------------------------------------------------


class Curve:
    """Rows of numbers; `thinned` ones may be fewer, but keep the extremes and the ends."""

    def __init__(self, *columns, thinned=False, legend=None, digits=DIGITS):
        rows = np.array(np.broadcast_arrays(*columns), dtype=float).T
        self.rows = rows[~np.isnan(rows).any(axis=1)]
        self.thinned, self.legend, self.digits = thinned, legend, digits


class Panel:
    """Names of axes with their units; None: not told here."""

    def __init__(self, x, y, curves, text=None):
        self.x, self.y, self.curves, self.text = x, y, curves, text


# --- comparison ----------------------------------------------------------------------------------


def same(got, want, digits, where):
    assert got.shape == want.shape, f"{where}: {got.shape} numbers, not {want.shape}"
    scale = np.abs(want).max(axis=0, initial=1e-300)
    off = np.abs(got - want) / scale
    assert not got.size or off.max() <= digits, (
        f"{where}: {got[np.argmax(off.max(axis=1))]}, not {want[np.argmax(off.max(axis=1))]}")


def same_thinned(got, want, where):
    """Each row is one of those wanted, and what must be kept is there."""
    scale = np.abs(want).max(axis=0, initial=1e-300)
    for row in got:
        off = np.abs(want - row).max(axis=1) if scale.max() == 0 else (
            np.abs(want - row) / np.maximum(scale, 1e-300)).max(axis=1)
        assert off.min() <= DIGITS, f"{where}: {row}; the nearest is {want[np.argmin(off)]}"
    for keep in (np.min, np.max):
        same(keep(got, axis=0)[None], keep(want, axis=0)[None], DIGITS, where)
    same(got[[0, -1]], want[[0, -1]], DIGITS, where)


def check_axis(axis, want, where):
    if want:
        brief = {"acceleration": "accel.", "displacement": "displ.", "storey drift": "drift",
                 "storey shear": "shear"}
        assert axis.name in (want[0], brief.get(want[0])), f"{where}: axis {axis.label}"
        assert (axis.unit or None) == want[1], f"{where}: unit {axis.unit}, not {want[1]}"
    for text, place in axis.tics if axis.tics and axis.name not in ("floor", "") else []:
        assert abs(float(text) * axis.power - place) <= 1e-4 * abs(place), (
            f"{where}: '{text}' of {axis.label} at {place}")


def is_text(got, want):
    """Its middle may be left out."""
    head, dots, tail = got.partition("…")
    return want.startswith(head) and want.endswith(tail) if dots else got == want


def check_panel(got, want, legend, where):
    check_axis(got.x, want.x, where)
    check_axis(got.y, want.y, where)
    assert want.text is None or is_text(got.texts[0], want.text), f"{where}: {got.texts}"
    for curve, other in zip(got.curves, want.curves):
        at = f"{where} {curve.block}"
        columns = curve.columns * ([got.x.factor] + [got.y.factor] * (curve.columns.shape[1] - 1))
        if other.thinned:
            same_thinned(columns, other.rows, at)
        else:
            same(columns, other.rows, other.digits, at)
        if other.legend:
            colour = legend[other.legend][0]
            assert colour in (curve.colour, "#000000"), f"{at}: {colour} of {other.legend}"
        for axis, column in ((got.x, curve.columns[:, 0]), (got.y, curve.columns[:, 1])):
            low, high = axis.span
            room = 1e-3 * (high - low)
            out = column[(column < low - room) | (column > high + room)]
            assert not out.size, f"{at}: {out} leaves the axis {axis.span}"


def check_panels(picture, panels):
    assert len(panels) == len(picture.panels), f"{len(picture.panels)} panels, not {len(panels)}"
    for i, (got, want) in enumerate(zip(picture.panels, panels)):
        n, wanted = len(got.curves), len(want.curves)
        assert n == wanted or not wanted, f"panel {i + 1}: {n} curves, not {wanted}"
        check_panel(got, want, picture.legend, f"panel {i + 1}")


def check_text(text, form, values):
    pattern = re.escape(form).replace(r"\{\}", r"([-+\w.·⁻⁰¹²³⁴-⁹]+)")
    found = re.search(pattern, text)
    assert found, f"'{text}' does not say '{form}'"
    for word, value in zip(found.groups(), values):
        assert abs(number_of(word) - value) <= TEXT_DIGITS * abs(value), f"{word}, not {value}"


def run_check(main):
    """Runs it with the words of the command line; a fault is told, with exit status 1."""
    try:
        main(*sys.argv[1:])
    except (AssertionError, KeyError) as fault:
        print(f"{sys.argv[1]}: {fault}", file=sys.stderr)
        sys.exit(1)
