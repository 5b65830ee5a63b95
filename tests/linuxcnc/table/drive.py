#!/usr/bin/python3
"""LinuxCNC's display: moves the machine as job.json says, and writes down what the bar reads."""

import csv
import json
import math
import statistics
import time

import hal
import linuxcnc

RADIUS = 150.0
OVERSHOOT = 5.0  # degrees before and behind a sweep of a turn, in which the axes get and lose their speed
FEED = 14000.0  # mm/min along the circle: some 90 degrees a second
FIT = "tilting-table-a.0"
# Where the estimate is read: the ends, where it vanishes, are none of them.
PLACES = range(15, 360, 15)

command, status = linuxcnc.command(), linuxcnc.stat()


def wait_for(condition, what, seconds=30):
    end = time.time() + seconds
    while not condition():
        if time.time() > end:
            raise SystemExit(f"LinuxCNC: no {what} in {seconds} s")
        time.sleep(0.005)


def polled(condition):
    def holds():
        status.poll()
        return condition()

    return holds


def mdi(line):
    command.mdi(line)
    if command.wait_complete(60) != linuxcnc.RCS_DONE:
        raise SystemExit(f"LinuxCNC: {line}: {linuxcnc.error_channel().poll()}")


def start():
    for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
        command.state(state)
        command.wait_complete()
    command.mode(linuxcnc.MODE_MANUAL)
    command.wait_complete()
    command.home(-1)
    wait_for(polled(lambda: all(status.homed[:3])), "home")
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()
    mdi(f"G21 G90 G61 G19 G0 Y{RADIUS} Z0 A0")
    mdi(arc(0, -OVERSHOOT, ""))


def setp(values):
    for name, value in values.items():
        hal.set_p(name, str(value))


def arc(begin, end, rest):
    """The tool's circle from one angle to another, less than a turn of it or more."""
    (y0, z0), (y1, z1) = ([RADIUS * f(math.radians(at)) for f in (math.cos, math.sin)] for at in (begin, end))
    turns = 1 + int(abs(end - begin) // 360)
    code = "G3" if end > begin else "G2"
    return f"{code} Y{y1:.12f} Z{z1:.12f} J{-y0:.12f} K{-z0:.12f} P{turns} F{FEED}{rest}"


def sweep(run, forward, stream, clocks):
    """The samples of one turn, there or back; `clocks` gets what calls of the component took meanwhile."""
    ends = [-OVERSHOOT, 360 + OVERSHOOT]
    begin, end = ends if forward else ends[::-1]
    mdi(f"G0 A{begin if run == 'tilting' else 0}")
    setp({"plant.0.tilting": int(run == "tilting"), "plant.0.separation": int(run == "separation")})
    command.mdi(arc(begin, end, f" A{end}" if run == "tilting" else ""))
    rows, answer = [], -1
    while answer == -1:
        answer = command.wait_complete(0.01)
        if hal.get_value("plant.0.at-any"):
            clocks.append(hal.get_value(f"{FIT}.time"))
        while stream.readable:
            rows.append(stream.read())
    if answer != linuxcnc.RCS_DONE:
        raise SystemExit(f"LinuxCNC: {run}: {linuxcnc.error_channel().poll()}")
    setp({"plant.0.tilting": 0, "plant.0.separation": 0})
    return rows


def write(file, header, rows):
    with open(file, "w", newline="") as opened:
        out = csv.writer(opened)
        out.writerow(header)
        out.writerows([repr(value) for value in row] for row in rows)


def measured(stream, name):
    """Both runs, there and back: files for the fit, the largest true error, what the component in the control says."""
    setp({f"{FIT}.reset": 1})
    time.sleep(0.01)
    setp({f"{FIT}.reset": 0})
    errors = {1: [], -1: []}
    samples, clocks = 0, []
    for run in ("tilting", "separation"):
        rows = sweep(run, True, stream, clocks) + sweep(run, False, stream, clocks)
        samples += len(rows)
        if run == "tilting":
            for row in rows:
                errors[row[5]].append(row[4])
            write(f"{name}-known.csv", ["a_deg", "dya_um", "dza_um"], [(row[0], row[2], row[3]) for row in rows])
        write(f"{name}-{run}.csv", ["a_deg", "dr_um"], [row[:2] for row in rows])
    return {
        "samples": samples,
        "largest_true_urad": max(abs(e) for way in errors.values() for e in way),
        "mean_true_urad": {way: sum(e) / len(e) for way, e in errors.items()},
        "overruns": stream.num_overruns,
        "sample_clocks": statistics.median(clocks),
        "sample_clocks_most": hal.get_value(f"{FIT}.tmax"),
        "solve_clocks": hal.get_value(f"{FIT}.solve.time"),
        "component": component(),
    }


def solved():
    """Waits for a solution that was begun after now: the second one that ends."""
    before = hal.get_value(f"{FIT}.solutions")
    wait_for(lambda: hal.get_value(f"{FIT}.solutions") > before + 1, "solution")


def component():
    values = []
    for at in PLACES:
        setp({f"{FIT}.e-xa-at-deg": float(at)})
        solved()
        values.append([at, hal.get_value(f"{FIT}.e-xa-urad"), hal.get_value(f"{FIT}.e-xa-std-urad")])
    pins = ["samples", "refused", "status", "solve-status", "solve-samples", "residual-um"]
    told = {pin: hal.get_value(f"{FIT}.{pin}") for pin in pins}
    return {"e_xa": values, **told}


def main():
    with open("job.json") as file:
        job = json.load(file)
    own = hal.component("driver")
    own.ready()
    stream = hal.stream(own, hal.sampler_base, "fffffsb")
    setp(job["plant"])
    start()
    results = {}
    for one in job["measure"]:
        setp(one["plant"])
        results[one["name"]] = measured(stream, one["name"])
    with open("results.json", "w") as file:
        json.dump(results, file)


main()
