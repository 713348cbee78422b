"""Joints of a whole LinuxCNC with nominal and with written rotary centres -> crates/trueaxis/tests/data/linuxcnc-kinematics/

usage: python3 oracles/linuxcnc_kinematics.py [TRUEAXIS]      (default target/release/trueaxis; 6 min)
tool: LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, package linuxcnc-uspace): milltask, motmod, xyzac-trt-kins and
xyzbc-trt-kins, in simulation, in the frame of linuxcnc_comp.py.
For each machine file of that folder `trueaxis compensate tables` writes the files, LinuxCNC runs with their kinematics.hal and once
more with the pins of the machine without errors, which are worked out by hand below. In each run G54 lies where the part zero is
with the table at zero angles, the tool is G43.1, and the tip is sent to the same places of the part at the same angles by G0
X Y Z A C; joint.N.pos-cmd (HAL, double precision) is written down. The part stands on the table: its zero has gone with the C axis
by the location errors of both axes. Without LinuxCNC the script says so and writes nothing.
"""
import os
import random
import shutil
import subprocess
import sys
import tempfile

from linuxcnc_comp import ROOT, UI, ini, linuxcnc, loop

DATA = os.path.join(ROOT, "crates", "trueaxis", "tests", "data", "linuxcnc-kinematics")
PLACES = 60

# name: tilting axis, tool length, pins without errors and part zero of a tool of no length: places of the axes and of the
# part in the machine file, added up from the bed, less that of the tool; how far the part has gone
SETS = {
    # C at (5+40, -35+25, -60+18), A at (., -35, -60), part at (45-7, -10+9, -42+50), tool at (3, 0, 90)
    "xyzac": ("A", 80, {"x-rot-point": 42, "y-rot-point": -10, "z-rot-point": -132, "y-offset": -25, "z-offset": -18},
              (35, -1, -82), (0.050, -0.037 + 0.028, -0.043)),
    # C at (-30+22, 6-13, -60+15), B at (-30, ., -60), part at (-8+4, -7-6, -45+30), tool at (0, 0, 90)
    "xyzbc": ("B", 65, {"x-rot-point": -8, "y-rot-point": -7, "z-rot-point": -135, "x-offset": -22, "z-offset": -15},
              (-4, -13, -105), (-0.031 + 0.050, 0.046, 0.022)),
}


def tables(name):
    """Writes the files; gives that with the pins."""
    trueaxis = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "target", "release", "trueaxis")
    folder = os.path.join(DATA, name)
    shutil.rmtree(folder, ignore_errors=True)
    command = [trueaxis, "compensate", "tables", folder + ".toml", "--target", "linuxcnc", "-o", folder]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return open(os.path.join(folder, "kinematics.hal")).read()


def places(tilt):
    at = lambda low, high: f"{random.uniform(low, high):.3f}"
    random.seed(20261122)
    return [{"X": at(-150, 150), "Y": at(-150, 150), "Z": at(-50, 150), tilt: at(-115, 115), "C": at(-360, 360)}
            for _ in range(PLACES)]


def run(name, hal, zero):
    """The joints at each place, as LinuxCNC writes them."""
    tilt, length, *_ = SETS[name]
    letters, module = ["X", "Y", "Z", tilt, "C"], f"{name}-trt-kins"
    limits = {j: (-9999, 9999) for j in range(5)}
    head = ["G21 G90 G94", "G10 L2 P1 " + " ".join(f"{l}{v:.6f}" for l, v in zip("XYZ", zero)), "G54", f"G43.1 Z{length}"]
    moves = [("go", block) for block in head]
    moves += [("up", "G0 " + " ".join(f"{l}{v}" for l, v in place.items())) for place in places(tilt)]
    tool = f"net tool-length motion.tooloffset.z => {module}.tool-offset\n"
    with tempfile.TemporaryDirectory() as work:
        files = {"oracle.ini": ini(letters, {}, limits, module, ["loop.hal", "kinematics.hal", "tool.hal"]), "loop.hal": loop(5),
                 "kinematics.hal": hal, "tool.hal": tool, "tool.tbl": "", "sim.var": "",
                 "moves.txt": "".join(f"{way},{block}\n" for way, block in moves), "ui": "#!/usr/bin/python3\n" + UI}
        for file, text in files.items():
            open(os.path.join(work, file), "w").write(text)
        os.chmod(os.path.join(work, "ui"), 0o755)
        done = linuxcnc(work)
        result = os.path.join(work, "stops.csv")
        if not os.path.exists(result) or len(open(result).readlines()) != 5 * PLACES:
            sys.exit(f"{name}: LinuxCNC did not go through:\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
        positions = [row.split(",")[2] for row in open(result).read().split()]
    return [positions[5 * i:5 * i + 5] for i in range(PLACES)]


def main():
    if shutil.which("linuxcnc") is None:
        print("skipped: LinuxCNC is not installed (docs/compensation-tables.md tells how)")
        return
    rows = []
    for name, (tilt, _, nominal, zero, goes) in SETS.items():
        written = tables(name)
        exact = "".join(f"setp {name}-trt-kins.{pin} {value}\n" for pin, value in nominal.items())
        without = run(name, exact, zero)
        with_pins = run(name, written, [a + b for a, b in zip(zero, goes)])
        for place, a, b in zip(places(tilt), without, with_pins):
            for joint, letter in ((3, tilt), (4, "C")):
                assert all(abs(float(run[joint]) - float(place[letter])) < 1e-9 for run in (a, b)), (place, a, b)
            rows.append(",".join([name, *place.values(), *a[:3], *b[:3]]))
    head = [
        "# Joints of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, linuxcnc-uspace) at standstill, nominal pins and those written",
        "# machines and files: beside; written by `python3 oracles/linuxcnc_kinematics.py`, which also wrote the files",
        "# x, y, z: tip in the part; mm, deg",
        "machine,x,y,z,tilt,c,nominal_x,nominal_y,nominal_z,actual_x,actual_y,actual_z",
    ]
    with open(os.path.join(DATA, "joints.csv"), "w") as out:
        out.write("\n".join(head + rows) + "\n")
    print(f"{len(rows)} places written")


if __name__ == "__main__":
    main()
