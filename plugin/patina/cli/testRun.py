"""Runs every test of a checkout in one pytest session: the googletest programs of the build first,
then the Python tests of testenv and of the package. Further arguments go to pytest
(`./patina test -k furnace`). Two processes or more share them (`-n 0`: one). ./patina builds what is needed before.
"""
import importlib.util
import os
import subprocess
import sys

from patina.cli.errors import CommandError

HELP = "run every test of a checkout"
PASSES_ON = True


def add_arguments(parser):
    parser.usage = "patina test [pytest arguments]"


def run(arguments):
    root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
    if not os.path.isfile(os.path.join(root, "testenv", "conftest.py")):
        raise CommandError("the tests are in a checkout only: run ./patina test there")
    environment = dict(os.environ)
    assets = os.path.normpath(os.path.join(root, "..", "shared", "assets"))
    if "PATINA_ASSETS" not in environment and os.path.isdir(assets):
        environment["PATINA_ASSETS"] = assets
    environment.setdefault("PATINA_BUILD_DIR", os.path.join(root, "build"))
    # pytest runs in the root, where testpaths are meant; paths keep the meaning that they had.
    passed_on = [os.path.abspath(a) if not a.startswith("-") and os.path.exists(a.partition("::")[0]) else a
                 for a in arguments.passed_on]
    command = [sys.executable, "-m", "pytest", *_workers(passed_on), "-q", "-ra", "-c", os.path.join(root, "testenv", "pytest.ini"),
               "--rootdir", root, *passed_on]
    return min(1, subprocess.call(command, env=environment, cwd=root))


def _workers(passed_on):
    """:returns: arguments that let several processes share the tests, whole files at a time; none where pytest-xdist is
    missing, there is one core, or the user says how many or wants to look into a test"""
    alone = ("-n", "--numprocesses", "--pdb", "-s", "--capture=no", "--collect-only", "--co")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if cores < 2 or importlib.util.find_spec("xdist") is None:
        return []
    if any(a == name or a.startswith(name + "=") or (name == "-n" and a[:2] == "-n" and a[2:].isalnum())
           for a in passed_on for name in alone):
        return []
    return ["-n", str(min(cores, 4)), "--dist", "loadscope"]
