# SPDX-License-Identifier: Apache-2.0
"""The files of parts: a description of what made them, films, and a report of the render."""
import json
import math
import os

from patina.cli.errors import CommandError
from patina.farm import cut

COUNTED = ("rays", "shadowRays", "paths", "droppedSamples")  # statistics of which parts have shares
MOST_DECIMALS = 100  # of a frame's number
# What a file leads to that others made: its checksum may be right, and its values those of nobody's render.
FOREIGN = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)


def foreign(file):
    """:returns: the error that ends a command which has read such a file"""
    return CommandError(f"{file} is of another version of Patina")


class Description:
    """The header of a part's file."""

    def __init__(self, file, values):
        self.file = file
        try:
            self.identity = values["identity"]
            self.part = cut.part(values["part"])
            self.range = tuple(values["range"])
            self.arguments, self.options = values["arguments"], values["options"]
            self.frame, self.camera, self.settings = values["frame"], values["camera"], values["settings"]
            self.noise = float(values["noiseTolerance"])
            self.folder, self.home = values["folder"], values["home"]
            self.denoise, self.decimals = values["denoise"], values["decimals"]
            for table in (self.identity, self.identity["files"], self.arguments, self.options, self.settings):
                table.items()
            for name in (self.folder, self.home, self.arguments["stage"], *self.identity["files"]):
                os.fsencode(name)
                if "\0" in name:
                    raise ValueError
            for value, kind in ((self.camera, str), (self.denoise, bool), (self.decimals, int)):
                if type(value) is not kind:
                    raise TypeError
            if not (self.frame is None or math.isfinite(self.frame)) or not 0 <= self.decimals <= MOST_DECIMALS:
                raise ValueError
        except FOREIGN:
            raise foreign(file) from None


def describe(part, samples, identity, arguments, options, frame, camera, settings, noise, **more):
    """:param samples: (begin, end) of the part
    :param arguments: as they were typed
    :param options: of the image's file
    :param more: folder of the stage, home: folder in which the names of `arguments` are meant, denoise: whether the merged film
        is denoised, decimals: of the frames
    :returns: the text that PartialWriter takes"""
    return json.dumps({"identity": identity, "part": str(part), "range": list(samples), "frame": frame, "camera": camera,
                       "settings": settings, "noiseTolerance": noise, "arguments": plain(arguments), "options": options,
                       **more}, default=str)


def add_up(sums, statistics):
    """Adds what is counted of one render to that of others.

    :param sums: dict that is changed"""
    for name in COUNTED:
        if name in statistics:
            sums[name] = sums.get(name, 0) + statistics[name]


def read(module, file):
    """:raises CommandError: where the file holds no part"""
    try:
        values = json.loads(module.partial_description(file))
    except (RecursionError, ValueError):
        raise foreign(file) from None
    except RuntimeError as error:
        raise CommandError(str(error)) from error
    return Description(file, values)


def plain(arguments):
    """:returns: dict of those parsed arguments that JSON can hold; the part itself is told elsewhere"""
    found = {name: value for name, value in vars(arguments).items() if name not in ("part", "partial", "argv")}
    return dict(found, given=sorted(found.get("given", ())))
