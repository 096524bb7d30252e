# SPDX-License-Identifier: Apache-2.0
"""axe-core in the browser of the tests."""
import os

import pytest

HERE = os.path.dirname(os.path.abspath(__file__))


def axe_script():
    """:returns: the script of axe-core; skips where npm cannot fetch it"""
    from patina.cli.errors import CommandError
    from patina.view import bundle

    try:
        folder = bundle.packages(os.path.join(HERE, "web"))
    except CommandError as error:
        pytest.skip(str(error))
    with open(os.path.join(folder, "node_modules", "axe-core", "axe.min.js"), encoding="utf-8") as file:
        return file.read()


def violations(browser, axe):
    """:returns: those of WCAG 2 A and AA: rule, what it says, and the first elements"""
    browser._page.evaluate(axe + "\n;0")  # a script tag would be refused by the policy of the page
    found = browser._page.evaluate("axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa']})")
    assert found["passes"], "axe-core looked at nothing"
    return [f"{v['id']}: {v['help']}: {[n['html'][:160] for n in v['nodes'][:3]]}" for v in found["violations"]]


def look_at(browser, axe, path, scheme, width=1000):
    """:param scheme: light or dark
    :param width: of the window, pixels
    :returns: violations, and whether the page has to be scrolled sideways"""
    browser.open(path, width=width, height=700)
    browser._page.emulate_media(color_scheme=scheme)
    browser._page.wait_for_load_state("load")
    wider = browser._page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    return violations(browser, axe) + ([f"{wider} pixels wider than the window"] if wider > 0 else [])
