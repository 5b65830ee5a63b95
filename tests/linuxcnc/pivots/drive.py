#!/usr/bin/python3
"""LinuxCNC's display: does what job.json says, and writes down what came of it."""

import json
import time

import hal
import linuxcnc

command, status = linuxcnc.command(), linuxcnc.stat()
# Pins can only be set by who has a component.
component = hal.component("drive")
component.ready()


def wait_for(condition, what, seconds):
    end = time.time() + seconds
    while True:
        status.poll()
        if condition():
            return
        if time.time() > end:
            raise SystemExit(f"LinuxCNC: no {what} in {seconds} s: {linuxcnc.error_channel().poll()}")
        time.sleep(0.01)


def mode(which):
    command.mode(which)
    command.wait_complete()


def mdi(line):
    command.mdi(line)
    if command.wait_complete(60) != linuxcnc.RCS_DONE:
        raise SystemExit(f"LinuxCNC: {line}: {linuxcnc.error_channel().poll()}")
    # What the plant makes of where the drives stand is there a period later.
    time.sleep(0.05)


def words(names, values):
    return " ".join(f"{name}{value:.9f}" for name, value in zip(names, values))


def run(program):
    mode(linuxcnc.MODE_AUTO)
    command.program_open(program)
    command.auto(linuxcnc.AUTO_RUN, 0)
    wait_for(lambda: status.interp_state != linuxcnc.INTERP_IDLE, "start", 10)
    wait_for(lambda: status.interp_state == linuxcnc.INTERP_IDLE, f"end of {program}", 240)
    error = linuxcnc.error_channel().poll()
    if error:
        raise SystemExit(f"LinuxCNC: {program}: {error}")
    mode(linuxcnc.MODE_MDI)


def look(axes, place):
    mdi("G0 " + words(axes, place))
    pins = [f"joint.{joint}.motor-pos-cmd" for joint in range(5)], [f"sphere.0.off-{i}" for i in range(3)]
    joints, off = ([hal.get_value(pin) for pin in own] for own in pins)
    return {"place": place, "joints": joints, "off": off}


def main():
    with open("job.json") as file:
        job = json.load(file)
    for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
        command.state(state)
        command.wait_complete()
    mode(linuxcnc.MODE_MANUAL)
    command.home(-1)
    wait_for(lambda: all(status.homed[:5]), "home", 30)
    for name, value in job["hal"].items():
        # An integer takes no point.
        hal.set_p(name, f"{value:.17g}")
    mode(linuxcnc.MODE_MDI)
    mdi("G21 G90 G61 G94 G49 G10 L2 P1 " + words(job["axes"], job["zero"] + [0, 0]))
    mdi("G54")
    for program in job["programs"]:
        run(program)
    aside = [0, 0, 0]
    if job["at-sphere"]:
        # The tip is set to the sphere's centre with both axes at zero, as one sets a work offset.
        aside = look(job["axes"], job["places"][0])["off"]
    seen = [look(job["axes"], [at - off for at, off in zip(place, aside)] + place[3:]) for place in job["places"]]
    with open("result.json", "w") as file:
        json.dump(seen, file)


if __name__ == "__main__":
    main()
