"""A study on a cluster, through Dask: any number of workers, the same bits.

Needs ``pip install 'trueaxis[distributed]'``. The samples are cut into partitions; each is a task, and becomes a Parquet file
in a folder when it is done. A run that was stopped, whatever stopped it, goes on from the files that are whole.

    import trueaxis.distributed
    from dask.distributed import Client
    study = trueaxis.Study.load("fleet.toml")
    answer = trueaxis.distributed.run(study, Client(), "fleet-parts")
    print(answer)
"""

from __future__ import annotations

import os
import time
import zlib
from pathlib import Path as _Path
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Optional, Tuple

import numpy as np

from . import _native
from ._answers import Answer
from ._machine import Path
from ._poses import Floats
from ._problems import refuse
from ._study import Study

if TYPE_CHECKING:
    from . import documents

#: Samples of a partition: a second or two of work, a few MB of memory.
USUAL_PARTITION = 20_000

#: Where what belongs to a partition stands in its file.
_KEY = b"trueaxis"


def run(
    study: Study,
    client: Any,
    folder: Path,
    *,
    partition: int = USUAL_PARTITION,
    retries: int = 3,
    progress: Optional[Callable[[int, int], None]] = None,
) -> Answer[documents.StudyDocument]:
    """Computes a study on the workers of a Dask client, and answers it.

    folder: where the partitions are written, by this process: ``part-000000.parquet`` and so on, a row for each sample
    with its number and outputs (mm). It is made if it is not there; whole partitions of the same study in it are taken as
    they are, a partition of another study is refused.
    partition: samples of a task. The numbers do not depend on it.
    retries: how often a task is tried again after its worker was lost.
    progress: called with the numbers of partitions done and in all.

    Raises TrueAxisError: ``other-version`` if a worker has another version of this package, ``other-study`` if the folder
    has partitions of another study or division.
    """
    _check_versions(client)
    place = _Path(os.fspath(folder))
    place.mkdir(parents=True, exist_ok=True)
    for left in place.glob(".part-*"):
        left.unlink()
    ranges = _ranges(study, partition)
    missing = [number for number in range(len(ranges)) if not _is_whole(study, place, number, ranges[number])]
    done = len(ranges) - len(missing)
    if progress is not None:
        progress(done, len(ranges))
    for number, rows in _computed(study, client, [(n, ranges[n]) for n in missing], retries):
        _write(study, place, number, ranges[number], rows)
        done += 1
        if progress is not None:
            progress(done, len(ranges))
    return answer(study, place, partition=partition)


def answer(study: Study, folder: Path, *, partition: int = USUAL_PARTITION) -> Answer[documents.StudyDocument]:
    """The answer from partitions that all are whole.

    Raises TrueAxisError ``partition-missing`` with the first that is not.
    """
    place = _Path(os.fspath(folder))
    ranges = _ranges(study, partition)
    values = np.empty((study.samples, len(study.outputs)))
    for number, (start, stop) in enumerate(ranges):
        rows = _read(study, place, number, (start, stop))
        if rows is None:
            name = str(place / _name(number))
            message = f"the partition of samples {start} to {stop} is not there, or not whole"
            raise refuse("partition-missing", name, message, "run the study again: it goes on from what is there")
        values[start:stop] = rows
    return study.answer(values)


def _ranges(study: Study, partition: int) -> List[Tuple[int, int]]:
    if partition < 1:
        raise ValueError(f"partition = {partition}: 1 sample or more")
    return [(start, min(start + partition, study.samples)) for start in range(0, study.samples, partition)]


def _values(study: Study, start: int, stop: int) -> Tuple[Floats, float]:
    """On a worker: one thread, as Dask has a task for each of its own. With the processor time, s."""
    begun = time.thread_time()
    rows = study.values(start, stop, threads=1)
    return rows, time.thread_time() - begun


def _computed(
    study: Study, client: Any, wanted: List[Tuple[int, Tuple[int, int]]], retries: int
) -> Iterator[Tuple[int, Floats]]:
    import dask.distributed

    # Without types of its own.
    as_completed: Any = dask.distributed.as_completed
    if not wanted:
        return
    sent = client.scatter(study, broadcast=True, hash=False)
    numbers: Dict[str, int] = {}
    waiting = iter(wanted)
    # No more at once than the workers need: what is done waits in no memory.
    at_once = 4 * max(1, sum(client.nthreads().values()))
    tasks = as_completed([], with_results=False)

    def submit() -> bool:
        for number, (start, stop) in waiting:
            name = f"trueaxis-{study.identity[:12]}-{number}"
            task = client.submit(_values, sent, start, stop, key=name, retries=retries, pure=False)
            numbers[task.key] = number
            tasks.add(task)
            return True
        return False

    for _ in range(at_once):
        if not submit():
            break
    for task in tasks:
        rows, _ = task.result()
        number = numbers.pop(task.key)
        task.release()
        submit()
        yield number, rows


def _check_versions(client: Any) -> None:
    own = _native.VERSION
    for worker, version in client.run(_version).items():
        if version != own:
            message = f"the worker has version {version} of trueaxis, this process {own}"
            raise refuse("other-version", str(worker), message, "install the same wheel everywhere")


def _version() -> str:
    try:
        from trueaxis import __version__
    except ImportError:
        return "none"
    return __version__


def _name(number: int) -> str:
    return f"part-{number:06}.parquet"


def _head(study: Study, bounds: Tuple[int, int], rows: Floats) -> str:
    return f"{study.identity} {bounds[0]} {bounds[1]} {zlib.crc32(np.ascontiguousarray(rows).tobytes()):08x}"


def _write(study: Study, place: _Path, number: int, bounds: Tuple[int, int], rows: Floats) -> None:
    """Whole or not at all: a file gets its name when all of it is on the disk."""
    import pyarrow
    import pyarrow.parquet

    columns = [pyarrow.array(np.arange(*bounds, dtype=np.int64))]
    columns += [pyarrow.array(rows[:, k]) for k in range(rows.shape[1])]
    table = pyarrow.table(columns, names=["sample", *study.outputs])
    table = table.replace_schema_metadata({_KEY: _head(study, bounds, rows).encode()})
    part = place / f".{_name(number)}-{os.getpid()}"
    with open(part, "wb") as file:
        pyarrow.parquet.write_table(table, file)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, place / _name(number))


def _is_whole(study: Study, place: _Path, number: int, bounds: Tuple[int, int]) -> bool:
    return _read(study, place, number, bounds) is not None


def _read(study: Study, place: _Path, number: int, bounds: Tuple[int, int]) -> Optional[Floats]:
    """The rows of a partition; None if it is not there or not whole."""
    import pyarrow
    import pyarrow.parquet

    path = place / _name(number)
    if not path.exists():
        return None
    try:
        with open(path, "rb") as file:
            table = pyarrow.parquet.read_table(file)
    except (pyarrow.ArrowException, OSError):
        return None
    head = (table.schema.metadata or {}).get(_KEY, b"").decode(errors="replace").split()
    if head[:3] != [study.identity, str(bounds[0]), str(bounds[1])]:
        message = "this partition is of another study, another version, or another division"
        hint = "name another folder, or take the same study, version and `partition` as before"
        raise refuse("other-study", str(path), message, hint)
    rows = np.column_stack([table.column(name).to_numpy() for name in study.outputs])
    whole = rows.shape == (bounds[1] - bounds[0], len(study.outputs))
    return rows if whole and _head(study, bounds, rows).split() == head else None
