# SPDX-License-Identifier: Apache-2.0
"""A page of docs/design has its five parts: idea, equation with source, rejected alternatives, limits, places in the code."""
import os
import re

import pytest

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FOLDER = os.path.join(ROOT, "docs", "design")
PAGES = sorted(os.listdir(FOLDER))
LONGEST = 200  # lines: what is read at one sitting
SOURCE = re.compile(r"\b(1[89]|20)\d\d\b|\bspecification\b|\bUsdGeomMesh\b|\bOpenSubdiv\b|\bclosed form")


def without_code(text):
    return re.sub(r"```.*?```", "", text, flags=re.DOTALL)


def missing(text):
    """:returns: the parts that a page lacks"""
    sections = dict(re.findall(r"^## (.*)\n((?:(?!## ).*\n?)*)", text, re.MULTILINE))
    found = []
    if not re.match(r"# .+\n\n(?![#|!])\S", text):
        found.append("the idea in a sentence below the title")
    if not re.search(r"^ {4,}\S.*[=:<]", without_code(text), re.MULTILINE):
        found.append("an equation")
    if not SOURCE.search(text):
        found.append("a source")
    found += [f"## {name}" for name in ("Rejected", "Limits", "Where") if not sections.get(name, "").strip()]
    return found


@pytest.mark.parametrize("page", PAGES)
def test_has_its_parts(page):
    with open(os.path.join(FOLDER, page), encoding="utf-8") as file:
        text = file.read()
    assert not missing(text)
    assert text.count("\n") <= LONGEST


def test_a_page_without_them_is_found():
    assert len(missing("# Title\n\n## Limits\n\n## Where\nhere\n")) == 5
    assert not missing("# Title\n\nAn idea (Veach 1997).\n\n    a = b\n\n## Rejected\n- c\n\n## Limits\nd\n\n## Where\n`e`\n")
