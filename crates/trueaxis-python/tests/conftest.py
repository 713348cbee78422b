"""What the tests share: the repository as the current folder, and the command to compare with."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(autouse=True)
def at_root(monkeypatch):
    monkeypatch.chdir(ROOT)


class Command:
    """The command `trueaxis`."""

    def __init__(self, program):
        self.program = program

    def run(self, *words):
        words = [self.program, *map(str, words)]
        return subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)

    def text(self, *words):
        return self.run(*words).stdout

    def json(self, *words):
        return json.loads(self.run(*words, "--format", "json").stdout)


@pytest.fixture(scope="session")
def command():
    program = os.environ.get("TRUEAXIS", "")
    if not shutil.which(program):
        pytest.skip("there is no command to compare with: set TRUEAXIS, or cargo build")
    return Command(program)
