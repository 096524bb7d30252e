# SPDX-License-Identifier: Apache-2.0
"""Nodes that inputs of lights are connected to, against the same values as authored and against closed forms."""
import os

import numpy as np
import pytest

from inProcess import Stage
from lightStages import ABOVE, DOWN, light
from lightStages import stage as floor_under
from rendering import SCENES
from usda import prim

TEXTURE = os.path.join(SCENES, "textures", "checker.png")
NODES = prim("Scope", "rig",
    prim("Shader", "double", 'uniform token info:id = "ND_multiply_float"', "float inputs:in1 = 1.5", "float inputs:in2 = 2",
         "float outputs:out"),
    prim("Shader", "tint", 'uniform token info:id = "ND_multiply_color3FA"', "color3f inputs:in1 = (0.25, 0.5, 0.75)",
         "float inputs:in2.connect = </rig/double.outputs:out>", "color3f outputs:out"),
    prim("Shader", "image", 'uniform token info:id = "ND_image_color3"',
         'asset inputs:file = @%s@ (colorSpace = "srgb_texture")', "color3f outputs:out"),
    prim("Shader", "square", 'uniform token info:id = "ND_multiply_color3"',
         "color3f inputs:in1.connect = </rig/image.outputs:out>", "color3f inputs:in2.connect = </rig/image.outputs:out>",
         "color3f outputs:out"),
    prim("Shader", "place", 'uniform token info:id = "ND_position_vector3"', "vector3f outputs:out"),
    prim("Shader", "up", 'uniform token info:id = "ND_dotproduct_vector3"',
         "vector3f inputs:in1.connect = </rig/place.outputs:out>", "vector3f inputs:in2 = (0, 1, 0)", "float outputs:out"),
    prim("Shader", "grey", 'uniform token info:id = "ND_convert_float_color3"',
         "float inputs:in.connect = </rig/up.outputs:out>", "color3f outputs:out")) % TEXTURE
BOTH = pytest.mark.parametrize("backend", ["embree", "raster"])


COLOR = "color3f inputs:color.connect = </rig/%s.outputs:out>"


def rendered(folder, lamp, backend="embree", samples=16, nodes=NODES, bound="white"):
    """:returns: an image of the floor, and the warnings"""
    path = folder / "stage.usda"
    path.write_text(floor_under(lamp, nodes).replace("binding = </white>", f"binding = </{bound}>"))
    stage = Stage(path, "--camera", "/camera", "--imageWidth", 8, "--imageHeight", 8, "--samples", samples,
                  "--backend", backend)
    image = stage.image(1)
    return image, [f"{w['prim']} {w['input']}: {w['message']}" for w in stage.scene.warnings()]

CONSTANT = {"color": "color3f inputs:color.connect = </rig/tint.outputs:out>",
            "exposure": "float inputs:exposure.connect = </rig/double.outputs:out>"}
VALUES = {"color": "color3f inputs:color = (0.75, 1.5, 2.25)", "exposure": "float inputs:exposure = 3"}
KINDS = {"SphereLight": ABOVE, "RectLight": DOWN, "DistantLight": DOWN, "DomeLight": {}}


@BOTH
@pytest.mark.parametrize("kind", KINDS)
def test_constant_nodes_are_values(tmp_path, kind, backend):
    fixed = "float inputs:intensity = 0.5"  # a distant light's own is large
    given, warned = rendered(tmp_path, light(kind, fixed, *CONSTANT.values(), place=KINDS[kind]), backend)
    wanted, _ = rendered(tmp_path, light(kind, fixed, *VALUES.values(), place=KINDS[kind]), backend)
    assert np.array_equal(given, wanted) and given.min() > 0 and not warned


