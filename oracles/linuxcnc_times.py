"""Times of the programs in crates/trueaxis/tests/data/linuxcnc-times/*.ngc on LinuxCNC's own trajectory
planner: three axes of 333 mm/s and 2000 mm/s², no jerk limit (2.9 has none). Counts the servo cycles of
1 ms in which an axis moves. Writes crates/trueaxis/tests/data/linuxcnc-times.csv.

Run in the repository root, Debian 12: apt-get install linuxcnc-uspace; python3 oracles/linuxcnc_times.py
(as root with RTAPI_UID=65534 in the environment; LinuxCNC wants a terminal, which `script` of util-linux gives it).
"""

import glob
import os
import pathlib
import subprocess
import tempfile

DATA = pathlib.Path("crates/trueaxis/tests/data")
AXIS = """[AXIS_{letter}]
MIN_LIMIT = -1000
MAX_LIMIT = 1000
MAX_VELOCITY = 333
MAX_ACCELERATION = 2000
[JOINT_{number}]
TYPE = LINEAR
MIN_LIMIT = -1000
MAX_LIMIT = 1000
MAX_VELOCITY = 333
MAX_ACCELERATION = 2000
HOME_SEQUENCE = 0
FERROR = 100
MIN_FERROR = 100
"""
INI = """[EMC]
MACHINE = times
VERSION = 1.1
[DISPLAY]
DISPLAY = {folder}/drive.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = times.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 10
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tool.tbl
[HAL]
HALFILE = times.hal
[TRAJ]
COORDINATES = X Y Z
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 333
MAX_LINEAR_VELOCITY = 333
DEFAULT_LINEAR_ACCELERATION = 2000
MAX_LINEAR_ACCELERATION = 2000
NO_FORCE_HOMING = 1
[KINS]
KINEMATICS = trivkins coordinates=XYZ
JOINTS = 3
"""
HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
loadrt sampler depth=200000 cfg=fff
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf sampler.0 servo-thread
net x joint.0.motor-pos-cmd => joint.0.motor-pos-fb sampler.0.pin.0
net y joint.1.motor-pos-cmd => joint.1.motor-pos-fb sampler.0.pin.1
net z joint.2.motor-pos-cmd => joint.2.motor-pos-fb sampler.0.pin.2
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net change iocontrol.0.tool-change => iocontrol.0.tool-changed
"""
DRIVE = '''#!/usr/bin/python3
import glob, linuxcnc, subprocess, time
command, stat = linuxcnc.command(), linuxcnc.stat()

def wait(reached, seconds=60):
    end = time.time() + seconds
    while time.time() < end:
        stat.poll()
        if reached():
            return
        time.sleep(0.01)

def idle():
    return stat.inpos and stat.interp_state == linuxcnc.INTERP_IDLE

command.state(linuxcnc.STATE_ESTOP_RESET)
wait(lambda: stat.task_state != linuxcnc.STATE_ESTOP)
command.state(linuxcnc.STATE_ON)
wait(lambda: stat.task_state == linuxcnc.STATE_ON)
for name in sorted(glob.glob("{folder}/*.ngc")):
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()
    command.mdi("G0 X0 Y0 Z0")
    command.wait_complete()
    wait(idle)
    time.sleep(0.5)
    sampler = subprocess.Popen(["halsampler", "-t"], stdout=open(name + ".samples", "w"))
    time.sleep(0.5)
    command.mode(linuxcnc.MODE_AUTO)
    command.wait_complete()
    command.program_open(name)
    command.wait_complete()
    command.auto(linuxcnc.AUTO_RUN, 0)
    time.sleep(0.5)
    wait(idle)
    time.sleep(0.5)
    sampler.terminate()
    sampler.wait()
'''


def moving_s(path):
    """From the first to the last cycle in which an axis of the samples moves."""
    rows = [line.split() for line in open(path)]
    rows = [(int(r[0]), *map(float, r[1:4])) for r in rows if len(r) == 4 and r[0].isdigit()]
    moves = [b[0] for a, b in zip(rows, rows[1:]) if max(abs(x - y) for x, y in zip(a[1:], b[1:])) > 1e-9]
    # What comes before a pause is the way back of the program before.
    begin = next((b for a, b in reversed(list(zip(moves, moves[1:]))) if b - a > 100), moves[0])
    return (moves[-1] - begin + 1) / 1000


with tempfile.TemporaryDirectory() as folder:
    os.chmod(folder, 0o777)
    at = pathlib.Path(folder)
    for program in sorted((DATA / "linuxcnc-times").glob("*.ngc")):
        (at / program.name).write_text(program.read_text())
    (at / "times.ini").write_text(
        INI.format(folder=folder) + "".join(AXIS.format(letter=l, number=n) for n, l in enumerate("XYZ")))
    (at / "times.hal").write_text(HAL)
    (at / "tool.tbl").write_text("")
    (at / "times.var").write_text("")
    (at / "drive.py").write_text(DRIVE.replace("{folder}", folder))
    os.chmod(at / "drive.py", 0o755)
    subprocess.run(["script", "-qec", f"linuxcnc {folder}/times.ini", "/dev/null"], check=True,
                   stdout=subprocess.DEVNULL, cwd=folder,
                   env=os.environ | {"RTAPI_FIFO_PATH": f"{folder}/fifo"})
    version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "linuxcnc-uspace"],
                             capture_output=True, text=True, check=True).stdout
    lines = [f"# LinuxCNC {version}, python3 oracles/linuxcnc_times.py", "program,time_s"]
    for samples in sorted(glob.glob(f"{folder}/*.samples")):
        lines.append(f"{pathlib.Path(samples).name.removesuffix('.ngc.samples')},{moving_s(samples):.3f}")
(DATA / "linuxcnc-times.csv").write_text("\n".join(lines) + "\n")
