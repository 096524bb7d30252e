# SPDX-License-Identifier: Apache-2.0
"""The seeds of corpora: one sound input of each kind, so that fuzzers start behind the first checks."""
import os
import shutil
import struct

import damaged

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
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


def _header(width, height):
    """A film's header with two AOVs; checksums are zeros that the target forges."""
    aovs = b"".join(_text(name) + struct.pack("<iifI", components, kind, 0.0, 0) for name, components, kind in
                    ((b"color", 3, 0), (b"depth", 1, 1)))
    return struct.pack("<iiQI", width, height, 0, 0) + _text(b"token") + struct.pack("<I", 2) + aovs + bytes(8)


def _pixels(count):
    return bytes((96 + 8) * count)


def checkpoint():
    return b"PatinaCP" + struct.pack("<II", 3, 0x01020304) + _header(2, 2) + _pixels(4) + bytes(8)


def part():
    head = b"PatinaPT" + struct.pack("<II", 1, 0x01020304) + _text(b"{}") + struct.pack("<I", 1)
    head += struct.pack("<4i", 0, 0, 2, 2) + bytes(8)
    return head + struct.pack("<I", 1) + _header(2, 2) + _pixels(4) + struct.pack("<I", 0) + _text(b"{}") + bytes(8)


def _kept(folder, extension):
    return [os.path.join(ROOT, folder, name) for name in sorted(os.listdir(os.path.join(ROOT, folder)))
            if name.endswith(extension)]


def write(name, folder):
    """Puts the first inputs of a fuzzer into a folder that is its corpus."""
    texts = {"ies": {"plain": IES.encode()}, "film": {"checkpoint": checkpoint(), "part": part()},
             "image": {"small": damaged.small_png()}, "network": {"none": b"\0"}}.get(name, {})
    for key, data in texts.items():
        with open(os.path.join(folder, "seed-" + key), "wb") as file:
            file.write(data)
    if name == "mtlx":
        for path in _kept("testenv/stability/corpus", ".mtlx"):
            shutil.copy(path, os.path.join(folder, "seed-" + os.path.basename(path)))
