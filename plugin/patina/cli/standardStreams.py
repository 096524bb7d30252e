# SPDX-License-Identifier: Apache-2.0
"""A reader of a standard stream that goes away does not end a render: further output is lost."""
import os
import sys


class LosingStream:
    """Standard error whose reader may be gone (`2>&1 | head`), or whose disk full."""

    def __init__(self, stream):
        self._stream = stream

    def write(self, text):
        try:
            return self._stream.write(text)
        except (OSError, ValueError):
            self._give_up()
            return len(text)

    def flush(self):
        try:
            self._stream.flush()
        except (OSError, ValueError):
            self._give_up()

    def _give_up(self):
        silence(self._stream)

    def __getattr__(self, name):
        return getattr(self._stream, name)


def silence(stream):
    """Discards the rest of its buffer, so that nothing fails again when Python ends."""
    try:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, stream.fileno())
        os.close(null)
    except (OSError, ValueError):
        pass


class Streams:
    """Standard output and error of a command; both are there within the block."""

    def __enter__(self):
        self._before = sys.stdout, sys.stderr
        if sys.stdout is None:
            sys.stdout = open(os.devnull, "w", encoding="utf-8")
        sys.stderr = LosingStream(sys.stderr) if sys.stderr is not None else open(os.devnull, "w", encoding="utf-8")
        return self

    def __exit__(self, *_):
        sys.stdout, sys.stderr = self._before
        return False
