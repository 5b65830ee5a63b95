#!/usr/bin/python3
"""The tables of docs/controller.md: written from what was measured, or held against it."""

import json
import re
import sys
from pathlib import Path

BEGIN, END = "<!-- linuxcnc: written by `.ci/linuxcnc bless` -->\n", "<!-- end of linuxcnc -->\n"
# Every session draws the same noise; what differs are the last digits of another version's path.
RELATIVE, ABSOLUTE = 0.05, 0.03
# What a processor and a compiler make of it is told, not held.
OWN = ("clock cycles", "bytes")


def costs(sessions, usage):
    """What the component costs."""
    clocks = json.loads((sessions / "clocks.json").read_text())
    frames = {line.split("\t")[0].split(":")[-1]: int(line.split("\t")[1]) for line in usage.read_text().splitlines()}
    deepest = max(bytes for name, bytes in frames.items() if name not in ("export", "rtapi_app_main"))
    rows = [
        ("a sample, median, clock cycles", clocks["sample_clocks"]),
        ("a solution, clock cycles", clocks["solve_clocks"]),
        ("largest stack frame, bytes", deepest),
    ]
    lines = ["| the component of `tilting-table-a` | |", "|---|---:|", *(f"| {what} | {value:.0f} |" for what, value in rows)]
    return "\n".join(lines) + "\n"


def rows(text):
    cells = [[cell.strip() for cell in line.strip("| ").split("|")] for line in text.splitlines() if line.startswith("| ")]
    number = re.compile(r"-?\d+(\.\d+)?").fullmatch
    return {first: [float(cell) for cell in rest] for first, *rest in cells if rest and all(map(number, rest))}


def differing(told, measured):
    """Names of rows that are not what was measured."""
    near = lambda a, b: abs(a - b) <= ABSOLUTE + RELATIVE * abs(b)
    held = {name: values for name, values in measured.items() if not name.endswith(OWN)}
    same = lambda name: len(told.get(name, [])) == len(held[name]) and all(map(near, told[name], held[name]))
    return [name for name in held if not same(name)] + [name for name in told if name not in measured]


def main(page, sessions, usage, bless):
    page, sessions = Path(page), Path(sessions)
    measured = (sessions / "table.md").read_text() + "\n" + costs(sessions, Path(usage))
    print(measured)
    text = page.read_text()
    before, rest = text.split(BEGIN)
    told, after = rest.split(END)
    if bless == "bless":
        page.write_text(before + BEGIN + measured + END + after)
        return
    wrong = differing(rows(told), rows(measured))
    if wrong:
        raise SystemExit(f"{page}: not as measured: {', '.join(wrong)}; `.ci/linuxcnc bless` writes them")


main(*sys.argv[1:])
