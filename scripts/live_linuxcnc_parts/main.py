"""Runs LinuxCNC with trueaxis on it, records every servo cycle, and judges the tool by truth.py. See scripts/live-linuxcnc."""
import json
import math
import os
import signal
import subprocess
import sys
import time

import linuxcnc
import machine
from truth import Machine, inverse, product, shift, turn

WORK = os.path.dirname(os.path.abspath(__file__))
EXAMPLE = os.path.join(WORK, "example")
CELSIUS, TOOL = 32.0, 50.0
DEMOS = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis/vismach/5axis/table-rotary-tilting/demos"
DEMO = """G21 G90 G94 G17 G40 G49 G64 P0.01
T1 M6 G43
G0 X0 Y0 Z60 {t}0 C0
G1 X30 Y0 Z55 {t}12 C20 F2000
G1 X30 Y20 Z55 {t}25 C60
G2 X-10 Y20 Z50 {t}35 C120 R25
G1 X-60 Y-40 Z70 {t}20 C200
G1 X80 Y-60 Z40 {t}40 C150
G1 X0 Y0 Z60 {t}0 C0
M2
"""
SWITCH = """G21 G90 G94
T1 M6 G43
G1 X20 Y10 Z60 {t}20 C30 F3000
M68 E3 Q1
G4 P0.1
M66 P3 L3 Q5
G4 P0.2
M68 E3 Q0
G4 P0.1
M66 P3 L3 Q5
G1 X40 Y10 Z60 {t}30 C40 F3000
M2
"""
failed = []


def check(name, good, said=""):
    print(f"  {'pass' if good else 'FAIL'}  {name}{': ' + said if said else ''}", flush=True)
    if not good:
        failed.append(name)


def hal(*words):
    return subprocess.run(["halcmd", *map(str, words)], check=True, capture_output=True, text=True).stdout


# What the names of its threads begin with.
SERVO = "rtapi_app:T"


def signal_of(name):
    text = hal("gets", name).strip()
    return text == "TRUE" if text in ("TRUE", "FALSE") else float(text)


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def threads_of(pid, name=None):
    """The threads of a process whose name begins so; none of a process that has ended."""
    try:
        threads = os.listdir(f"/proc/{pid}/task")
        return [t for t in threads if name is None or open(f"/proc/{pid}/task/{t}/comm").read().startswith(name)]
    except OSError:
        return []


def servo_owner():
    """The process with the servo threads; that of a control that has just been closed may still be there."""
    found = subprocess.run(["pgrep", "-x", "rtapi_app"], capture_output=True, text=True).stdout.split()
    return next((pid for pid in reversed(found) if threads_of(pid, SERVO)), None)


def fifo(pid, priority, name=None):
    """Asks for FIFO priority of the threads of a process whose name begins so."""
    if "FIFO" not in os.environ:
        return False
    threads = threads_of(pid, name)
    if not threads:
        return False
    done = os.path.join(WORK, "fifo-done")
    if os.path.exists(done):
        os.remove(done)
    open(os.path.join(WORK, "fifo.part"), "w").write("".join(f"{t} {priority}\n" for t in threads))
    os.rename(os.path.join(WORK, "fifo.part"), os.path.join(WORK, "fifo"))
    until(lambda: os.path.exists(done), 5, "priority")
    scheduled = {open(f"/proc/{pid}/task/{t}/stat").read().rsplit(")", 1)[1].split()[38] for t in threads}
    return scheduled == {"1"}


def until(what, seconds, name):
    end = time.monotonic() + seconds
    while not what():
        if time.monotonic() > end:
            raise TimeoutError(name)
        time.sleep(0.01)


