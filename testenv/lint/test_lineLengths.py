# SPDX-License-Identifier: Apache-2.0
"""Lines of Python are no longer than CONTRIBUTING says, C++ is as clang-format has it; both tools are told the same."""
import os
import re
import shutil
import subprocess

import pytest

from documents import read

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
LIMIT = 128


def too_long(text, limit=LIMIT):
    """:returns: numbers of lines; a word that cannot be broken, a link say, is no mistake"""
    return [number for number, line in enumerate(text.split("\n"), 1)
            if len(line) > limit and re.search(r"\s", line.strip().lstrip("# "))]


def listed(*patterns):
    if not shutil.which("git") or subprocess.run(["git", "rev-parse"], cwd=ROOT, capture_output=True).returncode:
        pytest.skip("this is no git checkout: git lists the files")
    found = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns], cwd=ROOT,
                           capture_output=True, text=True, check=True).stdout.splitlines()
    return [path for path in found if os.path.isfile(os.path.join(ROOT, path))]


def test_python_keeps_to_its_columns():
    files = listed("*.py")
    assert len(files) > 200
    found = [f"{path}:{number}" for path in files for number in too_long(read(path))]
    assert not found, f"longer than {LIMIT} columns"


def pinned():
    """:returns: the version of clang-format that runs before each commit; others break lines elsewhere"""
    return re.search(r"mirrors-clang-format\s+rev: v([\d.]+)", read(".pre-commit-config.yaml"))[1]


def formatter():
    """:returns: the path of that version of clang-format; skips where it is not installed"""
    for name in ("clang-format", "clang-format-" + pinned().split(".", maxsplit=1)[0]):
        program = shutil.which(name)
        if program and f" {pinned()}" in subprocess.run([program, "--version"], capture_output=True, text=True,
                                                        check=False).stdout:
            return program
    pytest.skip(f"no clang-format {pinned()} here (pip install clang-format=={pinned()})")


def test_cpp_is_as_clang_format_has_it():
    program, files = formatter(), listed("*.cpp", "*.h")
    assert len(files) > 500
    done = subprocess.run([program, "--dry-run", *files], cwd=ROOT, capture_output=True, text=True, check=False)
    found = sorted(set(re.findall(r"^(\S+?):\d+:\d+: warning", done.stderr, re.MULTILINE)))
    assert done.returncode == 0 and not found, f"{program} -i changes these"


def test_documents_and_tools_name_the_same_limit():
    words = " ".join(read("CONTRIBUTING.md").split())
    columns = re.search(r"(\d+) columns \(`.clang-format`\), Python (\d+)", words)
    ruff = read("pyproject.toml").partition("[tool.ruff]")[2]
    assert int(columns[2]) == LIMIT and f"line-length = {LIMIT}" in ruff
    assert "E501" not in re.search(r"^ignore = \[.*?\]", ruff, re.MULTILINE)[0]
    assert f"ColumnLimit: {columns[1]}" in read(".clang-format")


def test_a_long_line_is_found():
    assert too_long("a\n" + "b " * 65 + "\n# " + "x" * 200) == [2]
