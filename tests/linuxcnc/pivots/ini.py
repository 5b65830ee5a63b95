"""A machine's INI file for either kinematics."""

HEAD = """[EMC]
MACHINE = cradle
VERSION = 1.1

[DISPLAY]
DISPLAY = ./drive.py
PROGRAM_PREFIX = .

[TASK]
TASK = milltask
CYCLE_TIME = 0.001

[RS274NGC]
PARAMETER_FILE = machine.var

[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 60
SERVO_PERIOD = 1000000

[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1

[HAL]
HALFILE = machine.hal

[TRAJ]
SPINDLES = 1
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 100
MAX_LINEAR_VELOCITY = 2000
DEFAULT_ANGULAR_VELOCITY = 90
MAX_ANGULAR_VELOCITY = 2000
NO_FORCE_HOMING = 1
"""

# Nobody waits for a machine here, either.
# With kinematics that couple the axes a joint is none of them: limits for both.
LIMITS = "MIN_LIMIT = -1000\nMAX_LIMIT = 1000\nMAX_VELOCITY = 2000\nMAX_ACCELERATION = 100000\n"


def ini(kinematics, axes):
    text = HEAD + f"COORDINATES = {' '.join(axes)}\n\n[KINS]\nKINEMATICS = {kinematics}\nJOINTS = {len(axes)}\n\n"
    for joint, axis in enumerate(axes):
        kind = "LINEAR" if axis in "XYZ" else "ANGULAR"
        text += f"[AXIS_{axis}]\n{LIMITS}\n[JOINT_{joint}]\nTYPE = {kind}\nHOME = 0\n{LIMITS}"
        text += "FERROR = 5\nMIN_FERROR = 5\nHOME_SEQUENCE = 0\n\n"
    return text