class Control:
    """A LinuxCNC with the files of machine.py."""

    def __init__(self, name, tilt):
        self.name, self.tilt = name, tilt
        # One that has just ended takes its time to unload.
        until(lambda: servo_owner() is None, 20, "the end of the LinuxCNC before")
        self.folder = os.path.join(WORK, name)
        os.makedirs(self.folder)
        machine.write(self.folder, name, tilt)
        os.symlink(os.path.join(EXAMPLE, "trueaxis.hal"), os.path.join(self.folder, "trueaxis.hal"))
        log = open(os.path.join(self.folder, "linuxcnc.log"), "w")
        self.process = subprocess.Popen(["linuxcnc", "-r", f"{name}.ini"], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=log,
                                        stderr=log, start_new_session=True)
        ready = lambda: os.path.exists(os.path.join(self.folder, "ready"))
        until(lambda: ready() or self.process.poll() is not None, 30, "start of LinuxCNC")
        if not ready():
            sys.exit("LinuxCNC did not start:\n" + open(log.name).read()[-3000:])
        recorder, self.columns = machine.recorder(tilt)
        for line in recorder.splitlines():
            hal(*line.split())
        self.command, self.status, self.errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
        until(lambda: self.polled() is not None, 10, "status")
        self.on()
        self.command.mode(linuxcnc.MODE_MANUAL)
        self.command.wait_complete()
        self.command.home(-1)
        until(lambda: all(self.polled().homed[:5]), 20, "homing")
        until(lambda: servo_owner() is not None, 10, "the servo thread")
        self.is_fifo = fifo(servo_owner(), 80, SERVO)
        self.mdi("T1 M6 G43")

    def polled(self):
        try:
            self.status.poll()
        except linuxcnc.error:
            return None
        return self.status

    def on(self):
        for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
            self.command.state(state)
            self.command.wait_complete()

    def off(self):
        self.command.state(linuxcnc.STATE_OFF)
        self.command.wait_complete()

    def mdi(self, block):
        self.command.mode(linuxcnc.MODE_MDI)
        self.command.wait_complete()
        self.command.mdi(block)
        self.command.wait_complete(60)
        until(self.is_idle, 60, block)

    def is_idle(self):
        status = self.polled()
        return status.interp_state == linuxcnc.INTERP_IDLE and status.inpos

    def start(self, file):
        self.command.mode(linuxcnc.MODE_AUTO)
        self.command.wait_complete()
        self.command.program_open(file)
        self.command.wait_complete()
        self.command.auto(linuxcnc.AUTO_RUN, 0)
        until(lambda: not self.is_idle(), 10, "start of the program")

    def run(self, file, seconds, during=lambda: None):
        """Runs a program, at most so long; every servo cycle of it, as rows by column."""
        self.mdi(f"G0 X0 Y0 Z60 {self.tilt}0 C0")
        drain = subprocess.Popen(["halsampler", "-n", "16000"], stdout=subprocess.DEVNULL)
        time.sleep(0.3)
        drain.terminate()
        drain.wait()
        out = os.path.join(self.folder, "rows.txt")
        sampler = subprocess.Popen(["halsampler", "-t"], stdout=open(out, "w"))
        hal("setp", "sampler.0.enable", 1)
        began = signal_of("ta-end")
        self.start(file)
        during()
        end = time.monotonic() + seconds
        while not self.is_idle() and time.monotonic() < end:
            time.sleep(0.01)
        if not self.is_idle():
            self.command.abort()
            self.command.wait_complete()
        hal("setp", "sampler.0.enable", 0)
        time.sleep(0.3)
        sampler.terminate()
        sampler.wait()
        rows = [line.split()[1:] for line in open(out) if not line.startswith("overrun")]
        rows = [dict(zip(self.columns, map(float, row))) for row in rows if len(row) == len(self.columns)]
        return [row for row in rows if row["ta-end"] >= began]

    def said(self):
        found = []
        while (error := self.errors.poll()) is not None:
            found.append(error[1])
        return found

    def close(self):
        open(os.path.join(self.folder, "stop"), "w").close()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)


class Live:
    """`trueaxis live` on the plan of the example."""

    def __init__(self, name, *words):
        self.plan = os.path.join(EXAMPLE, f"{name}-live.toml")
        self.log = open(os.path.join(WORK, f"{name}-live.log"), "w+")
        self.process = subprocess.Popen([os.path.join(WORK, "trueaxis"), "live", self.plan, *words], stdout=self.log, stderr=self.log)

    def text(self):
        return open(self.log.name).read()

    def reaches(self, state, seconds=10):
        until(lambda: self.state() == state or self.process.poll() is not None, seconds, f"state {state}\n{self.text()}")
        if self.process.poll() is not None:
            sys.exit("trueaxis has ended:\n" + self.text())
        return self

    def state(self):
        done = subprocess.run([os.path.join(WORK, "trueaxis"), "live", "status", self.plan, "--format", "json"], capture_output=True, text=True)
        last = json.loads(done.stdout).get("last")
        return last and last["state"]

    def lines(self):
        return [line.split("s  ", 1)[1].strip() for line in self.text().splitlines() if " s  " in line]

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(20)


