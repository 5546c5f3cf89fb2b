#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples and tests/peers/models, exported by `jostle export` and run by OpenSeesPy, beside
jostle: the largest difference of a displacement over its peak, by `jostle compare`. Each deck runs
as it is, and with linear contacts, which both programs solve in the same way. Prints the rows of
export.tsv; with --page it puts them into the table of docs/opensees.md. From the project's folder,
by a Python that has OpenSeesPy:

    python3 tests/peers/export.py >tests/peers/export.tsv
    python3 tests/peers/export.py --page
"""
import datetime
import os
import pathlib
import re
import subprocess
import sys
import tempfile

JOSTLE = os.environ.get("JOSTLE", "build/jostle")
DURATION = "6s"
PAGE = pathlib.Path("docs/opensees.md")
SAME = 1e-6

# One run of each study.
ONE_RUN = {
    "collapse": ["record=records/ELCENTRO_1940_NS.AT2", "gap=30mm", "sa=0.5g"],
    "gap_study": ["record=records/ELCENTRO_1940_NS.AT2", "gap=20mm", "pga=3m/s^2"],
    "ida": ["record=records/ELCENTRO_1940_NS.AT2", "sa=0.8g"],
    "monte_carlo": ["record=records/ELCENTRO_1940_NS.AT2", "kA=345MN/m", "kB=345MN/m", "gap=20mm",
                    "e=0.65"],
    "motions": ["record=records/ELCENTRO_1940_NS.AT2", "factor=1", "gap=20mm",
                "C=2MN*s^0.6/m^0.6"],
    "separation": ["record=records/ELCENTRO_1940_NS.AT2"],
    "shaking_table": ["f=2.5Hz"],
    "stripes": ["motion=1"],
}

# Linear contacts of bodies that are too light for that of `linear`.
STIFFNESS = {"girder": "150kN/m", "shaking_table": "1MN/m"}


def run(words, **options):
    """The output of a command, and the time of the processor that it took [s]."""
    before = os.times()
    done = subprocess.run(words, capture_output=True, text=True, check=False, **options)
    after = os.times()
    return done, after.children_user - before.children_user


def linear(text, stiffness):
    """The deck with linear contacts."""
    text = re.sub(r"\\\n\s*", " ", text)

    def contact(match):
        line = match.group(0)
        gap = re.search(r"-gap (.*?)(?= -[a-z]|$)", line).group(1)
        ends = re.match(r"contact (\S+ \S+)", line).group(1)
        return f"contact {ends} -gap {gap} -law linear -k {stiffness}"

    return re.sub(r"^contact .*$", contact, text, flags=re.M)


def deck_of(path, text, scratch):
    """A copy of the deck that finds its records, and is no longer than DURATION."""
    if not re.search(r"^duration", text, flags=re.M):
        text += f"duration {DURATION}\n"
    text = re.sub(r"^output (?!-interval [0-9.]+us).*$", "", text, flags=re.M)
    if "$e" not in text:
        text = re.sub(r"^sweep e .*$", "", text, flags=re.M)
    text = text.replace("records/", f"{path.parent.resolve()}/records/")
    text = re.sub(r"^(include|matrix \S+) (\S+)", rf"\1 {path.parent.resolve()}/\2", text,
                  flags=re.M)
    copy = scratch / path.name
    copy.write_text(text)
    return copy


def compare(path, text, label):
    """Prints a row: deck, contacts, histories, difference, times of both programs, notes."""
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        deck = deck_of(path, text, scratch)
        define = [word for value in ONE_RUN.get(path.stem, [])
                  if re.search(rf"[${{ ]{value.split('=')[0]}\b", re.sub(r"(?m)^sweep.*$", "", text))
                  or f"-as {value.split('=')[0]}" in text
                  for word in ("-D", value.replace("records/", f"{path.parent.resolve()}/records/"))]
        jostle = pathlib.Path(JOSTLE).resolve()
        export, _ = run([jostle, "export", deck, "--opensees", "py", *define])
        if export.returncode:
            raise RuntimeError(export.stderr)
        (scratch / "model.py").write_text(export.stdout)
        own, own_time = run([jostle, "run", deck, *define, "-q", "-o", scratch / "run.h5"])
        if own.returncode:
            raise RuntimeError(own.stderr)
        other, other_time = run([sys.executable, "model.py"], cwd=scratch)
        notes = "; ".join(sorted({re.sub(r"^note: (building )?\S+: ", "", line)
                                  for line in export.stderr.splitlines()
                                  if line.startswith("note: ") and "study" not in line}))
        worst, first, n = "-", "-", 0
        if "did not converge" in other.stderr:
            notes = "OpenSees does not converge" + ("; " + notes if notes else "")
        else:
            table, _ = run([jostle, "compare", scratch / "run.h5", scratch / "displacement.out",
                            "--tolerance", str(SAME), "--tsv"])
            rows = [line.split("\t") for line in table.stdout.splitlines()[1:]]
            if not rows:
                raise RuntimeError(table.stderr)
            n = len(rows)
            worst = f"{max(float(row[5]) for row in rows):.1e}"
            times = [float(row[7]) for row in rows if row[7] != "nan"]
            first = f"{min(times):.2f}" if times else "-"
        name = path.stem if path.parent.name == "input" else f"models/{path.stem}"
        row = [name, label, str(n), worst, first, f"{own_time:.2f}", f"{other_time:.1f}", notes]
        print(*row, sep="\t", flush=True)


def reason(row):
    """Why a row differs."""
    if row[3] != "-" and float(row[3]) <= SAME:
        return "same equations"
    if row[7]:
        return row[7]
    if row[1] == "linear":
        return "rounding that impacts enlarge"
    return "v0 or dashpots at the instant of closure, or errors that impacts enlarge"


def write_page(rows):
    table = ["| deck | contacts | largest difference | above 1e-6 from | jostle [s] | OpenSees [s] "
             "| reason |", "| --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        table.append(f"| {row[0]} | {row[1]} | {row[3]} | {row[4]} | {row[5]} | {row[6]} "
                     f"| {reason(row)} |")
    text = PAGE.read_text()
    start, end = "<!-- export.py -->\n", "<!-- end -->"
    before, rest = text.split(start)
    PAGE.write_text(before + start + "\n".join(table) + "\n" + end + rest.split(end)[1])


def measure():
    print(f"# OpenSeesPy 3.7.1, {datetime.date.today()}: deck, contacts, histories, difference, "
          "first time above 1e-6 [s], jostle [s], OpenSees [s], notes")
    for path in sorted(pathlib.Path("tests/peers/models").glob("*.deck")) + sorted(
            pathlib.Path("input").glob("*.deck")):
        if sys.argv[1:] and path.stem not in sys.argv[1:]:
            continue
        text = path.read_text()
        if path.parent.name == "input":
            compare(path, text, "as they are")
            text = linear(text, STIFFNESS.get(path.stem, "2GN/m"))
        compare(path, text, "linear")


def main():
    if sys.argv[1:] == ["--page"]:
        lines = pathlib.Path("tests/peers/export.tsv").read_text().splitlines()
        write_page([line.split("\t") for line in lines if not line.startswith("#")])
    else:
        measure()


if __name__ == "__main__":
    main()
