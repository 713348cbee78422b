"""The fleet on a Dask cluster of this computer; one worker may be killed while it runs.

    pip install '.[distributed]'
    python examples/09_study/fleet_dask.py --workers 2 --kill-one

Writes the samples as Parquet files into a folder; started again after it was stopped, it goes on from them.
"""

import argparse
import os
import resource
import signal
import sys
import time
from pathlib import Path

import trueaxis
import trueaxis.distributed
from dask.distributed import Client, LocalCluster

HERE = Path(__file__).resolve().parent


def main() -> int:
    parser = argparse.ArgumentParser(description="The fleet of fleet.toml on a Dask cluster of this computer.")
    parser.add_argument("--workers", type=int, default=2, help="processes, each with one thread")
    parser.add_argument("--machines", type=int, help="instead of the 10 000 of the study")
    parser.add_argument("--kill-one", action="store_true", help="kill a worker (SIGKILL) after a third of the partitions")
    parser.add_argument("--folder", default="fleet-parts", help="where the Parquet files go")
    arguments = parser.parse_args()

    study = trueaxis.Study.load(HERE / "fleet.toml", machines=arguments.machines)
    print(study, file=sys.stderr)
    with LocalCluster(n_workers=arguments.workers, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            killed = []

            def progress(done: int, parts: int) -> None:
                print(f"\r{done} of {parts} partitions", end="", file=sys.stderr, flush=True)
                if arguments.kill_one and not killed and done > parts // 3:
                    killed.append(next(iter(client.run(os.getpid).values())))
                    os.kill(killed[0], signal.SIGKILL)
                    print(f"\nworker {killed[0]} was killed", file=sys.stderr)

            begun = time.monotonic()
            answer = trueaxis.distributed.run(study, client, arguments.folder, progress=progress)
            seconds = time.monotonic() - begun
            memory = max(client.run(lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss).values())
    machines = answer.design.machines
    print(f"\n{seconds:.1f} s, {machines / seconds:.0f} machines/s, {memory / 1024:.0f} MB of the largest worker", file=sys.stderr)
    print(answer)
    return 0 if answer.is_yes else 1


if __name__ == "__main__":
    sys.exit(main())
