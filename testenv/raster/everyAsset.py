# SPDX-License-Identifier: Apache-2.0
"""Everything under $PATINA_ASSETS that can be rendered: its stages as they are, and each material of its MaterialX documents
on the ball of materialSheet.py."""
import functools
import os

import materialSheet

PREFIX = "assets/"
STAGES = (".usd", ".usda", ".usdc", ".usdz")


def root():
    return os.environ.get("PATINA_ASSETS", "")


@functools.lru_cache(maxsize=None)
def names():
    """:returns: `assets/FILE` of every stage, and `assets/FILE.mtlx:MATERIAL`; layers that show nothing are among them"""
    if not root():
        return []
    files = sorted(os.path.relpath(os.path.join(folder, file), root()).replace(os.sep, "/")
                   for folder, _, found in os.walk(root()) for file in found)
    stages = [file for file in files if file.lower().endswith(STAGES)]
    materials = [f"{file}:{name}" for file in files if file.endswith(".mtlx")
                 for name in materialSheet.materials(os.path.join(root(), file))]
    return [PREFIX + name for name in stages + materials]


def path(name, folder):
    """:param name: one of names()
    :param folder: where the stage of a document's material is written
    :returns: the path of a stage"""
    file, _, material = name[len(PREFIX):].partition(":")
    file = os.path.join(root(), *file.split("/"))
    if not material:
        return file
    stage = os.path.join(folder, flat(name) + ".usda")
    with open(stage, "w", encoding="utf-8") as out:
        out.write(materialSheet.stage_of(file, material))
    return stage


def flat(name):
    """:returns: a name as a file's"""
    return name.replace("/", "-").replace(":", "-")
