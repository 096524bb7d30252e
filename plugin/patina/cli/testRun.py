# SPDX-License-Identifier: Apache-2.0
"""Runs the tests of a checkout in one pytest session: googletest programs of the build and Python tests of testenv and of
the package. ./patina builds what is needed before.

  patina test                   what CI runs (tier `full`, meant to end within 15 minutes on two cores)
  patina test --tier unit       within 30 seconds; smoke: within 3 minutes; long: hours; lint: committed files
  patina test --room shaders    the tests for a change to one room, within 3 minutes (with --tier full: all of the room)
  patina test -k furnace        further arguments go to pytest; named files and tests run whatever tier they are in

The summary names the tests that took most of the processor's time; --costs FILE writes that of all.

testenv/manifest.py says which tier and rooms a test belongs to. Several processes share the tests, at most five: as many as
cores, or one more (`-n 0`: one).

Some tests look at public assets (the Standard Shader Ball, MaterialX's examples). PATINA_ASSETS names their folder; without
it a folder `assets` that holds them is looked for beside the checkout, and in the folders beside it. Where there is none,
these tests are skipped and say so.
"""
import glob
import importlib.util
import os
import signal
import subprocess
import sys

from patina.cli import checkout, denoiser
from patina.cli.errors import UsageError

PASSES_ON = True
TIERS = ("lint", "unit", "smoke", "full", "long", "all")
MOST_PROCESSES = 5
PROCESS_MEMORY = 2 << 30  # bytes that a process of tests takes, with the renders in it

_ASSET = "StandardShaderBall"  # what tells the folder of public assets from others that are called so


def add_arguments(parser):
    parser.usage = "patina test [--tier TIER] [--room ROOM] [pytest arguments]"
    parser.add_argument("--tier", choices=TIERS, help="default: full; with --room smoke; with named tests all. unit, smoke and "
                        "full each include the tiers before; long has the tests that they leave out")
    parser.add_argument("--room", action="append", default=[], metavar="ROOM", help="only tests of this room (repeatable)")


def run(arguments):
    checkout.require("testenv/conftest.py", "test", "the tests are")
    root = checkout.ROOT
    testenv = os.path.join(root, "testenv")
    environment = dict(os.environ)
    assets = find_assets(root)
    if assets:
        environment.setdefault("PATINA_ASSETS", assets)
    environment.setdefault("PATINA_BUILD_DIR", os.path.join(root, "build"))
    environment.setdefault("PATINA_OIDN_LIBRARY", denoiser.of_wheel())  # googletest programs find it so
    environment["PYTHONPATH"] = os.pathsep.join(filter(None, [environment.get("PYTHONPATH"), testenv]))
    # pytest runs in the root, where testpaths are meant; paths keep the meaning that they had.
    passed_on = [os.path.abspath(a) if _named(a) else a for a in arguments.passed_on]
    tier = arguments.tier or ("all" if any(map(_named, arguments.passed_on)) else "smoke" if arguments.room else "full")
    command = [sys.executable, "-m", "pytest", *_workers(passed_on, tier), "-q", "-ra", "-c",
               os.path.join(testenv, "pytest.ini"), "--rootdir", root, "-p", "testTiers", "-p", "testCosts", "--tier", tier,
               *_rooms(arguments.room, testenv), *passed_on]
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_IGN:  # as by nohup, and child processes inherit it
            signal.signal(number, signal.SIG_DFL)
    return min(1, subprocess.call(command, env=environment, cwd=root))


def find_assets(root):
    """:param root: of a checkout
    :returns: the folder of public assets near it, or None"""
    beside = glob.escape(os.path.dirname(root))
    for pattern in ("assets", "*/assets"):
        for folder in sorted(glob.glob(os.path.join(beside, pattern))):
            if os.path.isdir(os.path.join(folder, _ASSET)):
                return folder
    return None


def _named(argument):
    """:returns: whether an argument for pytest is a file, a folder or a test in one"""
    return not argument.startswith("-") and os.path.exists(argument.partition("::")[0])


def _rooms(rooms, testenv):
    """:returns: arguments for pytest
    :raises UsageError: where there is no such room"""
    specification = importlib.util.spec_from_file_location("manifest", os.path.join(testenv, "manifest.py"))
    manifest = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(manifest)
    for room in rooms:
        if room not in manifest.ROOMS:
            raise UsageError(f"patina test: there is no room '{room}' (there are: {', '.join(manifest.ROOMS)})")
    return [part for room in rooms for part in ("--room", room)]


def _workers(passed_on, tier="full"):
    """:returns: arguments that let several processes share the tests; none where pytest-xdist is missing, there is one
    core, or the user says how many or wants to look into a test"""
    alone = ("-n", "--numprocesses", "--pdb", "-s", "--capture=no", "--collect-only", "--co")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if cores < 2 or importlib.util.find_spec("xdist") is None:
        return []
    if any(a == name or a.startswith(name + "=") or (name == "-n" and a[:2] == "-n" and a[2:].isalnum())
           for a in passed_on for name in alone):
        return []
    # One more than cores: tests that wait (for servers, signals, a browser) leave a core to another. Those of the small tiers
    # wait little, and each process has to find all tests first.
    processes = cores + (tier in ("full", "long", "all"))
    # Neighbours stay together, and so do tests of a module. (By modules, pytest-xdist runs a test that takes its process
    # down again and again.)
    return ["-n", str(max(1, min(processes, MOST_PROCESSES, _free_memory() // PROCESS_MEMORY))), "--dist", "worksteal"]


def _free_memory():
    """:returns: bytes that processes may still take; a large number where the system does not say"""
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            return next(int(line.split()[1]) * 1024 for line in file if line.startswith("MemAvailable:"))
    except (OSError, StopIteration):
        return 1 << 62
