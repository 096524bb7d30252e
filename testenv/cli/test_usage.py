# SPDX-License-Identifier: Apache-2.0
"""Every command has help; wrong usage has exit status 2 and one line."""
import pytest

import inProcess
from patina.cli import bench, main


def run(*arguments):
    return inProcess.patina(*arguments, check=False)


@pytest.mark.parametrize("command", sorted(main.COMMANDS))
def test_every_command_has_help(command):
    process = run(command, "--help")
    assert process.returncode == 0 and f"patina {command}" in process.stdout


def test_overview_lists_every_command():
    process = run("--help")
    assert process.returncode == 0
    assert all(command in process.stdout for command in main.COMMANDS)
    assert set(main.SUMMARIES) == set(main.COMMANDS)


@pytest.mark.parametrize("arguments", [
    [], ["nonsense"], ["record"], ["record", "a.usda"], ["record", "a.usda", "b.png", "--noSuchFlag"],
    ["record", "a.usda", "b.png", "--samples", "0"], ["record", "a.usda", "b.png", "--imageWidth", "-5"],
    ["record", "a.usda", "b.png", "--tolerance", "nan"], ["record", "a.usda", "b.png", "--complexity", "9"],
    ["record", "a.usda", "b.png", "--dataWindow", "5,5,1,1"], ["record", "a.usda", "b.png", "--seed", "-1"],
    ["record", "a.usda", "b.png", "--defaultTime", "--frames", "1"],
    ["record", "a.usda", "b.png", "--samp", "1"], ["compare", "a.png"], ["bsdf", "draw", "a.mtlx"],
    ["bsdf", "eval", "a.mtlx"], ["bsdf", "albedo", "a.mtlx", "--wo", "0,0,0"],
    ["bsdf", "albedo", "a.mtlx", "--wo", "1,2"],
])
def test_wrong_usage(arguments):
    process = run(*arguments)
    assert process.returncode == 2
    assert "Traceback" not in process.stderr
    if arguments:
        assert len(process.stderr.strip().splitlines()) == 1


@pytest.mark.parametrize("before, after", [
    (["--json", "a"], ["--json=-", "a"]),
    (["--json=x", "a"], ["--json=x", "a"]),
    (["--wo", "-0.5,0,1"], ["--wo=-0.5,0,1"]),
    (["-f", "-3:5"], ["-f-3:5"]),
    (["a", "-1.png"], ["a", "-1.png"]),
    (["--wo", "-"], ["--wo", "-"]),
])
def test_values_that_begin_with_a_minus(before, after):
    assert main._normalise(before) == after


def test_benchmarks_read_their_flags_as_they_are_typed(monkeypatch):
    found = []
    monkeypatch.setattr(bench, "run", lambda arguments: found.extend(arguments.passed_on))
    assert run("bench", "path", "--json", "a.json").returncode == 0
    assert found == ["path", "--json", "a.json"]
