"""The kinds of input files, with the command that reads each. `05/x` is `examples/05_identify/x`, `i5/` one of machines/."""

import math
import re
import struct
import subprocess

FOLDERS = ("01_describe", "02_simulate", "03_predict", "04_plan", "05_identify", "06_compensate", "07_verify", "08_live")
I5, XKAS, MILL = "machines/i5-engraver/machine.toml", "machines/xkas2525/machine.toml", "machines/three-axis-mill/machine.toml"
GANTRY = "machines/gantry-001/machine.toml"

# Kind, file that is changed, command.
KINDS = [
    ("machine file", I5, f"check {I5}"),
    ("machine file with errors", XKAS, f"pose {XKAS} --at X=3000,Y=1200,Z=-700,C=-90,A=15"),
    ("error table", "machines/xkas2525/X.csv", f"check {XKAS}"),
    ("machine file with scales", GANTRY, f"compensate values {GANTRY} --axis X --step 350 --temperature scale_x=30.5,workpiece=30.5"),
    ("positions", "01/positions.csv", f"pose {XKAS} --at-file 01/positions.csv"),
    ("tool path", "01/path.csv", f"solve {I5} --path 01/path.csv"),
    ("STL, text", "made/block.stl", f"simulate {I5} 02/collision-fanuc.nc --setup made/text-stl.setup.toml"),
    ("STL, binary", "made/binary.stl", f"simulate {I5} 02/collision-fanuc.nc --setup made/binary-stl.setup.toml"),
    ("set-up", "02/collision-fanuc.setup.toml", f"simulate {I5} 02/collision-fanuc.nc"),
    ("SINUMERIK archive", "made/archive.ini", f"simulate {MILL} made/archive.mpf --setup made/archive.setup.toml"),
    ("program, FANUC", "06/everyday-fanuc.nc", f"simulate {I5} 06/everyday-fanuc.nc"),
    ("program, FANUC, radius", "02/square-g41.nc", f"simulate {MILL} 02/square-g41.nc"),
    ("program, Haas", "02/ring-fanuc.nc", f"simulate {I5} 02/ring-fanuc.nc --control haas"),
    ("program, SINUMERIK", "made/short.mpf", f"simulate machines/wyxzcat-gantry/machine.toml made/short.mpf --setup 02/impeller-840d.setup.toml"),
    ("program, HEIDENHAIN", "02/incremental.h", "simulate machines/head-table/machine.toml 02/incremental.h"),
    ("program, LinuxCNC", "02/circle-times.ngc", f"simulate {MILL} 02/circle-times.ngc"),
    ("temperature log", "03/torque-arm-hall.csv", "predict 03/torque-arm-over-a-shift.toml"),
    ("study of a test piece", "03/cone-on-i5.toml", "predict 03/cone-on-i5.toml"),
    ("test piece", "testpieces/iso10791-7-cone.toml", "predict 03/cone-on-i5.toml"),
    ("tolerances of a test piece", "testpieces/gbt33150-tolerances.toml", "predict made/toleranced.toml"),
    ("study of holes", "03/torque-arm.toml", "predict 03/torque-arm.toml"),
    ("readings of a set-up", "03/nas979-set-up-readings.toml", "predict 03/nas979-set-up.toml"),
    # Each sample of a part takes 2 ms: few of them, whatever the file says.
    ("study of a part", "03/housing.toml", "predict 03/housing.toml --samples 10"),
    ("part file", "parts/housing.toml", "predict 03/housing.toml --samples 10"),
    ("part file by its program", "parts/impeller-blade.toml", "predict 03/blade.toml"),
    ("points of a part", "parts/s-shape-a.csv", "predict 03/s-shape.toml"),
    ("QIF of a product", "import/plate.qif", "part import/plate.qif"),
    ("set-up of a part", "03/s-shape.setup.toml", "predict 03/s-shape.toml"),
    ("set-up with stock", "02/ring-fanuc.setup.toml", f"simulate {I5} 02/ring-fanuc.nc --stock"),
    ("STL of a stock", "made/blank.stl", f"simulate {I5} 02/ring-fanuc.nc --setup made/blank.setup.toml --stock"),
    ("campaign, plan", "04/probe-ball.toml", "plan 04/probe-ball.toml"),
    ("campaign, measure", "04/laser-gantry.toml", "measure 04/laser-gantry.toml -o out/readings"),
    ("poses", "07/probe-ball-poses.csv", "measure 07/probe-ball-campaign.toml -o out/readings"),
    ("study of a surface", "made/probe-surface.toml", "plan probe-surface made/probe-surface.toml"),
    ("points of a surface", "made/bangle.csv", "plan probe-surface made/probe-surface.toml"),
    ("set-up of a tool setting", "04/tool-setting.setup.toml", f"plan tool-setting {I5} 04/tool-setting.setup.toml -o out/setting --control fanuc"),
    ("campaign, identify", "05/mixed-instruments.toml", "identify 05/mixed-instruments.toml"),
    ("readings, ball-bar", "05/ball-bar.csv", "identify 05/mixed-instruments.toml"),
    ("readings, R-test", "05/r-test.csv", "identify 05/mixed-instruments.toml"),
    ("readings, laser", "05/laser-x.csv", "identify 05/mixed-instruments.toml"),
    ("readings, probe on a ball", "made/probe-ball.csv", "identify made/probe-ball.toml"),
    ("readings, drift", "05/drift.csv", "identify 05/drift.toml"),
    ("readings, ball centres", "made/head-head.csv", "identify made/head-head.toml"),
    ("readings, ring on the table", "made/ring-on-table.csv", "identify made/ring-on-table.toml"),
    ("campaign in stages", "05/probe-ball-procedure.toml", "identify 05/probe-ball-procedure.toml"),
    ("readings of a stage", "05/procedure-zero.csv", "identify 05/probe-ball-procedure.toml"),
    ("values and covariance", "made/predicted-covariance.toml", "pose made/predicted.toml --at X=300,Y=250,Z=-150,C=45"),
    ("machine file of all errors", "made/predicted.toml", "pose made/predicted.toml --at X=300,Y=250,Z=-150,C=45"),
    ("laser runs", "05/y-axis-two-temperatures.csv", "identify expansion 05/y-axis-two-temperatures.toml"),
    ("study of an expansion", "05/y-axis-two-temperatures.toml", "identify expansion 05/y-axis-two-temperatures.toml"),
    ("study of error tables", "05/error-tables.toml", "identify tables 05/error-tables.toml"),
    ("readings of one error", "05/error-tables/EXX.csv", "identify tables 05/error-tables.toml"),
    ("circles of error tables", "05/error-tables/circle-XY.csv", "identify tables 05/error-tables.toml"),
    ("thermal study", "05/lathe-thermal.toml", "identify thermal 05/lathe-thermal.toml --score 05/lathe-new-day.csv"),
    ("thermal log", "05/lathe-thermal/cycle-1.csv", "identify thermal 05/lathe-thermal.toml"),
    ("thermal log, later day", "05/lathe-new-day.csv", "identify thermal 05/lathe-thermal.toml --score 05/lathe-new-day.csv"),
    ("RTCP file", "05/rtcp-engraver.toml", "identify rtcp 05/rtcp-engraver.toml"),
    ("RTCP readings", "05/rtcp-engraver-c-rtcp.csv", "identify rtcp 05/rtcp-engraver.toml"),
    ("RTCP positions", "05/rtcp-engraver-a.csv", "identify rtcp 05/rtcp-engraver.toml"),
    ("RTCP, two balls", "05/rtcp-angles-high.csv", "identify rtcp 05/rtcp-angles.toml"),
    ("study of a probe", "05/ring-60.toml", "identify probe 05/ring-60.toml"),
    ("hits of a probe", "05/ring-60.csv", "identify probe 05/ring-60.toml"),
    ("hits to be corrected", "05/ring-60-fresh.csv", "identify probe 05/ring-60.toml --correct 05/ring-60-fresh.csv -o out/corrected.csv"),
    ("hits on a sphere", "05/sphere-long.csv", "identify probe 05/sphere.toml"),
    ("log of a probe program", "05/ring-programs.log", "identify probe 05/ring-programs.toml"),
    ("study of hits", "05/bangle-hits.toml", "identify surface 05/bangle-hits.toml"),
    ("log of hits", "05/bangle-hits.log", "identify surface 05/bangle-hits.toml"),
    ("points of hits", "05/bangle-points.csv", "identify surface 05/bangle-hits.toml"),
    ("log of a tool setter", "05/tool-setting.log", f"identify tools {I5} 04/tool-setting.setup.toml 05/tool-setting.log"),
    ("cutter locations, APT", "06/plate.cls", f"post {MILL} 06/plate.cls --control heidenhain --tcp length -o out/plate.h --verify"),
    ("cutter locations, five axes", "made/blade.cls", f"post {XKAS} made/blade.cls --control sinumerik -o out/blade.mpf --verify"),
    ("template of a post", "made/template.j2", f"post {MILL} 06/plate.cls --control fanuc --tcp length --template made/template.j2 -o out/plate.nc"),
    ("program, compensated", "06/everyday-fanuc.nc", f"compensate program {I5} 06/everyday-fanuc.nc -o out/everyday.nc"),
    ("study of an adaptation", "made/adapt.toml", "compensate adapt made/adapt.toml"),
    ("path of an adaptation", "made/adapt.cls", "compensate adapt made/adapt.toml"),
    ("measured blank", "made/blank.csv", "compensate adapt made/adapt.toml"),
    ("verify file", "07/probe-ball.toml", "verify 07/probe-ball.toml"),
    ("readings to verify", "07/probe-ball.csv", "verify 07/probe-ball.toml"),
    ("laser before and after", "07/laser-before-after-x.toml", "verify --before-after 07/laser-before-after-x.toml"),
    ("certificate", "07/certificate-program.toml", "verify --certificate 07/certificate-program.toml"),
    ("readings of a certificate", "07/certificate-program-after.csv", "verify --certificate 07/certificate-program.toml"),
    ("indices of a part", "07/nas979-measured.toml", "verify --part 07/nas979-measured.toml"),
    ("points of a part", "made/part-points.csv", "verify --part made/part.toml"),
    ("study of a part's points", "made/part.toml", "verify --part made/part.toml"),
    ("later machine file", "07/xkas2525-after-a-year.toml", f"verify --diff {XKAS} 07/xkas2525-after-a-year.toml"),
    ("history, machine file", "07/history/mill-2024.toml", "verify --history 07/history"),
    ("history, document", "made/evaluated.json", "verify --history made/evaluated.json made/evaluated-later.json"),
    ("sheet, ISO 230-1 plate", "07/moody-1955.csv", "evaluate iso230-1 07/moody-1955.csv"),
    ("sheet, ISO 230-1 level", "07/straightness-x-level.csv", "evaluate iso230-1 07/straightness-x-level.csv"),
    ("sheet, ISO 230-1 square", "07/squareness-xy.csv", "evaluate iso230-1 07/squareness-xy.csv"),
    ("sheet, ISO 230-2", "07/x-axis-laser.csv", "evaluate iso230-2 07/x-axis-laser.csv"),
    ("sheet, ISO 230-2 rotary", "07/c-axis-polygon.csv", "evaluate iso230-2 07/c-axis-polygon.csv"),
    ("sheet, VDI 3441", "07/x-axis-laser.csv", "evaluate vdi3441 07/x-axis-laser.csv"),
    ("sheet, ISO 230-3", "07/spindle-drift.csv", "evaluate iso230-3 07/spindle-drift.csv"),
    ("sheet, ISO 230-4", "07/circle-xy.csv", "evaluate iso230-4 07/circle-xy.csv"),
    ("sheet, ISO 230-6", "07/body-diagonals.csv", "evaluate iso230-6 07/body-diagonals.csv"),
    ("sheet, ISO 230-7", "07/spindle-motion.csv", "evaluate iso230-7 07/spindle-motion.csv"),
    ("sheet, ISO 230-10", "07/probe-performance.csv", "evaluate iso230-10 07/probe-performance.csv"),
    ("conditions of a sheet", "07/x-axis-laser.toml", "evaluate iso230-2 07/x-axis-laser.csv"),
    ("conditions of a circle", "07/circle-xy.toml", "evaluate iso230-4 07/circle-xy.csv"),
    ("conditions of a plate", "07/moody-1955.toml", "evaluate iso230-1 07/moody-1955.csv"),
    ("points of a form", "07/cone-section.csv", "evaluate form 07/cone-section.csv --element circle"),
    ("points of a cylinder", "07/cylinder-points.csv", "evaluate form 07/cylinder-points.csv --element cylinder"),
    ("tolerance file", "made/tolerances.toml", "evaluate iso230-2 07/x-axis-laser.csv --tolerances made/tolerances.toml"),
    ("mapping file", "07/ball-bar-export.map.toml", "evaluate iso230-4 07/ball-bar-export.csv"),
    ("mapped table", "07/ball-bar-export.csv", "evaluate iso230-4 07/ball-bar-export.csv"),
    ("import, QIF", "made/circles.qif", "evaluate iso230-4 made/circles.qif --feature bore"),
    ("import, ECMC", "made/report.md", "evaluate iso230-2 made/report.md"),
    ("import, Renishaw", "made/laser.rtl", "evaluate iso230-2 made/laser.rtl"),
    ("plan of a live run", "08/gantry-mock.toml", "live expect 08/gantry-mock.toml --temperature-log 03/torque-arm-hall.csv"),
    ("plan of a live run, LinuxCNC", "08/linuxcnc/xyzac-live.toml", "live status 08/linuxcnc/xyzac-live.toml"),
    ("record of a part", "made/arm.csv", "predict made/arm.toml"),
    ("log of a live day", "03/torque-arm-hall.csv", "live expect 08/gantry-mock.toml --temperature-log 03/torque-arm-hall.csv"),
]

