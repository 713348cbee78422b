"""A machine over arrays: numbers, types, strides, memory, threads, and what is refused."""

import concurrent.futures
import multiprocessing
import os
import pickle
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest
import trueaxis
from trueaxis import TrueAxisError, TrueAxisWarning

XKAS = "machines/xkas2525/machine.toml"
AT = np.array([[3000, 1200, -700, -90, 15]])


@pytest.fixture(scope="module")
def machine():
    return trueaxis.Machine.load(os.path.join(os.path.dirname(__file__), "../../..", XKAS))


def commands(count, machine, seed=1):
    """Commands within the travel."""
    random = np.random.default_rng(seed)
    ends = [machine.travel[axis] for axis in machine.axes]
    low, high = np.clip(ends, -360, 5000).T
    return random.uniform(low, high, (count, len(ends)))


def same(one, other):
    assert len(one) == len(other)
    np.testing.assert_array_equal(one._block, other._block)


def test_the_line_that_must_show(machine):
    assert machine.axes == ("X", "Y", "Z", "C", "A")
    assert machine.units == ("mm", "mm", "mm", "deg", "deg")
    shown = repr(machine.deviation(AT))
    assert "tip 35.134 -20.773 11.643 um" in shown


def test_deviations_are_those_of_the_command(machine, command, tmp_path):
    at = commands(300, machine)
    table = tmp_path / "positions.csv"
    header = ",".join(machine.axes)
    table.write_text(header + "\n" + "\n".join(",".join(map(repr, row)) for row in at.tolist()))
    rows = command.json("pose", XKAS, "--at-file", table)["rows"]
    found = machine.pose(at).to_pandas()
    for name in found.columns:
        wanted = np.array([row[name] for row in rows])
        # The command makes its nominal axis a unit vector again, which moves the last digit.
        last = 4e-16 if name.startswith("axis_") else 0
        np.testing.assert_allclose(found[name].to_numpy(), wanted, rtol=0, atol=last, err_msg=name)


@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisNote")
def test_a_pose_at_temperatures_is_that_of_the_command(command):
    path, at = "machines/gantry-001/machine.toml", {"X": 3500.0, "Y": 2300.0}
    temperature = {"scale_x": 30.5, "scale_y": 31.2, "workpiece": 30.5}
    machine = trueaxis.Machine.load(path, temperature=temperature)
    words = "scale_x=30.5 scale_y=31.2 workpiece=30.5"
    document = command.json("pose", path, "--at", "X=3500 Y=2300", "--temperature", words)
    found = machine.pose(at)
    # The command takes one pose by the plain form of the chain, arrays by the compiled one: equal to 1e-9 um.
    np.testing.assert_allclose(found.tip_um[0], document["deviation"]["tip_um"], rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.actual_tip_mm[0], document["actual"]["tip_mm"], rtol=0, atol=1e-9)
    assert machine.errors_at(at).workpiece_um[0, 0] > 0


@pytest.mark.parametrize(
    "change",
    [
        np.asfortranarray,
        lambda a: np.repeat(a, 3, axis=0)[::3],
        lambda a: np.repeat(a, 2, axis=1)[:, ::2],
        lambda a: np.ascontiguousarray(a[::-1, ::-1])[::-1, ::-1],
        lambda a: a.astype(">f8"),
        lambda a: a.tolist(),
        lambda a: np.concatenate([np.zeros(1, "u1"), np.frombuffer(a.tobytes(), "u1")])[1:].view("f8").reshape(a.shape),
    ],
    ids=["columns", "every third row", "every second column", "reversed", "other byte order", "lists", "unaligned"],
)
def test_strides_do_not_change_a_bit(machine, change):
    at = commands(5000, machine)
    same(machine.deviation(change(at)), machine.deviation(at))


