"""The corrected programs of `identify probe --corrections` on LinuxCNC's own interpreter.

Tool: `rs274` of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7 (Debian 12, `linuxcnc-uspace`), which takes every touch to come at
the end of its way (STRAIGHT_PROBE). What its LOG lines say is what LinuxCNC computes with the table.

Run in the repository root: python3 oracles/linuxcnc_ring.py TRUEAXIS [RS274]
Writes crates/trueaxis/tests/data/linuxcnc-ring.txt.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

EXPECTED = pathlib.Path("crates/trueaxis/tests/data/linuxcnc-ring.txt")
STUDY = "examples/05_identify/ring-programs.toml"
PROGRAMS = ("ring-corrected", "four-hits-corrected", "z-datum-corrected")

trueaxis = pathlib.Path(sys.argv[1]).resolve()
rs274 = sys.argv[2] if len(sys.argv) > 2 else "rs274"
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([trueaxis, "identify", "probe", STUDY, "--corrections", folder, "--control", "linuxcnc"],
                   check=True, capture_output=True)
    path = pathlib.Path(folder)
    (path / "t.ini").write_text("[RS274NGC]\nSUBROUTINE_PATH = .\nPARAMETER_FILE = v.var\n[EMCIO]\nTOOL_TABLE = t.tbl\n")
    (path / "t.tbl").write_text("T5 P5 Z0 D0\n")
    (path / "v.var").write_text("")
    text = "# rs274 of LinuxCNC 2.9.0~pre1+git20230208.f1270d6ed7; oracles/linuxcnc_ring.py\n"
    for name in PROGRAMS:
        command = [rs274, "-i", "t.ini", "-t", "t.tbl", "-v", "v.var", "-g", f"{name}.ngc"]
        ran = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
        lines = re.findall(r'LOG\("(.*)"\)', ran.stdout)
        text += f"program {name}\n" + "".join(f"{line}\n" for line in lines)
EXPECTED.write_text(text)
