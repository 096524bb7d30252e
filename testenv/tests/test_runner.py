# SPDX-License-Identifier: Apache-2.0
"""A test that takes its process down fails alone: all others of the run are run, and pass."""
import os
import subprocess
import sys

import pytest

pytest.importorskip("xdist", reason="pytest-xdist is not installed")

from patina.cli import testRun  # noqa: E402

TESTENV = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
DIES = """import os, signal, pytest

@pytest.fixture(scope="module")
def thing():
    return 1

@pytest.mark.parametrize("number", range(4))
def test_one(thing, number):
    if number == 1:
        os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_process_that_dies_fails_one_test(tmp_path, monkeypatch):
    folder = tmp_path / "testenv" / "cli"
    folder.mkdir(parents=True)
    (folder / "test_dies.py").write_text(DIES)
    (folder / "test_lives.py").write_text("import pytest\n@pytest.mark.parametrize('n', range(6))\ndef test_two(n): pass\n")
    environment = dict(os.environ, PYTHONPATH=TESTENV)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1}, raising=False)
    shared = testRun._workers([])
    done = subprocess.run([sys.executable, "-m", "pytest", "-p", "testTiers", "-q", "-p", "no:cacheprovider", "--rootdir",
                           str(tmp_path), "--import-mode=importlib", *shared, "testenv"], cwd=tmp_path, env=environment,
                          capture_output=True, text=True, timeout=120)
    assert "1 failed, 9 passed" in done.stdout, done.stdout + done.stderr
    assert "test_dies.py::test_one[1]" in done.stdout
