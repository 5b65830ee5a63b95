"""Cradles: what turns about C on an axis that tilts, as the model, the kinematics and the plant have it."""

import random
import re

# The equator is measured along one axis, the top along Z: their scales differ by twice this at most, over the radius of a touch.
SCALE = 2e-5
LENGTHS = {"L": 150.0, "H": 80.0}
# Where a cradle is nominally, mm.
ZERO = [20.0, -35.0, -110.0]
COMPONENTS = "XYZABC"


class Cradle:
    def __init__(self, model, kinematics, tilting, about, errors, pins, down):
        self.model, self.kinematics = model, kinematics
        # The axis that tilts, and which of X and Y it turns about.
        self.tilting, self.about = tilting, about
        self.axes = "XYZ" + tilting + "C"
        self.errors = errors
        # Each pin as it was designed, and the location errors in it.
        self.pins = pins
        # The sphere is beside the axis that tilts, by L, and above it.
        self.ball = [LENGTHS["L"] if about == 1 else 0.0, LENGTHS["L"] if about == 0 else 0.0, LENGTHS["H"]]
        poses = [(0, 0), (60, 0), (-30, 0), (0, 90), (0, 200), (90, 120), (45, -60), (-20, 45)]
        # Mostly to the side on which the sphere goes down.
        self.poses = [(down * tilt, turn) for tilt, turn in poses]

    def designed(self):
        return {pin: nominal for pin, (nominal, _) in self.pins.items()}

    def machine(self, seed):
        """Errors of a machine, mm and rad: pivots off by tenths, everything else by what a machine has; of the axes, and the others."""
        draw = random.Random(seed).uniform
        lengths = {name: draw(-0.3, 0.3) for name in self.errors if name[1] in "XYZ"}
        angles = {name: draw(-1e-4, 1e-4) for name in self.errors if name[1] in "ABC"}
        others = {name: draw(-1e-4, 1e-4) for name in ("ec0y", "eb0z", "ea0z")}
        return lengths | angles, others | {f"scale-{i}": draw(-SCALE, SCALE) for i in range(3)}

    def right(self, truth):
        """What each pin should be."""
        return {pin: nominal + sum(sign * truth[name] for name, sign in of) for pin, (nominal, of) in self.pins.items()}

    def plant(self, truth, others, sense):
        """The parameters of sphere.comp."""
        place = lambda name: ("turning" if name.endswith("C") else "tilting") + f"-{COMPONENTS.index(name[1])}"
        located = {place(name): value for name, value in truth.items()}
        return located | {f"sense-{at}": value for at, value in enumerate(sense)} | others | {"about": self.about}

    def handed(self, text, sense):
        """The model file of a table that turns about its axes in either sense."""
        for axis, about, own in ((self.tilting, "xy"[self.about], sense[0]), ("C", "z", sense[1])):
            if own > 0:
                continue
            letter = axis.lower()
            text = text.replace(f'rotary = "{about}"', f'rotary = "-{about}"').replace(f"sin({letter})", f"sin(-{letter})")
            if axis == self.tilting:
                text = re.sub(rf'{axis} = "(-?)pi/2"', lambda own: f'{axis} = "{"" if own[1] else "-"}pi/2"', text)
                text = re.sub(r"range = \[(\S+), (\S+)\]", lambda own: f"range = [{-int(own[2])}, {-int(own[1])}]", text)
        return text


CRADLES = {
    cradle.model: cradle
    for cradle in (
        Cradle(
            "ac-trunnion-probe", "xyzac-trt-kins", "A", 0,
            ["EY0A", "EZ0A", "EB0A", "EC0A", "EX0C", "EY0C", "EA0C", "EB0C"],
            {
                "x-rot-point": (ZERO[0], [("EX0C", 1)]),
                "y-rot-point": (ZERO[1], [("EY0A", 1), ("EY0C", 1)]),
                "z-rot-point": (ZERO[2], [("EZ0A", 1)]),
                "y-offset": (0.0, [("EY0C", -1)]),
            },
            -1,
        ),
        Cradle(
            "bc-trunnion-probe", "xyzbc-trt-kins", "B", 1,
            ["EX0B", "EZ0B", "EA0B", "EC0B", "EX0C", "EY0C", "EA0C", "EB0C"],
            {
                "x-rot-point": (ZERO[0], [("EX0B", 1), ("EX0C", 1)]),
                "y-rot-point": (ZERO[1], [("EY0C", 1)]),
                "z-rot-point": (ZERO[2], [("EZ0B", 1)]),
                "x-offset": (0.0, [("EX0C", -1)]),
            },
            1,
        ),
    )
}
