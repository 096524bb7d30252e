# SPDX-License-Identifier: Apache-2.0
"""TIFF files of any size that take little disk: all their tiles are a few that lie in the file once."""
import struct
import zlib

import numpy as np

_SHORT, _LONG, _ASCII = 3, 4, 2
_PIXAR_TEXTURE_FORMAT = 33302  # says that further images of the file are levels of the first


def write(path, side, seed=0, levels=True, tile=256, kinds=5):
    """Writes a square 8-bit RGB texture of noise.

    :param side: texels, a power of two
    :param levels: whether the file has a mip pyramid, as one of maketx has
    :param kinds: how many different tiles there are
    :returns: bytes of its texels, without levels"""
    random = np.random.default_rng(seed)
    with open(path, "wb") as file:
        file.write(b"II*\0\0\0\0\0")
        places = []
        for _ in range(kinds):
            colors = random.integers(0, 256, (tile // 32, tile // 32, 3), np.uint8).repeat(32, 0).repeat(32, 1)
            colors[::16] ^= 0x55  # lines, which differ from level to level
            data = zlib.compress(colors.tobytes(), 9)
            places.append((file.tell(), len(data)))
            file.write(data)
        link, level = 4, side
        while True:
            start = _directory(file, level, tile, places, reduced=level < side, texture=levels)
            end = file.tell()
            file.seek(link)
            file.write(struct.pack("<I", start))
            file.seek(end)
            link, level = end - 4, level // 2
            if not levels or level == 0:
                return side * side * 3


def _directory(file, side, tile, places, reduced, texture):
    """Writes an image's directory behind its tables. :returns: where it begins"""
    across = (side + tile - 1) // tile
    chosen = [places[(3 * x + 7 * y + x * y) % len(places)] for y in range(across) for x in range(across)]
    entries = [(254, _LONG, [int(reduced)]), (256, _LONG, [side]), (257, _LONG, [side]), (258, _SHORT, [8, 8, 8]),
               (259, _SHORT, [8]), (262, _SHORT, [2]), (277, _SHORT, [3]), (284, _SHORT, [1]), (322, _LONG, [tile]),
               (323, _LONG, [tile]), (324, _LONG, [p for p, _ in chosen]), (325, _LONG, [n for _, n in chosen])]
    if texture:
        entries.append((_PIXAR_TEXTURE_FORMAT, _ASCII, b"Plain Texture\0"))
    written = []
    for tag, kind, values in entries:
        data = values if kind == _ASCII else struct.pack(f"<{len(values)}{'H' if kind == _SHORT else 'I'}", *values)
        if len(data) > 4:
            file.seek(file.tell() + file.tell() % 2)
            place = struct.pack("<I", file.tell())
            file.write(data)
            data = place
        written.append(struct.pack("<HHI", tag, kind, len(values)) + data.ljust(4, b"\0"))
    file.seek(file.tell() + file.tell() % 2)
    start = file.tell()
    file.write(struct.pack("<H", len(written)) + b"".join(written) + b"\0\0\0\0")
    return start
