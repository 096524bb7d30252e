# SPDX-License-Identifier: Apache-2.0
"""pytest plugin: `--tier` and `--room` choose tests by manifest.py, which also says what is run first."""
import json
import os
import sys

import pytest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import googleTests  # noqa: E402
import manifest  # noqa: E402


def pytest_addoption(parser):
    group = parser.getgroup("patina")
    group.addoption("--tier", choices=list(manifest.RUNS), default="all", help="tests of this tier, and of those it holds")
    group.addoption("--room", action="append", default=[], choices=manifest.ROOMS, help="only tests of this room (repeatable)")


def pytest_sessionstart(session):
    if getattr(session.config.option, "numprocesses", None) and not hasattr(session.config, "workerinput"):
        googleTests.list_all()  # once, for all workers


def name_of(item):
    """:returns: the name that the manifest knows a test by"""
    return getattr(item, "manifest_name", item.nodeid)


def pytest_collection_modifyitems(config, items):
    tiers, rooms = manifest.RUNS[config.getoption("--tier")], set(config.getoption("--room"))
    kept, left, lost = [], [], []
    for item in items:
        place = manifest.place_of(name_of(item))
        if place is None:
            lost.append(name_of(item))
            continue
        (kept if place[0] in tiers and (not rooms or rooms & place[1]) else left).append(item)
    if lost:
        raise pytest.UsageError("tests in no tier (testenv/manifest.py): " + ", ".join(lost))
    if left:
        config.hook.pytest_deselected(items=left)
    costly = [manifest.is_costly(name_of(item)) for item in kept]
    items[:] = in_order(kept, costly, getattr(config, "workerinput", {}).get("workercount", 1))


def in_order(items, costly, processes):
    """Each process starts with an equal part of a list (pytest-xdist's `worksteal`): the costly tests are dealt out to the
    heads of these parts, so that none is begun when the others have nothing left to do.

    :param costly: for each item, whether it is
    :returns: the items, all others in the order that they had"""
    first = [item for item, long in zip(items, costly) if long]
    rest = [item for item, long in zip(items, costly) if not long]
    if len(rest) < len(first) + 2 * processes:  # heads would be longer than parts
        return list(items)
    found, taken = [], 0
    for i in range(processes):
        head = first[i::processes]
        size = (len(items) - len(found)) // (processes - i) - len(head)
        found += head + rest[taken:taken + size]
        taken += size
    return found


def pytest_report_header(config):
    rooms = config.getoption("--room")
    return f"tier: {config.getoption('--tier')}" + (f", rooms: {', '.join(rooms)}" if rooms else "")


def pytest_terminal_summary(terminalreporter):
    terminalreporter.write_line(f"OpenUSD whose Hydra was tested: {_open_usd()}")


def _open_usd():
    """:returns: version and place of the one that this build has a plugin for"""
    try:
        with open(os.path.join(os.environ.get("PATINA_BUILD_DIR", ""), "hydra.json"), encoding="utf-8") as file:
            build = json.load(file)
    except OSError:
        return "none was found"
    number = int(build["version"])
    return f"{number // 100 % 100}.{number % 100:02d} in {build['root']}"
