"""The stages that the Hydra tests render, with a camera for each: hosts need one that is a prim."""
import math
import os

import numpy as np

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


class Shot:
    """A stage as both hosts can render it.

    stage: path; a layer over the stage when that has no camera: then with the camera that the
        stage reader frames it with
    camera, frame, size: what to render
    scene: the `_patina.Scene` that the stage reader makes of it, without lights of its own"""

    def __init__(self, path, folder, width=64, purposes=("default", "render")):
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
        if self.info.framed:
            self.stage = _with_camera(opened, path, lens, folder)
            self.camera = "/framingCamera"
            opened = reader.open_stage(self.stage)
            with self.scene.edit() as edit:
                edit.clear()
                reader.read_stage(opened, edit, reader.StageOptions(
                    frame=self.frame, headlight=False, purposes=purposes, camera=self.camera))
        height = max(1, round(width * lens["vertical_aperture"] / lens["horizontal_aperture"]))
        self.size = (width, min(height, 4 * width))

    def host_flags(self):
        return ["--camera", self.camera, "--frame", self.frame, "--size", f"{self.size[0]}x{self.size[1]}"]


def _with_camera(opened, path, lens, folder):
    """Writes a layer that shows the stage through a camera. :returns: its path"""
    matrix = np.array(lens["transform"]).reshape(-1, 4, 4)[0]
    rows = ", ".join("(" + ", ".join(repr(float(x)) for x in row) + ")" for row in matrix)
    root = opened.GetRootLayer()
    lines = [f'{name} = "{root.pseudoRoot.GetInfo(name)}"' if isinstance(root.pseudoRoot.GetInfo(name), str)
             else f"{name} = {root.pseudoRoot.GetInfo(name)}"
             for name in ("upAxis", "metersPerUnit", "startTimeCode", "endTimeCode", "timeCodesPerSecond")
             if root.pseudoRoot.HasInfo(name)]
    text = "#usda 1.0\n(\n    " + "\n    ".join(lines + [f"subLayers = [@{path}@]"]) + f"""
)
def Camera "framingCamera"
{{
    float2 clippingRange = ({lens['clip_near']!r}, {lens['clip_far']!r})
    float focalLength = {lens['focal_length']!r}
    float focusDistance = {lens['focus_distance']!r}
    float horizontalAperture = {lens['horizontal_aperture']!r}
    float verticalAperture = {lens['vertical_aperture']!r}
    matrix4d xformOp:transform = ( {rows} )
    uniform token[] xformOpOrder = ["xformOp:transform"]
}}
"""
    out = os.path.join(str(folder), os.path.basename(path).rsplit(".", 1)[0] + "Framed.usda")
    with open(out, "w", encoding="utf-8") as file:
        file.write(text)
    return out


def is_finite(values):
    return all(map(math.isfinite, np.asarray(values).ravel()))
