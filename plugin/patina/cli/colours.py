# SPDX-License-Identifier: Apache-2.0
"""Colours of messages on a terminal: warnings yellow, failures red. $NO_COLOR (no-color.org) and a dumb terminal have none."""
import os

_CODES = {"warning:": 33, "patina:": 31, "patina": 31}  # the last begins wrong usage: "patina record: ..."


def painted(text, stream):
    """:param text: a line
    :param stream: that it is written to
    :returns: the line, its first word in colour where the stream is a terminal that shows it"""
    first, space, rest = text.partition(" ")
    if first not in _CODES or os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" or not stream.isatty():
        return text
    return f"\033[{_CODES[first]}m{first}\033[0m{space}{rest}"
