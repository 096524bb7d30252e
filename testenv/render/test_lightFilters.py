# SPDX-License-Identifier: Apache-2.0
"""Light filters against closed forms, on the floor of lightStages: albedo 0.5, a light two units above."""
import json
import math

import numpy as np
import pytest

from lightStages import light
from lightStages import stage as floor_under
from rendering import color, shot
import usda

POINT = ["float inputs:intensity = 4", "float inputs:radius = 0.01", "bool inputs:normalize = 1", "bool treatAsPoint = 1"]


def filter_text(kind, lines, place=(0.0, 1.0, 0.0), name="filter"):
    return usda.prim(kind, name, *lines, at=place, rotateX=-90)


def floor(folder, lamp, filters="", samples=16, flags=(), size=8):
    return color(shot(folder, floor_under(lamp, filters), "--camera", "/camera", "--imageWidth", size, "--imageHeight", size,
                      "--samples", samples, *flags)).mean()


def lamp(kind="SphereLight", attributes=POINT, target="</filter>"):
    return light(kind, *attributes, f"rel light:filters = {target}")


@pytest.fixture
def unfiltered(tmp_path):
    return floor(tmp_path, light("SphereLight", *POINT))


# The floor's point is the origin; the light's way to it crosses the plane y = 1 at x = 0.
@pytest.mark.parametrize("lines, place, share", [
    (["float inputs:ri:lightFilter:width = 2"], (0, 1, 0), 1.0),
    (["float inputs:ri:lightFilter:width = 0.5", "float inputs:ri:lightFilter:radius = 0"], (1, 1, 0), 0.0),
    (["float inputs:width = 0.5", "float inputs:radius = 0", "bool inputs:invert = 1"], (1, 1, 0), 1.0),
    (["float inputs:width = 0.5", "float inputs:radius = 0", "float inputs:density = 0.25"], (1, 1, 0), 0.75),
    (["float inputs:width = 1", "float inputs:radius = 0", "float inputs:edge = 1"], (1, 1, 0), 0.5),  # smoothstep(1/2)
    (["float inputs:width = 1", "float inputs:radius = 0", "float inputs:left = 1"], (1, 1, 0), 1.0),
    (["float inputs:width = 0.5", "float inputs:radius = 0"], (1, 3, 0), 1.0),  # above the light: nothing crosses it
    (["float inputs:width = 1", "float inputs:intensity = 3"], (0, 1, 0), 3.0),
    (["float inputs:width = 1", "float inputs:intensity = -3"], (0, 1, 0), -3.0),
    (["float inputs:width = 0.5", "float inputs:radius = 0", "float inputs:density = 2"], (1, 1, 0), 0.0),  # at most 1
])
def test_barn_door(tmp_path, unfiltered, lines, place, share):
    found = floor(tmp_path, lamp(), filter_text("PxrBarnLightFilter", lines, place))
    assert found == pytest.approx(share * unfiltered, rel=1e-3, abs=1e-6)


def test_barn_door_over_half_of_a_light(tmp_path):
    """An opening whose side stands over the middle of a wide light hides half of it: half of its irradiance, by symmetry."""
    wide = ["float inputs:width = 2", "float inputs:height = 2", "float inputs:intensity = 2"]
    whole = floor(tmp_path, light("RectLight", *wide), samples=256)
    opening = filter_text("PxrBarnLightFilter",
                          ["float inputs:width = 4", "float inputs:height = 8", "float inputs:radius = 0"], (2, 1, 0))
    half = floor(tmp_path, lamp("RectLight", wide), opening, samples=256)
    # 16384 samples of what is 0 or 1: a standard error of 0.4 % of the half were they independent; five of them.
    assert half == pytest.approx(0.5 * whole, rel=0.02)


def test_barn_door_before_a_distant_light(tmp_path):
    sun = ["float inputs:intensity = 1", "float inputs:angle = 0"]
    whole = floor(tmp_path, light("DistantLight", *sun))
    for x, share in ((0.0, 1.0), (2.0, 0.0)):
        found = floor(tmp_path, lamp("DistantLight", sun), filter_text("PxrBarnLightFilter", [], (x, 1, 0)))
        assert found == pytest.approx(share * whole, rel=1e-3, abs=1e-6)


@pytest.mark.parametrize("lines, place, share", [
    ([], (0, 0, 0), 0.0),
    ([], (0, 1.5, 0), 1.0),  # beside the point, on the way to the light: rods change what is lit inside of them
    (["float inputs:intensity = 0.25"], (0, 0, 0), 0.25),
    (["float inputs:intensity = 0.25", "bool inputs:invert = 1"], (0, 1.5, 0), 0.25),
    (["float inputs:radius = 0", "float inputs:edge = 1"], (1, 0, 0), 0.5),
])
def test_rod(tmp_path, unfiltered, lines, place, share):
    found = floor(tmp_path, lamp(), filter_text("PxrRodLightFilter", lines, place))
    assert found == pytest.approx(share * unfiltered, rel=1e-3, abs=1e-6)