class Judge:
    """Where the tool is in the workpiece, and where the program wants it."""

    def __init__(self, name, tilt):
        path = os.path.join(EXAMPLE, f"{name}.toml")
        self.truth, self.exact = Machine(path, CELSIUS), Machine(path, exact=True)
        self.tilt = tilt
        self.arm = [0, 20, 10] if tilt == "A" else [20, 0, 10]
        self.letters = ["x", "y", "z", tilt.lower(), "c"]

    def world(self, joints):
        """Tip as LinuxCNC counts it, less the tool: the formula of its manual (xyzac-trt-kins, xyzbc-trt-kins)."""
        x, y, z, tilt, c = joints
        to = product(turn("C", -c), product(shift(*self.arm), product(turn(self.tilt, -tilt), shift(*(-v for v in self.arm)))))
        tip = [x, y, z - TOOL, 1.0]
        return [sum(to[i][k] * tip[k] for k in range(4)) for i in range(3)]

    def joints(self, row):
        return [row[f"ta-joint-{l}"] * (1.0 if l in "xyz" else math.pi / 180) for l in self.letters]

    def missed(self, row, offset):
        """Deviation of tip (um) and tool axis (urad) from the program; `offset` acts in this cycle."""
        joints = self.joints(row)
        wanted = [p - o for p, o in zip(self.world(joints), offset[:3])]
        at = {"X": joints[0], "Y": joints[1], "Z": joints[2], self.tilt: joints[3], "C": joints[4]}
        tip, axis = self.truth.tool(at)
        turns = [math.radians(o) for o in offset[3:]]
        nominal = {**at, self.tilt: joints[3] - turns[0], "C": joints[4] - turns[1]}
        _, along = self.exact.tool(nominal)
        return 1e3 * math.dist(tip, wanted), 1e6 * math.dist(axis, along)

    def all(self, rows):
        """Of every cycle in motion. The interpolator of LinuxCNC makes the offset of three cycles act in the fourth."""
        acting = [[row[f"ta-acting-{l}"] for l in self.letters] for row in rows]
        found = []
        for k in range(3, len(rows)):
            if rows[k]["ta-velocity"] > 0:
                offset = [(a + 4 * b + c) / 6 for a, b, c in zip(acting[k - 1], acting[k - 2], acting[k - 3])]
                found.append(self.missed(rows[k], offset))
        return found


def ages(rows):
    """Servo cycles between the reading of a cycle and the offset that was written for it: the echo is the cycle that was read."""
    return [row["ta-end"] - row["ta-echo"] for row in rows if row["ta-velocity"] > 0]


def gaps(rows):
    return sum(b["ta-end"] - a["ta-end"] > 1.5 for a, b in zip(rows, rows[1:]))


def largest_step(rows, letters):
    """Largest change of the offset that is asked for in one cycle, um and 1e-3 deg, and of a joint beyond its speed, um."""
    asked = max(abs(b[f"ta-request-{l}"] - a[f"ta-request-{l}"]) for a, b in zip(rows, rows[1:]) for l in letters[:3])
    joint = max(abs(b[f"ta-joint-{l}"] - a[f"ta-joint-{l}"]) for a, b in zip(rows, rows[1:]) for l in letters[:3])
    return 1e3 * asked, joint


def program(control, text):
    file = os.path.join(control.folder, "program.ngc")
    open(file, "w").write(text.format(t=control.tilt))
    return file


