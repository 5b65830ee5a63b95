#!/usr/bin/python3
"""The tables of a page: written from what a session printed, or held against it.

page.py PAGE.md NAME OUTPUT [bless], between `<!-- NAME: written by … -->` and `<!-- end of NAME -->`
"""

import re
import sys
from pathlib import Path

# Every session draws the same noise; what differs are the last digits of another version's path, and a probe stops a servo
# period sooner or later.
RELATIVE, ABSOLUTE = 0.05, {"linuxcnc": 0.03, "ac-trunnion-probe": 3.0, "bc-trunnion-probe": 3.0}
# What a processor and a compiler make of it is told, not held.
OWN = ("clock cycles", "bytes")


def tables(output):
    """The tables among other lines, a blank line between two."""
    lines = [line for line in output.splitlines() if line.startswith("|")]
    begins = lambda at: at and at + 1 < len(lines) and lines[at + 1].startswith("|---")
    return "".join("\n" * bool(begins(at)) + line + "\n" for at, line in enumerate(lines))


def rows(text):
    """Names of rows, and their numbers, whatever their unit."""
    cells = [[cell.strip() for cell in line.strip("| ").split("|")] for line in text.splitlines() if line.startswith("| ")]
    number = re.compile(r"(-?\d+(?:\.\d+)?)(?: \S+)?").fullmatch
    return {first: [float(number(cell)[1]) for cell in rest] for first, *rest in cells if rest and all(map(number, rest))}


def differing(told, measured, most):
    """Names of rows that are not what was measured."""
    near = lambda a, b: abs(a - b) <= most + RELATIVE * abs(b)
    held = {name: values for name, values in measured.items() if not name.endswith(OWN)}
    same = lambda name: len(told.get(name, [])) == len(held[name]) and all(map(near, told[name], held[name]))
    return [name for name in held if not same(name)] + [name for name in told if name not in measured]


def main(page, name, output, bless=""):
    page, measured = Path(page), tables(Path(output).read_text())
    text = page.read_text()
    begin, end = re.search(rf"<!-- {name}: .*-->\n", text).end(), text.index(f"<!-- end of {name} -->")
    if bless == "bless":
        page.write_text(text[:begin] + measured + text[end:])
        return
    wrong = differing(rows(text[begin:end]), rows(measured), ABSOLUTE[name])
    if wrong or not rows(measured):
        raise SystemExit(f"{page}: not as measured: {', '.join(wrong)}; `.ci/linuxcnc bless` writes them")


main(*sys.argv[1:])