@pytest.mark.parametrize("kind", ["i1", "i4", "i8", "u2", "f2", "f4"])
def test_other_numbers_are_converted(machine, kind):
    at = np.array([[100, 20, 0, 4, 5]])
    same(machine.deviation(at.astype(kind)), machine.deviation(at.astype(float)))


def test_tables_are_read_by_their_names(machine):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"C": [-90.0, 0.0], "X": [3000, 10], "A": [15, 1]})
    wanted = machine.deviation([[3000, 0, 0, -90, 15], [10, 0, 0, 0, 1]])
    same(machine.deviation(frame), wanted)
    same(machine.deviation(dict(frame)), wanted)
    structured = np.array([(-90, 3000, 15), (0, 10, 1)], dtype=[("C", "f8"), ("X", "f8"), ("A", "f8")])
    same(machine.deviation(structured), wanted)
    with pytest.raises(TrueAxisError, match="no axis `Q`") as raised:
        machine.deviation({"Q": [1.0]})
    assert raised.value.code == "unknown-axis"


def test_no_rows_are_no_rows(machine):
    assert len(machine.deviation(np.zeros((0, 5)))) == 0
    assert machine.errors_at(np.zeros((0, 5))).values.shape == (0, len(machine.error_names))


@pytest.mark.parametrize(
    ("given", "code", "place", "words"),
    [
        ([1, 2, 3, 4, 5], "array-shape", "commands", r"has the shape \(5\), not \(n, 5\)"),
        ([[1, 2, 3, 4]], "array-shape", "commands", "X mm, Y mm, Z mm, C deg, A deg"),
        (np.zeros((2, 5, 1)), "array-shape", "commands", r"\(2, 5, 1\)"),
        ([[1, 2, 3, 4, "15 deg"]], "array-type", "commands[0, 0]", "row 0, column 0"),
        (np.array([[1, 2, 3, 4, "15 deg"]], dtype=object), "array-type", "commands[0, 4]", "'15 deg' in row 0, column 4"),
        (np.array([[1, 2, None, 4, 5]]), "array-type", "commands[0, 2]", "None in row 0, column 2"),
        (np.zeros((1, 5), bool), "array-type", "commands[0, 0]", "bool"),
        (np.zeros((1, 5), complex), "array-type", "commands[0, 0]", "complex"),
        (np.ma.zeros((1, 5)), "array-type", "commands", "mask"),
        ([[1, 2], [3]], "array-type", "commands", "no array of numbers"),
        ([[0, 0, 0, 0, 0], [0, 0, 0, float("nan"), 0]], "not-finite", "commands[1, 3]", r"column 3 \(C deg\) is NaN"),
        ([[0, float("inf"), 0, 0, 0]], "not-finite", "commands[0, 1]", r"column 1 \(Y mm\) is inf"),
        ([[1e300, 0, 0, 0, 0]], "outside-table", "commands[0]", "1"),
    ],
)
@pytest.mark.parametrize("method", ["deviation", "pose", "errors_at"])
@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisWarning")
def test_what_cannot_be_is_refused_with_its_place(machine, method, given, code, place, words):
    with pytest.raises(TrueAxisError, match=words) as raised:
        getattr(machine, method)(given)
    error = raised.value
    assert (error.code, error.place.file, error.place.line) == (code, place, 0)
    assert error.hint and error.diagnostics
    if "[" in place:
        assert error.place.entry == tuple(int(n) for n in place[9:-1].split(","))


def test_bad_rows_far_inside_are_found(machine):
    at = commands(20_000, machine)
    at[[12_345, 17_000], [2, 0]] = np.nan
    with pytest.raises(TrueAxisError) as raised:
        machine.deviation(at)
    places = [d.place.entry for d in raised.value.diagnostics if d.severity == "error"]
    assert places == [(12_345, 2), (17_000, 0)]


