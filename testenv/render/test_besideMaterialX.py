# SPDX-License-Identifier: Apache-2.0
"""Layered materials have the brightness that MaterialX's own shaders give them."""
import glob
import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest

from patina.experiment import LUMINANCE
from rendering import pixels, shot
import usda

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "..", "..", "shared", "assets", "materialx")
STAGE = usda.stage(
    usda.camera(flat=(20, 20), clippingRange=(0.1, 10), at=(0, 0, 5)),
    usda.prim("DomeLight", "sky"),
    usda.prim("Scope", "materials", meta=("references = @%(document)s@</MaterialX>",)),
    usda.prim("Sphere", "ball", bind="materials/Materials/%(material)s"))

# A white base, a grey and a dark one, each in a channel.
BASES = "0.8, 0.4, 0.05"
COLOR = {"standard_surface": "base_color", "open_pbr_surface": "base_color", "gltf_pbr": "base_color",
         "UsdPreviewSurface": "diffuseColor"}
MATERIALS = {
    "standardPlastic": ("standard_surface", {"base": 1.0, "specular_roughness": 0.3}),
    "standardCoat": ("standard_surface", {"base": 1.0, "specular_roughness": 0.5, "coat": 1.0, "coat_roughness": 0.1}),
    "standardSheen": ("standard_surface", {"base": 1.0, "specular": 0.0, "sheen": 1.0, "sheen_roughness": 0.5}),
    "standardMetal": ("standard_surface", {"base": 1.0, "metalness": 1.0, "specular_roughness": 0.3}),
    "openPbrPlastic": ("open_pbr_surface", {"specular_roughness": 0.3}),
    "openPbrCoat": ("open_pbr_surface", {"specular_roughness": 0.5, "coat_weight": 1.0, "coat_roughness": 0.1}),
    "openPbrFuzz": ("open_pbr_surface", {"specular_roughness": 0.5, "fuzz_weight": 1.0, "fuzz_roughness": 0.5}),
    "openPbrMetal": ("open_pbr_surface", {"base_metalness": 1.0, "specular_roughness": 0.3}),
    "gltfPlastic": ("gltf_pbr", {"metallic": 0.0, "roughness": 0.5}),
    "gltfCoat": ("gltf_pbr", {"metallic": 0.0, "roughness": 0.5, "clearcoat": 1.0, "clearcoat_roughness": 0.1}),
    "previewPlastic": ("UsdPreviewSurface", {"roughness": 0.5}),
    "previewCoat": ("UsdPreviewSurface", {"roughness": 0.5, "clearcoat": 1.0, "clearcoatRoughness": 0.1}),
    "previewMetal": ("UsdPreviewSurface", {"roughness": 0.3, "metallic": 1.0}),
}


def document():
    lines = ['<?xml version="1.0"?>', '<materialx version="1.39">']
    for name, (model, inputs) in MATERIALS.items():
        lines.append(f'<{model} name="{name}Surface" type="surfaceshader">')
        lines.append(f'<input name="{COLOR[model]}" type="color3" value="{BASES}"/>')
        lines += [f'<input name="{key}" type="float" value="{value}"/>' for key, value in inputs.items()]
        lines += [f"</{model}>", f'<surfacematerial name="{name}" type="material">',
                  f'<input name="surfaceshader" type="surfaceshader" nodename="{name}Surface"/>', "</surfacematerial>"]
    return "\n".join([*lines, "</materialx>"])


def theirs(path, *materials):
    """:returns: the means that MaterialX's GLSL has; skips where it cannot be drawn"""
    pytest.importorskip("MaterialX.PyMaterialXRenderGlsl")
    if not shutil.which("xvfb-run"):
        pytest.skip("MaterialX draws in a window, and there is no xvfb-run")
    done = subprocess.run(["xvfb-run", "-a", sys.executable, os.path.join(HERE, "materialxBall.py"), str(path), *materials],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def ours(path, material, folder):
    """:returns: mean RGB over the same pixels of a path traced ball"""
    text = STAGE % {"document": path, "material": material}
    image = pixels(shot(folder, text, "-w", "48", "--samples", "256", "--camera", "/camera"))[..., :3]
    y, x = (2.0 * (np.indices(image.shape[:2]) + 0.5) / len(image) - 1.0)
    return image[np.hypot(x, y) < 1.0 - 2.0 / len(image)].mean(0)


# By the specification it reflects its albedo at all angles, in MaterialX it is a conductor: the dark channel is a third apart.
OWN_CURVE = "previewMetal"


def test_layers_are_as_bright_as_in_materialx(tmp_path):
    """One test for all, as MaterialX's compiler of shaders starts once."""
    document_path = tmp_path / "layers.mtlx"
    document_path.write_text(document())
    means, apart = theirs(document_path), {}
    for material in MATERIALS:
        found, expected = ours(document_path, material, tmp_path), np.array(means[material])
        if material == OWN_CURVE:
            found, expected = found @ LUMINANCE, expected @ LUMINANCE
        if found != pytest.approx(expected, rel=0.03):
            apart[material] = (found, expected)
    assert not apart


# Neither textures, nor light below the surface and within glass, nor films, which MaterialX's shaders take from RGB alone.
PLAIN = ("gltf_pbr_carpaint", "gltf_pbr_gold", "gltf_pbr_plastic", "standard_surface_carpaint", "standard_surface_chrome",
         "standard_surface_copper", "standard_surface_default", "standard_surface_gold", "standard_surface_greysphere",
         "standard_surface_metal_brushed", "standard_surface_plastic", "standard_surface_velvet",
         "usd_preview_surface_carpaint", "usd_preview_surface_default", "usd_preview_surface_gold",
         "usd_preview_surface_plastic")


@pytest.mark.parametrize("name", PLAIN)
def test_materialx_own_examples_are_as_bright(name, tmp_path):
    files = glob.glob(os.path.join(EXAMPLES, "*", f"{name}.mtlx"))
    if not files:
        pytest.skip(f"{name}.mtlx is not there")
    (material, expected), = theirs(files[0]).items()
    assert ours(files[0], material, tmp_path) @ LUMINANCE == pytest.approx(np.array(expected) @ LUMINANCE, rel=0.03)
