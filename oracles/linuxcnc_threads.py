"""Random G76 threads through LinuxCNC's interpreter -> crates/trueaxis-nc/tests/data/linuxcnc-threads.txt

usage: python3 oracles/linuxcnc_threads.py
tool: rs274 of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, `linuxcnc-uspace`)
A program stands after `program`, its moves after `moves`: X and Z in the unit of the program and the travel in a turn, 0 for a rapid.
"""
import os
import random
import re
import subprocess
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis-nc", "tests", "data", "linuxcnc-threads.txt")


def program(r):
    x, z = r.randint(10, 40), r.randint(-5, 15)
    words = ["p%.2f" % r.uniform(0.5, 3), "z%d" % (z + r.choice([-1, 1]) * r.randint(15, 40))]
    words += ["i%.2f" % (r.choice([-1, 1]) * r.uniform(0.5, 3)), "j%.3f" % r.uniform(0.1, 0.4), "k%.3f" % r.uniform(0.5, 1.6)]
    words += ["r%.1f" % r.uniform(1, 2.5)] if r.random() < 0.6 else []
    words += ["q%.1f" % r.uniform(10, 30)] if r.random() < 0.6 else []
    words += ["h%d" % r.randint(0, 3)] if r.random() < 0.6 else []
    words += ["e%.2f l%d" % (r.uniform(0.5, 2), r.randint(0, 3))] if r.random() < 0.6 else []
    return [r.choice(["g20", "g21"]) + " g18 " + r.choice(["g7", "g8"]), "m3 s300", "g0 x%d z%d" % (x, z), "g76 " + " ".join(words), "g0 x50", "m2"]


def moves(text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "p.ngc")
        with open(path, "w", encoding="ascii") as file:
            file.write(text)
        ran = subprocess.run(["rs274", "-g", path], cwd=folder, capture_output=True, text=True, check=False)
    if ran.returncode:
        return None
    found, pitch = [], 0.0
    for name, words in re.findall(r"(STRAIGHT_\w+|START_SPEED_FEED_SYNC|STOP_SPEED\w+)\(([^)]*)\)", ran.stdout):
        numbers = [float(word) for word in words.split(",") if word.strip()]
        if name.startswith("START"):
            pitch = numbers[0]
        elif name.startswith("STOP"):
            pitch = 0.0
        else:
            found.append("%.4f %.4f %.4f" % (numbers[0], numbers[2], pitch if name == "STRAIGHT_FEED" else 0.0))
    return found


def main():
    out = []
    for seed in range(60):
        lines = program(random.Random(seed))
        found = moves("\n".join(lines) + "\n")
        if found:
            out += ["program", *lines, "moves", *found]
    with open(OUT, "w", encoding="ascii") as file:
        file.write("\n".join(out) + "\n")


main()
