"""A headless Chromium that shows pages of `patina view`."""
import functools
import json
import os
import shutil
import subprocess

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))


def chromium():
    """:returns: path of a Chromium, or None"""
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


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

    if not chromium():
        return "there is no Chromium (Debian: apt install chromium)"
    try:
        bundle.packages()
    except CommandError as error:
        return str(error)
    return ""


class Browser:
    def __init__(self):
        from patina.view import bundle

        modules = os.path.join(bundle.packages(), "node_modules")
        self._process = subprocess.Popen(["node", os.path.join(HERE, "drive.mjs"), modules, chromium()],
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def call(self, name, **arguments):
        self._process.stdin.write(json.dumps({"do": name, **arguments}) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError("the browser's driver ended")
        answer = json.loads(line)
        if "error" in answer:
            raise RuntimeError(f"{name}: {answer['error']}")
        return answer["value"]

    def open(self, path, query="", **arguments):
        self.call("open", url=f"file://{os.path.abspath(path)}{query}", **arguments)

    def evaluate(self, code):
        """Runs statements in the page, where `page` is the page and `viewer` its viewer; `return` gives JSON."""
        return self.call("evaluate", code="const page = await window.patina.ready, viewer = page?.viewer;" + code)

    def picture(self, change=""):
        """What the page computes after a change: linear colours, top row first."""
        flat = self.evaluate(change + "; viewer.invalidate(); viewer.settle();"
                             "return [viewer.width, viewer.height, Array.from(viewer.accumulator.read())];")
        return np.array(flat[2], np.float32).reshape(flat[1], flat[0], 4)[::-1, :, :3]

    def messages(self):
        return self.call("messages")

    def close(self):
        self._process.stdin.close()
        self._process.wait(timeout=30)
