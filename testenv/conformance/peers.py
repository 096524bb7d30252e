# SPDX-License-Identifier: Apache-2.0
"""Pictures that other renderers made of a stage, where they lie beside it.

- OpenUSD's tests of UsdImagingGL: CMakeLists.txt names the stage and the picture, which is in the folder `baseline`.
- Arnold's test suite: `ref/reference.tif` beside the folder `data` of the stage.
- Assets of the USD Working Group: `thumbnails` and `screenshots` beside the stage.
"""
import functools
import glob
import os
import re

MOST = 3  # pictures of a stage
IMAGES = (".png", ".jpg", ".jpeg", ".tif", ".exr")


def of(stage):
    """:returns: paths of pictures, the nearest first"""
    folder, file = os.path.split(stage)
    stem = os.path.splitext(file)[0]
    found = list(_registered(stage))
    for parent in (folder, os.path.dirname(folder)):
        found += _images(os.path.join(parent, "ref"), "reference")
        found += _images(os.path.join(parent, "baseline"), stem)
        found += _images(os.path.join(parent, "baseline"), "*" + stem)
    for place in ("thumbnails", "screenshots"):
        found += _images(os.path.join(folder, place), stem)
        found += _images(os.path.join(folder, place), stem + "*")
    found += _images(os.path.join(folder, "screenshots"), "usdview*")
    return list(dict.fromkeys(found))[:MOST]


def _images(folder, pattern):
    pattern = "".join(letter if letter == "*" else glob.escape(letter) for letter in pattern)
    return [path for path in sorted(glob.glob(os.path.join(glob.escape(folder), pattern + ".*")))
            if path.lower().endswith(IMAGES)]


def _registered(stage):
    """Yields the pictures that a CMakeLists.txt beside the folder `testenv` registers for a stage."""
    head, found, tail = stage.rpartition(os.sep + "testenv" + os.sep)
    if not found:
        return
    folder, _, name = tail.partition(os.sep)
    for test, used, image in _tests(os.path.join(head, "CMakeLists.txt")):
        picture = os.path.join(head, "testenv", folder, "baseline", image)
        if test == folder and os.path.normpath(used) == os.path.normpath(name) and os.path.isfile(picture):
            yield picture


@functools.lru_cache(maxsize=None)
def _tests(path):
    """:returns: list of (folder of the test, stage below it, name of the picture)"""
    if not os.path.isfile(path):
        return []
    with open(path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    found = []
    for block in re.findall(r"pxr_register_test\((.*?)\n\)", text, re.DOTALL):
        stage, image = re.search(r"-stage (\S+)", block), re.search(r"-write (\S+\.png)", block)
        folder = re.search(r"TESTENV (\S+)", block)
        if stage and image:
            found.append((folder[1] if folder else block.split()[0], stage[1], image[1].rstrip('"')))
    return found
