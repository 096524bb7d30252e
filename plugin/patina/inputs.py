# SPDX-License-Identifier: Apache-2.0
"""The files that a command has read: so that it reads nothing but regular files of a bounded size, and
writes over none of them."""
import os
import re
import stat

from patina import limits
from patina.cli.compiled import _patina

_TILES = {"<UDIM>": r"\d{4}", "<UVTILE>": r"u\d+_v\d+"}
_noted = set()


class InputError(OSError):
    """A one-line reason why a file is not read."""


def forget():
    """Begins anew: another command of the same process reads other files."""
    _noted.clear()


def note(path):
    """:param path: of a file that is read; <UDIM> and <UVTILE> stand for any tile, a file in a package for the package"""
    if path:
        _noted.add(os.path.abspath(file_of(path)))


def file_of(path):
    """:returns: the path itself, or of a file in a package that of the package"""
    end = path.lower().find(".usdz[")
    return path if end < 0 else path[:end + len(".usdz")]


def note_document(path):
    """The same for a MaterialX document, with what it includes."""
    for file in _patina.mtlx_files(os.fsencode(os.path.abspath(path))):
        note(os.fsdecode(file))


def note_network(network):
    """Notes what a material's nodes read: a MaterialX document names its textures itself, without a stage."""
    for node in network.nodes():
        for value in node["inputs"].values():
            if value["type"] == "filename" and isinstance(value["value"], str):
                note(value["value"])


def files():
    """:returns: sorted list of the noted files; of <UDIM> and <UVTILE> those tiles that are there"""
    found = set()
    for file in _noted:
        folder, name = os.path.split(file)
        tile = _tile_of(name)
        if not tile:
            found.add(file)
            continue
        try:
            found.update(os.path.join(folder, other) for other in os.listdir(folder) if re.fullmatch(tile, other))
        except OSError:
            found.add(file)
    return sorted(found)


def _tile_of(name):
    """:returns: regular expression of the tiles that a file name stands for; empty for a plain name"""
    tile = re.escape(name)
    for token, pattern in _TILES.items():
        tile = tile.replace(re.escape(token), pattern)
    return "" if tile == re.escape(name) else tile


def read_by(path):
    """:returns: the noted file that a path leads to, or None"""
    try:
        wanted = os.stat(path)
    except (OSError, ValueError):
        return None
    for file in sorted(_noted):
        folder, name = os.path.split(file)
        tile = _tile_of(name)
        if tile:
            if (os.path.realpath(folder) == os.path.dirname(os.path.realpath(path))
                    and re.fullmatch(tile, os.path.basename(os.path.realpath(path)))):
                return file
            continue
        try:
            if os.path.samestat(os.stat(file), wanted):
                return file
        except (OSError, ValueError):
            continue
    return None


def check_regular(path):
    """:raises InputError: where it is there and no regular file: a device has no end, a pipe waits"""
    try:
        mode = os.stat(path).st_mode
    except OSError:
        return  # whoever opens it says so
    if not stat.S_ISREG(mode):
        raise InputError(f"{path} is a folder" if stat.S_ISDIR(mode) else f"{path} is no regular file")


def read(path, maximum=None):
    """:param maximum: of bytes; None: the limit documentBytes
    :returns: the bytes of a regular file
    :raises InputError: where it is none, or larger than `maximum`"""
    check_regular(path)
    named = f"{maximum}" if maximum else f"{limits.value('documentBytes')} (--limit documentBytes)"
    maximum = maximum or limits.value("documentBytes")
    file = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    with open(file, "rb") as stream:
        if not stat.S_ISREG(os.fstat(file).st_mode):
            raise InputError(f"{path} is no regular file")
        data = stream.read(maximum + 1)
    if len(data) > maximum:
        raise InputError(f"{path} holds more bytes than the {named} that are read")
    return data
