# SPDX-License-Identifier: Apache-2.0
"""Report, charts, sheets and the page of materials can be used by keyboard and screen reader: axe-core finds no serious
violation of WCAG 2 A and AA on them, in light and in dark, and Tab reaches what can be operated."""
import os

import pytest

from accessibility import axe_script, look_at, violations

from patina.chart import look, lobes, png
from patina.cli import main
from patina.library import catalog, page

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
STAGE = os.path.join(ROOT, "testenv", "scenes", "furnace.usda")


@pytest.fixture(scope="module")
def axe():
    return axe_script()


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    assert main.main(["record", STAGE, str(folder / "a.png"), "-w", "24", "--samples", "4", "--report", str(folder / "a.html"),
                      "--quiet"]) == 0
    return str(folder / "a.html")


@pytest.fixture(scope="module")
def charts(tmp_path_factory):
    folder = tmp_path_factory.mktemp("charts")
    assert main.main(["chart", STAGE, "-w", "8", "--maxSamples", "4", "--referenceSamples", "8", "--tolerances", "none",
                      "--backend", "embree", "--quiet", "--out", str(folder)]) == 0
    return next(str(folder / name) for name in sorted(os.listdir(folder)) if name.endswith(".html"))


@pytest.fixture(scope="module")
def sheet(tmp_path_factory):
    """The data of both back ends' page and contact sheets."""
    import numpy as np

    path = tmp_path_factory.mktemp("sheet") / "a.html"
    path.write_text(look.page("Sheet") + "<h1>Sheet</h1>" + f'<img alt="grey" src="{png.data_uri(np.full((4, 4, 3), 0.5))}">'
                    + lobes.scatter("t", [(1.0, 0.1, "a"), (2.0, 0.01, "b")], "y") + look.END)
    return str(path)


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    path = tmp_path_factory.mktemp("library") / "a.html"
    path.write_text(page.document(16, 1, [e for e in catalog.entries() if e.name in ("chalk", "gold")])[0])
    return str(path)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", ["report", "charts", "sheet", "library"])
def test_pages_have_no_serious_violation(chromium, axe, request, name, scheme):
    assert not look_at(chromium, axe, request.getfixturevalue(name), scheme)


def test_the_page_of_materials_has_no_serious_violation(chromium, axe, make):
    chromium.open(make("accessible.html", STAGE), width=1000, height=700)
    chromium.evaluate("return 1;")
    assert not violations(chromium, axe)


def test_a_violation_would_be_found(chromium, axe, tmp_path):
    path = tmp_path / "bad.html"
    path.write_text('<!doctype html><html><title>a</title><body style="background:#fff"><p style="color:#ccc">words</p><img '
                    'src=""></body></html>')
    found = " ".join(look_at(chromium, axe, str(path), "light"))
    assert "color-contrast" in found and "image-alt" in found and "html-has-lang" in found


def test_the_report_works_by_keyboard(chromium, report):
    """Tab goes through every control once, each is named, and arrows move the divider."""
    chromium.open(report, width=1000, height=700)
    page = chromium._page
    reached = []
    for _ in range(60):
        page.keyboard.press("Tab")
        here = page.evaluate("(() => { const e = document.activeElement; return e === document.body ? '' : e.tagName + '#' + "
                             "e.id + '|' + (e.getAttribute('aria-label') || e.innerText || e.labels?.[0]?.innerText || "
                             "'').trim(); })()")
        if not here or here in reached:
            break
        reached.append(here)
    controls = page.evaluate("[...document.querySelectorAll('button, select, summary, #divider')].filter(e => "
                             "e.offsetParent).length")
    assert len(reached) >= controls > 0, reached
    assert all(name.partition("|")[2] for name in reached), reached
    page.focus("#divider")
    before = page.evaluate("document.querySelector('#divider').getBoundingClientRect().x")
    page.keyboard.press("ArrowRight")
    assert page.evaluate("document.querySelector('#divider').getBoundingClientRect().x") > before
