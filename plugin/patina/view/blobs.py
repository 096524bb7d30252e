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
