#!/usr/bin/python3
"""The path programs of `trunnion new`, read by LinuxCNC's own interpreter: where its blocks end, in full precision.

paths.py TRUNNION, for every model of the catalogue. The machine is worked out here from its model file alone: where the axes should be at
a sweep, and where the balls are then. Blocks are straight in the axes' coordinates, so their middles are looked at as well.
"""

import math
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from itertools import pairwise
from pathlib import Path

import gcode
from rs274.interpret import Translated, empty_spindle_data

MACHINES = Path(__file__).resolve().parent.parent.parent / "codegen/machines"
AXES = "XYZABCUVW"
# What the pages claim: a block is within this of the path, mm.
NEAR = 1e-4
# What `trunnion new` adds to either end without --overshoot-deg, degrees.
OVERSHOOT = 5.0
# Of a rotary axis a radian counts as this, mm: about as far as balls are from an axis.
ARM = 100.0
FEED_IN = 1.5
NAMES = {name: getattr(math, name) for name in ("pi", "sin", "cos", "sqrt", "atan2")}


class Read(Translated):
    """The interpreter's canonical calls: ways, each a place begun at and the ends of its blocks with their feed."""

    def __init__(self, folder):
        self.parameter_file = str(folder / "parameters")
        Path(self.parameter_file).touch()
        self.ways, self.feed = [], 0.0

    def straight_traverse_translated(self, *to):
        self.ways.append([(to, 0.0)])

    def straight_feed_translated(self, *to):
        self.ways[-1].append((to, self.feed))

    def set_feed_rate(self, rate):
        self.feed = rate

    def get_external_length_units(self):
        return 1.0 / 25.4

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 0x1FF

    def get_block_delete(self):
        return False

    def get_tool(self, _):
        return empty_spindle_data

    def check_abort(self):
        return False

    def __getattr__(self, name):
        """Nothing else of a program is of interest here."""
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *_: None


class Machine:
    """A model file's axes and balls, without errors."""

    def __init__(self, description, run):
        self.lengths = {name.removesuffix("_mm"): mm for name, mm in description["lengths"].items()}
        self.sweep, self.run = run["sweep"], run
        defined = [(name, compile(text, name, "eval")) for name, text in run.get("define", {}).items()]
        self.at = {axis: compile("0" if text == "rest" else text, axis, "eval") for axis, text in run["at"].items()}
        self.defined, self.axes = defined, description["axis"]
        self.sides = [(description.get(side, []), run.get(f"{side}_ball", {}).get("at", ["0"] * 3)) for side in ("workpiece", "tool")]
        self.distance = 0.0 if isinstance(run["reading"], dict) else self.value(run["reading"])

    def value(self, text):
        return float(eval(text, NAMES | self.lengths))

    def coordinates(self, sweep):
        """Where each axis should be, mm or rad."""
        names = NAMES | self.lengths | {self.sweep: sweep}
        for name, code in self.defined:
            names[name] = eval(code, names)
        return {axis: float(eval(code, names)) for axis, code in self.at.items()}

    def apart(self, coordinates):
        """The distance of the balls, mm."""
        ends = []
        for axes, at in self.sides:
            ball = [self.value(text) for text in at]
            for name in reversed(axes):
                ball = self.moved(ball, self.axes[name], coordinates[name])
            ends.append(ball)
        return math.dist(*ends)

    def moved(self, p, axis, by):
        kind = "rotary" if "rotary" in axis else "linear"
        d = axis[kind]
        if isinstance(d, str):
            sign = -1.0 if d.startswith("-") else 1.0
            d = [sign * (d[-1] == letter) for letter in "xyz"]
        else:
            d = [self.value(text) for text in d]
        if kind == "linear":
            return [x + by * e for x, e in zip(p, d)]
        # Rodrigues' rotation.
        along = sum(x * e for x, e in zip(p, d))
        across = [d[1] * p[2] - d[2] * p[1], d[2] * p[0] - d[0] * p[2], d[0] * p[1] - d[1] * p[0]]
        s, c = math.sin(by), math.cos(by)
        return [c * x + s * y + (1 - c) * along * e for x, y, e in zip(p, across, d)]

    def word(self, axis, to):
        """An axis' coordinate in a block, mm or rad."""
        x = to[AXES.index(axis)]
        return math.radians(x) if "rotary" in self.axes[axis] else x

    def off(self, sweep, coordinates):
        """Where axes are, less where they should be, mm."""
        rotary = lambda axis: "rotary" in self.axes[axis]
        turned = lambda x: ARM * math.remainder(x, math.tau)
        there = self.coordinates(sweep)
        return [(turned if rotary(axis) else float)(coordinates[axis] - x) for axis, x in there.items()]

    def nearest(self, sweep, coordinates):
        """The sweep near this one at which the path is nearest, and how far it is, mm."""
        step = 1e-5
        for _ in range(2):
            r, after = self.off(sweep, coordinates), self.off(sweep + step, coordinates)
            slope = [(b - a) / step for a, b in zip(r, after)]
            sweep -= sum(a * b for a, b in zip(slope, r)) / sum(a * a for a in slope)
        return sweep, math.hypot(*self.off(sweep, coordinates))

    def within(self, program, to):
        """Holds an end of a block to the axes' ranges."""
        for axis in self.at:
            low, high = self.axes[axis].get("range", (-math.inf, math.inf))
            x = to[AXES.index(axis)]
            assert low - NEAR <= x <= high + NEAR, f"{program.name}: {axis} goes to {x}, beyond {low} to {high}"


