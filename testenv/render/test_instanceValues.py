# SPDX-License-Identifier: Apache-2.0
"""Primvars with a value per instance: instances look like copies that have the values themselves."""
import os

import numpy as np
import pytest

from inProcess import needs_opengl
from rendering import color, patina, shot
import usda

HEAD = usda.stage(
    usda.camera(lens=(50, 20, 20), clippingRange=(0.01, 1000), at=(0, 0, 10)),
    usda.prim("DomeLight", "sky", intensity=1),
    usda.material("reads", {
        "surface": ("UsdPreviewSurface", {"color3f diffuseColor": "<tint>", "color3f emissiveColor": "<glow>"}),
        "tint": ("UsdPrimvarReader_float3", {"varname": "tint", "float3 fallback": (0.2, 0.2, 0.2)}),
        "glow": ("UsdPrimvarReader_float3", {"varname": "glow"})}))
PLACES = [(-1.2, -1, 0), (0, 1, 0), (1.2, -1, 0)]
COLOURS = [(0.8, 0.1, 0.1), (0.1, 0.8, 0.1), (0.1, 0.1, 0.8)]


def primvar(kind, name, values, per_instance=False):
    return f"{kind}[] primvars:{name} = {list(values)}" + ' (interpolation = "vertex")' * per_instance


def of_instance(primvars, i):
    """:param primvars: dict name: (type, values)"""
    return [primvar(kind, name, values[i:i + 1]) for name, (kind, values) in primvars.items()]


def ball(name, *lines, at=None, bound=False):
    return usda.prim("Sphere", name, *lines, bind="reads" if bound else "", radius=0.6, at=at)


def instanced(primvars, *own, bound=False):
    """Balls at PLACES as instances."""
    return usda.prim(
        "PointInstancer", "balls", "int64[] ids = [7, 3, 5]", "rel prototypes = [</balls/ball>]",
        *(primvar(kind, name, values, True) for name, (kind, values) in primvars.items()), ball("ball", *own, bound=bound),
        positions=PLACES, protoIndices=[0, 0, 0])


def native(primvars, bound=False):
    """The same as native instances below prims that have the values."""
    copy = usda.prim("Xform", "copy", meta=("instanceable = true", "inherits = </prototype>"))
    return usda.prim("Xform", "prototype", ball("ball", bound=bound), specifier="class") + "".join(
        usda.prim("Xform", f"above{i}", *of_instance(primvars, i), copy, at=place) for i, place in enumerate(PLACES))


def copies(primvars, bound=False):
    return "".join(ball(f"copy{i}", *of_instance(primvars, i), at=place, bound=bound) for i, place in enumerate(PLACES))


def render(folder, name, text, *arguments):
    return shot(folder, HEAD + text, "--imageWidth", "48", "--samples", "16", "--strict", *arguments, name=name)


def same(folder, primvars, *arguments, make=instanced, **more):
    a = color(render(folder, "instances", make(primvars, **more), *arguments))
    b = color(render(folder, "copies", copies(primvars, **more), *arguments))
    assert a.std() > 0.05  # something is seen
    # A prototype's place is rounded otherwise than a copy's: a ray that grazes an edge may go another way. That is one
    # sample of 16 of a pixel, of either sign.
    away = abs(a - b).max(axis=2)
    assert np.mean(away > 2e-3) < 0.05 and away.max() < 2.0 / 16
    assert abs((a - b).mean()) < 1e-3
    return a


def test_colours_are_those_of_each_instance(tmp_path):
    image = same(tmp_path, {"displayColor": ("color3f", COLOURS)})
    for channel, (x, y, _) in enumerate(PLACES):  # ten units away, a frame of four units
        pixel = image[int(24 - 12 * y), int(24 + 12 * x)]
        assert pixel.argmax() == channel and pixel[channel] > 2.0 * np.delete(pixel, channel).max()


def test_opacity_lets_shadows_and_eyes_through(tmp_path):
    same(tmp_path, {"displayOpacity": ("float", [0.2, 1, 0.6])})


def test_materials_read_them_by_name(tmp_path):
    same(tmp_path, {"tint": ("color3f", COLOURS)}, bound=True)


def test_native_instances_are_like_copies(tmp_path):
    same(tmp_path, {"tint": ("color3f", COLOURS), "glow": ("color3f", [(0, 0, 0), (0.3, 0.3, 0), (0, 0, 0)])}, bound=True,
         make=native)


def test_what_glows_by_them_lights_alike(tmp_path):
    """Light of a mesh is sampled by what each instance emits."""
    floor = usda.prim("Cube", "wall", size=6, at=(0, 0, -3.7))
    primvars = {"glow": ("color3f", [(9, 0, 0), (0, 0, 0), (0, 0, 9)])}
    images = [color(render(tmp_path, name, make(primvars, bound=True) + floor, "--samples", "256"))
              for name, make in (("instances", instanced), ("copies", copies))]
    for side, channel in ((slice(0, 24), 0), (slice(24, 48), 2)):  # the walls beside the balls
        a, b = (image[:, side, channel].mean() for image in images)
        assert a == pytest.approx(b, rel=0.03)


def test_the_prims_own_value_wins(tmp_path):
    own = primvar("color3f", "displayColor", [(0.3, 0.3, 0.9)])
    image = color(render(tmp_path, "instances", instanced({"displayColor": ("color3f", COLOURS)}, own)))
    plain = color(render(tmp_path, "plain", instanced({}, own)))
    assert np.array_equal(image, plain)


def test_the_rasterizer_shows_them_too(tmp_path):
    needs_opengl()
    same(tmp_path, {"displayColor": ("color3f", COLOURS)}, "--backend", "raster")
    # The light let through is drawn by lot, by the numbers of prims: alike in the mean of a ball's middle.
    primvars = {"displayOpacity": ("float", [1, 0.4, 1])}
    a, b = (color(render(tmp_path, name, make(primvars), "--backend", "raster", "--samples", "64"))[9:15, 21:27].mean()
            for name, make in (("instances", instanced), ("copies", copies)))
    opaque = color(render(tmp_path, "opaque", instanced({}), "--backend", "raster"))[9:15, 21:27].mean()
    assert a == pytest.approx(b, rel=0.05) and a > 1.1 * opaque


def test_aovs_show_values_and_ids_of_instances(tmp_path):
    import _patina

    image = render(tmp_path, "aovs", instanced({"tint": ("color3f", COLOURS)}), "--aov", "primvars:instanceId", "--aov",
                   "primvars:tint")
    found = _patina.read_image(str(image))
    data = {name: np.array(found.pixels)[..., i] for i, name in enumerate(found.channels)}
    ids = next(v for k, v in data.items() if k.startswith("primvars:instanceId"))
    tints = [v for k, v in data.items() if k.startswith("primvars:tint")][:3]
    for (x, y, _), own, tint in zip(PLACES, (7, 3, 5), COLOURS):
        at = int(24 - 12 * y), int(24 + 12 * x)
        assert ids[at] == own
        assert [t[at] for t in tints] == pytest.approx(tint, abs=1e-5)


def test_too_few_values_are_told(tmp_path):
    stage = tmp_path / "few.usda"
    stage.write_text(HEAD + instanced({"displayColor": ("color3f", COLOURS[:2])}))
    process = patina("record", stage, tmp_path / "few.exr", "--imageWidth", 16, "--samples", 1)
    assert os.path.exists(tmp_path / "few.exr")
    assert "/balls" in process.stderr and "displayColor" in process.stderr
