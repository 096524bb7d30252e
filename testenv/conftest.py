# SPDX-License-Identifier: Apache-2.0
"""Collects the googletest programs of the build as pytest items, one for each test suite."""
import glob
import os
import subprocess
import sys

import pytest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.path += sorted(glob.glob(os.path.join(HERE, "*/")))  # tests import helpers of all rooms
if os.environ.get("PATINA_BUILD_DIR"):  # tests run programs in other folders
    os.environ["PATINA_BUILD_DIR"] = os.path.abspath(os.environ["PATINA_BUILD_DIR"])

import googleTests  # noqa: E402
import inProcess  # noqa: E402

TIMEOUT = 1200  # seconds for one suite: a hang fails rather than blocks
# These compile hundreds of shaders and run each for milliseconds. The driver's optimizer would take a quarter of their time;
# the pictures of other tests are drawn with it.
MANY_SHADERS = "testGlsl"


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
        environment = dict(os.environ)
        if os.path.basename(self.program).startswith(MANY_SHADERS):
            environment.setdefault("GALLIVM_PERF", "nopt")
        try:
            result = subprocess.run([self.program, f"--gtest_filter={self.suite}.*", "--gtest_brief=1"], env=environment,
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
        for program in googleTests.programs():
            for suite in googleTests.suites(program) or [None]:
                yield _Suite.from_parent(self, name=f"{os.path.basename(program)}::{suite or 'list'}",
                                         program=program, suite=suite)


@pytest.fixture(scope="session")
def opengl():
    """Skips a test where the rasterizer cannot run."""
    inProcess.needs_opengl()


def pytest_collect_file(file_path, parent):
    if file_path.name == "googletest.txt":
        return _GoogleTests.from_parent(parent, path=file_path)
    return None