RTL = (
    "HEADER::\r\nFile type  : rtl\r\nOwner      : Linear\r\n\r\nTARGET DATA::\r\nFiletype  : ISO\r\nTarget-count: 3\r\nTargets :\r\n"
    "0.000  100.000\r\n 200.000 \r\nFlags: 0 0 2 0\r\n\r\nUSER-TEXT::\r\nMachine: M7\r\nDate:2020-02-02 10:00:00\r\nAxis:X\r\n\r\n"
    "RUNS::\r\nRun-count:10\r\n\r\nDEVIATIONS::\r\nRun Target Data:\r\n"
)


def long(word):
    folder = next((f for f in FOLDERS if word[:3] == f[:2] + "/"), None)
    return f"examples/{folder}/{word[3:]}" if folder else word


def words(command):
    """The words of a command; commas stand for blanks in a position."""
    all_words = [long(w) for w in command.split(" ")]
    return [w.replace(",", " ") if "=" in w else w for w in all_words]


def _rtl():
    rows = []
    for run in range(1, 11):
        targets = (1, 2, 3) if run % 2 else (3, 2, 1)
        rows += [f"{run}   {t}      {0.4 * t + 0.1 * (run % 3):.1f}\r\n" for t in targets]
    return RTL + "".join(rows) + "\r\nENVIRONMENT::\r\nAir temp: 20.1\r\nEOF::\r\n"


