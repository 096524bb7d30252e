# SPDX-License-Identifier: Apache-2.0
"""Light filters, drawn by the rasterizer and by the path tracer: the answer has to be the same, by equivalence.py."""
import dataclasses

import numpy as np
import pytest

import equivalence
import floorLights
import inProcess
import sameImage
from floorLights import STAGE, light, write
from usda import mesh, prim

pytestmark = pytest.mark.usefixtures("opengl")

NO_HEADLIGHT = "--disableCameraLight"
WIDE = {"intensity": 10, "width": 1, "height": 1}
BALL = {"intensity": 60, "radius": 0.15}


def overhead(x, y=1.6):
    return {"at": (x, y, 0), "turn": (-90, 0, 0)}


def filter_prim(kind, text, name="filter", place=overhead(-0.5)):
    lines = [f'uniform token lightFilter:shaderId = "{kind}"', *text.split("; ")]
    return prim("LightFilter", name, *lines, **place)


def lamp(kind, *filters, **inputs):
    paths = ", ".join(f"</World/{name}>" for name in filters or ["filter"])
    return light(kind, f"rel light:filters = [{paths}]", **inputs)


SOFT = "float inputs:width = 1.2; float inputs:height = 1; float inputs:radius = 0.1; float inputs:edge = 0.4"
IMAGE = "asset inputs:map = @./image.exr@; float inputs:width = 3; float inputs:height = 3"
GLOWING = mesh("lamp", [(-0.8, 2.5, -0.8), (0.2, 2.5, -0.8), (0.2, 2.5, 0.2), (-0.8, 2.5, 0.2)],
               "float inputs:intensity = 12", "rel light:filters = </World/filter>", apis=("MeshLightAPI",))
CASES = {
    "barn": lamp("RectLight", **WIDE) + filter_prim("PxrBarnLightFilter", SOFT),
    "barnAnalytic": lamp("SphereLight", **BALL) + filter_prim(
        "PxrBarnLightFilter", SOFT + "; int inputs:barnMode = 1; float inputs:apex = 2; bool inputs:invert = 1"),
    "barnShear": lamp("SphereLight", **BALL) + filter_prim(
        "PxrBarnLightFilter", SOFT + "; int inputs:barnMode = 1; bool inputs:directional = 1; float inputs:shearX = 0.4"),
    "cookie": lamp("SphereLight", **BALL) + filter_prim("PxrCookieLightFilter", IMAGE + "; int inputs:tileMode = 2"),
    "gobo": lamp("RectLight", **WIDE) + filter_prim(
        "PxrGoboLightFilter", IMAGE + "; float inputs:scaleU = 0.7; float inputs:offsetV = 0.1; float inputs:density = 0.7"),
    "rod": lamp("SphereLight", **BALL) + filter_prim(
        "PxrRodLightFilter", "float inputs:edge = 0.5; float inputs:intensity = 0.2", place=overhead(0, 0.3)),
    "ramp": lamp("SphereLight", **BALL) + filter_prim(
        "PxrRampLightFilter", "float inputs:beginDist = 2; float inputs:endDist = 6; "
        'float[] inputs:ramp_Knots = [0, 0.4, 0.7, 1]; float[] inputs:ramp_Floats = [1, 0.2, 1.5, 0.5]; '
        'string inputs:ramp_Interpolation = "bspline"; float[] inputs:colorRamp_Knots = [0.2, 0.8]; '
        "color3f[] inputs:colorRamp_Colors = [(1, 0.5, 0.2), (0.2, 0.5, 1)]"),
    "several": lamp("SphereLight", "filter", "other", **BALL) + filter_prim("PxrBarnLightFilter", SOFT) + filter_prim(
        "PxrIntMultLightFilter", "float inputs:exposure = 1; float inputs:density = 0.5", "other"),
    "sun": (lamp("DistantLight", intensity=3000, angle=3, place={"turn": (-70, 20, 0)})
            + filter_prim("PxrBarnLightFilter", SOFT)),
    "dome": (lamp("DomeLight", color=(0.3, 0.4, 0.6), place={})
             + filter_prim("PxrBarnLightFilter", SOFT + "; bool inputs:invert = 1")),
    "meshLight": GLOWING + filter_prim("PxrBarnLightFilter", SOFT),
}
# Half of the light of few pixels hangs on few of the light's places.
LESS = dataclasses.replace(equivalence.FULL, widest=10 * equivalence.MARGIN)


@pytest.mark.parametrize("name", sorted(CASES))
def test_filtered_light_is_the_path_tracers(name, tmp_path):
    sameImage.assert_same(write(tmp_path, STAGE % CASES[name]), None, NO_HEADLIGHT, power=LESS)


@pytest.mark.parametrize("name", ["barn", "meshLight"])
def test_the_camera_sees_the_filtered_light(name, tmp_path):
    """A camera below looks through the opening; pixels without a light are black in both."""
    stage = floorLights.world("%s").replace(
        "matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 0.6, -0.8, 0), (0, 0.8, 0.6, 0), (0, 5.6, 4.2, 1))",
        "matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (-0.5, 0, 0, 1))")
    lamps = {"barn": lamp("RectLight", **WIDE, place=overhead(-0.3, 2.5)), "meshLight": GLOWING}
    opening = filter_prim("PxrBarnLightFilter", "float inputs:width = 0.5; float inputs:height = 0.3; float inputs:radius = 0")
    path = write(tmp_path, stage % (lamps[name] + opening))
    images = [inProcess.Stage(path, "--backend", backend, "--samples", 64, "-w", 48, NO_HEADLIGHT).image(0)
              for backend in ("raster", "embree")]
    assert all((image == 0).mean() > 0.5 and image.max() > 5 for image in images)
    # A pixel on the edge of the opening: the mean of 64 samples that are the light or nothing, five standard errors of both.
    edge = 5 * np.sqrt(2 * 0.25 / 64) * images[1].max()
    assert np.abs(images[0] - images[1]).max() < edge
    assert images[0].mean() == pytest.approx(images[1].mean(), rel=0.02)


def test_edits_give_a_light_its_first_filter_and_take_it_away(tmp_path):
    """Programs that knew no filters are compiled anew."""
    stage = inProcess.Stage(write(tmp_path, STAGE % ""), "--backend", "raster", "--samples", 1, "-w", 8, NO_HEADLIGHT)
    quarter = {"path": "/quarter", "type": "multiplier", "intensity": 0.25, "transform": np.eye(4)}
    images = []
    for filters in ([], [quarter], []):
        with stage.scene.edit() as edit:
            edit.set_light("/sky", type="dome", intensity=1.0, filters=filters)
        images.append(stage.image(0))
    assert images[0].max() > 0.1
    assert np.array_equal(images[0], images[2])
    # A product more, of floats.
    assert np.allclose(images[1], 0.25 * images[0], rtol=1e-5, atol=0.0)
