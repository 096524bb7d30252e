# SPDX-License-Identifier: Apache-2.0
"""Renders frames at once and cut, and compares all that their files hold."""
import os

import numpy as np

from inProcess import patina

MACHINE = ("patina:seconds",)  # what two renders of the same frame do not have in common


def contents(image):
    """:returns: bytes of all channels, and the metadata that does not tell of time"""
    import _patina

    found = _patina.read_image(str(image))
    metadata = {name: value for name, value in found.metadata.items()
                if name not in MACHINE and "date" not in name.lower()}
    return found.channels, np.array(found.pixels).tobytes(), metadata


def whole(stage, image, *flags):
    patina("record", stage, image, *flags, "--quiet")
    return contents(image)


def parts(folder, stage, image, cut, *flags):
    """Renders every part of a frame. :returns: their files, last part first"""
    tiles, _, ranges = cut.partition("x")
    files = []
    for number in range(1, int(tiles) * int(ranges or 1) + 1):
        files.insert(0, os.path.join(str(folder), f"{cut}.{number}.part"))
        patina("record", stage, image, *flags, f"--part={number}/{cut}", f"--partial={files[0]}", "--quiet")
    return files
