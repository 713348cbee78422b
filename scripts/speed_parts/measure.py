"""One run of a command: how long, how much of the processors, how much memory."""

import os
import shutil
import subprocess
import sys
import time


def measured(program, words, out):
    """Seconds by the clock, seconds of all processors, MB. What it writes is in a new, empty folder."""
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    command = [str(program), *map(str, words)]
    with open(out / "stdout", "wb") as stdout, open(out / "stderr", "wb") as stderr:
        begin = time.monotonic()
        child = subprocess.Popen(command, stdout=stdout, stderr=stderr)
        _, status, usage = os.wait4(child.pid, 0)
        wall_s = time.monotonic() - begin
    if os.waitstatus_to_exitcode(status) not in (0, 1):
        sys.stderr.write((out / "stderr").read_text(errors="replace")[:2000])
        raise subprocess.CalledProcessError(os.waitstatus_to_exitcode(status), command)
    return wall_s, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1000
