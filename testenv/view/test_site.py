# SPDX-License-Identifier: Apache-2.0
"""The site is whole, is read without a network, and can be used by keyboard and screen reader."""
import html.parser
import json
import os
import sys

import pytest

from accessibility import axe_script, look_at

pytest.importorskip("mkdocs", reason="PyPI's mkdocs-material is not installed")

from patina.cli import main  # noqa: E402

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    sys.path.insert(0, os.path.join(ROOT, "docs", "site"))
    folder = tmp_path_factory.mktemp("site") / "site"
    assert main.main(["docs", str(folder), "--strict"]) == 0  # no page links to nothing, none is left out of the navigation
    return folder


class Assets(html.parser.HTMLParser):
    """The files that a page loads by itself."""

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag in ("script", "img", "iframe", "source", "video", "audio", "embed"):
            self.found.append(values.get("src") or "")
        elif tag == "link" and values.get("rel") not in ("canonical", "prev", "next", "edit"):
            self.found.append(values.get("href") or "")


def pages(site):
    return [path for path in sorted(site.rglob("*.html"))]


def test_nothing_is_loaded_from_a_network(site):
    every = pages(site)
    assert len(every) > 60
    for path in every:
        for asset in Assets(path.read_text(encoding="utf-8")).found:
            assert not asset.startswith(("http:", "https:", "//")), f"{path}: {asset}"
            if asset and not asset.startswith(("data:", "javascript:")) and path.name != "404.html":
                assert (path.parent / asset.partition("?")[0].partition("#")[0]).exists(), f"{path}: {asset}"
    assert "https://fonts." not in "".join(p.read_text(encoding="utf-8") for p in site.rglob("*.css"))


def test_search_knows_the_tutorials(site):
    index = json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))
    assert any("turntable" in entry["location"] for entry in index["docs"])
    assert (site / "search" / "search_index.js").exists()  # what pages that are opened from a file search in


def test_search_works_from_a_file(chromium, site):
    chromium.open(str(site / "index.html"), width=1200, height=800)
    page = chromium._page
    page.keyboard.press("/")  # the key that Material gives to the search
    page.keyboard.type("turntable")
    page.wait_for_selector(".md-search-result__link")
    assert "turntable" in page.inner_text(".md-search-result__list").lower()
    assert not [m for m in chromium.messages() if m.startswith("request")]


def test_diagrams_are_drawn(chromium, site):
    chromium.open(str(site / "architecture.html"), width=1200, height=800)
    chromium._page.wait_for_function("document.querySelectorAll('div.mermaid').length >= 2")
    assert not [m for m in chromium.messages() if m.startswith(("request", "error"))]


def test_the_interfaces_are_in_it(site):
    module = (site / "api" / "module.html").read_text(encoding="utf-8")
    assert "make_renderer" in module and "set_light" in module
    assert "StageOptions" in (site / "api" / "package.html").read_text(encoding="utf-8")
    assert "SceneEdit" in "".join(p.read_text(encoding="utf-8") for p in (site / "api" / "cpp").glob("class*.html"))


def own_pages(site):
    """:returns: all but Doxygen's, and but the page for unknown addresses, whose links begin at a server's root"""
    return [path for path in pages(site) if "cpp" not in path.relative_to(site).parts and path.name != "404.html"]


HEADERS = ("index", "annotated", "hierarchy", "files", "functions", "namespacepatina", "classpatina_1_1Film", "film_8h",
           "film_8h_source", "search/all_0")  # one of each sort of Doxygen's pages


@pytest.mark.parametrize("scheme, width", [("light", 1280), ("dark", 400)])
def test_no_page_of_headers_has_a_violation(chromium, site, scheme, width):
    script = axe_script()
    found = {name: look_at(chromium, script, str(site / "api" / "cpp" / f"{name}.html"), scheme, width) for name in HEADERS}
    assert not {name: texts for name, texts in found.items() if texts}


@pytest.mark.parametrize("scheme, width", [("light", 1280), ("dark", 400)])
def test_no_page_has_a_violation(chromium, site, scheme, width):
    """Every page, at the width of a desk and in dark at that of a telephone: axe-core finds nothing, and nothing sticks out."""
    script, every = axe_script(), own_pages(site)
    assert len(every) > 60
    found = {str(path.relative_to(site)): look_at(chromium, script, str(path), scheme, width) for path in every}
    assert not {name: texts for name, texts in found.items() if texts}
