# SPDX-License-Identifier: Apache-2.0
"""Files that change while they are read: cut short, made longer, spoiled, replaced by others, by folders and pipes, removed,
again and again until the render ends. It ends with an image or with one line, and never waits."""
import json
import os
import random as randoms
import shutil
import time

import damaged
import outcomes
import mtlx
from usda import camera, material, prim, stage

EXTENSION = ".json"
LINES = False
CPU_SECONDS = 100  # a driver in software compiles for half a minute before it draws
STAGE = stage(
    camera(at=(0, 0, 6)),
    prim("DomeLight", "dome", "asset inputs:texture:file = @sky.exr@"),
    prim("SphereLight", "lamp", "asset inputs:shaping:ies:file = @lamp.ies@", at=(3, 3, 3)),
    prim("Volume", "puff", "rel field:density = </puff/density>",
        prim("OpenVDBAsset", "density", filePath="puff.vdb", fieldName="density")),
    prim("Sphere", "ball", "rel material:binding = </m>"),
    prim("Cube", "box", "rel material:binding = </documents/Materials/M>"),
    prim("", "documents", meta=("prepend references = @look.mtlx@</MaterialX>",)),
    material("m", {"s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>"}),
                   "t": ("UsdUVTexture", {"file": "checker.png"}, "color3f rgb")}, surface="s"),
    up="", subLayers="[@layer.usda@]")
LAYER = '#usda 1.0\ndef Xform "many"\n{\n%s}\n'
LOOK = mtlx.document(mtlx.shader("M"))
FILES = ("checker.png", "sky.exr", "puff.vdb", "lamp.ies", "look.mtlx", "layer.usda", "shot.usda")
CHANGES = ("cut", "empty", "longer", "spoiled", "zeros", "other", "folder", "pipe", "gone", "unreadable", "whole")


def make(seed):
    """:returns: the bytes of an input: which files change, how, and how quickly"""
    r = randoms.Random(seed)
    return json.dumps({"files": r.sample(FILES, r.choice((1, 1, 2, 3))),
                       "changes": [r.choice(CHANGES) for _ in range(r.randint(1, 6))], "wait": r.choice((0.0, 0.002, 0.02)),
                       "begin": round(r.uniform(0.0, 0.3), 3), "seed": r.randint(0, 1 << 30),
                       "backend": r.choice(("embree", "embree", "raster"))}, indent=1).encode() + b"\n"


def write_all(folder):
    """Puts a stage with all that it reads into a folder."""
    balls = "".join(f'    def Sphere "s{i}"\n    {{\n        double radius = 0.0{i % 9 + 1}\n    }}\n' for i in range(400))
    for name, text in (("shot.usda", STAGE), ("layer.usda", LAYER % balls), ("look.mtlx", LOOK), ("lamp.ies", (
            "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 2 1 1 0 0 0\n1 1 1\n0 45 90\n0 360\n1 2 3\n4 5 6\n"))):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    for name in ("checker.png", "sky.exr", "puff.vdb"):
        shutil.copyfile(os.path.join(damaged.SCENES, "textures", name), os.path.join(folder, name))


def _change(path, kind, data, r):
    """The object at a path becomes another one. :param data: of the file as it was"""
    if kind in ("cut", "empty", "longer", "spoiled", "zeros") and os.path.isfile(path):  # in place: readers have it open
        with open(path, "r+b") as file:
            if kind == "cut":
                file.truncate(r.randrange(len(data)))
            elif kind == "empty":
                file.truncate(0)
            elif kind == "longer":
                file.seek(0, os.SEEK_END)
                file.write(data)
            else:
                file.seek(r.randrange(len(data)))
                file.write(bytes(64) if kind == "zeros" else r.randbytes(64))
        return
    if os.path.isdir(path):
        os.rmdir(path)
    elif os.path.lexists(path):
        os.remove(path)
    if kind == "folder":
        os.mkdir(path)
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind not in ("gone", "cut", "empty", "longer", "spoiled", "zeros"):
        with open(path, "wb") as file:
            file.write(data if kind != "other" else damaged.small_png())
        if kind == "unreadable":
            os.chmod(path, 0)


def execute(path, folder):
    """Renders while files change, in a process that may die. :returns: its exit status"""
    with open(path, encoding="utf-8") as file:
        asked = json.load(file)
    write_all(folder)
    whole = {}
    for name in FILES:
        with open(os.path.join(folder, name), "rb") as file:
            whole[name] = file.read()
    r = randoms.Random(asked["seed"])
    process = os.fork()
    if not process:
        outcomes.end_with_parent()
        outcomes.leave(outcomes.record(["record", "shot.usda", "image.exr", "--camera", "/camera", "--backend",
                                        asked["backend"]], folder))
    time.sleep(asked["begin"])
    number = 0
    while True:
        ended, state = os.waitpid(process, os.WNOHANG)
        if ended:
            break
        for name in asked["files"]:
            _change(os.path.join(folder, name), asked["changes"][number % len(asked["changes"])], whole[name], r)
        number += 1
        time.sleep(asked["wait"])
    if os.WIFSIGNALED(state):
        os.kill(os.getpid(), os.WTERMSIG(state))
    return os.WEXITSTATUS(state)