def _box_stl():
    corners = [(x, y, z) for x in (0, 20) for y in (0, 20) for z in (0, 10)]
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return [(corners[a], corners[b], corners[c]) for q in quads for a, b, c in (q[:3], (q[0], q[2], q[3]))]


def _arm():
    """What acted at the 32 holes of the torque arm."""
    rows = ["time_s,block,followed,known,tcp,X_mm,Y_mm,Z_mm,X_acted_um,Y_acted_um,scale_x_degC,scale_y_degC,scale_z_degC,workpiece_degC"]
    for hole in range(32):
        turn = 2.0 * math.pi * hole / 32
        x, y = 2300.0 + 1000.0 * math.cos(turn), 1150.0 + 1000.0 * math.sin(turn)
        rows.append(f"{60 * hole},{10 * hole},1,1,0,{x:.4f},{y:.4f},-30,{0.0155 * x:.1f},{0.044 * y:.1f},30.5,31.2,30.8,30.8")
    return "\n".join(rows) + "\n"


def prepare(tree, program):
    """Smaller copies of slow examples, and files that the project makes itself."""
    made = tree / "made"
    made.mkdir()

    def read(name):
        return (tree / long(name)).read_text(encoding="utf-8")

    def write(name, text, *changes):
        for old, new in changes:
            assert old in text, (name, old)
            text = text.replace(old, new)
        (made / name).write_bytes(text.encode())

    def run(command, name=None, ok=(0,)):
        done = subprocess.run([program, *words(command)], cwd=tree, capture_output=True, check=False)
        assert done.returncode in ok, (command, done.returncode, done.stderr.decode())
        if name:
            (made / name).write_bytes(done.stdout)

    def every(name, step):
        rows = [r for r in read(name).splitlines() if not r.startswith("#")]
        return "\n".join(rows[:1] + rows[1::step]) + "\n"

    box = _box_stl()
    facets = "".join("facet normal 0 0 1\nouter loop\n" + "".join("vertex %g %g %g\n" % p for p in t) + "endloop\nendfacet\n" for t in box)
    write("block.stl", f"solid block\n{facets}endsolid block\n")
    (made / "binary.stl").write_bytes(b"\0" * 80 + struct.pack("<I", len(box)) + b"".join(struct.pack("<12fH", 0, 0, 1, *t[0], *t[1], *t[2], 0) for t in box))
    setup = read("02/collision-fanuc.setup.toml")
    for name, stl in (("text-stl", "block.stl"), ("binary-stl", "binary.stl")):
        write(f"{name}.setup.toml", f'{setup}\n[[fixture]]\nname = "block"\nstl = "{stl}"\nplacement = "-10 -10 0 mm"\n')
    blank = read("02/ring-fanuc.setup.toml").replace('cylinder = { diameter = "60 mm", length = "34 mm" }', 'stl = "blank.stl"')
    write("blank.setup.toml", blank)
    write("blank.stl", f"solid block\n{facets}endsolid block\n")
    write("archive.ini", '$TC_TP2[3]="MILL 10"\n$TC_DP1[3,1]=120\n$TC_DP3[3,1]=50.5\n$TC_DP6[3,1]=5\n$P_UIFR[1]=CTRANS(X,300,Y,200,Z,-300)\n')
    write("archive.setup.toml", 'control = "sinumerik"\narchive = "archive.ini"\n')
    write("archive.mpf", 'T="MILL 10" D1\nM6\nG54 G17 G90 G0 X0 Y0 Z50\nG1 Z10 F500\nX40 Y20\nG2 X60 Y40 I0 J20\nM30\n')
    write("short.mpf", "\n".join(read("02/impeller-840d.mpf").splitlines()[:120]) + "\nM30\n")
    write("toleranced.toml", read("03/nas979-set-up.toml"), ("\nname = \"NAS", '\ntolerances = "../testpieces/gbt33150-tolerances.toml"\nname = "NAS'),
          ("../../", "../"), ('"nas979-', '"../examples/03_predict/nas979-'))
    for name in ("probe-ball", "ring-on-table", "head-head"):
        text = read(f"05/{name}.toml").replace("../../", "../").replace('"head-head-machine', '"../examples/05_identify/head-head-machine')
        # With much noise nothing is left to be explained, which takes long.
        text = re.sub(r'noise = "\d+ um"', 'noise = "300 um"', text) if name != "probe-ball" else text
        write(f"{name}.toml", text)
        write(f"{name}.csv", every(f"05/{name}.csv", 1 if name == "head-head" else 3))
    write("bangle.csv", every("04/bangle-nominal.csv", 6))
    write("probe-surface.toml", read("04/probe-surface.toml"), ("../../", "../"), ("bangle-nominal.csv", "bangle.csv"),
          ("../05_identify", "../examples/05_identify"), ("bangle-true.csv", "../examples/04_plan/bangle-true.csv"))
    run("identify 05/drift.toml --predictor made/predicted.toml")
    run(f"post {MILL} 06/plate.cls --control fanuc --show-template", "template.j2")
    write("blade.cls", "\n".join(read("06/blade.cls").splitlines()[:150]) + "\nFINI\n")
    for name in ("evaluated", "evaluated-later"):
        run("evaluate iso230-2 07/x-axis-laser.csv --format json", f"{name}.json")
    later = (made / "evaluated-later.json").read_text()
    assert "2026-11-21" in later
    (made / "evaluated-later.json").write_text(later.replace("2026-11-21", "2026-12-21"))
    write("tolerances.toml", 'name = "acceptance"\n[tolerance]\nA = "16 um"\nR = "8 um"\n[axis.X]\nM = "10 um"\n[axis.Y]\nA = "18 um"\n')
    for name in ("circles.qif", "report.md"):
        (made / name).write_bytes((tree / "import" / name).read_bytes())
    write("laser.rtl", _rtl())
    write("part-points.csv", every("07/nas979-points.csv", 6))
    study = read("03/nas979-on-xkas2525.toml").replace("../../", "../").replace("samples = 10000", "samples = 0")
    write("part-study.toml", study)
    write("part.toml", read("07/nas979-points.toml"), ("../03_predict/nas979-on-xkas2525.toml", "part-study.toml"), ("nas979-points.csv", "part-points.csv"))
    write("arm.toml", read("03/torque-arm.toml").split("[temperature]")[0], ("../../", "../"), ('applied = "comprehensive"', 'acted = "arm.csv"'))
    write("arm.csv", _arm())
    path = read("06/bangle-adapt.cls").splitlines()
    write("adapt.cls", "\n".join(path[:200] + path[-3:]) + "\n")
    write("blank.csv", every("06/bangle-measured.csv", 2))
    write("adapt.toml", read("06/bangle-adapt.toml").split("[virtual_cut]")[0], ("../../", "../"), ("bangle-adapt.cls", "adapt.cls"), ("bangle-measured.csv", "blank.csv"))
