"""Posted programs through LinuxCNC's interpreter -> crates/trueaxis/tests/data/linuxcnc-{holes,plate}.txt

usage: python3 oracles/linuxcnc_holes.py PATH/TO/trueaxis
tool: rs274 of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, `linuxcnc-uspace`)
The program of `trueaxis post` for tests/data/holes.apt stands behind `program`, LinuxCNC's end points (X Y Z, mm, without
repetitions) behind `points`; for examples/06_compensate/plate.cls (`--tcp length`: arcs and cycles) its calls behind `calls`.
"""
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DATA = os.path.join(ROOT, "crates", "trueaxis", "tests", "data")
MACHINE = os.path.join(ROOT, "machines", "three-axis-mill", "machine.toml")


def plate():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "plate.ngc")
        file = os.path.join(ROOT, "examples", "06_compensate", "plate.cls")
        post = [sys.argv[1], "post", MACHINE, file, "--control", "linuxcnc", "--tcp", "length", "-o", path]
        subprocess.run(post, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(path, encoding="ascii") as file:
            program = file.read()
        table = os.path.join(folder, "tool.tbl")
        with open(table, "w", encoding="ascii") as file:
            file.write("T1 P1 D10 Z0\n")
        ran = subprocess.run(["rs274", "-g", "-t", table, path], cwd=folder, capture_output=True, text=True, check=True)
    calls = []
    for name, words in re.findall(r"(STRAIGHT_\w+|ARC_FEED|DWELL)\(([^)]*)\)", ran.stdout):
        count = {"ARC_FEED": 6, "DWELL": 1}.get(name, 3)
        calls.append(" ".join([name] + [word.strip() for word in words.split(",")[:count]]))
    with open(os.path.join(DATA, "linuxcnc-plate.txt"), "w", encoding="ascii") as out:
        out.write("program\n" + program + "calls\n" + "\n".join(calls) + "\n")


def main():
    plate()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "holes.ngc")
        post = [sys.argv[1], "post", MACHINE, os.path.join(DATA, "holes.apt"), "--control", "linuxcnc", "--tcp", "off", "-o", path]
        subprocess.run(post, check=True, stdout=subprocess.DEVNULL)
        with open(path, encoding="ascii") as file:
            program = file.read()
        table = os.path.join(folder, "tool.tbl")
        with open(table, "w", encoding="ascii") as file:
            file.write("T1 P1 D10 Z0\n")
        ran = subprocess.run(["rs274", "-g", "-t", table, path], cwd=folder, capture_output=True, text=True, check=True)
    points = []
    for words in re.findall(r"STRAIGHT_\w+\(([^)]*)\)", ran.stdout):
        point = " ".join(word.strip() for word in words.split(",")[:3])
        if not points or points[-1] != point:
            points.append(point)
    with open(os.path.join(DATA, "linuxcnc-holes.txt"), "w", encoding="ascii") as out:
        out.write("program\n" + program + "points\n" + "\n".join(points) + "\n")


if __name__ == "__main__":
    main()
