# SPDX-License-Identifier: Apache-2.0
"""pytest plugin: every stage of a folder is a test that compares its render with a golden one.

  pytest --patina-scenes FOLDER                     the tests
  pytest --patina-scenes FOLDER --patina-update     makes the golden images, or makes them anew
  pytest --patina-scenes FOLDER -k kitchen          one of them
  pytest --patina-scenes FOLDER --renderer Storm    another Hydra delegate's pictures against the same golden images
  pytest --patina-scenes FOLDER --patina-report report.html    a page about the run, with the pictures

An installed Patina registers the plugin by itself; from a checkout it is `./patina python -m pytest -p
patina.regression.plugin --patina-scenes FOLDER`. The tests need SciPy.
"""
import importlib.util
import os
import shlex
import warnings

import pytest

from patina.cli.compiled import _patina
from patina.regression.scenes import Folder, SceneError

REPORTED = "patina stage"  # of a test's user properties, which pytest-xdist brings from its processes
DIFFERENCE = "red: brighter now, blue: darker, full colour from 50 % on"
HOW = "{pytest} --patina-scenes {folder} -k {name} --patina-update"
PYTEST = "pytest"  # where Patina is installed
FROM_CHECKOUT = "{command} python -m pytest -p patina.regression.plugin"


def pytest_addoption(parser):
    group = parser.getgroup("patina", "stages rendered by Patina")
    group.addoption("--patina-scenes", metavar="FOLDER", help="test every stage of this folder against its golden image")
    group.addoption("--patina-update", action="store_true", help="make the golden images anew; every stage passes that renders")
    group.addoption("--renderer", metavar="NAME", help="render by this Hydra delegate, as usdrecord calls it, or by the name "
                    "of its plugin (HdStormRendererPlugin). With --patina-update the golden images are its own")
    group.addoption("--usdrecord", metavar="COMMAND", default="usdrecord", help="the usdrecord that renders then, with its "
                    "arguments (default: usdrecord)")
    group.addoption("--patina-report", metavar="FILE", help="write a page (HTML) about the run, with golden and new pictures")
    group.addoption("--patina-out", metavar="FOLDER", help="where images of failed tests go (default: `failed` in the folder)")


def pytest_configure(config):
    folder = config.getoption("--patina-scenes")
    if not folder:
        return
    if not importlib.util.find_spec("scipy"):  # before anything is rendered, not at the first difference
        raise pytest.UsageError("--patina-scenes needs SciPy: pip install scipy")
    from patina.regression import golden, usdrecord

    name = config.getoption("--renderer")
    try:
        config.patina_folder = Folder(folder)
        config.patina_draw = usdrecord.UsdRecord(name, config.getoption("--usdrecord")) if name else golden.render
    except (SceneError, golden.RenderError) as error:
        raise pytest.UsageError(str(error)) from None
    report = config.getoption("--patina-report")
    if report and not hasattr(config, "workerinput"):
        _check_report(report)
        config.pluginmanager.register(_Report(report, name))
    named = getattr(config, "args_source", None) == pytest.Config.ArgsSource.ARGS
    args = config.args if named or hasattr(config, "workerinput") else []
    if config.patina_folder.path not in args:
        config.args = [*args, config.patina_folder.path]


def pytest_collect_directory(path, parent):
    folder = getattr(parent.config, "patina_folder", None)
    if folder and os.path.abspath(path) == folder.path:
        return _Scenes.from_parent(parent, path=path)
    return None


def _check_report(path):
    """Before anything is rendered. :raises pytest.UsageError: where it could not be written"""
    from patina.cli import outputs
    from patina.cli.errors import CommandError

    try:
        outputs.check_all([path])
    except CommandError as error:
        raise pytest.UsageError(f"--patina-report: {error}") from None


class _Report:
    """Gathers what tests tell of their stages."""

    def __init__(self, path, renderer):
        self.path, self.renderer, self.stages = path, renderer, []

    def pytest_runtest_logreport(self, report):
        if report.when == "call":
            self.stages += [dict(value, seconds=report.duration) for name, value in report.user_properties if name == REPORTED]

    def pytest_sessionfinish(self):
        from patina.regression import reportPage

        reportPage.write(self.path, self.stages, [("renderer", self.renderer)] if self.renderer else [])

    def pytest_terminal_summary(self, terminalreporter):
        terminalreporter.write_line(f"patina: {self.path} has {len(self.stages)} stages with their pictures")


