# SPDX-License-Identifier: Apache-2.0
"""A small movie, rendered by a farm and frame by frame at once; the bits are compared."""
import os
import subprocess
import sys

STAGE = '''#usda 1.0
(
    startTimeCode = 1
    endTimeCode = 240
    upAxis = "Y"
)
def Camera "camera"
{
    double3 xformOp:translate = (0, 1, 9)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Sphere "ball"
{
    double3 xformOp:translate.timeSamples = { 1: (-2, 1, 0), 240: (2, 1, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
    color3f[] primvars:displayColor = [(0.8, 0.3, 0.1)]
}
def Mesh "floor"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-9, 0, 9), (9, 0, 9), (9, 0, -9), (-9, 0, -9)]
}
def DomeLight "sky"
{
    float inputs:intensity = 0.6
}
def SphereLight "lamp"
{
    float inputs:intensity = 30
    double3 xformOp:translate = (3, 5, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
'''


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
