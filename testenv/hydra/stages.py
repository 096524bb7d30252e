# SPDX-License-Identifier: Apache-2.0
"""The stages that the Hydra tests render, with a camera for each: hosts need one that is a prim."""
import os

import usda

ROOT = os.path.normpath(os.path.join(os.path.dirname(__file__), "..", ".."))
SCENES = os.path.join(ROOT, "testenv", "scenes")
STAGES = (".usd", ".usda", ".usdc", ".usdz")


def scenes():
    """:returns: paths of the test scenes"""
    return sorted(os.path.join(SCENES, name) for name in os.listdir(SCENES) if name.endswith(".usda"))


def assets():
    """:returns: paths of all stages of the assets, an empty list where there are none"""
    folder = os.environ.get("PATINA_ASSETS", "")
    return sorted(os.path.join(root, name) for root, _, names in os.walk(folder) for name in names
                  if name.lower().endswith(STAGES))


def name_of(stage):
    """:returns: a name for reports: the path below the scenes or the assets"""
    for base in (SCENES, os.environ.get("PATINA_ASSETS", "")):
        if base and stage.startswith(base + os.sep):
            return os.path.relpath(stage, base)
    return os.path.basename(stage)


LIGHT = usda.prim("DomeLight", "testDome", "color3f inputs:color = (1, 0.9, 0.8)", intensity=0.8)


def front(width, height, *prims, camera=(), dome=(), **metadata):
    """:param camera: lines of the camera, which looks along -z at so many units around the origin
    :param dome: lines of the white sky
    :returns: a stage's text"""
    return usda.stage(usda.camera(*camera, flat=(10 * width, 10 * height), clippingRange=(1, 100), at=(0, 0, 20)),
                      usda.prim("DomeLight", "dome", *dome), *prims, up="", **metadata)


class Shot:
    """A stage as both hosts can render it.

    stage: path; a layer over the stage when that has no camera or no light, or names render settings: then
        with the camera that the stage reader frames it with, and with `light`, in which @rows@ is the
        camera's transform
    camera, frame, size: what to render
    scene: the `_patina.Scene` that the stage reader makes of it, without lights of its own"""

    def __init__(self, path, folder, width=64, purposes=("default", "render"), light=LIGHT):
        import _patina
        from patina import stage as reader

        opened = reader.open_stage(path)
        self.frame = opened.GetStartTimeCode()
        self.stage = path
        options = reader.StageOptions(frame=self.frame, headlight=False, purposes=purposes)
        self.scene = _patina.Scene()
        with self.scene.edit() as edit:
            edit.clear()
            self.info = reader.read_stage(opened, edit, options)
        self.camera = self.info.camera
        lens = self.scene.camera(self.camera)
        text = self.scene.dump()
        # Hosts that are not interactive would write a stage's products, and no image.
        if self.info.framed or "\nLight " not in text or opened.HasAuthoredMetadata("renderSettingsPrimPath"):
            self.stage = _wrapped(opened, path, _lens(text, self.camera), self.info.framed,
                                  "" if "\nLight " in text else light, folder)
            self.camera = "/framingCamera" if self.info.framed else self.camera
            with self.scene.edit() as edit:
                edit.clear()
                reader.read_stage(reader.open_stage(self.stage), edit, reader.StageOptions(
                    frame=self.frame, headlight=False, purposes=purposes, camera=self.camera))
        height = max(1, round(width * lens["vertical_aperture"] / lens["horizontal_aperture"]))
        self.size = (width, min(height, 4 * width))

    def host_flags(self):
        return ["--camera", self.camera, "--frame", self.frame, "--size", f"{self.size[0]}x{self.size[1]}"]


def shot_of(text, folder, **options):
    """:param text: of a stage
    :param options: of Shot"""
    path = os.path.join(str(folder), "stage.usda")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return Shot(path, folder, **options)


def _lens(text, camera):
    """:returns: what a scene's text says of a camera, by name"""
    lines = text.splitlines()
    first = lines.index(f"Camera {camera}") + 1
    last = next((i for i in range(first, len(lines)) if not lines[i].startswith(" ")), len(lines))
    fields = {"horizontalAperture": "20.955", "verticalAperture": "15.2908", "focalLength": "50",
              "focusDistance": "0", "clipNear": "1", "clipFar": "1e6", "transform": "1 0 0 0, 0 1 0 0, 0 0 1 0, 0 0 0 1"}
    fields.update(line.strip().split(" = ") for line in lines[first:last])
    return fields


def _wrapped(opened, path, lens, framed, light, folder):
    """Writes a layer over a stage with a camera, where it is framed, and a light. :returns: its path"""
    root = opened.GetRootLayer().pseudoRoot
    lines = [f'{name} = "{root.GetInfo(name)}"' if isinstance(root.GetInfo(name), str) else f"{name} = {root.GetInfo(name)}"
             for name in ("upAxis", "metersPerUnit", "startTimeCode", "endTimeCode", "timeCodesPerSecond")
             if root.HasInfo(name)]
    text = "#usda 1.0\n(\n    " + "\n    ".join(lines + [f"subLayers = [@{os.path.abspath(path)}@]"]) + "\n)\n"
    if opened.GetTimeCodesPerSecond() == 0:  # a sublayer's times would be scaled by 0 / 0, and USD never returns
        text = opened.Flatten().ExportToString()
    rows = ", ".join("(" + ", ".join(row.split()) + ")" for row in lens["transform"].split(","))
    if framed:
        names = ("focalLength", "focusDistance", "horizontalAperture", "verticalAperture")
        text += usda.camera(name="framingCamera", clippingRange=(lens["clipNear"], lens["clipFar"]), matrix=f"( {rows} )",
                            **{name: lens[name] for name in names})
    out = os.path.join(str(folder), os.path.basename(path).rsplit(".", 1)[0] + "Wrapped.usda")
    with open(out, "w", encoding="utf-8") as file:
        file.write(text + light.replace("@rows@", rows))
    return out
