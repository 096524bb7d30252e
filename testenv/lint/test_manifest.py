# SPDX-License-Identifier: Apache-2.0
"""The manifest knows every test: each has a tier and rooms, and no rule is left over from what is gone."""
import fnmatch
import os
import subprocess
import sys

import pytest

import manifest

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def files(ending):
    """:returns: paths of the checkout, below its root"""
    found = []
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [f for f in folders if not f.startswith((".", "build", "node_modules"))]
        found += [os.path.relpath(os.path.join(folder, n), ROOT).replace(os.sep, "/") for n in names if n.endswith(ending)]
    return found


def programs():
    """:returns: names of googletest programs, as `folder::program`"""
    folder = os.path.join(os.environ.get("PATINA_BUILD_DIR", ""), "tests")
    notes = [n for n in os.listdir(folder) if n.endswith(".folder")] if os.path.isdir(folder) else []
    found = []
    for note in notes:
        with open(os.path.join(folder, note), encoding="utf-8") as file:
            found.append(f"{file.read().strip()}::{note[:-len('.folder')]}::any")
    return found


def test_every_test_has_a_tier_and_rooms():
    names = [file + "::any" for file in files(".py") if os.path.basename(file).startswith("test_")] + programs()
    assert len(names) > 50
    for name in names:
        place = manifest.place_of(name)
        assert place, f"{name} is in no tier: testenv/manifest.py"
        assert place[0] in manifest.TIERS and place[1], name
        assert place[1] <= set(manifest.ROOMS), name


def test_the_command_knows_the_tiers():
    from patina.cli import testRun

    assert set(testRun.TIERS) == set(manifest.RUNS)
    assert all(set(tiers) <= set(manifest.TIERS) for tiers in manifest.RUNS.values())


def test_every_folder_with_tests_of_its_own_room_has_a_rule():
    """The rule for all of testenv is there for new folders, not for those that stay."""
    for file in files(".py"):
        parts = file.split("/")
        if parts[-1].startswith("test_") and parts[0] == "testenv":
            assert f"testenv/{parts[1]}/" in manifest.FOLDERS, file


def test_no_rule_is_left_over():
    for folder in manifest.FOLDERS:
        assert os.path.isdir(os.path.join(ROOT, folder)), folder
    known = programs()
    for pattern, tier, rooms in (*manifest.OVERRIDES, *((pattern, None, None) for pattern in manifest.COSTLY)):
        assert tier in (None, *manifest.TIERS) and set((rooms or "").split()) <= set(manifest.ROOMS), pattern
        place, _, test = pattern.partition("::")
        if place.endswith(".py"):
            assert os.path.isfile(os.path.join(ROOT, place)), pattern
            function = test.partition("[")[0]
            with open(os.path.join(ROOT, place), encoding="utf-8") as file:
                assert "*" in function or f"def {function}(" in file.read(), pattern
        elif not test:
            assert os.path.isdir(os.path.join(ROOT, place.rstrip("*"))), pattern
        elif known:
            program = test.partition("::")[0]
            assert any(fnmatch.fnmatchcase(name, f"{place}::{program}::*") for name in known), pattern


def test_the_last_rule_that_says_something_counts(monkeypatch):
    monkeypatch.setattr(manifest, "OVERRIDES", (("a/*", "long", None), ("a/b.py::*", None, "film"),
                                                ("a/b.py::x", "unit", None)))
    monkeypatch.setattr(manifest, "FOLDERS", {"a/": ("full", "cli"), "a/c/": ("smoke", "view")})
    assert manifest.place_of("a/d.py::x") == ("long", {"cli"})
    assert manifest.place_of("a/b.py::y") == ("long", {"film"})
    assert manifest.place_of("a/b.py::x") == ("unit", {"film"})
    assert manifest.place_of("a/c/d.py::x") == ("long", {"view"})
    assert manifest.place_of("b/d.py::x") is None


def run(tmp_path, *arguments):
    """A pytest of its own in a folder with one test in each of two tiers, and one that no folder of the manifest holds."""
    for folder in ("testenv/mitsuba", "testenv/film", "elsewhere"):
        (tmp_path / folder).mkdir(parents=True, exist_ok=True)
        (tmp_path / folder / "test_one.py").write_text("def test_one(): pass\n")
    environment = dict(os.environ, PYTHONPATH=os.path.join(ROOT, "testenv"), PYTEST_DISABLE_PLUGIN_AUTOLOAD="1")
    return subprocess.run([sys.executable, "-m", "pytest", "-p", "testTiers", "-q", "-p", "no:cacheprovider", "--rootdir",
                           str(tmp_path), "--import-mode=importlib", *arguments], cwd=tmp_path, env=environment,
                          capture_output=True, text=True)


@pytest.mark.parametrize("arguments, passed", [(["--tier", "long"], 1), (["--tier", "full"], 1), (["--tier", "all"], 2),
                                               (["--tier", "all", "--room", "film"], 1)])
def test_tiers_and_rooms_choose(tmp_path, arguments, passed):
    done = run(tmp_path, "testenv", *arguments)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{passed} passed" in done.stdout


def test_a_test_in_no_tier_ends_the_run(tmp_path):
    done = run(tmp_path, "testenv", "elsewhere")
    assert done.returncode != 0 and "elsewhere/test_one.py::test_one" in done.stdout + done.stderr
