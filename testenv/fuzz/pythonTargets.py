# SPDX-License-Identifier: Apache-2.0
"""Fuzzers of the Python parts that follow the coverage of their lines, by atheris: bytes stand for the random numbers of a
generator, so that every input is a legal stage, or a command line.

Usage: pythonTargets.py NAME [libFuzzer's arguments]    NAME is one of TARGETS
       pythonTargets.py NAME --run FILE...    runs inputs without atheris
       pythonTargets.py NAME --lines SOURCES FOLDER    runs a folder's inputs and prints how many lines of functions they reach,
                                                       and how many there are; sources: beginnings of paths below
                                                       plugin/patina, with commas"""
import atexit
import contextlib
import glob
import io
import itertools
import json
import os
import random as randoms
import shutil
import sys
import tempfile
import types

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))


class Bytes(randoms.Random):
    """Random numbers that bytes give; always the same ones, once there are none left. All of Random's choices are made of these
    two."""

    def __init__(self, data):
        super().__init__(0)
        self.data, self.at = data, 0

    def random(self):
        return self.getrandbits(16) / 65536.0

    def getrandbits(self, bits):
        size = (bits + 7) // 8
        part = self.data[self.at:self.at + size]
        self.at += size
        if len(part) < size:
            return super().getrandbits(bits)
        return int.from_bytes(part, "little") & ((1 << bits) - 1)


def stage_reader():
    """:returns: a function of bytes that reads the stage they mean; what a reader has not foreseen is raised"""
    from pxr import Sdf, Usd

    import _patina
    import outcomes
    import randomStages
    from patina import stage as reader
    from patina.stage import context

    leave = context.Guard.__exit__

    def strict(self, kind, error, trace):
        return leave(self, kind, error, trace) if kind is None or kind.__name__ in outcomes._FORESEEN else False
    context.Guard.__exit__ = strict
    randomStages._schemas()

    def one(data):
        text = randomStages.stage(randomStages._Writer(0, Bytes(data))).decode()
        layer = Sdf.Layer.CreateAnonymous("fuzzed.usda")
        if not layer.ImportFromString(text):
            return
        scene = _patina.Scene()
        with scene.edit() as edit, contextlib.suppress(reader.StageError):
            reader.read_stage(Usd.Stage.Open(layer), edit, reader.StageOptions(frame=0.0, camera="/camera"))
    return one


def command_parser():
    """:returns: a function of bytes that parses the command line they mean; it is taken, or refused in one line"""
    import importlib

    import commandLines
    from patina.cli import main

    for name in commandLines.COMMANDS:
        importlib.import_module("patina.cli." + name).run = lambda arguments: 0

    def one(data):
        command, words = commandLines.line(Bytes(data))
        said = io.StringIO()
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
            try:
                status = main.main([command, *words])
            except SystemExit as end:
                status = end.code or 0
        if status not in (0, 2) or (status == 2 and said.getvalue().count("\n") != 1):
            raise AssertionError(f"{command} {words}: {status}: {said.getvalue()}")
    return one


