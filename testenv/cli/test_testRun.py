# SPDX-License-Identifier: Apache-2.0
"""`patina test` hands tiers and rooms to pytest, runs what is named whatever its tier, and names rooms that there are not."""
import os
import subprocess

import pytest

from patina.cli import main, testRun

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


@pytest.fixture
def asked(monkeypatch):
    """:returns: function of arguments -> what pytest was called with"""
    calls = []
    monkeypatch.setattr(subprocess, "call", lambda command, **keywords: calls.append((command, keywords)) or 0)

    def run(*arguments):
        assert main.main(["test", *arguments]) == 0
        command, keywords = calls[-1]
        assert keywords["cwd"] == ROOT and os.path.join(ROOT, "testenv") in keywords["env"]["PYTHONPATH"].split(os.pathsep)
        return command

    return run


@pytest.mark.parametrize("arguments, tier", [
    ([], "full"), (["-k", "furnace"], "full"), (["--tier", "unit"], "unit"), (["--room", "shaders"], "smoke"),
    (["--room", "shaders", "--tier", "full"], "full"), ([os.path.abspath(__file__)], "all"),
    ([os.path.abspath(__file__) + "::test_x"], "all"), ([os.path.abspath(__file__), "--tier", "long"], "long")])
def test_the_tier_follows_from_what_is_asked(asked, arguments, tier):
    command = asked(*arguments)
    assert command[command.index("--tier") + 1] == tier
    assert ("--room" in command) == ("--room" in arguments)


def test_a_room_that_there_is_not(capsys):
    assert main.main(["test", "--room", "cellar"]) == 2
    error = capsys.readouterr().err
    assert "cellar" in error and "shaders" in error and len(error.strip().splitlines()) == 1


def test_a_tier_that_there_is_not(capsys):
    assert main.main(["test", "--tier", "nightly"]) == 2
    assert "nightly" in capsys.readouterr().err


def test_the_command_of_ci_is_the_readmes():
    with open(os.path.join(ROOT, ".ci", "run"), encoding="utf-8") as file:
        assert file.read().rstrip().endswith("exec ./patina test")


@pytest.mark.parametrize("place", ["assets", "other/assets", "none"])
def test_public_assets_are_found_near_the_checkout(tmp_path, place):
    (tmp_path / "aGame" / "assets").mkdir(parents=True)  # is called so, and is another
    (tmp_path / place / "StandardShaderBall").mkdir(parents=True)
    found = testRun.find_assets(str(tmp_path / "checkout"))
    assert found == (None if place == "none" else str(tmp_path / place))
