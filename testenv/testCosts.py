# SPDX-License-Identifier: Apache-2.0
"""pytest plugin: the processor time of each test, and at the end of a run where it went.

Processor time says more than a clock where several processes share the cores. It is that of the test's process with all of its
threads, and of child processes that ended meanwhile. What a fixture of a module takes counts for the test that asks first.
What hosts of Hydra take that stay for several tests (hydraBuild.py) is in none.
"""
import resource

import pytest

COST = "processorSeconds"  # the name of the property in a report
NAME = "manifestName"
SHOWN = 12


def pytest_addoption(parser):
    parser.getgroup("patina").addoption("--costs", metavar="FILE",
                                        help="write the processor seconds of each test, dearest first")


def pytest_configure(config):
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(_Costs(config.getoption("--costs")), "costs")


def spent():
    """:returns: seconds of the processor in this process and in its ended children"""
    own, children = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item):
    item.costs_since = spent()
    yield


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item):
    began, item.costs_since = item.costs_since, spent()
    report = (yield).get_result()
    report.user_properties = [*report.user_properties, (COST, item.costs_since - began),
                              (NAME, getattr(item, "manifest_name", item.nodeid))]


class _Costs:
    """Adds up what the reports of all processes say."""

    def __init__(self, file):
        self.file = file
        self.tests = {}  # name: processor's seconds by phase, and `wall`

    def pytest_runtest_logreport(self, report):
        properties = dict(report.user_properties)
        if COST in properties:
            found = self.tests.setdefault(properties[NAME], {"wall": 0.0})
            found[report.when] = properties[COST]
            found["wall"] += report.duration

    def pytest_terminal_summary(self, terminalreporter):
        if not self.tests:
            return
        phases = ("setup", "call", "teardown")
        rows = []
        for name, found in self.tests.items():
            parts = [found.get(phase, 0.0) for phase in phases]
            rows.append((sum(parts), *parts, found["wall"], name))
        rows.sort(key=lambda row: (-row[0], row[-1]))
        if self.file:
            with open(self.file, "w", encoding="utf-8") as file:
                file.write("\t".join(["seconds", *phases, "wall", "test"]) + "\n")
                file.writelines("\t".join([*(f"{value:.2f}" for value in row[:-1]), row[-1]]) + "\n" for row in rows)
        total = sum(row[0] for row in rows)
        terminalreporter.section("processor time")
        terminalreporter.write_line(f"{total:.0f} s of {len(rows)} tests, {sum(row[0] for row in rows[:SHOWN]):.0f} s of the "
                                    f"{min(SHOWN, len(rows))} dearest:")
        for row in rows[:SHOWN]:
            terminalreporter.write_line(f"{row[0]:6.1f} s  {row[-1]}")
