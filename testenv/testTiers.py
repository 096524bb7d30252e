# SPDX-License-Identifier: Apache-2.0
"""pytest plugin: `--tier` and `--room` choose tests by manifest.py."""
import os
import sys

import pytest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import manifest  # noqa: E402


def pytest_addoption(parser):
    group = parser.getgroup("patina")
    group.addoption("--tier", choices=list(manifest.RUNS), default="all", help="tests of this tier, and of those it holds")
    group.addoption("--room", action="append", default=[], choices=manifest.ROOMS, help="only tests of this room (repeatable)")


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
        items[:] = kept


def pytest_report_header(config):
    rooms = config.getoption("--room")
    return f"tier: {config.getoption('--tier')}" + (f", rooms: {', '.join(rooms)}" if rooms else "")
