"""A headless Chromium that shows pages."""
import json
import os
import shutil
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))


def chromium():
    """:returns: path of a Chromium, or None"""
    return next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


class Browser:
    def __init__(self, node_modules):
        self._process = subprocess.Popen(["node", os.path.join(HERE, "drive.mjs"), node_modules, chromium()],
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
        """Runs statements in the page; `return` gives JSON."""
        return self.call("evaluate", code=code)

    def close(self):
        self._process.stdin.close()
        self._process.wait(timeout=30)
