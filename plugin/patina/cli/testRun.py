"""Runs every test of a checkout in one pytest session: the googletest programs of the build first,
then the Python tests of testenv and of the package. Further arguments go to pytest
(`./patina test -k furnace`). ./patina builds what is needed before.
"""
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
    command = [sys.executable, "-m", "pytest", "-q", "-ra", "-c", os.path.join(root, "testenv", "pytest.ini"),
               "--rootdir", root, *passed_on]
    return min(1, subprocess.call(command, env=environment, cwd=root))
