# SPDX-License-Identifier: Apache-2.0
"""The blocks of a tutorial: files that it tells to save, and commands that it tells to run."""
import dataclasses
import os
import re
import subprocess

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FOLDER = os.path.join(ROOT, "docs", "tutorials")
SECONDS = 900  # for one block: a hang fails rather than blocks
LINKED = ("patina", "testenv", "docs", "build")  # what commands of a tutorial find in the folder that they run in
FENCE = re.compile(r'^```(\w+)(?: title="([^"\n]+)")?[^\n]*\n(.*?)^```$', re.MULTILINE | re.DOTALL)


@dataclasses.dataclass
class Block:
    language: str
    title: str  # of a file; empty for what is run
    text: str
    line: int


class BlockFailure(Exception):
    """A block that does not do what its page says: page, line, command, and what was printed."""


def pages():
    """:returns: names of the tutorials, without .md"""
    return sorted(name[:-3] for name in os.listdir(FOLDER) if name.endswith(".md") and name != "README.md")


def read(path):
    """:returns: (blocks, what the page needs that may not be there)"""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    needs = re.match(r"<!-- needs: (.*?) -->", text)
    found = [Block(m[1], m[2] or "", m[3], text.count("\n", 0, m.start()) + 1) for m in FENCE.finditer(text)]
    return found, needs[1] if needs else ""


def _link(folder):
    for name in LINKED:
        target = os.environ.get("PATINA_BUILD_DIR", os.path.join(ROOT, name)) if name == "build" else os.path.join(ROOT, name)
        if not os.path.lexists(os.path.join(folder, name)):
            os.symlink(target, os.path.join(folder, name))


def _calls(text, programs):
    """:returns: the first of the programs that a line of a command begins with, or None"""
    return next((name for name in programs if re.search(rf"^{re.escape(name)}\b", text, re.MULTILINE)), None)


def run(path, folder, environment=None, say=lambda line: None, absent=(), left=None):
    """Does what a page says: saves its files and runs its commands (`sh`, and `python` without a title) in a folder.

    :param path: of the page
    :param folder: an empty folder
    :param environment: more variables
    :param absent: programs that are not there; commands that call one are left out
    :param left: a list that gets page, line and program of each command that was left out
    :returns: how many blocks were saved or run
    :raises BlockFailure: at the first that fails"""
    _link(folder)
    variables = {**os.environ, **(environment or {})}
    done = 0
    for block in read(path)[0]:
        where = f"{os.path.relpath(path, ROOT)}:{block.line}"
        program = _calls(block.text, absent) if block.language == "sh" else None
        if program:
            say(f"{where}: left out, there is no {program}")
            if left is not None:
                left.append(f"{where} calls {program}")
            continue
        if block.title:
            target = os.path.join(folder, block.title)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            with open(target, "w", encoding="utf-8") as file:
                file.write(block.text)
        elif block.language in ("sh", "python"):
            command = ["bash", "-euo", "pipefail", "-c", block.text] if block.language == "sh" else [
                os.path.join(folder, "patina"), "python", "-c", block.text]
            say(f"{where}\n{block.text}")
            try:
                ended = subprocess.run(command, cwd=folder, env=variables, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                       stdin=subprocess.DEVNULL, text=True, errors="replace", timeout=SECONDS)
            except subprocess.TimeoutExpired as error:
                said = error.output or b""  # bytes, whatever was asked for
                said = said.decode(errors="replace") if isinstance(said, bytes) else said
                raise BlockFailure(f"{where}: no end after {SECONDS} s\n{block.text}{said[-2000:]}") from None
            say(ended.stdout)
            if ended.returncode != 0:
                raise BlockFailure(f"{where}: exit status {ended.returncode}\n{block.text}{ended.stdout[-4000:]}")
        else:
            continue
        done += 1
    return done
