# SPDX-License-Identifier: Apache-2.0
"""The runner of tutorials finds their blocks, and fails where one of them fails."""
import os
import re

import pytest

import tutorialBlocks
from tutorialBlocks import BlockFailure

PAGE = """# Page
```text title="play/a.txt"
words
```
Text.
```sh
grep words play/a.txt > b.txt
```
```console
false
```
"""


def write(tmp_path, text):
    path, folder = tmp_path / "page.md", tmp_path / "folder"
    path.write_text(text)
    folder.mkdir(exist_ok=True)
    return str(path), str(folder)


def test_files_are_saved_and_commands_run(tmp_path):
    path, folder = write(tmp_path, PAGE)
    assert tutorialBlocks.run(path, folder) == 2
    assert (tmp_path / "folder" / "b.txt").read_text() == "words\n"


@pytest.mark.parametrize("broken", [
    "false", "false | true", "cat none.txt\ntrue", 'echo "$NOT_SET"', "./patina record none.usda none.png", "./patina nothing"])
def test_a_broken_block_fails(tmp_path, broken):
    path, folder = write(tmp_path, f"{PAGE}\n```sh\n{broken}\n```\n")
    with pytest.raises(BlockFailure) as failure:
        tutorialBlocks.run(path, folder)
    assert re.search(r"page.md:13: exit status [1-9]", str(failure.value)) and broken in str(failure.value)


def test_a_broken_file_makes_the_next_command_fail(tmp_path):
    path, folder = write(tmp_path, PAGE.replace("words\n```\nT", "others\n```\nT"))
    with pytest.raises(BlockFailure):
        tutorialBlocks.run(path, folder)


def test_a_broken_script_fails(tmp_path):
    path, folder = write(tmp_path, "```python\nassert 1 + 1 == 3\n```\n")
    with pytest.raises(BlockFailure, match="AssertionError"):
        tutorialBlocks.run(path, folder)


def test_a_command_whose_program_is_not_there_is_left_out_and_named(tmp_path):
    path, folder = write(tmp_path, "```sh\ntouch a\n```\n```sh\nnoSuchProgram --now\n```\n```sh\ntouch b\n```\n")
    left = []
    assert tutorialBlocks.run(path, folder, absent=["noSuchProgram"], left=left) == 2
    assert len(left) == 1 and left[0].endswith("page.md:4 calls noSuchProgram")
    assert (tmp_path / "folder" / "b").exists()
    with pytest.raises(BlockFailure, match="noSuchProgram"):
        tutorialBlocks.run(path, folder)


@pytest.mark.parametrize("page", tutorialBlocks.pages())
def test_every_block_of_a_page_is_understood(page):
    """A fence that is not closed or is written otherwise would not be run, and nobody would know."""
    path = os.path.join(tutorialBlocks.FOLDER, page + ".md")
    with open(path, encoding="utf-8") as file:
        fences = re.findall(r"^\s*```", file.read(), re.MULTILINE)
    blocks = tutorialBlocks.read(path)[0]
    assert len(fences) == 2 * len(blocks) > 0
    assert {b.language for b in blocks} <= {"sh", "python", "usda", "xml", "json", "console"}
    for block in blocks:
        assert block.title or block.language in ("sh", "python", "console"), f"line {block.line}: a file without a title"
        assert not block.title or block.title.startswith("play/")