def accuracy(control, judge, name, file, seconds, priority):
    before = judge.all(control.run(file, seconds))
    live = Live(control.name)
    live.reaches("run")
    is_fifo = priority and control.is_fifo and fifo(live.process.pid, 50)
    rows = control.run(file, seconds)
    after = judge.all(rows)
    code = live.end()
    ratio = [quantile([m[i] for m in before], 0.99) / max(1e-9, quantile([m[i] for m in after], 0.99)) for i in (0, 1)]
    age = ages(rows)
    kind = "FIFO priority" if is_fifo else "normal priority"
    print(f"{control.name}, {name}, {kind}: {len(after)} servo cycles in motion, {gaps(rows)} not recorded")
    for i, (of, unit) in enumerate((("tip", "um"), ("tool axis", "urad"))):
        b, a = [m[i] for m in before], [m[i] for m in after]
        print(f"  {of:9} without  p50 {quantile(b, .5):8.3f}  p99 {quantile(b, .99):8.3f}  largest {max(b):8.3f} {unit}")
        print(f"  {'':9} with     p50 {quantile(a, .5):8.3f}  p99 {quantile(a, .99):8.3f}  largest {max(a):8.3f} {unit}   {ratio[i]:.1f} times smaller at p99")
    print(f"  age of the offset: p50 {quantile(age, .5):.0f}, p99 {quantile(age, .99):.0f}, largest {max(age):.0f} servo cycles")
    states = live.lines()
    check("states were Off, Arm, Run, RampDown, Off only", all(s.split(":")[0] in ("off", "arm", "run", "ramp-down", "Off", "Arm", "Run", "RampDown") for s in states), "; ".join(states))
    check("nothing of it is left in the control", code == 0 and max(abs(signal_of(f"ta-request-{l}")) for l in judge.letters) < 2e-6)
    check("LinuxCNC reports no error", not (said := control.said()), "; ".join(said))
    return ratio[0], quantile(age, 0.99), is_fifo


