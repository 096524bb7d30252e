# SPDX-License-Identifier: Apache-2.0
"""The folder that inputs run in: what stages may name and no program should have to read."""
import os
import random

from patina.chart import png

SCENES = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "scenes")
SPHERE = '#usda 1.0\ndef Sphere "ball"\n{\n}\ndef DomeLight "dome"\n{\n}\n'


def small_png(width=2, height=2):
    """:returns: the bytes of a picture of 2 x 2 pixels, whatever size it claims"""
    return png.wrapped(width, height, b"\0\xff\0\0\0\xff\0" + b"\0\0\0\xff\xff\xff\xff")


def fill(folder, seed=0):
    """Makes the files in a folder, those that are damaged in another way for each seed."""
    chance = random.Random(seed)

    def write(name, data):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)

    def spoiled(name):
        with open(os.path.join(SCENES, "textures", name), "rb") as file:
            data = bytearray(file.read())
        for _ in range(chance.randint(1, 30)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        return bytes(data[:chance.randint(len(data) // 2, len(data))])

    write("small.png", small_png())
    write("huge.png", small_png(100000, 100000))  # 30 GB when it is unpacked
    write("damaged.png", spoiled("checker.png"))
    write("damaged.exr", spoiled("sky.exr"))
    write("damaged.vdb", spoiled("puff.vdb"))
    write("damaged.ies", b"IESNA:LM-63-2002\nTILT=NONE\n1 1e30 1 3 2 1 1 0 0 0\n1 1 1\n0 nan 90\n0 360\n1 2 3 4 5 1e39\n")
    write("damaged.mtlx",
          b'<?xml version="1.0"?><materialx version="1.39"><xi:include href="damaged.mtlx"/><nodegraph name="a">')
    write("damaged.usdz", b"PK\3\4" + bytes(60))
    write("zeros.png", bytes(65536))
    write("loop.usda", b"#usda 1.0\n(\n    subLayers = [@loop.usda@]\n)\n")
    write("stage.usda", SPHERE.encode())
    os.mkdir(os.path.join(folder, "folder"))
    os.mkfifo(os.path.join(folder, "pipe"))
