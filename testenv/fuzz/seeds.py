# SPDX-License-Identifier: Apache-2.0
"""The seeds of corpora: one sound input of each kind, so that fuzzers start behind the first checks."""
import os
import shutil
import struct

import damaged
import keptFindings

IES = """IESNA:LM-63-2002
[TEST] none
TILT=NONE
1 1000 1 3 2 1 1 0 0 0
1 1 100
0 45 90
0 360
100 50 0
100 50 0
"""


def _text(value):
    return struct.pack("<I", len(value)) + value


def _header(width, height, first=0):
    """A film's header with an AOV of each kind; checksums are zeros that the target forges."""
    aovs = b"".join(_text(name) + struct.pack("<iifI", components, kind, 0.0, 0) for name, components, kind in
                    ((b"albedo", 3, 0), (b"depth", 1, 1), (b"cryptoObject", 12, 2)))
    names = struct.pack("<I", 1) + _text(b"/ball")
    return struct.pack("<iiQI", width, height, 0, first) + _text(b"token") + struct.pack("<I", 3) + aovs + names + bytes(8)


def _pixels(width, height, samples=2):
    """Rows of pixels, sums of albedo and nearest depths, then an id of each pixel."""
    pixel = struct.pack("<10d", *[0.5 * samples] * 10) + struct.pack("<IffI", samples, 0.4, 0.1, 0)
    row = pixel * width + struct.pack("<7d", *[0.5 * samples] * 6, samples) * width + struct.pack("<2f", 3.0, 0.1) * width
    return row * height + struct.pack("<III", 1, 7, samples) * width * height


def checkpoint():
    return b"PatinaCP" + struct.pack("<II", 3, 0x01020304) + _header(2, 2) + _pixels(2, 2) + bytes(8)


def part(width=2, tiles=((0, 0, 2, 2),), first=0):
    head = b"PatinaPT" + struct.pack("<II", 2, 0x01020304) + _text(b"{}") + struct.pack("<I", len(tiles))
    head += b"".join(struct.pack("<4i", *tile) for tile in tiles) + bytes(8)
    film = struct.pack("<I", 1) + _header(width, 2, first) + struct.pack(f"<{1 + len(tiles)}I", len(tiles), *range(len(tiles)))
    film += b"".join(_pixels(x1 - x0, y1 - y0) for x0, y0, x1, y1 in tiles)
    return head + film + struct.pack("<I", 0) + _text(b"{}") + bytes(8)


def parts():
    """:returns: a frame of two tiles in four parts: settings, then two tiles, each with two spans of samples"""
    tiles = ((0, 0, 1, 2), (1, 0, 2, 2))
    return b"\0\2\0\1" + b"".join(part(2, (tile,), first) for first in (0, 2) for tile in tiles)


def write(name, folder):
    """Puts the first inputs of a fuzzer into a folder that is its corpus."""
    texts = {"ies": {"plain": IES.encode()}, "film": {"checkpoint": checkpoint(), "part": part()},
             "parts": {"spans": parts()},
             "image": {"small": damaged.small_png()}, "network": {"none": b"\0"}}.get(name, {})
    for key, data in texts.items():
        with open(os.path.join(folder, "seed-" + key), "wb") as file:
            file.write(data)
    for path in keptFindings.corpus({"mtlx": "randomGraphs", "image": "texture"}.get(name, "none")):
        shutil.copy(path, os.path.join(folder, "seed-" + os.path.basename(path)))
