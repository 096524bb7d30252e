# SPDX-License-Identifier: Apache-2.0
"""Reads small stages written as text and gives the scene that came of them."""
import itertools
import os
import re
import subprocess
import sys

import numpy as np
import pytest
from pxr import Usd

import _patina
from patina import limits
from patina.stage import StageOptions, read_stage

# Ends as a command does: OpenUSD's own threads may outlive what they need.
_APART = """import sys, _patina
from pxr import Usd
from patina.cli import ending
from patina.stage import StageOptions, read_stage
scene = _patina.Scene()
with scene.edit() as edit:
    read_stage(Usd.Stage.Open(sys.argv[1]), edit, StageOptions(frame=float(sys.argv[2])))
print(scene.dump(64), scene.warnings())
ending.end(0)"""


class Reading:
    """A scene after one read."""

    def __init__(self, stage, **options):
        self.scene = _patina.Scene()
        with self.scene.edit() as edit:
            self.info = read_stage(stage, edit, StageOptions(**options))
        self.text = self.scene.dump(64)
        self.warnings = [f"{w['prim']} {w['input']}: {w['message']}" for w in self.scene.warnings()]

    def prim(self, path):
        """:returns: dict of the dump's lines of a prim; `kind` says what it is"""
        found, current = {}, None
        for line in self.text.splitlines():
            if not line.startswith(" "):
                kind, _, name = line.partition(" ")
                current = found.setdefault(name, {"kind": kind})
            else:
                key, _, value = line.strip().partition(" = ")
                current[key] = value
        assert path in found, f"{path} is not among {list(found)}; warnings: {self.warnings}"
        return found[path]

    def has(self, path):
        return f" {path}\n" in self.text


def _statements(text):
    return re.sub(r"(?<=\S)  (?=\S)| (?=\})", "\n", text)


def floats(text):
    """:returns: the numbers of a dump's line"""
    return [float(x) for x in text.replace(",", " ").split()]


@pytest.fixture
def read(tmp_path):
    """A function: read(text of a usda layer, **options) -> Reading without the headlight. In the text
    two spaces, or one and a brace, end a statement as a line's end does."""
    def run(text, **options):
        """:param text: of the layer, or the path of a file"""
        options.setdefault("headlight", False)
        if not isinstance(text, str):
            return Reading(Usd.Stage.Open(str(text)), **options)
        file = tmp_path / "stage.usda"
        file.write_text("#usda 1.0\n" + _statements(text))
        return Reading(Usd.Stage.Open(str(file)), **options)

    return run


@pytest.fixture
def pictures():
    """A function: pictures(reading, width) yields (back end, colours of its square picture) of both."""
    import _patina

    from patina.experiment import draw

    def run(reading, width):
        for backend in ("embree", "raster"):
            film, settings = _patina.Film(), {"width": width, "height": width, "samples": 4, "seed": 1}
            draw(_patina.make_renderer(backend), reading.scene, reading.info.camera, settings, film)
            yield backend, np.array(film.resolve("color"))[..., :3]

    return run


@pytest.fixture
def read_apart(tmp_path):
    """A function: read_apart(text of a usda layer, frame=, **environment) -> what a process of its own prints: dump and
    warnings. It fails where the process does."""
    def run(text, frame=0.0, **environment):
        (tmp_path / "stage.usda").write_text("#usda 1.0\n" + _statements(text))
        done = subprocess.run([sys.executable, "-c", _APART, str(tmp_path / "stage.usda"), str(frame)], capture_output=True,
                              text=True, check=False, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path),
                                                           **environment})
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    return run


@pytest.fixture
def limit(monkeypatch):
    """A function: limit(name=value) sets limits of the process for one test."""
    held = {**_patina.limits()}

    def run(**values):
        monkeypatch.setattr(limits, "value", {**held, **values}.__getitem__)

    return run


@pytest.fixture
def steps(read):
    """A function: steps(text, **options) -> how many instructions of Python are done while a stage of that text is read: its
    cost, the same on every machine."""
    def run(text, **options):
        count, before = itertools.count(), sys.gettrace()

        def trace(frame, event, _):
            frame.f_trace_opcodes = True
            if event == "opcode":
                next(count)
            return trace

        sys.settrace(trace)
        try:
            read(text, **options)
        finally:
            sys.settrace(before)
        return next(count)

    return run


@pytest.fixture
def numbers():
    return floats


@pytest.fixture
def statements():
    return _statements
