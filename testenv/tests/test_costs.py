# SPDX-License-Identifier: Apache-2.0
"""A run says where its processor time went: in tests and their child processes, from several processes of tests too."""
import importlib.util
import os
import subprocess
import sys

import pytest

TESTENV = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
SECONDS = 0.2
BURN = f"import time\nbegan = time.process_time()\nwhile time.process_time() < began + {SECONDS}: pass\n"
TESTS = f"""import subprocess, sys, pytest

BURN = {BURN!r}

@pytest.fixture(scope="module")
def dear():
    exec(BURN)

def test_nothing(): pass
def test_itself(): exec(BURN)
def test_child(): subprocess.run([sys.executable, "-c", BURN], check=True)
def test_fixture(dear): pass
def test_fixture_again(dear): pass
"""


@pytest.mark.parametrize("processes", [0, 2])
def test_time_is_that_of_the_test_that_took_it(tmp_path, processes):
    if processes and not importlib.util.find_spec("xdist"):
        pytest.skip("pytest-xdist is not installed")
    (tmp_path / "test_some.py").write_text(TESTS)
    several = ["-n", str(processes), "--dist", "loadfile"] if processes else []
    done = subprocess.run([sys.executable, "-m", "pytest", "-p", "testCosts", "-q", "-p", "no:cacheprovider", "--rootdir",
                           str(tmp_path), "--costs", "costs.tsv", *several, "test_some.py"], cwd=tmp_path,
                          env=dict(os.environ, PYTHONPATH=TESTENV), capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    head, *rows = [line.split("\t") for line in (tmp_path / "costs.tsv").read_text().splitlines()]
    assert head == ["seconds", "setup", "call", "teardown", "wall", "test"]
    found = {row[-1].partition("::")[2]: dict(zip(head, map(float, row[:-1]))) for row in rows}
    assert len(found) == 5 and [row["seconds"] for row in found.values()] == sorted(
        (row["seconds"] for row in found.values()), reverse=True)
    for name, phase in (("test_itself", "call"), ("test_child", "call"), ("test_fixture", "setup")):
        assert found[name][phase] >= SECONDS - 0.02, (name, found)  # clocks of the processor have ticks of up to 10 ms
    assert found["test_fixture_again"]["setup"] < found["test_fixture"]["setup"]
    assert "5 tests" in done.stdout and "test_some.py::test_child" in done.stdout
