# SPDX-License-Identifier: Apache-2.0
"""What benchmarks share: a command line, processes that tell their figures, and renderers that wait for images to draw."""
import argparse
import contextlib
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(HERE, "..", folder) for folder in ("", "hydra", "view")]  # benchmarks use what tests there do

import pathWorker  # noqa: E402
from patina.cli import outputs  # noqa: E402


class Parser(argparse.ArgumentParser):
    """Of `patina bench NAME`. :param counts: flags of whole numbers: default, and what it is a number of"""

    def __init__(self, name, description, size=None, **counts):
        super().__init__(prog=f"patina bench {name}", description=description,
                         formatter_class=argparse.RawDescriptionHelpFormatter)
        self.add_argument("--json", metavar="FILE", help="also write the figures as JSON")
        if size:
            self.add_argument("--size", default=size, help=f"of the images (default: {size})")
        for flag, (default, what) in counts.items():
            self.add_argument("--" + flag, type=int, default=default, help=f"{what} (default: {default or 'all'})")

    def parse(self, arguments):
        """:returns: the options, with `size` as typed and as whole numbers in `pixels`"""
        options = self.parse_args(arguments)
        outputs.check_all([options.json])
        if "size" in options:
            options.pixels = tuple(map(int, options.size.split("x")))
        return options

    def known(self, asked, known, fits, needs):
        """:param fits: whether the other options do, and what they need
        :returns: the names that are asked for, all where none is"""
        unknown = [name for name in asked if name not in known]
        if unknown or not fits:
            self.error(f"there is no {unknown[0]}" if unknown else needs)
        return asked or known


def reason(process):
    """:returns: the last that a finished process said"""
    return (process.stderr.strip().splitlines() or ["no message"])[-1]


def told(process, who):
    """:returns: the report of a host; None where it does not run here, which is said"""
    if process.returncode != 0:
        print(f"{who} does not run here: {reason(process)}", file=sys.stderr)
        return None
    return json.loads(process.stdout[process.stdout.index("{"):])


def figures(who, command, **options):
    """:returns: what the last line of a worker tells
    :raises SystemExit: with its reason"""
    process = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, check=False, **options)
    if process.returncode != 0:
        raise SystemExit(f"{who}: {reason(process)}")
    return json.loads(process.stdout.strip().splitlines()[-1])


class Worker:
    """A renderer's process, ready for images of one scene."""

    def __init__(self, command, log):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log, text=True)
        first = self._answer()
        self.ready, self.version = first["ready"], first["version"]

    def _answer(self):
        last = "no message"
        for line in self.process.stdout:
            last = line.strip() or last
            _, said, after = line.partition(pathWorker.SAID)  # after what the renderer's own log left in the line
            if said:
                return json.loads(after)
        raise RuntimeError(f"{os.path.basename(self.process.args[0])} ended with status {self.process.wait()}: {last}")

    def draw(self, samples, seed, file=os.devnull, plain=False):
        """:param plain: without what the scene asks for that blurs: denoiser, methods and blur
        :returns: {seconds, processor}: wall and processor seconds of the image"""
        self.process.stdin.write(json.dumps({"samples": samples, "seed": seed, "file": file, "plain": plain}) + "\n")
        self.process.stdin.flush()
        return self._answer()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Workers(dict):
    """Workers by name, each with a scene in a folder of its own. All end with the block. Where one fails in it, the benchmark
    ends with the last lines that were logged.

    :param name: of what is measured, for messages"""

    def __init__(self, name):
        super().__init__()
        self.name, self._held = name, contextlib.ExitStack()

    def __enter__(self):
        self.folder = self._held.enter_context(tempfile.TemporaryDirectory(prefix="patinaBench"))
        self._log = self._held.enter_context(open(os.path.join(self.folder, "log"), "w+", encoding="utf-8"))
        return self

    def start(self, key, command, scene, settings):
        """:param key: the renderer's name, or a tuple that begins with it
        :param command: as of pathBench.peers()
        :param settings: as of pathWorker.save()
        :returns: whether it runs here. Others than Patina are left out where they do not, which is said"""
        own = tempfile.mkdtemp(dir=self.folder)
        pathWorker.save(scene, own, settings)
        filled = [own if word is None else word for word in command]
        try:
            self[key] = Worker(filled if None in command else [*filled, own], self._log)
        except RuntimeError as error:
            who = key if isinstance(key, str) else key[0]
            if who == "Patina":
                raise
            print(f"{self.name}: {who} is left out: {error}")
        return key in self

    def image(self, key, samples, seed, plain=False):
        """:returns: what Worker.draw() does, and the pixels (height, width, 3)"""
        file = os.path.join(self.folder, "image.npy")
        return self[key].draw(samples, seed, file, plain), np.load(file)

    def title(self, key):
        """:returns: a renderer with its version"""
        return f"{key} {self[key].version}".strip()

    def __exit__(self, kind, error, trace):
        for worker in self.values():
            worker.close()
        with self._held:
            if isinstance(error, RuntimeError):
                self._log.seek(0)
                raise SystemExit(f"{self.name}: {error}\n" + "".join(self._log.readlines()[-8:])) from error