def test_outside_the_travel_is_a_warning():
    machine = trueaxis.Machine.from_text(trueaxis.EXAMPLE + '[axis.Y]\ntravel = ["0 mm", "500 mm"]')
    assert machine.travel["Y"] == (0, 500) and machine.travel["X"] == (-np.inf, np.inf)
    with pytest.warns(TrueAxisWarning, match="Y stands outside its travel in 1 of 2 rows") as found:
        result = machine.deviation([[0, 500, 0], [0, 501, 0]])
    assert found[0].filename == __file__
    (diagnostic,) = result.diagnostics
    assert (diagnostic.code, diagnostic.place.entry) == ("outside-travel", (1, 1))


def test_wrong_words_are_refused(machine):
    with pytest.raises(TrueAxisError) as raised:
        machine.deviation(AT, approach="X=up")
    assert raised.value.code == "bad-approach"
    with pytest.raises(TrueAxisError) as raised:
        trueaxis.Machine.load(XKAS, tool_length="5 parsec")
    assert raised.value.place.file == "--tool-length"
    with pytest.raises(TrueAxisError) as raised:
        trueaxis.Machine.load(XKAS, tool_length=10, tool="a")
    assert raised.value.code == "unused-argument"
    with pytest.raises(TrueAxisError) as raised:
        trueaxis.Machine.load("no/machine.toml")
    assert (raised.value.code, raised.value.place.file) == ("unreadable-file", "no/machine.toml")
    with pytest.raises(TypeError):
        trueaxis.Machine()


def test_a_wrong_file_has_all_its_places():
    text = trueaxis.EXAMPLE + 'EC0Q = "1 urad"\nEB0X = "1 parsec"\n'
    with pytest.raises(TrueAxisError) as raised:
        trueaxis.Machine.from_text(text, name="shop/mill.toml")
    error = raised.value
    assert len([d for d in error.diagnostics if d.severity == "error"]) == 2
    assert error.place.file == "shop/mill.toml" and error.place.line == 9
    again = pickle.loads(pickle.dumps(error))
    assert (again.code, again.place, str(again)) == (error.code, error.place, str(error))


def test_backlash_follows_the_approach(command):
    path = "machines/three-axis-mill/machine.toml"
    machine, at = trueaxis.Machine.load(path), {"X": [100.0], "Y": [50.0]}
    for side in "+-":
        document = command.json("pose", path, "--at", "X=100 Y=50", "--approach", f"X={side}")
        found = machine.deviation(at, approach={"X": side}).tip_um[0]
        np.testing.assert_allclose(found, document["deviation"]["tip_um"], rtol=0, atol=1e-6)
    rising, falling = (machine.errors_at(at, approach=f"X={side}")["EXX"][0] for side in "+-")
    assert abs(rising - falling) == pytest.approx(1.2)


def test_results_are_views_of_what_was_written(machine):
    found = machine.pose(commands(1000, machine))
    for array in (found.tip_mm, found.axis, found.nominal_tip_mm, found.nominal_axis):
        assert array.shape == (1000, 3) and array.dtype == np.float64
        assert np.shares_memory(array, found._block) and not array.flags.owndata
    np.testing.assert_array_equal(found.tip_um, found.tip_mm * 1e3)
    np.testing.assert_array_equal(found.actual_tip_mm, found.nominal_tip_mm + found.tip_mm)
    errors = machine.errors_at(commands(10, machine))
    assert np.shares_memory(errors.values, errors._block)
    assert errors.values.shape == (10, len(errors.names))


def test_out_is_written_again(machine):
    at = commands(3000, machine)
    first = machine.deviation(at[::-1])
    block = first._block
    second = machine.deviation(at, out=first)
    assert second._block is block
    same(second, machine.deviation(at))
    poses = machine.pose(at)
    np.testing.assert_array_equal(poses.tip_mm, second.tip_mm)
    np.testing.assert_array_equal(poses.axis, second.axis)
    for wrong in (lambda: machine.deviation(at[:5], out=first), lambda: machine.pose(at, out=first)):
        with pytest.raises(TrueAxisError) as raised:
            wrong()
        assert raised.value.code == "array-shape"
    assert len(machine.pose(at, out=poses)) == len(machine.deviation(at, out=poses)) == 3000


