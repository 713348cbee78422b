"""The files of a LinuxCNC that moves nothing: five joints, a tilting rotary table, ideal drives, a recorder."""
import os

RATE = 1000
TRUEAXIS = """[TRUEAXIS]
TILT = {tilt}
RATE = 1000
LIMIT = 0.3
SLEW = 5
TURN_LIMIT = 0.05
TURN_SLEW = 1
TIMEOUT = 0.1
"""


def ini(name, tilt):
    linear = "MIN_LIMIT = -500\nMAX_LIMIT = 500\nMAX_VELOCITY = 200\nMAX_ACCELERATION = 2000\n"
    limits = {"C": "MIN_LIMIT = -36000\nMAX_LIMIT = 36000\nMAX_VELOCITY = 90\nMAX_ACCELERATION = 900\n"}
    limits[tilt] = limits["C"].replace("36000", "120")
    text = f"""[EMC]
VERSION = 1.1
MACHINE = {name}
[DISPLAY]
DISPLAY = ./waits
[RS274NGC]
PARAMETER_FILE = {name}.var
[KINS]
KINEMATICS = {name}-trt-kins
JOINTS = 5
[HAL]
HALUI = halui
HALFILE = drives.hal
HALFILE = trueaxis.hal
[TRAJ]
COORDINATES = X Y Z {tilt} C
LINEAR_UNITS = mm
ANGULAR_UNITS = deg
DEFAULT_LINEAR_VELOCITY = 100
MAX_LINEAR_VELOCITY = 200
DEFAULT_LINEAR_ACCELERATION = 1000
MAX_LINEAR_ACCELERATION = 2000
[EMCMOT]
EMCMOT = motmod
SERVO_PERIOD = {10**9 // RATE}
COMM_TIMEOUT = 4.0
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tool.tbl
"""
    for i, letter in enumerate(["X", "Y", "Z", tilt, "C"]):
        kind, own = ("LINEAR", linear) if letter in "XYZ" else ("ANGULAR", limits[letter])
        text += f"[AXIS_{letter}]\n{own}OFFSET_AV_RATIO = 0.2\n[JOINT_{i}]\nTYPE = {kind}\nHOME = 0\n{own}FERROR = 1.0\n"
        text += "MIN_FERROR = 0.1\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n"
    return text + TRUEAXIS.format(tilt=tilt.lower())


def drives(name, tilt):
    side = "y" if tilt == "A" else "x"
    lines = [
        "loadrt [KINS]KINEMATICS",
        "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS",
        "addf motion-command-handler servo-thread", "addf motion-controller servo-thread",
        "net stop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in",
        "net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared",
        "net change iocontrol.0.tool-change => iocontrol.0.tool-changed",
        f"net ta-tool-length motion.tooloffset.z => {name}-trt-kins.tool-offset",
        "net ta-asked motion.analog-out-03", "net ta-kins => motion.switchkins-type",
        f"setp {name}-trt-kins.{side}-offset 20", f"setp {name}-trt-kins.z-offset 10",
    ]
    lines += [f"net drive-{i} joint.{i}.motor-pos-cmd => joint.{i}.motor-pos-fb" for i in range(5)]
    return "\n".join(lines) + "\n"


def recorder(tilt):
    """After trueaxis.hal, by halcmd: its signals are there then."""
    letters = ["x", "y", "z", tilt.lower(), "c"]
    signals = [f"ta-joint-{l}" for l in letters] + [f"ta-acting-{l}" for l in letters] + [f"ta-request-{l}" for l in letters]
    signals += ["ta-end", "ta-echo", "ta-velocity", "ta-tripped"]
    lines = ["loadrt sampler depth=16000 cfg=" + "f" * (len(signals) - 1) + "b", "addf sampler.0 servo-thread"]
    lines += [f"net {signal} => sampler.0.pin.{i}" for i, signal in enumerate(signals)]
    return "\n".join(lines + ["setp sampler.0.enable 0"]) + "\n", signals


def write(folder, name, tilt):
    files = {f"{name}.ini": ini(name, tilt), "drives.hal": drives(name, tilt), f"{name}.var": "",
             "tool.tbl": "T1 P1 D6 Z50 ; ball\nT2 P2 D10 Z80 ; end mill\n",
             "waits": "#!/bin/sh\ntouch ready\nwhile [ ! -e stop ]; do sleep 0.1; done\nrm -f stop ready\n"}
    for file, text in files.items():
        open(os.path.join(folder, file), "w").write(text)
    os.chmod(os.path.join(folder, "waits"), 0o755)