@pytest.mark.parametrize("lines, share", [
    (["float inputs:beginDist = 1", "float inputs:endDist = 5"], 0.75),  # the light is 2 away
    (["float inputs:beginDist = 1", "float inputs:endDist = 5", "float[] inputs:ramp_Knots = [0, 0.5, 1]",
      "float[] inputs:ramp_Floats = [2, 4, 0]"], 3.0),
    (['token inputs:rampType = "spherical"', "float inputs:beginDist = 0", "float inputs:endDist = 4"], 0.75),
    (["int inputs:rampType = 1", "float inputs:beginDist = 0", "float inputs:endDist = 2"], 0.5),
    (["int inputs:rampType = 3", "float inputs:beginDist = 0", "float inputs:endDist = 20"], 1.0),
    (["float inputs:beginDist = 1", "float inputs:endDist = 1"], 0.0),  # a step: the light is beyond it
    (["float inputs:beginDist = 3", "float inputs:endDist = 3"], 1.0),
    (["float[] inputs:ramp_Knots = [0, 9]", "float[] inputs:ramp_Floats = [3e-9, 3e-9]"], 3e-9),
])
def test_ramp(tmp_path, unfiltered, lines, share):
    found = floor(tmp_path, lamp(), filter_text("PxrRampLightFilter", lines))
    # The camera's pixels are up to 0.02 away from the origin.
    assert found == pytest.approx(share * unfiltered, rel=2e-3, abs=1e-6 if share == 0.0 else 0.0)


@pytest.fixture
def quarters(tmp_path):
    """An image of four texels: the rows are 0.25 and 0.5, then 0.75 and 1."""
    import _patina

    values = np.repeat(np.float32([[0.25, 0.5], [0.75, 1.0]])[..., None], 3, axis=2)
    _patina.write_image(str(tmp_path / "quarters.exr"), values, ["R", "G", "B"])


MAP = "asset inputs:map = @./quarters.exr@"


# The light crosses the image at the middle of a texel. The image lies flat with its top towards -z.
@pytest.mark.parametrize("kind", ["PxrGoboLightFilter", "PxrCookieLightFilter"])
@pytest.mark.parametrize("lines, place, share", [
    ([], (0.25, 1, 0.25), 0.25),  # the image lies to the right and near: its top left
    ([], (-0.25, 1, 0.25), 0.5),
    ([], (0.25, 1, -0.25), 0.75),
    ([], (-0.25, 1, -0.25), 1.0),
    ([], (0, 1, 0), 0.625),  # between all four
    ([], (2, 1, 0), 0.0),  # beside it: the fill colour
    (["color3f inputs:fillColor = (0.125, 0.125, 0.125)"], (2, 1, 0), 0.125),
    (["color3f inputs:fillColor = (0.125, 0.125, 0.125)"], (0, 3, 0), 0.125),  # behind: the way does not cross it
    (["int inputs:tileMode = 1"], (2, 1, 0.25), 0.25),  # its edge goes on
    (["int inputs:tileMode = 2"], (2.25, 1, 0.25), 0.25),  # it repeats
    (["int inputs:tileMode = 2"], (0, 3, 0), 1.0),
    (["bool inputs:invert = 1"], (0.25, 1, 0.25), 0.75),
    (["float inputs:density = 0.5"], (0.25, 1, 0.25), 0.625),
    (["float inputs:intensity = 3", "color3f inputs:fillColor = (0.125, 0.125, 0.125)"], (2, 1, 0), 0.375),
    (["float inputs:scaleU = 2", "float inputs:width = 0.5"], (0.25, 1, 0.25), 0.25),
    (["float inputs:offsetU = 0.5"], (-0.25, 1, 0.25), 0.25),  # moved by a half to the right
    (["float inputs:offsetV = 0.5", "int inputs:tileMode = 2"], (0.25, 1, 0.25), 0.75),
])
def test_image(tmp_path, unfiltered, quarters, kind, lines, place, share):
    found = floor(tmp_path, lamp(), filter_text(kind, [MAP, *lines], place))
    # The camera's pixels are up to 0.02 away from the origin: the image changes by 0.01 there.
    assert found == pytest.approx(share * unfiltered, rel=5e-3, abs=float(0.01 * unfiltered))


MESH = usda.mesh("light", [(-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)], "float inputs:intensity = 2", "%s",
                 apis=("MeshLightAPI",))


