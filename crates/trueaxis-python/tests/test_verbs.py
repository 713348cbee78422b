"""The verbs: each answer is that of the command, and each option is one of the command."""

import inspect
import json
import re
import warnings

import pytest
import trueaxis
from trueaxis import TrueAxisError, TrueAxisNote, TrueAxisWarning

XKAS, MILL, ENGRAVER = (f"machines/{name}/machine.toml" for name in ("xkas2525", "three-axis-mill", "i5-engraver"))
RING = "examples/02_simulate/ring-fanuc.nc"
AT = "X=3000 Y=1200 Z=-700 C=-90 A=15"

#: A function, its arguments, and the words of the command.
ASKED = [
    ("pose", (XKAS,), {"at": AT, "bodies": True}, ["pose", XKAS, "--at", AT, "--bodies"]),
    ("pose", (XKAS,), {"at": {"X": 3000, "C": -90}}, ["pose", XKAS, "--at", "X=3000 C=-90"]),
    (
        "solve",
        (ENGRAVER,),
        {"tip": [10, 20, 30], "axis": (0.3, -0.2, 0.93), "from_": {"A": 10}},
        ["solve", ENGRAVER, "--tip", "10 20 30", "--axis", "0.3 -0.2 0.93", "--from", "A=10"],
    ),
    ("part", ("parts/housing.toml",), {}, ["part", "parts/housing.toml"]),
    ("simulate", (ENGRAVER, RING), {"chord": 0.01}, ["simulate", ENGRAVER, RING, "--chord", "0.01"]),
    ("trace", (ENGRAVER, RING), {"block": 20}, ["trace", ENGRAVER, RING, "--block", "20"]),
    (
        "predict",
        ("examples/03_predict/nas979-on-xkas2525.toml",),
        {"samples": 20, "seed": 3},
        ["predict", "examples/03_predict/nas979-on-xkas2525.toml", "--samples", "20", "--seed", "3"],
    ),
    (
        "study",
        ("examples/09_study/fleet.toml",),
        {"machines": 10, "days": 3, "seed": 4},
        ["study", "examples/09_study/fleet.toml", "--machines", "10", "--days", "3", "--seed", "4"],
    ),
    ("measure", ("examples/04_plan/probe-ball.toml",), {"seed": 2}, ["measure", "examples/04_plan/probe-ball.toml", "--seed", "2"]),
    ("plan", ("examples/04_plan/probe-ball.toml",), {"control": "fanuc"}, ["plan", "examples/04_plan/probe-ball.toml", "--control", "fanuc"]),
    ("identify", ("examples/05_identify/probe-ball.toml",), {}, ["identify", "examples/05_identify/probe-ball.toml"]),
    (
        "identify_expansion",
        ("examples/05_identify/y-axis-two-temperatures.toml",),
        {},
        ["identify", "expansion", "examples/05_identify/y-axis-two-temperatures.toml"],
    ),
    ("identify_tables", ("examples/05_identify/error-tables.toml",), {}, ["identify", "tables", "examples/05_identify/error-tables.toml"]),
    ("identify_rtcp", ("examples/05_identify/rtcp-engraver.toml",), {}, ["identify", "rtcp", "examples/05_identify/rtcp-engraver.toml"]),
    ("identify_probe", ("examples/05_identify/ring-60.toml",), {}, ["identify", "probe", "examples/05_identify/ring-60.toml"]),
    ("identify_thermal", ("examples/05_identify/lathe-thermal.toml",), {}, ["identify", "thermal", "examples/05_identify/lathe-thermal.toml"]),
    (
        "compensate_values",
        (MILL,),
        {"axis": "X", "step": 50},
        ["compensate", "values", MILL, "--axis", "X", "--step", "50"],
    ),
    ("compensate_adapt", ("examples/06_compensate/bangle-adapt.toml",), {}, ["compensate", "adapt", "examples/06_compensate/bangle-adapt.toml"]),
    (
        "evaluate",
        ("iso230-2", "examples/07_verify/x-axis-laser.csv"),
        {"tolerance": ["A=16 um", "R=8 um"]},
        ["evaluate", "iso230-2", "examples/07_verify/x-axis-laser.csv", "--tolerance", "A=16 um", "--tolerance", "R=8 um"],
    ),
    ("evaluate", ("iso230-1", "examples/07_verify/moody-1955.csv"), {}, ["evaluate", "iso230-1", "examples/07_verify/moody-1955.csv"]),
    ("evaluate", ("iso230-4", "examples/07_verify/circle-xy.csv"), {}, ["evaluate", "iso230-4", "examples/07_verify/circle-xy.csv"]),
    ("evaluate", ("iso230-10", "examples/07_verify/probe-performance.csv"), {}, ["evaluate", "iso230-10", "examples/07_verify/probe-performance.csv"]),
    (
        "evaluate_form",
        ("examples/07_verify/cone-section.csv",),
        {"element": "circle", "u": "0.3 um"},
        ["evaluate", "form", "examples/07_verify/cone-section.csv", "--element", "circle", "--u", "0.3 um"],
    ),
    ("verify", ("examples/07_verify/probe-ball.toml",), {}, ["verify", "examples/07_verify/probe-ball.toml"]),
    (
        "verify",
        (),
        {"diff": [XKAS, "examples/07_verify/xkas2525-after-a-year.toml"]},
        ["verify", "--diff", XKAS, "examples/07_verify/xkas2525-after-a-year.toml"],
    ),
    ("verify", (), {"part": "examples/07_verify/nas979-points.toml"}, ["verify", "--part", "examples/07_verify/nas979-points.toml"]),
    (
        "verify",
        (),
        {"history": "examples/07_verify/history", "limit": "EC0X=40 urad"},
        ["verify", "--history", "examples/07_verify/history", "--limit", "EC0X=40 urad"],
    ),
]


