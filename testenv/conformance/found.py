# SPDX-License-Identifier: Apache-2.0
"""The stages of a folder, and which of them are parts of others."""
import os

STAGES = (".usd", ".usda", ".usdc", ".usdz")


class Set:
    """A folder of stages. `name`: what results call it"""

    def __init__(self, text):
        """:param text: FOLDER, or NAME=FOLDER; a single stage is a folder of one"""
        name, equals, folder = text.partition("=")
        folder = os.path.abspath(folder if equals else text)
        self.name = name if equals else os.path.basename(folder)
        self.folder = folder if os.path.isdir(folder) else os.path.dirname(folder)
        self.stages = [folder] if os.path.isfile(folder) else sorted(
            os.path.join(root, file) for root, _, files in os.walk(folder) for file in files if file.lower().endswith(STAGES))

    def label(self, stage):
        """:returns: the name of a stage in results"""
        return self.name + "/" + os.path.relpath(stage, self.folder).replace(os.sep, "/")


def parts(stages):
    """Which stages others sublayer, reference or load as payloads.

    :returns: dict of path to the path of one that does"""
    known, users = {os.path.realpath(stage): stage for stage in stages}, {}
    for stage in stages:
        for used in _used(stage):
            part = known.get(os.path.realpath(os.path.join(os.path.dirname(stage), used)))
            if part and part != stage:
                users.setdefault(part, stage)
    return users


def _used(stage):
    """:returns: paths that a layer composes, as they are authored; none where it is unreadable, which the run then tells"""
    from pxr import Sdf, Tf

    try:
        layer = Sdf.Layer.FindOrOpen(stage)
    except Tf.ErrorException:
        return []
    return [path for path in layer.GetCompositionAssetDependencies() if path] if layer else []
