#!/usr/bin/env python3
"""Writes cw.csv and ccw.csv beside it: a machine with known errors on a circle of 150 mm, read to 0.1 µm."""
import random
from math import cos, copysign, degrees, exp, radians, sin
from pathlib import Path

RADIUS = 150.0  # mm
FEED = 1000 / 60  # mm/s
CENTRE = (0.0041, -0.0027)  # mm
SHORT = 0.0018  # mm
SCALE = (9e-6, -14e-6)  # of the travel, X and Y
SQUARE = 22e-6  # rad over the right angle
LOST = (0.0036, 0.0012)  # mm, X and Y
LAG = 0.15e-3  # s, X more than Y
SPIKES = {0: 0.0021, 90: 0.0052, 180: 0.0018, 270: 0.0044}  # mm outwards, at degrees
NOISE = 0.00015  # mm


def deviation(a, way):
    c, s = cos(a), sin(a)
    d = CENTRE[0] * c + CENTRE[1] * s - SHORT + RADIUS * (SCALE[0] * c * c + SCALE[1] * s * s)
    d += -RADIUS * SQUARE * s * c + way * FEED * LAG * s * c
    d += way * (LOST[0] * c * copysign(0.5, s) - LOST[1] * s * copysign(0.5, c))
    d += 0.0006 * cos(3 * a + 1)  # straightness, or a screw: nothing that is looked for
    for at, height in SPIKES.items():
        t = (way * (degrees(a) - at) + 180) % 360 - 180
        if 0 <= t < 6:
            d += height * t / 0.8 * exp(1 - t / 0.8)
    return d


rng = random.Random(4)
for name, way in (("cw", -1), ("ccw", 1)):
    angles = [0.5 * k + 0.25 for k in range(720)][::way]
    rows = [f"{a:.2f},{1e3 * (deviation(radians(a), way) + rng.gauss(0, NOISE)):.1f}\n" for a in angles]
    (Path(__file__).parent / f"{name}.csv").write_text("a_deg,dr_um\n" + "".join(rows))