@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisWarning")
@pytest.mark.parametrize(("verb", "arguments", "options", "words"), ASKED, ids=[" ".join(a[3][:2]) for a in ASKED])
def test_an_answer_is_that_of_the_command(command, verb, arguments, options, words):
    answer = getattr(trueaxis, verb)(*arguments, **options)
    done = command.run(*words, "--format", "json")
    assert answer.to_dict() == json.loads(done.stdout)
    assert answer.is_yes == (done.returncode == 0)
    assert answer.text == command.text(*words)


@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisWarning")
def test_files_are_written_as_the_command_writes_them(command, tmp_path):
    machine, program = XKAS, "examples/06_compensate/frustum.mpf"
    answer = trueaxis.compensate_program(machine, program, output=tmp_path / "p.mpf", report=tmp_path / "p.html")
    assert answer.is_yes
    assert [str(tmp_path / name) for name in ("p.mpf", "p.html")] == answer.written
    done = command.run("compensate", "program", machine, program, "-o", tmp_path / "c.mpf", "--report", tmp_path / "c.html")
    assert done.returncode == 0
    assert (tmp_path / "p.mpf").read_bytes() == (tmp_path / "c.mpf").read_bytes()
    assert (tmp_path / "p.html").read_text() == answer.page
    pages = [(tmp_path / f"{name}.html").read_text().replace(f"{name}.mpf", "") for name in "pc"]
    assert pages[0] == pages[1]


@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisWarning")
def test_tables_are_written_and_kept(tmp_path):
    place = tmp_path / "tables"
    answer = trueaxis.compensate_tables(MILL, target="linuxcnc", output=place)
    assert answer.schema.startswith("trueaxis/compensate-tables") and any(place.iterdir())
    with pytest.raises(TrueAxisError):
        trueaxis.compensate_tables(MILL, target="linuxcnc", output=place)
    kept = tmp_path / "kept.csv"
    kept.write_text("mine")
    with pytest.raises(TrueAxisError) as raised:
        trueaxis.simulate(ENGRAVER, RING, path=kept)
    assert raised.value.code == "unwritable-file" and kept.read_text() == "mine"
    trueaxis.simulate(ENGRAVER, RING, path=kept, force=True)
    assert kept.read_text().startswith("line") or "," in kept.read_text().splitlines()[0]


def test_a_machine_in_memory_is_asked(command):
    text = open(MILL, encoding="utf-8").read()
    loaded = trueaxis.Machine.from_text(text, name=MILL, tool_length=80)
    at = {"X": 100, "Y": 50}
    wanted = command.json("pose", MILL, "--at", "X=100 Y=50", "--tool-length", "80")
    assert trueaxis.pose(loaded, at=at).to_dict() == wanted


def test_an_answer_is_text_page_and_table():
    answer = trueaxis.evaluate("iso230-2", "examples/07_verify/x-axis-laser.csv")
    document = answer.to_dict()
    assert answer.schema == document["schema"] == answer.document.schema == answer.document["schema"]
    assert answer.page.startswith("<!DOCTYPE html>") and "<iframe srcdoc=" in answer._repr_html_()
    assert answer.pictures and all(picture.lstrip().startswith("<svg") for picture in answer.pictures)
    assert str(answer) == answer.text and document["schema"] in repr(answer)
    assert "schema" in dir(answer) and "no_such_entry" not in dir(answer)
    with pytest.raises(AttributeError, match="no entry `no_such_entry`"):
        answer.no_such_entry
    pandas = pytest.importorskip("pandas")
    for name in answer.tables:
        frame = answer.to_pandas(name)
        assert isinstance(frame, pandas.DataFrame) and len(frame) == len(answer.tables[name])
    with pytest.raises(KeyError, match="no table `?nothing"):
        answer.to_pandas("nothing")


