# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium that shows pages of `patina view`, driven by PyPI's playwright, which brings the Node that it needs."""
import functools
import os
import shutil

import numpy as np

MESA = "/usr/share/glvnd/egl_vendor.d/50_mesa.json"  # by this file EGL finds Mesa among a machine's drivers
TIMEOUT = 120000.0  # milliseconds for one step: software rendering is slow


def chromium():
    """:returns: path of a Chromium, or None"""
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


def software():
    """:returns: the arguments and the environment with which Chromium draws on the processor, on any machine: by Mesa, or where
        there is none by SwiftShader, which takes two to five times as long for the shaders of these pages"""
    if os.path.isfile(MESA):
        return ["--use-angle=gl-egl", "--ignore-gpu-blocklist"], {"__EGL_VENDOR_LIBRARY_FILENAMES": MESA,
                                                                  "LIBGL_ALWAYS_SOFTWARE": "1"}
    return ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"], {}


@functools.lru_cache(maxsize=None)
def missing():
    """:returns: why no page can be shown here, or an empty text"""
    try:
        import _patina  # noqa: F401
        import pxr.Usd  # noqa: F401
    except ImportError as error:
        return str(error)
    from patina.cli.errors import CommandError
    from patina.view import bundle

    try:
        import playwright.sync_api  # noqa: F401
    except ImportError:
        return "PyPI's playwright is not installed"
    if not chromium():
        return "there is no Chromium (Debian: apt install chromium)"
    try:
        bundle.packages()
    except CommandError as error:
        return str(error)
    return ""


class Browser:
    """Starts with the first page, and again after its process ended, so that a crash fails one test and no other."""

    def __init__(self):
        self._driver = self._browser = self._page = None
        self._messages = []

    def _started(self):
        from playwright import sync_api

        if self._browser is not None and self._browser.is_connected():
            return self._browser
        self.close()
        self._driver = sync_api.sync_playwright().start()
        arguments, environment = software()
        self._browser = self._driver.chromium.launch(
            executable_path=chromium(), headless=True, args=[*arguments, "--no-sandbox", "--disable-gpu-watchdog"],
            env={**os.environ, **environment})
        return self._browser

    def open(self, path, query="", width=640, height=480, touch=False, gl=True):
        if self._browser is not None and self._browser.is_connected() and self._page is not None:
            self._page.context.close()
        context = self._started().new_context(viewport={"width": width, "height": height}, has_touch=touch,
                                              accept_downloads=True, offline=True)
        self._messages = reported = []
        self._page = page = context.new_page()
        page.set_default_timeout(TIMEOUT)
        page.on("console", lambda m: reported.append(f"{m.type}: {m.text}"))
        page.on("pageerror", lambda e: reported.append(f"error: {e.message}"))
        page.on("dialog", lambda d: (reported.append(f"dialog: {d.message}"), d.dismiss()))
        page.on("request", lambda r: r.url.startswith(("file:", "data:", "blob:")) or reported.append(f"request: {r.url}"))
        if not gl:
            page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null;")
        page.goto(f"file://{os.path.abspath(path)}{query}")

    def shows(self, path):
        """:returns: whether a page is open still, and has told nothing"""
        alive = self._browser is not None and self._browser.is_connected() and self._page is not None
        return alive and self._page.url.partition("?")[0] == f"file://{os.path.abspath(path)}" and not self._messages

    def evaluate(self, code):
        """Runs statements in the page, where `page` is the page and `viewer` its viewer; `return` gives JSON."""
        return self._page.evaluate("(async () => { const page = await window.patina.ready, viewer = page?.viewer;"
                                   + code + " })()")

    def picture(self, change=""):
        """The picture that the page computes after a change: linear colours, top row first."""
        flat = self.evaluate(change + "; viewer.invalidate(); viewer.settle();"
                             "return [viewer.width, viewer.height, Array.from(viewer.accumulator.read())];")
        return np.array(flat[2], np.float32).reshape(flat[1], flat[0], 4)[::-1, :, :3]

    def press(self, key):
        self._page.keyboard.press(key)

    def download(self, selector, path):
        """Clicks what downloads a file, and saves it.

        :returns: the name that the page suggests
        """
        with self._page.expect_download() as download:
            self._page.click(selector)
        download.value.save_as(path)
        return download.value.suggested_filename

    def messages(self):
        """:returns: what the page has told since it was opened: console, errors, dialogs, requests to a network"""
        return list(self._messages)

    def close(self):
        """Ends browser and driver; one that has ended already is no error."""
        for ends in (getattr(self._browser, "close", None), getattr(self._driver, "stop", None)):
            try:
                if ends:
                    ends()
            except Exception as error:  # whatever a dead process makes of it: the next page starts a new one
                print(f"the browser had ended: {error}")
        self._driver = self._browser = self._page = None
