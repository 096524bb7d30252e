# SPDX-License-Identifier: Apache-2.0
"""Documents name files that are there, link to places that are there, and the first two stay short."""
import glob
import os
import re

import pytest

import documents

TOPS = ("base", "shaders", "materialNetwork", "hdDelegate", "plugin", "testenv", "docs", "cmake")
ENDINGS = ("", ".h", ".cpp", ".py", ".glsl")


def expanded(name):
    """:returns: the names that a{b,c}d stands for"""
    found = re.match(r"(.*)\{([^}]*)\}(.*)$", name)
    if not found:
        return [name]
    return [each for part in found[2].split(",") for each in expanded(found[1] + part + found[3])]


def is_there(name):
    if "*" in name:
        return bool(glob.glob(os.path.join(documents.ROOT, name)))
    return any(os.path.exists(os.path.join(documents.ROOT, name + ending)) for ending in ENDINGS)


@pytest.mark.parametrize("path", documents.paths())
def test_files_that_it_names_are_there(path):
    prose = re.sub(r"^```.*?^```", "", documents.read(path), flags=re.DOTALL | re.MULTILINE)
    named = [word.rstrip(".,:").split("::")[0] for code in re.findall(r"`([^`\n]+)`", prose) for word in code.split()]
    missing = [each for name in named if re.fullmatch(rf"({'|'.join(TOPS)})/[\w/.*{{}},-]+", name)
               for each in expanded(name) if not is_there(each)]
    assert not missing, missing


def anchors(text):
    """:returns: the fragments that GitHub gives a page's headings"""
    heads = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


@pytest.mark.parametrize("path", documents.paths())
def test_links_lead_somewhere(path):
    for target in re.findall(r"\]\(([^)\s]+)\)", documents.read(path)):
        if re.match(r"\w+:", target):
            continue
        file, _, fragment = target.partition("#")
        full = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
        assert os.path.exists(os.path.join(documents.ROOT, full)), target
        if fragment:
            assert fragment in anchors(documents.read(full)), target


@pytest.mark.parametrize("path, maximum", [("README.md", 120), ("ARCHITECTURE.md", 150)])
def test_the_first_pages_stay_short(path, maximum):
    assert len(documents.read(path).splitlines()) <= maximum


def test_every_page_can_be_found():
    """Another page links to it, or to its folder."""
    linked = set()
    for path in documents.paths():
        for target in re.findall(r"\]\(([^)#\s]+)", documents.read(path)):
            linked.add(os.path.normpath(os.path.join(os.path.dirname(path), target)))
    lost = [path for path in documents.paths() if path not in linked and os.path.dirname(path) not in linked
            and path != "README.md"]
    assert not lost, lost
