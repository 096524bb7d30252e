# SPDX-License-Identifier: Apache-2.0
"""Scripts that documents name run as they print them, and with any Python: they find the checkout's environment."""
import os
import re
import shutil
import subprocess
import sys

import pytest

import documents
import mtlx
from test_launcher import ROOT, checkout  # noqa: F401  (a fixture)

NAMED = sorted(set(re.findall(r"\./patina python\s+(testenv/[\w/]+\.py)", documents.text())))
SCRIPTS = [name for name in NAMED if "__main__" in open(os.path.join(ROOT, name), encoding="utf-8").read()]


def test_documents_name_some():
    assert {"testenv/wedges.py", "testenv/stability/randomGraphs.py"} <= set(SCRIPTS)


def bare(command, cwd, **environment):
    """Runs a command without what the launcher sets."""
    variables = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "PATINA"))}
    return subprocess.run([str(c) for c in command], cwd=cwd, env={**variables, **environment}, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL)


@pytest.mark.parametrize("script", SCRIPTS)
def test_without_the_environment_it_goes_on_in_it(script, checkout):  # noqa: F811
    (checkout.root / script).parent.mkdir(parents=True, exist_ok=True)
    for file in (script, "testenv/checkout.py"):
        shutil.copy(os.path.join(ROOT, file), checkout.root / file)
    checkout.calls.write_text("")
    found = bare([sys.executable, script, "a b", "--help"], checkout.root, CALLS=str(checkout.calls), ROOT=str(checkout.root),
                 PATH=f"{checkout.tools}:{os.environ['PATH']}", HOME=str(checkout.root))
    assert found.stdout == f"ran {script} a b --help\n", found.stderr
    assert "cmake --build" in checkout.calls.read_text()


@pytest.mark.parametrize("script", SCRIPTS)
def test_in_the_environment_it_runs(script):
    """As the launcher starts it, which keeps folders of scripts from Python's path."""
    found = subprocess.run([sys.executable, script, "--help"], cwd=ROOT, env=dict(os.environ, PYTHONSAFEPATH="1"),
                           capture_output=True, text=True)
    assert found.returncode == 0 and "usage:" in found.stdout, found.stderr


def test_it_does_not_start_itself_for_ever(tmp_path):
    found = bare([sys.executable, "-S", "-c", "import sys; sys.path.insert(0, 'testenv'); import checkout; checkout.enter()"],
                 ROOT, PATINA_ENTERED="1")
    assert found.returncode == 1 and "_patina" in found.stderr and "Traceback" not in found.stderr


def test_a_sheet_of_materials(tmp_path):
    (tmp_path / "red.mtlx").write_text(mtlx.document(mtlx.shader("red")))
    found = subprocess.run([sys.executable, os.path.join(ROOT, "testenv", "materialSheet.py"), tmp_path, tmp_path / "sheet.png",
                            "--width", "16", "--samples", "1"], env=dict(os.environ, PYTHONSAFEPATH="1"), capture_output=True,
                           text=True)
    assert found.returncode == 0 and "red" in found.stdout, found.stderr
    assert (tmp_path / "sheet.png").stat().st_size > 0


@pytest.mark.parametrize("script, thing", (("contactSheet.py", "stages"), ("materialSheet.py", "materials")))
def test_a_sheet_that_cannot_be_made_ends_in_one_line(script, thing, tmp_path):
    def said(sheet):
        found = subprocess.run([sys.executable, os.path.join(ROOT, "testenv", script), tmp_path, sheet], capture_output=True,
                               text=True, env=dict(os.environ, PYTHONSAFEPATH="1"))
        assert found.returncode == 1
        return found.stderr

    assert said(tmp_path / "sheet.png") == f"{tmp_path}: there are no {thing}\n"
    (tmp_path / "a.usda").write_text("#usda 1.0\n")
    (tmp_path / "a.mtlx").write_text('<materialx version="1.39"><surfacematerial name="m" type="material"/></materialx>')
    assert said("/nowhere/sheet.png") == "cannot write '/nowhere/sheet.png': the folder '/nowhere' does not exist\n"
