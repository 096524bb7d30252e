# SPDX-License-Identifier: Apache-2.0
"""A small movie, rendered by a farm and frame by frame at once; the bits are compared."""
import os
import subprocess
import sys

import usda

STAGE = usda.stage(
    usda.camera(at=(0, 1, 9)),
    usda.prim("Sphere", "ball", at={1: (-2, 1, 0), 240: (2, 1, 0)}, color=(0.8, 0.3, 0.1)),
    usda.floor("floor", 9, scheme=""),
    usda.prim("DomeLight", "sky", intensity=0.6),
    usda.prim("SphereLight", "lamp", intensity=30, at=(3, 5, 3)),
    startTimeCode=1, endTimeCode=240)


def write_stage(folder):
    """:returns: its path"""
    path = os.path.join(str(folder), "movie.usda")
    with open(path, "w", encoding="utf-8") as file:
        file.write(STAGE)
    return path


def command(*arguments):
    return [sys.executable, "-m", "patina", *map(str, arguments)]


def at_once(stage, folder, frames, flags):
    """Renders the frames by one process. :returns: their names in order"""
    os.makedirs(folder, exist_ok=True)
    subprocess.run(command("record", stage, os.path.join(folder, "movie.####.exr"), f"--frames={frames}", *flags, "--quiet"),
                   check=True)
    return sorted(name for name in os.listdir(folder) if name.endswith(".exr"))


def different(names, folder, other):
    """:returns: those images whose channels or metadata differ, or are missing in the other folder"""
    from partImages import contents

    found = []
    for name in names:
        path = os.path.join(other, name)
        if not os.path.exists(path) or contents(os.path.join(folder, name)) != contents(path):
            found.append(name)
    return found
