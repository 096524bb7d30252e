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
    command = [sys.executable, "-m", "pytest", "-q", "-ra", "-c", os.path.join(root, "testenv", "pytest.ini"),
               "--rootdir", root]
    # Without paths of the caller's own, everything.
    if not any(os.path.exists(a.partition("::")[0]) for a in arguments.passed_on if not a.startswith("-")):
        command += [os.path.join(root, "testenv"), os.path.join(root, "plugin", "patina")]
    return min(1, subprocess.call(command + arguments.passed_on, env=environment))
