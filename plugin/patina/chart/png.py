# SPDX-License-Identifier: Apache-2.0
"""Pictures as text in a page: PNG in a data URI."""
import base64
import struct
import zlib

import numpy as np


def display_values(linear):
    """:returns: linear colours as a display with sRGB takes them, 0 to 1"""
    values = np.clip(np.nan_to_num(linear), 0.0, 1.0)
    return np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1.0 / 2.4) - 0.055)


def display_bytes(linear):
    return np.round(display_values(np.asarray(linear, np.float64)) * 255.0).astype(np.uint8)


def wrapped(width, height, rows):
    """:param rows: bytes of all rows, with the filter before each
    :returns: the bytes of a PNG file with 8 bits of red, green and blue"""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def encode(image):
    """:param image: linear values (height, width, 3); shown as sRGB, cut to what a display has
    :returns: the bytes of a PNG file"""
    data = display_bytes(image)
    height, width = data.shape[:2]
    # Each row as its difference from the one above (filter 2): about half the size of plain rows.
    above = np.concatenate([np.zeros_like(data[:1]), data[:-1]])
    return wrapped(width, height, b"".join(b"\2" + row.tobytes() for row in (data - above).reshape(height, -1)))


def data_uri(image):
    return "data:image/png;base64," + base64.b64encode(encode(image)).decode()