@pytest.mark.parametrize("kind, lines, place, share, tolerance", [
    ("PxrIntMultLightFilter", ["float inputs:intensity = 0.25"], (0, 1, 0), 0.25, 1e-4),
    # An opening whose side stands over the middle of the light hides half of it, as of a rect.
    ("PxrBarnLightFilter", ["float inputs:width = 4", "float inputs:height = 8", "float inputs:radius = 0"], (2, 1, 0), 0.5,
     0.02),
])
def test_mesh_light(tmp_path, kind, lines, place, share, tolerance):
    whole = floor(tmp_path, MESH % "", samples=256)
    found = floor(tmp_path, MESH % "rel light:filters = </filter>", filter_text(kind, lines, place), samples=256)
    assert found == pytest.approx(share * whole, rel=tolerance)


def test_filters_of_a_mesh_light_leave_its_glow(tmp_path):
    """materialSyncMode independent: the light is filtered, and the glow of the material beside it is not."""
    glow = usda.preview("glow", emissiveColor=(1, 1, 1), diffuseColor=(0, 0, 0))
    none = filter_text("PxrIntMultLightFilter", ["float inputs:intensity = 0"])
    bound = 'token light:materialSyncMode = "independent"\n    rel light:filters = %s\n    rel material:binding = </glow>'
    mesh = MESH.replace('["MeshLightAPI"]', '["MeshLightAPI", "MaterialBindingAPI"]')
    filtered, whole = (floor(tmp_path, mesh % (bound % target) + glow, none, samples=256) for target in ("</filter>", "None"))
    assert filtered == pytest.approx(whole / 3, rel=0.02)  # the glow is 1, the light 2


def test_multiplier_and_order(tmp_path, unfiltered):
    filters = filter_text("PxrIntMultLightFilter", ["float inputs:exposure = 1", "float inputs:intensity = 0.75"])
    other = ['token lightFilter:shaderId = "PxrIntMultLightFilter"', "float inputs:intensity = 2"]
    filters += filter_text("LightFilter", other, name="other")
    found = floor(tmp_path, lamp(target="[</filter>, </other>]"), filters)
    assert found == pytest.approx(3.0 * unfiltered, rel=1e-5)


def test_the_camera_and_samples_of_the_bsdf_see_the_filtered_light(tmp_path):
    """A dome is found by both strategies; its filter scales what they find alike."""
    dome = ["float inputs:intensity = 1"]
    text = light("DomeLight", *dome, "rel light:filters = </filter>", place={})
    found = floor(tmp_path, text, filter_text("PxrIntMultLightFilter", ["float inputs:intensity = 2"]), samples=64)
    # Irradiance pi, albedo 0.5; 4096 samples whose values differ by less than their mean.
    assert found == pytest.approx(2.0 * 0.5, rel=5 / math.sqrt(4096))


def test_inputs_that_are_not_evaluated_are_named(tmp_path):
    lines = ["float inputs:ri:lightFilter:saturation = 0.5", "float inputs:diffuse = 1", "float inputs:twist = 3",
             "bool inputs:analytic:useLightDirection = 1", 'token inputs:combineMode = "mult"', "int inputs:colorRamp = 4",
             "float inputs:density = 2"]
    statistics = tmp_path / "statistics.json"
    floor(tmp_path, lamp(), filter_text("PxrBarnLightFilter", lines), samples=1, flags=(f"--json={statistics}",))
    said = sorted(w["message"] for w in json.loads(statistics.read_text())["warnings"])
    assert said == ["/filter has a density that is not within 0..1; it is clamped", "is 0.5, which is not evaluated",
                    "is 3.0, which is not evaluated", "is True, which is not evaluated"]


def test_bad_filters_are_named(tmp_path, unfiltered):
    wrong = filter_text("PxrNoSuchLightFilter", []) + filter_text("PxrCookieLightFilter", [], name="bare")
    wrong += filter_text("PxrRampLightFilter", ["float[] inputs:ramp_Knots = [1, 0]", "float[] inputs:ramp_Floats = [1, 1]",
                                                "float inputs:endDist = 1e9"], name="ramp")
    statistics = tmp_path / "statistics.json"
    found = floor(tmp_path, lamp(target="[</filter>, </nowhere>, </bare>, </ramp>]"), wrong, flags=(f"--json={statistics}",))
    assert found == pytest.approx(unfiltered, rel=1e-3)
    said = [w["message"] for w in json.loads(statistics.read_text())["warnings"] if w["prim"] == "/light"]
    for text in ("/nowhere does not exist", "unknown type 'PxrNoSuchLightFilter'", "/bare has no map",
                 "/ramp has a ramp whose knots"):
        assert any(text in message for message in said), (text, said)
