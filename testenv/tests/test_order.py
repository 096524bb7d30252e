# SPDX-License-Identifier: Apache-2.0
"""The order of tests, the number of processes that share them, and that a list of suites is made anew for a new program."""
import os

import pytest

import googleTests
import testTiers
from patina.cli import testRun


@pytest.mark.parametrize("processes", [1, 2, 3, 5])
def test_each_process_begins_with_its_share_of_the_costly(processes):
    items = list(range(101))
    costly = [item % 9 == 4 for item in items]
    found = testTiers.in_order(items, costly, processes)
    assert sorted(found) == items
    assert [item for item in found if not costly[item]] == [item for item in items if not costly[item]]
    begin, long = 0, sum(costly)
    for i in range(processes):  # as pytest-xdist cuts the list
        size = (len(items) - begin) // (processes - i)
        heads = [costly[item] for item in found[begin:begin + size]]
        count = sum(heads)
        assert heads == [True] * count + [False] * (size - count)
        assert long // processes <= count <= -(-long // processes)
        begin += size


def test_few_tests_stay_as_they_are():
    assert testTiers.in_order("abcd", [False, True, True, True], 3) == list("abcd")


@pytest.mark.parametrize("tier, free, processes", [("full", 1 << 40, 3), ("long", 1 << 40, 3), ("unit", 1 << 40, 2),
                                                   ("full", 5 << 30, 2), ("full", 0, 1)])
def test_processes_are_as_many_as_there_is_room_for(monkeypatch, tier, free, processes):
    pytest.importorskip("xdist", reason="pytest-xdist is not installed")
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1}, raising=False)
    monkeypatch.setattr(testRun, "_free_memory", lambda: free)
    assert testRun._workers([], tier)[:2] == ["-n", str(processes)]


def test_a_list_of_suites_is_of_the_program_as_it_is(tmp_path, monkeypatch):
    program = tmp_path / "tests" / "testThing"
    program.parent.mkdir()
    monkeypatch.setenv("PATINA_BUILD_DIR", str(tmp_path))

    def build(suite):
        program.write_text(f"#!/bin/sh\necho {suite}.\necho '  one'\necho 'Each/{suite}.  # TypeParam = int'\n")
        program.chmod(0o755)

    build("First")
    os.utime(program, (1, 1))
    assert googleTests.programs() == [str(program)]
    assert googleTests.suites(str(program)) == ["First", "Each/First"]
    kept = tmp_path / "tests" / "testThing.suites"
    text = kept.read_text()
    program.write_text("#!/bin/sh\nexit 1\n")
    os.utime(program, (1, 1))  # as if it were the same: it is not run again
    assert googleTests.suites(str(program)) == ["First", "Each/First"]
    kept.write_text(text[:-4])  # half written
    assert googleTests.suites(str(program)) is None
    build("Second")
    assert googleTests.suites(str(program)) == ["Second", "Each/Second"]
    assert googleTests.programs() == [str(program)]
