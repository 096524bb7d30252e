# SPDX-License-Identifier: Apache-2.0
"""Every command has help; wrong usage has exit status 2 and one line."""
import shutil
import subprocess

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


@pytest.mark.parametrize("arguments, hint", [
    (["record", "a.usda", "b.png", "--sampels", "5"], "did you mean --samples?"),
    (["record", "a.usda", "b.png", "--imagewidth=5"], "did you mean --imageWidth=5?"),
    (["record", "a.usda", "b.png", "--tolerance", "5%"], "a share is written as a number: --tolerance 0.05"),
    (["bsdf", "eval", "a.mtlx", "--wi", "0", "0", "1"], "write it with commas: --wi 0,0,1"),
    (["bsdf", "eval", "a.mtlx", "--wo=0", "0", "1", "--wi", "0,0,1"], "write it with commas: --wo 0,0,1"),
    (["recrod", "a.usda"], "did you mean record?")])
def test_what_was_meant_is_said(arguments, hint):
    process = run(*arguments)
    assert process.returncode == 2 and hint in process.stderr, process.stderr


def test_nothing_is_guessed_where_nothing_is_alike():
    for arguments in (["record", "a.usda", "b.png", "--frobnicate"], ["bsdf", "eval", "a.mtlx", "--wi", "0,0,1", "7"]):
        assert "did you mean" not in run(*arguments).stderr and "commas" not in run(*arguments).stderr


def completed(tmp_path, *words):
    """:returns: what bash completes the last word of a command to"""
    script = tmp_path / "complete.sh"
    script.write_text(run("completion", "bash").stdout + f"""
COMP_WORDS=(patina {' '.join(words)})
COMP_CWORD={len(words)}
_patina
printf '%s\n' "${{COMPREPLY[@]}}"
""")
    done = subprocess.run(["bash", str(script)], capture_output=True, text=True)
    assert not done.stderr
    return done.stdout.split()


def test_bash_completes_commands_flags_and_values(tmp_path):
    assert completed(tmp_path, "rec") == ["record"]
    assert completed(tmp_path, "record", "a.usda", "--tol") == ["--tolerance"]
    assert completed(tmp_path, "record", "--backend", "ra") == ["raster"]
    assert completed(tmp_path, "bsdf", "al") == ["albedo"] and completed(tmp_path, "completion", "z") == ["zsh"]
    assert completed(tmp_path, "record", "a.u") == []  # files are bash's own


def test_both_shells_know_every_command_and_flag():
    from patina.cli import completion

    table = completion.table()
    assert set(table) == set(main.COMMANDS) and "--samples" in table["record"]
    for shell in completion.SHELLS:
        text = run("completion", shell).stdout
        assert all(flag in text for flags in table.values() for flag in flags), shell
        checked = shutil.which(shell)
        if checked:
            assert subprocess.run([checked, "-n"], input=text, capture_output=True, text=True).returncode == 0


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