def test_a_vector_becomes_three_columns():
    pytest.importorskip("pandas")
    frame = trueaxis.pose(XKAS, at=AT).to_pandas("budget")
    assert {"error", "tip_um_x", "tip_um_y", "tip_um_z", "axis_urad_x"} <= set(frame.columns)


def test_warnings_and_notes_have_their_category():
    with pytest.warns(TrueAxisWarning) as caught:
        answer = trueaxis.pose(MILL, at={"X": 1e5})
    assert caught[0].filename == __file__
    assert {d.severity for d in answer.diagnostics} <= {"warning", "note"}
    assert len(caught) == len(answer.diagnostics) and "outside-travel" in {d.code for d in answer.diagnostics}
    assert issubclass(TrueAxisNote, TrueAxisWarning)
    with warnings.catch_warnings():
        warnings.simplefilter("error", TrueAxisWarning)
        with pytest.raises(TrueAxisWarning):
            trueaxis.pose(MILL, at={"X": 1e5})


@pytest.mark.parametrize(
    ("ask", "code", "place"),
    [
        (lambda: trueaxis.pose(XKAS, at="Q=3"), "unknown-axis", "--at"),
        (lambda: trueaxis.pose(XKAS, at="X=3 parsec"), None, "--at"),
        (lambda: trueaxis.pose(XKAS, at="X=3", at_file="x.csv"), "unused-argument", "at"),
        (lambda: trueaxis.predict("no.toml"), "unreadable-file", "no.toml"),
        (lambda: trueaxis.evaluate("iso230-99", "x.csv"), "unknown-choice", "standard"),
        (lambda: trueaxis.verify(), "unused-argument", "file"),
        (lambda: trueaxis.verify("a.toml", part="b.toml"), "unused-argument", "file"),
        (lambda: trueaxis.plan("examples/04_plan/probe-ball.toml", control="abacus"), "unknown-control", "--control"),
        (lambda: trueaxis.compensate_tables(MILL, target="isg", output="x", comp_file_type=1), "unused-argument", "comp_file_type"),
    ],
)
def test_what_makes_no_question_is_refused(ask, code, place):
    with pytest.raises(TrueAxisError) as raised:
        ask()
    error = raised.value
    assert code in (None, error.code) and error.place.file == place
    assert error.message in str(error) and error.diagnostics[0].severity == "error"


def test_values_are_written_in_a_form(command, tmp_path):
    for form in ("text", "json", "csv"):
        answer = trueaxis.compensate_values(MILL, axis="X", step=50, output=tmp_path / f"p.{form}", format=form)
        command.run("compensate", "values", MILL, "--axis", "X", "--step", 50, "--format", form, "-o", tmp_path / f"c.{form}")
        assert (tmp_path / f"p.{form}").read_text() == (tmp_path / f"c.{form}").read_text()
        assert "Values of X" in answer.text and answer.schema == "trueaxis/compensate/1"
    with pytest.raises(TrueAxisError, match="`format` has a meaning only together with `output`"):
        trueaxis.compensate_values(MILL, axis="X", format="csv")


def test_licences_are_those_of_the_lock():
    locked = open("Cargo.lock", encoding="utf-8").read()
    listed = re.findall(r"^  (\S+) (\S+): (.+)", trueaxis.licenses(), re.MULTILINE)
    assert {"pyo3", "numpy", "nalgebra"} <= {name for name, *_ in listed}
    assert not {"axum", "clap"} & {name for name, *_ in listed}
    for name, version, _ in listed:
        assert f'name = "{name}"\nversion = "{version}"' in locked, "run scripts/sbom --licenses"


def test_codes_are_explained():
    assert "**To do:**" in trueaxis.explain("array-shape")
    assert trueaxis.explain("no-such-code") is None


#: The words of the command for each function.
WORDS = {
    "plan_probe_surface": ["plan", "probe-surface"],
    "plan_tool_setting": ["plan", "tool-setting"],
    **{f"identify_{kind}": ["identify", kind] for kind in "expansion probe rtcp surface tables thermal tools".split()},
    **{f"compensate_{kind}": ["compensate", kind] for kind in "adapt program tables values".split()},
    "evaluate_form": ["evaluate", "form"],
    **{verb: [verb] for verb in "pose solve part simulate trace predict study measure plan identify post evaluate verify".split()},
}
#: Not for Python: how the command prints.
COMMAND_ONLY = {"help", "no-report", "show-template"}
#: Whether pictures are recorded; a report with its heading and a format everywhere or where a file is written.
PYTHON_ONLY = {"pictures", "format", "report", "heading"}