def faults(control, judge):
    """What breaks while it cuts, and what the part in the control does then."""
    slow = program(control, "G21 G90 G94\nT1 M6 G43\nG1 X60 Y40 Z60 {t}30 C90 F900\nG1 X0 Y0 Z60 {t}0 C0\nM2\n")
    size = lambda: max(abs(signal_of(f"ta-request-{l}")) for l in "xyz")

    live = Live(control.name).reaches("run")
    seen = {}

    def kill():
        time.sleep(2.0)
        seen["before"] = size()
        live.process.kill()
        live.process.wait()
        time.sleep(0.6)
        seen.update(tripped=signal_of("ta-tripped"), velocity=signal_of("ta-velocity"), after=size())
        seen["again"] = Live(control.name)
        seen["again"].reaches("run")
        time.sleep(0.5)
        seen.update(resumed=signal_of("ta-velocity"), offset=size())

    rows = control.run(slow, 20, kill)
    step, _ = largest_step(rows, judge.letters)
    check("killed in a cut: the feed stops, then the offset goes to zero", seen["before"] > 0.005 and seen["tripped"] and seen["velocity"] < 1e-6 and seen["after"] < 2e-6,
          f"{1e3 * seen['before']:.1f} um before, {1e3 * seen['after']:.3f} um 0.6 s after")
    check("started again: the offset comes back, the feed goes on", seen["resumed"] > 1 and seen["offset"] > 0.005)
    check("no step of the offset above its slew", step <= 5.0 + 0.01, f"{step:.2f} um a cycle, 5 mm/s are 5 um")
    live = seen["again"]

    def freeze():
        time.sleep(2.0)
        os.kill(live.process.pid, signal.SIGSTOP)
        time.sleep(0.6)
        seen.update(frozen=signal_of("ta-tripped"), frozen_size=size())
        os.kill(live.process.pid, signal.SIGCONT)
        time.sleep(2.0)
        seen.update(thawed=signal_of("ta-tripped"), thawed_size=size())

    rows = control.run(slow, 20, freeze)
    step, _ = largest_step(rows, judge.letters)
    check("frozen (SIGSTOP) in a cut: the control lets the offset go, and takes it again after", seen["frozen"] and seen["frozen_size"] < 2e-6 and not seen["thawed"] and seen["thawed_size"] > 0.005 and step <= 5.01,
          f"largest step {step:.2f} um a cycle")

    control.mdi(f"G0 X30 Y20 Z60 {control.tilt}25 C60")
    time.sleep(0.5)
    stands = lambda: [signal_of(f"ta-joint-{l}") for l in judge.letters]
    before = stands()
    control.off()
    time.sleep(0.5)
    off = live.state()
    control.on()
    control.mdi(f"G0 X30 Y20 Z60 {control.tilt}25 C60")
    time.sleep(1.0)
    apart = max(abs(a - b) for a, b in zip(before, stands()))
    check("machine off: hold; on again: the joints stand where they stood", off == "hold" and apart < 1e-5 and live.state() == "run", f"{1e3 * apart:.3f} um")

    rows = control.run(program(control, SWITCH), 30)
    zero = [max(abs(row[f"ta-acting-{l}"]) for l in judge.letters) for row in rows]
    step, joint = largest_step(rows, judge.letters)
    check("kinematics change with the offset at zero, without a jump of a joint", min(zero[len(zero) // 4:]) < 2e-6 and joint < 0.2 and not control.said(), f"largest motion of a joint {joint * 1e3:.1f} um a cycle")
    check("the run went on after it", live.state() == "run", "; ".join(live.lines()[-3:]))

    # A second one on the same control.
    other = subprocess.run([os.path.join(WORK, "trueaxis"), "live", live.plan, "--for", "2s"], capture_output=True, text=True, env={**os.environ, "XDG_STATE_HOME": WORK + "/other"})
    why = [line for line in other.stderr.splitlines() if "error[" in line]
    check("a second run is refused", other.returncode == 2 and len(why) == 1, "; ".join(why))
    check("the end leaves nothing in the control", live.end() == 0 and size() < 2e-6)

    # A machine file whose pivot is 20 um elsewhere is of another machine.
    text = open(os.path.join(EXAMPLE, f"{control.name}.toml")).read()
    pivot = "0 20 10 mm" if control.tilt == "A" else "20 0 10 mm"
    open(os.path.join(EXAMPLE, f"{control.name}.toml"), "w").write(text.replace(pivot, pivot.replace("20", "20.03").replace("10", "10.02")))
    live = Live(control.name)
    live.reaches("run")
    # One standing pose is its zero.
    time.sleep(0.5)
    control.mdi(f"G0 X30 Y20 Z60 {control.tilt}60 C150")
    until(lambda: live.state() == "hold", 5, "hold")
    check("another pivot than the machine file's is noticed", any("otherwise than the machine file" in line for line in live.lines()), live.lines()[-1])
    live.end()
    open(os.path.join(EXAMPLE, f"{control.name}.toml"), "w").write(text)


def main():
    quick = "--quick" in sys.argv
    worst = {}
    machines = [("xyzac", "A"), ("xyzbc", "B")]
    wanted = [m for m in machines if m[0] in sys.argv] or machines[:1 if quick else 2]
    if len(wanted) > 1:
        # A process talks to one LinuxCNC in its life: its channels stay those of the first.
        ends = [subprocess.run([sys.executable, *sys.argv, name]).returncode for name, _ in wanted]
        sys.exit(any(ends))
    for name, tilt in wanted:
        control = Control(name, tilt)
        judge = Judge(name, tilt)
        try:
            joints = judge.joints(control.run(program(control, DEMO), 1)[-1])
            apart = math.dist(judge.world(joints), judge.exact.tool(dict(zip(["X", "Y", "Z", tilt, "C"], joints)))[0])
            check("machine file and control have the same kinematics", apart < 1e-9, f"{apart:.1e} mm")
            jobs = [("demo", program(control, DEMO), 60)]
            demo = os.path.join(DEMOS, {"xyzac": "impeller-7bl-xyzac.ngc", "xyzbc": "boat-xyzbc.ngc"}[name])
            if not quick and os.path.exists(demo):
                # Its remapped codes switch to the kinematics that are on already.
                lines = [line for line in open(demo) if line[:4] not in ("M428", "M429")]
                file = os.path.join(control.folder, "other.ngc")
                open(file, "w").writelines(lines)
                jobs.append((f"{os.path.basename(demo)} of LinuxCNC, 40 s", file, 40))
            for title, file, seconds in jobs:
                for priority in (False, True) if control.is_fifo else (False,):
                    if title == "demo":
                        file = program(control, DEMO)
                    ratio, age, is_fifo = accuracy(control, judge, title, file, seconds, priority)
                    if is_fifo or not control.is_fifo:
                        check("at least 50 times smaller at p99", ratio >= 50, f"{ratio:.1f}")
                    if is_fifo:
                        check("age at p99 at most 2 servo cycles", age <= 2, f"{age:.0f}")
                    worst[(name, title, is_fifo)] = ratio
            print(f"{name}, faults")
            faults(control, judge)
        finally:
            control.close()
    print(f"{name}: all checks passed" if not failed else f"{name}, failed: {', '.join(failed)}")
    sys.exit(bool(failed))


main()
