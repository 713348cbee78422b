"""What a whole LinuxCNC adds to its commands -> crates/trueaxis/tests/data/linuxcnc-comp/

usage: python3 oracles/linuxcnc_comp.py [TRUEAXIS]      (default target/release/trueaxis; 3 min)
tool: LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, package linuxcnc-uspace): milltask, motmod, trivkins, in simulation.
Each folder of tables is written by `trueaxis compensate tables`, its lines are put into the joint sections of an INI file, the
joints are homed at once and driven in G53 from below to above the table and back, with a stop at each place. At each stop, when
nothing changes any more, what was added = joint.N.motor-pos-cmd - joint.N.pos-cmd (HAL, double precision) is written down.
The HAL only closes the loop: motor-pos-fb = motor-pos-cmd. What LinuxCNC adds at a stop is that of the last step before it, which
the acceleration of 1000 mm/s^2 keeps below 0.1 um. Without LinuxCNC the script says so and writes nothing.
"""
import os
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DATA = os.path.join(ROOT, "crates", "trueaxis", "tests", "data", "linuxcnc-comp")
STOPS = 48  # places of a joint: those of the table and equal steps between

# folder: machine, options, and for each joint its letter and travel
SETS = {
    "mill-type-0": ("three-axis-mill", ["--bound", "0.02 um"]),
    "mill-type-1": ("three-axis-mill", ["--bound", "0.02 um", "--comp-file-type", "1"]),
    "xkas2525-type-0": ("xkas2525", []),
}

UI = """
import sys, time, hal, linuxcnc
joints, out = int(sys.argv[-2]), sys.argv[-1]  # after "-ini FILE"
command, status = linuxcnc.command(), linuxcnc.stat()
reader = hal.component("stops")
reader.ready()
pin = lambda j, name: hal.get_value(f"joint.{j}.{name}")

def until(what, seconds=30):
    end = time.time() + seconds
    while not what():
        if time.time() > end:
            sys.exit(f"not reached: {what.__name__}")
        time.sleep(0.002)

def polled(f):
    def g():
        status.poll()
        return f()
    g.__name__ = f.__name__
    return g

@polled
def homed():
    return all(status.homed[:joints])

@polled
def idle():
    return status.interp_state == linuxcnc.INTERP_IDLE and status.inpos

def settled():
    seen = [pin(j, "motor-pos-cmd") for j in range(joints)]
    time.sleep(0.02)
    return seen == [pin(j, "motor-pos-cmd") for j in range(joints)]

def state(s):
    command.state(s)
    command.wait_complete()

state(linuxcnc.STATE_ESTOP_RESET)
state(linuxcnc.STATE_ON)
command.mode(linuxcnc.MODE_MANUAL)
command.wait_complete()
command.teleop_enable(0)
command.wait_complete()
command.home(-1)
until(homed)
command.mode(linuxcnc.MODE_MDI)
command.wait_complete()
with open(out, "w") as rows, open("moves.txt") as moves:
    for line in moves:
        way, block = line.rstrip().split(",", 1)
        command.mdi(block)
        command.wait_complete(60)
        until(idle)
        until(settled)
        if way != "go":
            for j in range(joints):
                at = pin(j, "pos-cmd")
                rows.write(f"{j},{way},{at!r},{pin(j, 'motor-pos-cmd') - at!r}\\n")
"""


def tables(folder, machine, options):
    """Writes the tables and gives, for each joint, the COMP_FILE lines and the positions of its table."""
    trueaxis = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "target", "release", "trueaxis")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(DATA, exist_ok=True)
    file = os.path.join("machines", machine, "machine.toml")
    command = [trueaxis, "compensate", "tables", file, "--target", "linuxcnc", "-o", folder, *options]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    letters, lines, positions, joint = [], {}, {}, None
    for line in open(os.path.join(folder, "compensation.ini")):
        line = line.strip()
        if line.startswith("COORDINATES"):
            letters = line.split("=")[1].split()
        elif line.startswith("[JOINT_"):
            joint = int(line[7:-1])
        elif line.startswith("COMP_FILE") and joint is not None:
            lines.setdefault(joint, []).append(line)
            if not line.startswith("COMP_FILE_TYPE"):
                rows = open(os.path.join(folder, line.split("=")[1].strip())).read().split("\n")
                positions[joint] = [float(r.split()[0]) for r in rows if r]
    return letters, lines, positions


def stops(nodes):
    """STOPS rising places: the nodes, and the rest evenly from 2 % below to 2 % above the table."""
    beyond = 0.02 * (nodes[-1] - nodes[0])
    count = STOPS - len(nodes)
    step = (nodes[-1] - nodes[0] + 2 * beyond) / (count - 1)
    even = [round(nodes[0] - beyond + i * step, 6) for i in range(count)]
    return sorted(set(nodes + even)), beyond


