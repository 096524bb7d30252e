# SPDX-License-Identifier: Apache-2.0
"""The browser that ends by itself fails the test that uses it, and no other."""
import os
import signal

import browser
import pytest


@pytest.fixture
def plain(tmp_path):
    page = tmp_path / "plain.html"
    page.write_text("<script>window.patina = { ready: Promise.resolve({ value: 7 }) };</script>")
    return page


def _kill_browsers():
    """Kills the browsers that this process started, and no others."""
    parents, commands = {}, {}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
                parents[int(pid)] = int(file.read().rpartition(")")[2].split()[1])
            with open(f"/proc/{pid}/cmdline", encoding="utf-8") as file:
                commands[int(pid)] = file.read()
        except OSError:  # it has ended meanwhile
            pass

    def ours(pid):
        return pid == os.getpid() or (pid in parents and ours(parents[pid]))

    found = [pid for pid in parents if ours(pid) and "--headless" in commands.get(pid, "") and "--type=" not in commands[pid]]
    assert found
    for pid in found:
        os.kill(pid, signal.SIGKILL)


def test_the_next_page_is_shown_after_the_browser_was_killed(plain):
    shown = browser.Browser()
    try:
        shown.open(plain)
        assert shown.evaluate("return page.value") == 7
        _kill_browsers()
        with pytest.raises(Exception):
            shown.evaluate("return page.value")
        shown.open(plain)
        assert shown.evaluate("return page.value") == 7
        _kill_browsers()
    finally:
        shown.close()  # must not raise: it would be the failure of whichever test the worker ran last