@BOTH
@pytest.mark.parametrize("kind", ["DomeLight", "RectLight"])
def test_an_image_node_is_the_texture(tmp_path, kind, backend):
    """Its texture coordinates are those of the light's own texture. The texture has as many texels as an image of nodes has at
    least, so that both are the same, but for the rounding of coordinates."""
    import _patina

    texels = np.random.default_rng(5).random((256, 512, 3)).astype(np.float32)
    _patina.write_image(str(tmp_path / "noise.exr"), texels, ["R", "G", "B"], {"half": False})
    sizes = ["float inputs:width = 3", "float inputs:height = 2"] if kind == "RectLight" else []
    node = NODES.replace(f'@{TEXTURE}@ (colorSpace = "srgb_texture")', f"@{tmp_path / 'noise.exr'}@")
    given, warned = rendered(tmp_path, light(kind, *sizes, COLOR % "image", place=KINDS[kind]), backend, nodes=node)
    file = f'asset inputs:texture:file = @{tmp_path / "noise.exr"}@'
    wanted, _ = rendered(tmp_path, light(kind, *sizes, file, place=KINDS[kind]), backend)
    assert given == pytest.approx(wanted, rel=1e-4) and given.min() > 0 and not warned


@BOTH
def test_a_sky_of_nodes(tmp_path, backend):
    """A sky of radiance cos(theta) about the zenith has the irradiance 2 pi / 3. Negative values are black."""
    image, warned = rendered(tmp_path, light("DomeLight", COLOR % "grey", place={}), backend, samples=256)
    # Samples follow radiance times cosine; the image's cells are 180 / 256 degrees high, over which a cosine is linear to 2e-5.
    assert image.mean() == pytest.approx(0.5 / np.pi * 2 * np.pi / 3, rel=0.01) and not warned


def test_nodes_multiply_a_texture(tmp_path):
    given, _ = rendered(tmp_path, light("DomeLight", COLOR % "image", f"asset inputs:texture:file = @{TEXTURE}@", place={}))
    squared, _ = rendered(tmp_path, light("DomeLight", COLOR % "square", place={}))
    assert given.mean() == pytest.approx(squared.mean(), rel=0.02)


def test_what_no_light_can_take_is_told(tmp_path):
    color = "color3f inputs:color = (1, 0.5, 0.25)"
    image, warned = rendered(tmp_path, light("SphereLight", COLOR % "grey", color, place=ABOVE))
    wanted, _ = rendered(tmp_path, light("SphereLight", color, place=ABOVE))
    assert np.array_equal(image, wanted)
    assert warned == ["/light inputs:color: is connected to /rig/grey, which gives no value that this light can take; its own "
                      "value is used"]


@BOTH
@pytest.mark.parametrize("output, more", [("mtlx:light", ""), ("light", ""), ("mtlx:light", "surface")])
def test_a_light_shader_on_geometry_shines(tmp_path, output, more, backend):
    """A material whose only shader is MaterialX's light: its radiance is edf * intensity * 2^exposure. Surfaces come first."""
    look = prim("Material", "lamp", f"token outputs:{output}.connect = </lamp/light.outputs:out>",
        prim("Shader", "edf", 'uniform token info:id = "ND_uniform_edf"', "color3f inputs:color = (0.5, 0.25, 0.125)",
             "token outputs:out"),
        prim("Shader", "light", 'uniform token info:id = "ND_light"', "token inputs:edf.connect = </lamp/edf.outputs:out>",
             "float inputs:intensity = 3", "float inputs:exposure = 1", "token outputs:out"),
        prim("Shader", "black", 'uniform token info:id = "ND_surface"', "token outputs:out"),
        "token outputs:mtlx:surface.connect = </lamp/black.outputs:out>" if more else "")
    image, warned = rendered(tmp_path, look, backend, nodes="", bound="lamp")
    wanted = [0, 0, 0] if more else [3, 1.5, 0.75]
    assert image == pytest.approx(np.broadcast_to(wanted, image.shape), rel=1e-6)
    assert warned == (["/lamp outputs:mtlx:light: a light shader is drawn where there is no surface; it is ignored"]
                      if more else [])
