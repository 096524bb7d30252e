# SPDX-License-Identifier: Apache-2.0
"""Collects the googletest programs of the build as pytest items, one for each test suite."""
import os
import stat
import subprocess
import sys

import pytest

TIMEOUT = 1200  # seconds for one suite: a hang fails rather than blocks


def _programs():
    folder = os.path.join(os.environ.get("PATINA_BUILD_DIR", ""), "tests")
    if not os.environ.get("PATINA_BUILD_DIR") or not os.path.isdir(folder):
        return []
    paths = [os.path.join(folder, name) for name in sorted(os.listdir(folder))]
    return [p for p in paths if os.path.isfile(p) and os.stat(p).st_mode & stat.S_IXUSR]


def _suites(program):
    """:returns: names of the suites in a program, those of parameterized tests included"""
    listing = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, timeout=60)
    if listing.returncode != 0:
        return None
    return [line.split("#")[0].strip().rstrip(".") for line in listing.stdout.splitlines()
            if line and not line[0].isspace() and line.split("#")[0].strip().endswith(".")]


class _GoogleTestFailure(Exception):
    pass


def _folder(program):
    """:returns: the folder whose CMakeLists.txt made a program, as the build noted it; else that of Hydra's own tests"""
    try:
        with open(program + ".folder", encoding="utf-8") as file:
            return file.read().strip()
    except OSError:
        return "hdDelegate/hydra"


class _Suite(pytest.Item):
    def __init__(self, *, program, suite, **keywords):
        super().__init__(**keywords)
        self.program, self.suite = program, suite
        self.manifest_name = f"{_folder(program)}::{self.name}"

    def runtest(self):
        if self.suite is None:
            raise _GoogleTestFailure(f"{self.program} cannot list its tests")
        try:
            result = subprocess.run([self.program, f"--gtest_filter={self.suite}.*", "--gtest_brief=1"],
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                                    timeout=TIMEOUT)
        except subprocess.TimeoutExpired as error:
            raise _GoogleTestFailure(f"no end after {TIMEOUT} s\n{error.output or ''}") from None
        if result.returncode != 0:
            reason = f"killed by signal {-result.returncode}\n" if result.returncode < 0 else ""
            raise _GoogleTestFailure(reason + result.stdout)
        counts = [line for line in result.stdout.splitlines() if "SKIPPED" in line and " test" in line]
        if counts and "[  PASSED  ] 0 tests" in result.stdout:
            pytest.skip(" ".join(result.stdout.split())[:200])

    def repr_failure(self, excinfo):
        if isinstance(excinfo.value, _GoogleTestFailure):
            return f"{self.program} --gtest_filter={self.suite}.*\n{excinfo.value}"
        return super().repr_failure(excinfo)

    def reportinfo(self):
        return self.path, None, self.name


class _GoogleTests(pytest.File):
    """googletest.txt, the place that the programs' suites hang below."""

    def collect(self):
        for program in _programs():
            for suite in _suites(program) or [None]:
                yield _Suite.from_parent(self, name=f"{os.path.basename(program)}::{suite or 'list'}",
                                         program=program, suite=suite)


def pytest_collect_file(file_path, parent):
    if file_path.name == "googletest.txt":
        return _GoogleTests.from_parent(parent, path=file_path)
    return None


def pytest_pycollect_makemodule(module_path):
    """Tests may import helpers that lie beside them or beside this file."""
    for folder in (str(module_path.parent), os.path.dirname(os.path.abspath(__file__))):
        if folder not in sys.path:
            sys.path.append(folder)
