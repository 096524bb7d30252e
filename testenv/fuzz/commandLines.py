# SPDX-License-Identifier: Apache-2.0
"""Random command lines: every flag of the commands that read what users give, with values that fit and that do not."""
import argparse
import os
import random as randoms

import outcomes

EXTENSION = ".json"
LINES = True  # one argument a line
COMMANDS = ("record", "explain", "bsdf", "check", "compare", "merge")
VALUES = ("0", "1", "-1", "2", "0.5", "1e9", "1e400", "nan", "inf", "-inf", "", " ", "x", "1:3", "1:1000000000", "3:1", "1x2",
          "1/2", "2/1",
          "0/0", "1,2,3", "0,0,1", "/", "/ball", "/nothing", "//", "stage.usda", "image.exr", "small.png", "damaged.exr",
          "damaged.mtlx",
          "missing.usda", "folder", "pipe", "/dev/null", "/dev/full", "a.####.png", "####", "all", "color,depth", "embree",
          "raster", "none",
          "list", "ball.radius=2", "/ball.radius=nan", "a=b=c", "%s%n", "ÿ𝛑", "x" * 4000, "out/../image.exr", "--", "-")
FILES = ("stage.usda", "image.exr", "small.png", "damaged.mtlx", "damaged.exr", "out.png", "out.exr", "folder", "pipe",
         "missing.usda", "")
# Options that may take long, or go on for as long as they are asked to, without fault.
LAST = {"record": ["-w", "16", "--samples", "2", "--threads", "2", "--seconds", "1"]}


def _flags(command):
    """:returns: list of (flag, whether it takes a value, its choices)"""
    import importlib

    module = importlib.import_module("patina.cli." + command)
    parser = argparse.ArgumentParser(prog=command, add_help=False)
    module.add_arguments(parser)
    return [(flag, a.nargs != 0, tuple(map(str, a.choices or ()))) for a in parser._actions for flag in a.option_strings]


def make(seed):
    """:returns: the bytes of an input: a list of words as JSON, one on a line"""
    command, words = line(randoms.Random(seed))
    words = [command, *words, *LAST.get(command, ())]
    return outcomes.in_lines(words)


def line(r):
    """:returns: a command, and the words after it"""
    command = r.choice(COMMANDS)
    words = [r.choice(FILES) for _ in range(r.choice((0, 1, 2, 2, 2, 3)))]
    if command == "record" and r.random() < 0.7:
        words = ["stage.usda", r.choice(("image.exr", "out.png", "out.exr"))]
    flags = _flags(command)
    for _ in range(r.choice((0, 1, 2, 3, 5))):
        flag, valued, choices = r.choice(flags)
        words.insert(r.randint(0, len(words)), flag)
        if valued and r.random() < 0.95:
            words.insert(words.index(flag) + 1, r.choice(choices) if choices and r.random() < 0.5 else r.choice(VALUES))
    return command, words


def execute(path, folder):
    """Runs a command line, in a process that may die. :returns: its exit status; an old image stays, or is a whole one"""
    words = [str(word) for word in outcomes.from_lines(path)]
    if not words or words[0] not in COMMANDS:
        return 0
    image = os.path.join(folder, "image.exr")
    import numpy as np

    import _patina

    _patina.write_image(image, np.full((4, 4, 3), 0.5, np.float32))
    try:
        status = outcomes.command(words, folder)
    except SystemExit as end:  # --help
        status = end.code or 0
    try:
        _patina.read_image(image)
    except (OSError, RuntimeError) as error:
        return outcomes.broken(f"the image that was there is lost: {error}")
    # Memory that a flag asks for may be missing, and is told.
    return 1 if status == 75 else status
