# SPDX-License-Identifier: Apache-2.0
"""Fuzzers of the Python parts that follow the coverage of their lines, by atheris: bytes stand for the random numbers of a
generator, so that every input is a legal stage, or a command line.

Usage: pythonTargets.py stageReader|commandParser [libFuzzer's arguments]
       pythonTargets.py stageReader|commandParser --run FILE...    runs inputs without atheris"""
import contextlib
import io
import os
import random as randoms
import sys

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


TARGETS = {"stageReader": stage_reader, "commandParser": command_parser}


def main():
    name = sys.argv.pop(1)
    if sys.argv[1:2] == ["--run"]:
        one = TARGETS[name]()
        for path in sys.argv[2:]:
            with open(path, "rb") as file:
                one(file.read())
        return
    import atheris

    with atheris.instrument_imports(include=["patina"], enable_loader_override=False):
        one = TARGETS[name]()
    atheris.Setup(sys.argv, one)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