def package():
    """:returns: a function of bytes that resolves files of the package that they are, as textures of a stage: by OpenUSD's
    reader, and by the one that stands for it. They become copies in one folder, none of them larger than the package"""
    from pxr import Ar, Sdf, Tf, Usd

    from patina import inputs
    from patina.stage import assets, compat

    folder = tempfile.mkdtemp(prefix="patinaFuzz")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    names = [".", "..", "a/..", "../a.usda", "../../../../etc/passwd", "/etc/passwd", "x" * 300, "a.usda/b", "a[b]", "a.usda"]
    older = types.SimpleNamespace(**{name: getattr(Ar, name) for name in dir(Ar) if name != "GetResolver"}, GetResolver=object)
    opener = getattr(Sdf, "ZipFile", None) or Usd.ZipFile  # by its version
    stage = Usd.Stage.CreateInMemory()
    attribute = stage.DefinePrim("/texture").CreateAttribute("file", Sdf.ValueTypeNames.Asset)
    context = types.SimpleNamespace(time=Usd.TimeCode.Default(), stage=stage)
    numbers = itertools.count()

    def one(data):
        path = os.path.join(folder, f"{next(numbers)}.usdz")  # OpenUSD keeps packages open, by their names
        with open(path, "wb") as file:
            file.write(data)
        inside = []
        with contextlib.suppress(UnicodeDecodeError, Tf.ErrorException):  # names that Python cannot tell, and damage
            opened = opener.Open(path)
            inside = opened.GetFileNames()[:8] if opened else []
        for compat.Ar in (Ar, older):
            for name in [names[len(data) % len(names)], *inside]:
                try:
                    attribute.Set(Sdf.AssetPath(Ar.JoinPackageRelativePath([path, name.replace("1001", "<UDIM>")])))
                    copy = assets.resolve(context, attribute).replace("<UDIM>", "1001")
                except Tf.ErrorException:  # of OpenUSD, which becomes a warning of the prim
                    continue
                if "\0" not in copy and copy != path and os.path.exists(copy) and not (
                        os.path.realpath(copy).startswith(str(assets._folder) + os.sep) and os.path.isfile(copy)
                        and os.path.getsize(copy) <= len(data)):
                    raise AssertionError(f"{name!r} becomes {copy}")
            assets._extracted.clear()
        inputs.forget()
        os.remove(path)
        for copies in os.scandir(assets._folder) if assets._folder else ():
            shutil.rmtree(copies.path)
    return one


TARGETS = {"stageReader": stage_reader, "commandParser": command_parser, "package": package}


def _lines_of(path):
    """:returns: set of the numbers of lines that functions of a file have"""
    found = set()

    def look(code, inside):
        for constant in code.co_consts:
            if hasattr(constant, "co_lines"):
                look(constant, inside or not constant.co_name.startswith("<") and bool(constant.co_flags & NEWLOCALS))
        if inside:
            found.update(line for _, _, line in code.co_lines() if line and line != code.co_firstlineno)
    with open(path, encoding="utf-8") as file:
        look(compile(file.read(), path, "exec"), False)
    return found


NEWLOCALS = 2  # flag of the code of functions, which that of modules and classes has not


def lines(one, sources, files):
    """:param one: function of bytes
    :param sources: beginnings of paths below plugin/patina
    :returns: (lines of functions that inputs reach, lines that there are)"""
    import patina

    root = os.path.dirname(os.path.abspath(patina.__file__))
    every = {path: _lines_of(path) for path in glob.glob(os.path.join(root, "**", "*.py"), recursive=True)
             if os.path.relpath(path, root).startswith(sources) and f"{os.sep}tests{os.sep}" not in path}
    reached = {path: set() for path in every}

    def trace(frame, event, _):
        seen = reached.get(frame.f_code.co_filename)
        if seen is None:
            return None
        if event == "line":
            seen.add(frame.f_lineno)
        return trace
    for path in files:
        with open(path, "rb") as file:
            data = file.read()
        sys.settrace(trace)
        try:
            with contextlib.suppress(Exception):  # a finding, which is told where it is looked for
                one(data)
        finally:
            sys.settrace(None)
    return sum(len(reached[path] & every[path]) for path in every), sum(map(len, every.values()))


def main():
    name = sys.argv.pop(1)
    if sys.argv[1:2] == ["--run"]:
        one = TARGETS[name]()
        for path in sys.argv[2:]:
            with open(path, "rb") as file:
                one(file.read())
        return
    if sys.argv[1:2] == ["--lines"]:
        files = sorted(glob.glob(os.path.join(glob.escape(sys.argv[3]), "*")))
        print(json.dumps(lines(TARGETS[name](), tuple(sys.argv[2].split(",")), files)))
        return
    import atheris

    with atheris.instrument_imports(include=["patina"], enable_loader_override=False):
        one = TARGETS[name]()
    atheris.Setup(sys.argv, one)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
