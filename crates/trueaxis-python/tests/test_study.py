"""Studies in pieces: the same bits in any of them, on any workers, after workers and files were lost."""

import os
import pickle
import signal

import numpy as np
import pytest
import trueaxis
from trueaxis import Study, TrueAxisError

FLEET = "examples/09_study/fleet.toml"


@pytest.fixture(scope="module")
def fleet():
    return Study.load(FLEET, machines=200, days=5)


@pytest.fixture(scope="module")
def values(fleet):
    return fleet.values()


def test_pieces_have_the_same_bits(fleet, values):
    assert values.shape == (fleet.samples, len(fleet.outputs))
    for start, stop in [(0, 1), (7, 7), (500, 1013), (fleet.samples - 3, fleet.samples)]:
        for threads in (1, 2, 5):
            assert np.array_equal(fleet.values(start, stop, threads=threads), values[start:stop])
    moved = pickle.loads(pickle.dumps(fleet))
    assert moved.identity == fleet.identity
    assert np.array_equal(moved.values(100, 200), values[100:200])


def test_the_answer_is_that_of_the_verb(fleet, values):
    asked = trueaxis.study(FLEET, machines=200, days=5)
    assert fleet.answer(values).to_dict() == asked.to_dict()
    assert fleet.inputs_of(0, 4).shape == (4, len(fleet.inputs)) == (4, len(fleet.units))
    assert fleet.inputs[0] == "EC0Y" and fleet.units[0] == "rad"


def test_what_is_no_piece_is_refused(fleet, values):
    for start, stop in [(5, 4), (0, fleet.samples + 1)]:
        with pytest.raises(ValueError, match="samples"):
            fleet.values(start, stop)
    with pytest.raises(ValueError, match="shape"):
        fleet.answer(values[:-1])
    with pytest.raises(ValueError, match="finite"):
        fleet.answer(np.where(np.arange(values.shape[1]) == 0, np.nan, values))
    with pytest.raises(ValueError, match="machines: 1 or more"):
        Study.load(FLEET, machines=0)


def test_a_mistake_has_its_place(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text('name = "x"\nstudy = "none.toml"\n[design]\nmachines = 10\n[[input]]\nerror = "EC0Y"\nvalue = "0 ± 1 um"\n')
    with pytest.raises(TrueAxisError) as caught:
        Study.load(path)
    assert {d.code for d in caught.value.diagnostics} >= {"unreadable-file", "wrong-unit"}


def test_options_and_files_change_the_identity(fleet):
    assert Study.load(FLEET, machines=200, days=5).identity == fleet.identity
    assert Study.load(FLEET, machines=200, days=6).identity != fleet.identity
    assert Study.load(FLEET, machines=200, days=5, seed=2).identity != fleet.identity


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        with distributed.Client(cluster) as client:
            yield client


def test_workers_give_the_same_bits(fleet, values, cluster, tmp_path):
    from trueaxis import distributed

    seen = []
    answer = distributed.run(fleet, cluster, tmp_path, partition=1500, progress=lambda *done: seen.append(done))
    assert answer.to_dict() == fleet.answer(values).to_dict()
    assert seen[0] == (0, seen[0][1]) and seen[-1] == (seen[0][1], seen[0][1])

    # One partition is cut short, one has another byte, one is gone, and a half-written one stands there.
    parts = sorted(tmp_path.glob("part-*.parquet"))
    content = parts[1].read_bytes()
    parts[1].write_bytes(content[: len(content) // 2])
    damaged = bytearray(parts[2].read_bytes())
    damaged[len(damaged) // 3] ^= 0x40
    parts[2].write_bytes(bytes(damaged))
    parts[3].unlink()
    (tmp_path / ".part-000003.parquet-1").write_bytes(b"PAR1")
    with pytest.raises(TrueAxisError) as caught:
        distributed.answer(fleet, tmp_path, partition=1500)
    assert caught.value.code == "partition-missing"
    seen.clear()
    answer = distributed.run(fleet, cluster, tmp_path, partition=1500, progress=lambda *done: seen.append(done))
    assert seen[0] == (len(parts) - 3, len(parts))
    assert answer.to_dict() == fleet.answer(values).to_dict()
    assert sorted(tmp_path.iterdir()) == parts

    # Another study, and another division, are not mixed with it.
    for study, partition in [(Study.load(FLEET, machines=200, days=5, seed=2), 1500), (fleet, 1600)]:
        with pytest.raises(TrueAxisError) as caught:
            distributed.run(study, cluster, tmp_path, partition=partition)
        assert caught.value.code == "other-study"


def test_a_worker_that_is_killed_changes_nothing(cluster, tmp_path):
    from trueaxis import distributed

    study = Study.load(FLEET, machines=2000, days=5)
    killed = []

    def progress(done, of):
        if done >= 2 and not killed:
            killed.append(next(iter(cluster.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    answer = distributed.run(study, cluster, tmp_path, partition=1000, progress=progress)
    assert killed and answer.to_dict() == study.answer(study.values()).to_dict()


def test_another_version_is_refused(fleet, tmp_path, monkeypatch):
    from trueaxis import distributed

    class Other:
        def run(self, _):
            return {"tcp://1": "0.0.9"}

    with pytest.raises(TrueAxisError) as caught:
        distributed.run(fleet, Other(), tmp_path)
    assert caught.value.code == "other-version" and not list(tmp_path.iterdir())
