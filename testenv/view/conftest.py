# SPDX-License-Identifier: Apache-2.0
"""The page's tests run in a headless Chromium; without one, playwright, Node or npm's packages they are left out,
and test_found.py says so."""
import pytest

import browser

if browser.missing():
    collect_ignore_glob = ["test_[!f]*.py"]


@pytest.fixture(scope="module")  # what ends badly fails a test of its own file
def chromium():
    started = browser.Browser()
    yield started
    started.close()


@pytest.fixture(scope="session")
def make(tmp_path_factory):
    """Makes a page by the command: make(name, argument...) -> path."""
    from patina.cli import main

    folder = tmp_path_factory.mktemp("pages")

    def made(name, *arguments):
        path = str(folder / name)
        assert main.main(["view", *map(str, arguments), "-o", path]) == 0
        return path

    return made