class SceneFailure(Exception):
    def __init__(self, text, outcome="broken"):
        super().__init__(text)
        self.outcome = outcome


class SceneWarning(UserWarning):
    """Golden images by which a test will see too little."""


class _Scenes(pytest.Directory):
    """The folder."""

    def collect(self):
        for name in self.config.patina_folder.names():
            yield _Stage.from_parent(self, name=name)


class _Stage(pytest.Item):
    """One stage."""

    def runtest(self):
        from patina.regression import golden

        told = {"name": self.name, "outcome": "broken", "text": "", "pictures": []}
        self.user_properties.append((REPORTED, told))
        try:
            self._run(golden, told)
        except golden.RenderError as error:
            told["text"] = str(error)
            raise SceneFailure(str(error)) from None
        except SceneFailure as failure:
            told.update(outcome=failure.outcome, text=str(failure))
            raise

    def _run(self, golden, told):
        folder = self.config.patina_folder
        stage, scene = os.path.join(folder.path, *self.name.split("/")), folder.scene(self.name)
        kept = folder.golden(self.name, ".npz")
        if self.config.getoption("--patina-update"):
            made, image, problem = golden.Golden.made(stage, scene, self.config.patina_draw)
            made.write(kept)
            _write(folder.golden(self.name, ".exr"), image)
            told.update(outcome="made", text=problem)
            self._show(told, folder, None)
            if problem:
                warnings.warn(SceneWarning(f"{self.name}: {problem}"))
            return
        if not os.path.exists(kept):
            raise SceneFailure(f"there is no golden image; make it, and look at it: {self._how()}", "missing")
        result = golden.compare(stage, scene, golden.Golden.read(kept), self.config.patina_draw)
        self._show(told, folder, result.image)
        if result.problem:
            raise SceneFailure("\n".join([result.problem, *self._pictures(folder, result.image),
                                          f"if the new one is right: {self._how()}"]), result.outcome)
        told["outcome"] = result.outcome
        if result.image is not None:
            told["text"] = f"a tile that differs by {100 * result.sees:.2g} % would show in most places"

    def _images(self, folder, image):
        """:returns: dict of linear pictures: the golden one, the new one and their difference, as far as they are there"""
        from patina.chart.scenePage import signed
        from patina.regression import golden

        kept = folder.golden(self.name, ".exr")
        found = {"golden": golden.color_of(kept)} if os.path.exists(kept) else {}
        if image is not None:
            found["new"] = image
        if len(found) == 2 and found["golden"].shape == image.shape:
            found[DIFFERENCE] = signed(image, found["golden"])
        return found

    def _show(self, told, folder, image):
        """Puts the pictures of a stage into what is told of it, where there is a page."""
        if self.config.getoption("--patina-report"):
            from patina.regression import reportPage

            told["pictures"] += [reportPage.picture(name, linear) for name, linear in self._images(folder, image).items()]

    def _how(self):
        command = os.environ.get("PATINA_COMMAND")  # of the launcher
        pytest_command = FROM_CHECKOUT.format(command=shlex.quote(command)) if command else PYTEST
        return HOW.format(pytest=pytest_command, folder=shlex.quote(self.config.getoption("--patina-scenes")),
                          name=shlex.quote(self.name))

    def _pictures(self, folder, image):
        """Writes the new image, and where the golden one has its size, the difference.

        :returns: lines that say where they are"""
        if image is None:
            return []
        out = os.path.abspath(self.config.getoption("--patina-out") or os.path.join(folder.path, "failed"))
        path = os.path.join(out, *(self.name + ".exr").split("/"))
        _write(path, image)
        lines, images = [f"new: {path}"], self._images(folder, image)
        if "golden" in images:
            lines.append(f"golden: {folder.golden(self.name, '.exr')}")
        if DIFFERENCE in images:
            picture = path[:-len(".exr")] + ".difference.png"
            _write(picture, images[DIFFERENCE])
            lines.append(f"difference: {picture} ({DIFFERENCE})")
        return lines

    def repr_failure(self, excinfo, style=None):
        if isinstance(excinfo.value, SceneFailure):
            return f"{self.name}: {excinfo.value}"
        return super().repr_failure(excinfo)

    def reportinfo(self):
        return self.path, None, self.name


def _write(path, image):

    os.makedirs(os.path.dirname(path), exist_ok=True)
    _patina.write_image(path, image.astype("float32"))