MEMORY = """
import resource, sys
import numpy as np
import trueaxis
machine = trueaxis.Machine.load(sys.argv[1])
machine.deviation(np.zeros((10_000, 5)))
at = np.zeros((2_000_000, 5), order=sys.argv[2])
at[:] = 0.0
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
found = machine.deviation(at)
found.tip_mm, found.axis
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the unit of ru_maxrss")
@pytest.mark.parametrize("order", ["C", "F"])
def test_memory_shows_no_copy(order):
    words = [sys.executable, "-c", MEMORY, XKAS, order]
    grown_kib = int(subprocess.run(words, capture_output=True, text=True, check=True).stdout)
    result_kib, commands_kib = 2_000_000 * 6 * 8 / 1024, 2_000_000 * 5 * 8 / 1024
    # The result, and less than a quarter of another copy of the commands.
    assert grown_kib < result_kib + commands_kib / 4


@pytest.mark.parametrize("method", ["deviation", "errors_at"])
def test_threads_do_not_change_a_bit(machine, method):
    at = commands(50_001, machine)
    one = getattr(machine, method)(at, threads=1)
    for threads in (2, 5):
        same(getattr(machine, method)(at, threads=threads), one)
    # A pose depends on nothing but its own command.
    same(getattr(machine, method)(at[7:9]), type("Part", (), {"_block": one._block[:, 7:9], "__len__": lambda _: 2})())


def test_the_interpreter_lock_is_released(machine):
    at = np.tile(commands(1000, machine), (3000, 1))
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    begun = time.perf_counter()
    machine.errors_at(at[:400_000], threads=1)
    machine.deviation(at, threads=1)
    ended = time.perf_counter()
    stop.set()
    thread.join()
    inside = [t for t in ticks if begun < t < ended]
    # With the lock held the other thread would have run once or twice.
    assert len(inside) > 10, f"{len(inside)} ticks in {ended - begun:.3f} s"


def test_several_threads_ask_one_machine(machine):
    at = commands(20_000, machine)
    wanted = machine.deviation(at)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for found in pool.map(machine.deviation, [at] * 8):
            same(found, wanted)


@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisNote")
def test_a_machine_goes_to_another_process_with_its_files(tmp_path, monkeypatch):
    path = "machines/gantry-001/machine.toml"
    machine = trueaxis.Machine.load(path, temperature={"scale_x": 30.5, "workpiece": 30.5})
    wanted = machine.deviation({"X": [3500.0]})
    pickled = pickle.dumps(machine)
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = pickle.loads(pickled)
    assert again.axes == machine.axes and again.diagnostics == machine.diagnostics
    same(again.deviation({"X": [3500.0]}), wanted)
    same(pickle.loads(pickle.dumps(again)).deviation({"X": [3500.0]}), wanted)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_process_has_threads(machine):
    at = commands(30_000, machine)
    wanted = machine.deviation(at)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for found in pool.map_async(machine.deviation, [at] * 4).get(timeout=60):
            same(found, wanted)


def test_errors_have_names_and_units(machine):
    found = machine.errors_at(AT)
    assert found.names == machine.error_names and set(found.units) == {"um", "urad"}
    assert found["EXX"].shape == (1,)
    with pytest.raises(KeyError, match="no error EQQ"):
        found["EQQ"]
    assert f"{found.names[0]}_{found.units[0]}" in found.to_dict()


def test_solutions_are_those_of_the_command(machine, command):
    path = "machines/i5-engraver/machine.toml"
    engraver = trueaxis.Machine.load(path)
    document = command.json("solve", path, "--tip", "10 20 30", "--axis", "0.3 -0.2 0.93")
    best = document["solutions"][0]
    found = engraver.solve([[10, 20, 30]], [[0.3, -0.2, 0.93]])
    assert dict(zip(engraver.axes, found.commands[0].tolist())) == best["axes"]
    assert (found.within_limits.tolist(), found.singular.tolist()) == ([best["within_limits"]], [document["singular"]])


def test_solving_undoes_the_pose(machine):
    at = commands(2000, machine)
    pose = machine.pose(at)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TrueAxisWarning)
        found = machine.solve(pose.nominal_tip_mm, pose.nominal_axis, near=at)
    np.testing.assert_allclose(found.commands, at, rtol=0, atol=1e-7)
    same_bits = machine.solve(pose.nominal_tip_mm, pose.nominal_axis, near=at, threads=5)
    np.testing.assert_array_equal(found.commands, same_bits.commands)


def test_a_path_is_solved_as_a_whole(command):
    path, table = "machines/i5-engraver/machine.toml", "examples/01_describe/path.csv"
    columns = np.genfromtxt(table, delimiter=",", skip_header=2)
    document = command.json("solve", path, "--path", table)
    found = trueaxis.Machine.load(path).solve(columns[:, :3], columns[:, 3:], path=True)
    wanted = [[row["axes"][axis] for axis in found.axes] for row in document["rows"]]
    assert found.commands.tolist() == wanted


@pytest.mark.parametrize(
    ("tips", "axes", "code", "place"),
    [
        ([[0, 0, 0]], [[0, 0, 0]], "zero-axis", "axes[0]"),
        ([[0, 0, 0], [0, 0, 0]], [[0, 0, 1]], "array-shape", "axes"),
        ([[0, 0, 0]], [[0, 0, -1]], "unreachable-direction", "axes[0]"),
        ([[0, np.nan, 0]], [[0, 0, 1]], "not-finite", "tips[0, 1]"),
    ],
)
def test_poses_that_cannot_be_reached(tips, axes, code, place):
    text = trueaxis.EXAMPLE
    for path in (False, True):
        with pytest.raises(TrueAxisError) as raised:
            trueaxis.Machine.from_text(text).solve(tips, axes, path=path)
        assert (raised.value.code, raised.value.place.file) == (code, place)


def test_masks_names_and_copies_are_not_lost(machine):
    masked = np.ma.array([1.0, 2.0], mask=[False, True])
    structured = np.ma.array([(1.0,), (2.0,)], dtype=[("X", float)], mask=[(False,), (True,)])
    for given in ({"X": masked}, structured):
        with pytest.raises(TrueAxisError, match="mask"):
            machine.deviation(given)
    with pytest.raises(TrueAxisError, match="no columns"):
        machine.deviation({})
    with pytest.raises(TrueAxisError) as raised:
        machine.deviation(AT, approach="X=- X=+")
    assert raised.value.code == "duplicate-axis"
    for table in ({"x": [1.0], "y": [2.0], "z": [3.0]}, np.array([(1.0, 2.0, 3.0)], dtype=[(n, float) for n in "zyx"])):
        with pytest.raises(TrueAxisError, match="`tips` is a table"):
            machine.solve(table, [[0, 0, 1]])
    with pytest.raises(TrueAxisError) as raised:
        machine.solve([[10, 500, 0]], [[0, 0, 1]], near={"Q": 1.0})
    assert raised.value.place.file == "near"
    for near in (np.zeros((2, 5)), np.zeros((0, 5))):
        with pytest.raises(TrueAxisError, match="`near` has"):
            machine.solve(np.zeros((2, 3)), [[0, 0, 1]] * 2, near=near, path=True)
    with pytest.raises(TrueAxisError, match="`out` is of the type Errors"):
        machine.deviation(AT, out=machine.errors_at(AT))
    with pytest.raises(ValueError, match="threads=1000000000"):
        machine.deviation(AT, threads=10**9)