def read(program, folder):
    canon = Read(folder)
    result, line = gcode.parse(str(program), canon, "G21", "")
    if result > gcode.MIN_ERROR:
        raise AssertionError(f"{program.name}:{line}: {gcode.strerror(result)}")
    # Canonical lengths of this interface are inches, of whatever program.
    mm = lambda to: [25.4 * x if axis in "XYZUVW" else x for axis, x in zip(AXES, to)]
    return [[(mm(to), feed) for to, feed in way] for way in canon.ways]


def held(program, machine, ways):
    """Holds a program to its path; the largest distance from it and of the balls from their own, mm."""
    text = program.read_text()
    ends = re.search(r"sweep (\S+) to (\S+) degrees at \S+ a minute, (\S+) degrees beyond", text).groups()
    assert float(ends[-1]) == OVERSHOOT, f"{program.name}: {ends[-1]} degrees to come to speed"
    begin, end, beyond = (math.radians(float(number)) for number in ends)
    assert len(ways) == 2, f"{program.name}: {len(ways)} ways"
    there, back = ([to for to, _ in way] for way in ways)
    assert there == back[::-1], f"{program.name}: the way back is another"
    for to in there:
        machine.within(program, to)
    axes = list(machine.at)
    at = lambda to: {axis: machine.word(axis, to) for axis in axes}
    path = [at(to) for to in there]
    # Where no linear axis moves there is nothing to shorten the bar by.
    if machine.distance > 0 and any("linear" in machine.axes[axis] and text != "rest" for axis, text in machine.run["at"].items()):
        fed_in, path, fed_out = path[0], path[1:-1], path[-1]
        for place in (fed_in, fed_out):
            assert abs(abs(machine.apart(place) - machine.distance) - FEED_IN) < 1e-3, f"{program.name}: feed-in"
    begin, end = begin - beyond, end + beyond
    step = (end - begin) / (len(path) - 1)
    middles = [{axis: (a[axis] + b[axis]) / 2 for axis in axes} for a, b in pairwise(path)]
    farthest, apart = 0.0, 0.0
    for number, place in [*enumerate(path), *((k + 0.5, place) for k, place in enumerate(middles))]:
        guess = begin + number * step
        sweep, off = machine.nearest(guess, place)
        # The ends of the sweep are told to a thousandth of a degree.
        assert abs(sweep - guess) < math.radians(1.1e-3), f"{program.name}: block {number} is at another sweep"
        farthest, apart = max(farthest, off), max(apart, abs(machine.apart(place) - machine.distance))
    assert max(farthest, apart) <= NEAR, f"{program.name}: {farthest} mm off the path, balls {apart} mm"
    return farthest, apart


def main(trunnion):
    programs, worst = 0, (0.0, 0.0)
    for file in sorted(MACHINES.glob("*.toml")):
        description = tomllib.loads(file.read_text())
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            made = subprocess.run([trunnion, "new", file.stem, "--out", folder / "made"], capture_output=True, text=True)
            assert made.returncode == 0, made.stderr
            for program in sorted((folder / "made").glob("*.linuxcnc.ngc")):
                machine = Machine(description, description["run"][program.name.removesuffix(".linuxcnc.ngc")])
                worst = tuple(map(max, worst, held(program, machine, read(program, folder))))
                programs += 1
    assert programs > 0
    print(f"{programs} programs: at most {1e3 * worst[0]:.3f} µm off the path, balls {1e3 * worst[1]:.3f} µm off their distance")


main(os.path.abspath(sys.argv[1]))