def test_every_function_is_known():
    functions = {name for name in trueaxis.__all__ if inspect.isfunction(getattr(trueaxis, name))}
    assert functions - {"explain", "licenses"} == set(WORDS)


@pytest.mark.parametrize("verb", WORDS)
def test_options_are_those_of_the_command(command, verb):
    shown = command.text(*WORDS[verb], "--help")
    options = set(re.findall(r"^ +(?:-\w, )?--([a-z-]+)", shown, re.MULTILINE)) - COMMAND_ONLY
    # An option without a long name.
    options |= {"output"} & {"output" for _ in re.findall(r"^ +-o <", shown, re.MULTILINE)}
    parameters = inspect.signature(getattr(trueaxis, verb)).parameters
    named = {name.rstrip("_").replace("_", "-") for name, p in parameters.items() if p.kind is p.KEYWORD_ONLY}
    assert named - PYTHON_ONLY == options - PYTHON_ONLY, named ^ options


@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisWarning")
def test_work_goes_on_in_spite_of_errors(tmp_path):
    program = tmp_path / "wrong.nc"
    program.write_text("G0 X1 Y1\nG1 X[1/0] F100\nG0 X3\nM30\n")
    options = {"control": "fanuc", "no_collisions": True}
    with pytest.raises(TrueAxisError) as raised:
        trueaxis.simulate(ENGRAVER, program, **options)
    assert (raised.value.place.file, raised.value.place.line) == (str(program), 2)
    with pytest.warns(TrueAxisWarning):
        answer = trueaxis.simulate(ENGRAVER, program, keep_going=True, **options)
    assert answer.in_spite_of_errors and "error" in {d.severity for d in answer.diagnostics}


def test_tolerances_and_limits_are_single_values(tmp_path):
    cone = trueaxis.evaluate_form("examples/07_verify/cone-section.csv", element="circle", tolerance="0.01 mm")
    assert "0.01" in cone.text or "10" in cone.text
    with pytest.raises(TrueAxisError, match="limit"):
        trueaxis.compensate_tables(XKAS, target="csv", output=tmp_path / "tables", limit="0.1 um")
    answer = trueaxis.compensate_tables(XKAS, target="csv", output=tmp_path / "tables", limit="5 mm")
    assert answer.written


def test_a_machine_that_was_read_is_an_input(tmp_path):
    first, copy = tmp_path / "first.toml", tmp_path / "machine.toml"
    trueaxis.identify("examples/05_identify/probe-ball.toml", output=first)
    copy.write_text(first.read_text())
    for machine in (first, copy):
        text = machine.read_text()
        for force in (False, True):
            with pytest.raises(TrueAxisError, match="input"):
                trueaxis.compensate_values(
                    trueaxis.Machine.load(machine), axis="X", targets="0 50", machine_only=True, output=machine, force=force
                )
        assert machine.read_text() == text


@pytest.mark.parametrize(
    ("ask", "place"),
    [
        (lambda out: trueaxis.compensate_adapt("examples/06_compensate/bangle-adapt.toml", output=out), "output"),
        (lambda out: trueaxis.compensate_adapt("examples/06_compensate/bangle-adapt.toml", control="fanuc"), "control"),
        (lambda out: trueaxis.identify_probe("examples/05_identify/ring-60.toml", output=out), "output"),
        (lambda out: trueaxis.identify_rtcp("examples/05_identify/rtcp-engraver.toml", programs=out, output=out), "programs"),
        (lambda out: trueaxis.identify_rtcp("examples/05_identify/rtcp-engraver.toml", control="fanuc"), "control"),
        (lambda out: trueaxis.verify("examples/07_verify/readings.toml", output=out), "output"),
        (lambda out: trueaxis.verify("examples/07_verify/readings.toml", limit="1 um"), "limit"),
        (lambda out: trueaxis.verify(diff=["a.toml"]), "diff"),
        (lambda out: trueaxis.evaluate("iso230-2", "x.csv", write_back=("m.toml",)), "write_back"),
        (lambda out: trueaxis.post(MILL, "x.cls", control="fanuc", output=out, number=99999999999), "number"),
        (lambda out: trueaxis.measure("examples/04_plan/probe-ball.toml", seed=-1), "seed"),
        (lambda out: trueaxis.compensate_program(MILL, "x.nc", output=out, no_rounding=True, increment="5 um"), "no_rounding"),
        (lambda out: trueaxis.plan_tool_setting(trueaxis.Machine.load(MILL, tool_length=80), "s.toml"), "machine"),
    ],
)
def test_no_option_is_left_out_without_a_word(ask, place, tmp_path):
    with pytest.raises(TrueAxisError) as raised:
        ask(tmp_path / "out")
    assert (raised.value.code, raised.value.place.file) == ("unused-argument", place)