def ini(letters, lines, limits, kinematics, halfiles):
    text = f"""[EMC]
VERSION = 1.1
MACHINE = trueaxis
[DISPLAY]
DISPLAY = ./ui {len(letters)} stops.csv
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = sim.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tool.tbl
[HAL]
{"".join(f"HALFILE = {file}" + chr(10) for file in halfiles)}[TRAJ]
COORDINATES = {" ".join(letters)}
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 500
MAX_LINEAR_VELOCITY = 2000
MAX_LINEAR_ACCELERATION = 1000
DEFAULT_ANGULAR_VELOCITY = 500
MAX_ANGULAR_VELOCITY = 2000
[KINS]
KINEMATICS = {kinematics}
JOINTS = {len(letters)}
"""
    for joint, letter in enumerate(letters):
        low, high = limits[joint]
        common = f"MIN_LIMIT = {low}\nMAX_LIMIT = {high}\nMAX_VELOCITY = 2000\nMAX_ACCELERATION = 1000\n"
        text += f"[AXIS_{letter}]\n{common}[JOINT_{joint}]\n{common}"
        text += f"TYPE = {'ANGULAR' if letter in 'ABC' else 'LINEAR'}\nFERROR = 1000\nMIN_FERROR = 1000\n"
        text += "HOME = 0\nHOME_OFFSET = 0\nHOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n"
        text += "".join(f"{line}\n" for line in lines.get(joint, []))
    return text


def loop(joints):
    wires = [
        "loadrt [KINS]KINEMATICS",
        "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS",
        "addf motion-command-handler servo-thread",
        "addf motion-controller servo-thread",
        "net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in",
        "net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared",
        "net change iocontrol.0.tool-change => iocontrol.0.tool-changed",
    ]
    wires += [f"net loop-{j} joint.{j}.motor-pos-cmd => joint.{j}.motor-pos-fb" for j in range(joints)]
    return "\n".join(wires) + "\n"


def linuxcnc(work):
    """Its real-time part refuses to be root's."""
    command, nobody = ["linuxcnc", "-r", "oracle.ini"], 65534
    if os.geteuid() == 0:
        for at, folders, files in os.walk(work):
            for path in [at, *(os.path.join(at, file) for file in files)]:
                os.chown(path, nobody, nobody)
        command = ["setpriv", f"--reuid={nobody}", f"--regid={nobody}", "--clear-groups", *command]
    home = {**os.environ, "HOME": work}
    return subprocess.run(command, cwd=work, env=home, capture_output=True, text=True, timeout=600)


def run(name, machine, options):
    folder = os.path.join(DATA, name)
    letters, lines, positions = tables(folder, machine, options)
    places = {j: stops(nodes) for j, nodes in positions.items()}
    limits = {j: (-1, 1) for j in range(len(letters))}
    limits |= {j: (min(at[0], 0) - 2 * b, max(at[-1], 0) + 2 * b) for j, (at, b) in places.items()}
    block = lambda at: "G53 G0 " + " ".join(f"{letters[j]}{p:.6f}" for j, p in sorted(at.items()))
    last = max(len(at) for at, _ in places.values())
    at = lambda i: {j: p[min(i, len(p) - 1)] for j, (p, _) in places.items()}
    ends = lambda sign: {j: p[0 if sign < 0 else -1] + 0.5 * sign * b for j, (p, b) in places.items()}
    moves = [("go", ends(-1))] + [("up", at(i)) for i in range(last)]
    moves += [("go", ends(1))] + [("down", at(i)) for i in reversed(range(last))]
    trivial = f"trivkins coordinates={''.join(letters)}"
    with tempfile.TemporaryDirectory() as work:
        shutil.copytree(folder, work, dirs_exist_ok=True)
        files = {"oracle.ini": ini(letters, lines, limits, trivial, ["loop.hal"]), "loop.hal": loop(len(letters)), "tool.tbl": "", "sim.var": "",
                 "moves.txt": "".join(f"{way},{block(p)}\n" for way, p in moves), "ui": "#!/usr/bin/python3\n" + UI}
        for file, text in files.items():
            open(os.path.join(work, file), "w").write(text)
        os.chmod(os.path.join(work, "ui"), 0o755)
        done = linuxcnc(work)
        result = os.path.join(work, "stops.csv")
        if not os.path.exists(result) or len(open(result).readlines()) != 2 * last * len(letters):
            sys.exit(f"{name}: LinuxCNC did not go through:\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
        rows = [r.split(",") for r in open(result).read().split()]
    return [f"{name},{j},{way},{float(p):.9f},{float(v):.12f}" for j, way, p, v in rows if int(j) in positions]


def main():
    if shutil.which("linuxcnc") is None:
        print("skipped: LinuxCNC is not installed (docs/compensation-tables.md tells how)")
        return
    rows = [row for name, (machine, options) in SETS.items() for row in run(name, machine, options)]
    head = [
        "# What LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, linuxcnc-uspace) adds at standstill to its commands",
        "# tables: the folders beside; written by `python3 oracles/linuxcnc_comp.py`, which also wrote the tables",
        "# way: reached while rising (up) or falling (down); position: joint.N.pos-cmd; added: motor-pos-cmd - pos-cmd; mm, deg",
        "tables,joint,way,position,added",
    ]
    with open(os.path.join(DATA, "added.csv"), "w") as out:
        out.write("\n".join(head + rows) + "\n")
    print(f"{len(rows)} places written")


if __name__ == "__main__":
    main()
