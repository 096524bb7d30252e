# SPDX-License-Identifier: Apache-2.0
"""Colours of messages: on a terminal alone, and nowhere where they are not wanted."""
import io

import pytest

from patina.cli import colours


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture(autouse=True)
def plain(monkeypatch):
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("TERM", "xterm")


def test_warnings_are_yellow_and_failures_red():
    assert colours.painted("warning: /a: b", Terminal()) == "\033[33mwarning:\033[0m /a: b"
    assert colours.painted("patina: there is no file a", Terminal()).startswith("\033[31mpatina:\033[0m ")
    assert colours.painted("patina record: --x", Terminal()).startswith("\033[31mpatina\033[0m record: ")
    assert colours.painted("a.png: 16 samples", Terminal()) == "a.png: 16 samples"


@pytest.mark.parametrize("name, value", [("NO_COLOR", "1"), ("TERM", "dumb")])
def test_who_wants_none_has_none(monkeypatch, name, value):
    monkeypatch.setenv(name, value)
    assert colours.painted("warning: /a: b", Terminal()) == "warning: /a: b"


def test_files_and_pipes_have_none():
    assert colours.painted("warning: /a: b", io.StringIO()) == "warning: /a: b"
