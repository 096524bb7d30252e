# SPDX-License-Identifier: Apache-2.0
"""Levels of detail by measured error: of each root the level of fewest triangles whose picture is near enough to that of the
level that the stage chooses.

Each level is drawn alone, by the picture's camera, in its size and with its materials, lit from the camera, before a grey as
bright as the object. The error of a level is the mean over the picture of |luminance - truth| / (truth + 0.01), which is what a
tolerance bounds. Shadows and reflections have no part in it, so a root that is out of view keeps its level.
"""
import dataclasses
import math

import numpy as np

from patina.cli.compiled import _patina
from patina.cli.usd import Usd, reader
from patina.experiment import LUMINANCE, draw, relative_error

SHARE = 0.1  # of a tolerance, for the errors of all roots together
_SAMPLES = 2**18  # of a level, where 16 or fewer of a pixel are as many
_AROUND = 8  # pixels around the bounds of a root that are drawn too


@dataclasses.dataclass
class Root:
    """A root of levels. errors and triangles are by level; truth and chosen are levels."""
    path: str
    names: list
    truth: int
    errors: list
    triangles: list
    chosen: int


def choose(stage, options, size_of, tolerance):
    """:param options: StageOptions of the picture
    :param size_of: function of the camera, as Scene.camera() tells it: width and height of the picture, pixels
    :param tolerance: more than 0
    :returns: (list of Roots whose levels may be chosen, the tolerance that is left for everything else)"""
    with _patina.Scene().edit() as edit:  # what there is to warn of, the picture's own reading tells
        camera, found = reader.levels.roots(stage, edit, options)
    options = dataclasses.replace(options, camera=camera)
    roots = []
    for path, (names, truth, bounds) in found.items():
        drawn = [_draw(stage, options, f"{path}/{name}", bounds, size_of) for name in names]
        roots.append(Root(path, names, truth, _errors(drawn, truth), [count for *_, count in drawn], truth))
    left = SHARE * tolerance
    while True:  # the step that saves most triangles for its error, as long as one fits
        steps = [((root.triangles[root.chosen] - root.triangles[i]) / max(error - root.errors[root.chosen], 1e-12), root, i)
                 for root in roots for i, error in enumerate(root.errors)
                 if root.triangles[i] < root.triangles[root.chosen] and error - root.errors[root.chosen] <= left]
        if not steps:
            break
        _, root, i = max(steps, key=lambda step: step[0])
        left -= root.errors[i] - root.errors[root.chosen]
        root.chosen = i
    spent = sum(root.errors[root.chosen] for root in roots)
    return roots, math.sqrt(tolerance**2 - spent**2)


def _errors(drawn, truth):
    """:param drawn: of each level, see _draw()
    :returns: list of a number for each level"""
    light, alpha, _ = drawn[truth]
    grey = light.sum() / max(alpha.sum(), 1.0)
    before = [image + (1.0 - alpha) * grey for image, alpha, _ in drawn]
    return [relative_error(image, before[truth]) for image in before]


def _draw(stage, options, path, bounds, size_of):
    """:param path: of a level, which is drawn alone
    :param bounds: of its root, see levels.roots()
    :returns: luminance and alpha, and its number of triangles"""
    root = path.rpartition("/")[0]
    mask = Usd.StagePopulationMask([path, options.camera])
    alone = Usd.Stage.OpenMasked(stage.GetRootLayer(), stage.GetSessionLayer(), stage.GetPathResolverContext(), mask)
    alone.ExpandPopulationMask()  # materials and skeletons
    scene, film = _patina.Scene(), _patina.Film()
    with scene.edit() as edit:
        info = reader.read_stage(alone, edit, dataclasses.replace(options, levels={root: 0}, headlight=True,
                                                                 shutter=(0.0, 0.0)))
    camera = scene.camera(info.camera)
    width, height = size_of(camera)
    settings = {"width": width, "height": height, "samples": 16, "maxDepth": 2, "seed": 1, "checkpointSeconds": 0.0}
    plain = camera["has_overscan"] and not camera["f_stop"] and abs(width / height / camera["image_aspect"] - 1.0) < 0.01
    if bounds and plain:  # no pixel beyond is of the root, apart from the filter and a frame that is cut to whole pixels
        left, right = ((0.5 + 0.5 * x) * width for x in bounds[::2])
        top, bottom = ((0.5 - 0.5 * y) * height for y in bounds[:0:-2])
        settings["dataWindow"] = (min(max(int(left) - _AROUND, 0), width - 1), min(max(int(top) - _AROUND, 0), height - 1),
                                  min(max(int(right) + _AROUND, 0), width - 1), min(max(int(bottom) + _AROUND, 0), height - 1))
        x0, y0, x1, y1 = settings["dataWindow"]
        settings["samples"] = min(max(_SAMPLES // ((x1 - x0 + 1) * (y1 - y0 + 1)), 4), 16)
    state = draw(_patina.make_renderer("embree"), scene, info.camera, settings, film)
    return (np.asarray(film.resolve("color"), np.float64) @ LUMINANCE, np.asarray(film.resolve("alpha"), np.float64),
            int(state["statistics"]["trianglesStored"]))
