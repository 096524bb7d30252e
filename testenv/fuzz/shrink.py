# SPDX-License-Identifier: Apache-2.0
"""Makes an input that fails smaller: delta debugging over lines (Zeller and Hildebrandt 2002)."""
import time


def lines(data, fails, seconds):
    """:param data: bytes
    :param fails: whether bytes still fail in the same way
    :param seconds: the most that this takes
    :returns: bytes that fail, of fewer lines or the same"""
    end = time.monotonic() + seconds
    parts = data.splitlines(keepends=True)
    size = max(1, len(parts) // 2)
    while True:
        at, shorter = 0, False
        while at < len(parts):
            if time.monotonic() > end:
                return b"".join(parts)
            left = parts[:at] + parts[at + size:]
            if left and fails(b"".join(left)):
                parts, shorter = left, True
            else:
                at += size
        if size == 1 and not shorter:
            return b"".join(parts)
        size = max(1, size // 2)
