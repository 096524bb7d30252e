# SPDX-License-Identifier: Apache-2.0
"""A command's process ends without the destructors of libraries: threads that nothing joins still need what these free."""
import subprocess
import sys

import pytest

# A destructor that fails, as the C++ runtime would call it, then the command.
PROGRAM = """
import ctypes, runpy, sys
c = ctypes.CDLL(None)
c.__cxa_atexit(ctypes.cast(c.abort, ctypes.c_void_p), None, None)
sys.argv = ["patina", *sys.argv[1:]]
runpy.run_module("patina", run_name="__main__", alter_sys=True)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="names the C++ runtime of Linux")
@pytest.mark.parametrize("words, status", [(["--version"], 0), (["nonsense"], 2), (["record", "missing.usda", "a.png"], 1)],
                         ids=["done", "usage", "failed"])
def test_destructors_are_left_out(tmp_path, words, status):
    done = subprocess.run([sys.executable, "-c", PROGRAM, *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == status
    assert done.stdout.startswith("patina ") if status == 0 else done.stderr.startswith("patina")


def test_what_python_tidies_up_is_tidied_up(tmp_path):
    program = ("import atexit, sys; from patina.cli import ending; atexit.register(print, 'tidied up'); print('done'); "
               "sys.exit(ending.end(3))")
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 3 and done.stdout == "done\ntidied up\n"


def test_errors_that_nothing_handles_are_told(tmp_path):
    done = subprocess.run([sys.executable, "-c", "import patina.cli.ending; raise RuntimeError('odd')"], cwd=tmp_path,
                          capture_output=True, text=True)
    assert done.returncode == 1 and "RuntimeError: odd" in done.stderr
