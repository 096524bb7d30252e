# SPDX-License-Identifier: Apache-2.0
"""Arrays as text of a page: little-endian, gzip, base64."""
import base64
import gzip

import numpy as np


def pack(array):
    """:returns: text for web/src/data.js"""
    data = np.ascontiguousarray(array)
    if data.dtype.byteorder == ">":
        data = data.astype(data.dtype.newbyteorder("<"))
    return base64.b64encode(gzip.compress(data.tobytes(), 9, mtime=0)).decode("ascii")


def half(array):
    """Half floats; what is larger than they hold becomes the largest."""
    return np.nan_to_num(np.clip(array, -65504.0, 65504.0), nan=0.0).astype("<f2")


def pack_text(text):
    return pack(np.frombuffer(text.encode("utf-8"), np.uint8))


def pack_smooth(halves):
    """Half floats of a table of pairs: what tells each value from the one before the last is small,
    and packs better with its low bytes apart from its high ones."""
    bits = np.ascontiguousarray(halves, "<f2").view("<u2").ravel()
    steps = bits.copy()
    steps[2:] -= bits[:-2]
    signed = steps.view("<i2").astype(np.int32)
    folded = (signed << 1) ^ (signed >> 31)
    return pack(np.concatenate([folded & 255, (folded >> 8) & 255]).astype(np.uint8))
