# SPDX-License-Identifier: Apache-2.0
"""Bad input gives a message that names the prim, and an image where there can be one."""
import json
import os

import numpy as np
import pytest

from rendering import color, patina, pixels, record, scene, shot
from usda import ST, camera, material, preview, prim
from usda import stage as stage_of

HEAD = '#usda 1.0\n(\n    upAxis = "Y"\n)\n'
CAMERA = camera(at=(0, 0, 5)) + prim("DomeLight", "dome", intensity=1)
GOOD = {"faceVertexCounts": [4], "faceVertexIndices": [0, 1, 2, 3], "subdivisionScheme": "none",
        "points": [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]}
PREVIEW = preview("material")
TINY = ("--imageWidth", 32, "--imageHeight", 32, "--samples", 4)


def render(tmp_path, text, *arguments, check=True):
    """:returns: the process, the image path and the warnings"""
    stage, image, out = tmp_path / "stage.usda", tmp_path / "image.exr", tmp_path / "out.json"
    stage.write_text(HEAD + CAMERA + text)
    process = record(stage, image, *TINY, f"--json={out}", *arguments, check=check)
    warnings = json.loads(out.read_text())["warnings"] if out.exists() else []
    return process, image, warnings


def mentions(warnings, *words):
    return any(all(word in json.dumps(w) for word in words) for w in warnings)


def quad(*lines, **changes):
    return prim("Mesh", "quad", *lines, bind="material", **{**GOOD, **changes})


NAN, INF = float("nan"), float("inf")


@pytest.mark.parametrize("scheme", ["none", "catmullClark", "loop", "bilinear"])
@pytest.mark.parametrize("change, word", [
    ({"faceVertexIndices": [0, 1, 2, 9]}, "faceVertexIndices"),
    ({"faceVertexIndices": [0, 1, -2, 3]}, "faceVertexIndices"),
    ({"faceVertexCounts": [5]}, "faceVertex"),
    ({"faceVertexCounts": [2, 4], "faceVertexIndices": [0, 1, 0, 1, 2, 3]}, "face"),
    ({"points": [(NAN, -1, 0), *GOOD["points"][1:]]}, "points"),
    ({"points": [(INF, -1, 0), *GOOD["points"][1:]]}, "points"),
    (['texCoord2f[] primvars:st = [(0, 0), (1, 1)] (interpolation = "vertex")'], "st"),
    (["int[] holeIndices = [7]"], "holeIndices"),
    (["int[] creaseIndices = [0, 1]", "int[] creaseLengths = [5]", "float[] creaseSharpnesses = [1]"], "crease"),
])
def test_broken_mesh(tmp_path, scheme, change, word):
    lines, changes = ((), change) if isinstance(change, dict) else (change, {})
    _, image, warnings = render(tmp_path, quad(*lines, **{"subdivisionScheme": scheme, **changes}) + PREVIEW)
    assert np.isfinite(pixels(image)).all()
    if word == "crease" and scheme in ("none", "bilinear") or word == "holeIndices" and scheme == "none":
        return  # the scheme does not read them
    assert mentions(warnings, "/quad", word), warnings


@pytest.mark.parametrize("points", [[], [(0, 0, 0)] * 4, [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)]])
@pytest.mark.parametrize("scheme", ["none", "catmullClark"])
def test_degenerate_faces_and_empty_meshes(tmp_path, points, scheme):
    _, image, _ = render(tmp_path, quad(points=points, subdivisionScheme=scheme) + PREVIEW)
    assert np.isfinite(pixels(image)).all()


def connected(inputs, **nodes):
    """:param inputs: of the surface"""
    return material("material", {"surface": ("UsdPreviewSurface", inputs), **nodes})


def test_missing_texture_is_magenta_and_named(tmp_path):
    text = quad(st=ST) + connected({"color3f emissiveColor": "<image>", "diffuseColor": (0, 0, 0)},
                                   image=("UsdUVTexture", {"file": "absent.png"}, "color3f rgb"))
    _, image, warnings = render(tmp_path, text)
    assert mentions(warnings, "/material/image", "absent.png"), warnings
    r, g, b = color(image)[16, 16]
    assert r > 0.5 and b > 0.5 and g < 0.3


def test_missing_primvar_uses_the_fallback_of_its_reader(tmp_path):
    text = quad() + connected({"color3f emissiveColor": "<reader>"}, reader=(
        "UsdPrimvarReader_float3", {"varname": "absent", "float3 fallback": (0, 5, 0)}))
    _, image, _ = render(tmp_path, text)
    r, g, b = color(image)[16, 16]
    assert g > 4 and r < 2 and b < 2


def test_cycle_in_a_network(tmp_path):
    text = quad() + connected({"color3f diffuseColor": "<a>"}, **{
        name: ("ND_multiply_color3", {"color3f in1": f"<{other}>"}, "color3f out") for name, other in ("ab", "ba")})
    _, image, warnings = render(tmp_path, text)
    assert mentions(warnings, "/material", "cycle"), warnings
    assert np.isfinite(pixels(image)).all()


def test_unknown_node(tmp_path):
    text = quad() + connected({"color3f diffuseColor": "<a>"}, a=("NoSuchNode", {}, "color3f out"))
    _, image, warnings = render(tmp_path, text)
    assert mentions(warnings, "/material/a", "NoSuchNode"), warnings


def test_type_mismatch(tmp_path):
    text = quad() + connected({"token roughness": "very"})
    _, image, warnings = render(tmp_path, text)
    assert mentions(warnings, "/material/surface", "roughness"), warnings
    assert np.isfinite(pixels(image)).all()


def test_binding_to_a_material_that_is_not_there(tmp_path):
    _, image, warnings = render(tmp_path, quad())
    assert color(image)[16, 16].max() > 0
    assert len(warnings) == 1 and "/material, which does not exist; the binding is left out" in warnings[0]["message"], warnings


def test_strict_turns_warnings_into_failure(tmp_path):
    process, image, _ = render(tmp_path, quad(faceVertexIndices=[0, 1, 2, 9]) + PREVIEW, "--strict", check=False)
    assert process.returncode == 1
    assert "/quad" in process.stderr


def fails(*arguments):
    process = patina(*arguments, check=False)
    assert process.returncode == 1, process.stderr
    assert "Traceback" not in process.stderr
    assert process.stderr.strip()
    return process.stderr


def test_camera_that_does_not_exist(tmp_path):
    assert "/nowhere" in fails("record", scene("furnace"), tmp_path / "a.exr", "--camera", "/nowhere")


def test_stage_that_does_not_exist(tmp_path):
    assert "absent.usda" in fails("record", tmp_path / "absent.usda", tmp_path / "a.exr")


@pytest.mark.parametrize("content", [b"", b"#usda 1.0\ndef Mesh {", b"PXR-USDC" + b"\0" * 90, b"PK\x03\x04junk"])
@pytest.mark.parametrize("suffix", ["usd", "usda", "usdc", "usdz"])
def test_unreadable_stage(tmp_path, content, suffix):
    path = tmp_path / f"broken.{suffix}"
    path.write_bytes(content)
    assert "broken" in fails("record", path, tmp_path / "a.exr")


def test_truncated_crate(tmp_path):
    from pxr import Usd

    Usd.Stage.Open(scene("diffuseBox")).Export(str(tmp_path / "whole.usdc"))
    data = (tmp_path / "whole.usdc").read_bytes()
    (tmp_path / "cut.usdc").write_bytes(data[: len(data) // 2])
    fails("record", tmp_path / "cut.usdc", tmp_path / "a.exr")


def test_missing_sublayer_is_named_and_the_rest_rendered(tmp_path):
    out = tmp_path / "out.json"
    text = stage_of(CAMERA, quad(), up="", subLayers="[@missingLayer.usda@]")
    image = shot(tmp_path, text, *TINY, f"--json={out}")
    assert mentions(json.loads(out.read_text())["warnings"], "missingLayer.usda")
    assert color(image)[16, 16].max() > 0


@pytest.mark.parametrize("size", [("--imageWidth", 0), ("--imageWidth", 10, "--imageHeight", 0), ("--imageWidth", -5)])
def test_image_without_pixels(tmp_path, size):
    process = patina("record", scene("furnace"), tmp_path / "a.exr", *size, check=False)
    assert process.returncode in (1, 2) and "Traceback" not in process.stderr
    assert not (tmp_path / "a.exr").exists()


def test_unwritable_output(tmp_path):
    fails("record", scene("furnace"), tmp_path / "no" / "such" / "folder" / "a.exr", *TINY)
    fails("record", scene("furnace"), tmp_path / "a.noSuchFormat", *TINY)


def test_failed_render_keeps_the_image_that_was_there(tmp_path):
    image = tmp_path / "a.exr"
    record(scene("furnace"), image, *TINY)
    before = image.read_bytes()
    fails("record", scene("furnace"), image, "--camera", "/nowhere")
    stage = tmp_path / "bad.usda"
    stage.write_text("nonsense")
    fails("record", stage, image)
    assert image.read_bytes() == before
    assert set(os.listdir(tmp_path)) == {"a.exr", "bad.usda"}


def test_empty_stage_renders(tmp_path):
    assert np.isfinite(pixels(shot(tmp_path, "#usda 1.0\n", *TINY))).all()


def test_nan_in_lights_and_transforms(tmp_path):
    text = (quad() + PREVIEW + prim("SphereLight", "bad", intensity=NAN, at=(NAN, 0, 1))
            + prim("SphereLight", "none", radius=0, scale=(0, 0, 0)))
    _, image, warnings = render(tmp_path, text)
    assert np.isfinite(pixels(image)).all()
    assert mentions(warnings, "/bad"), warnings


def test_usage_errors_have_status_2():
    for arguments in ([], ["nonsense"], ["record"], ["record", "--noSuchFlag"]):
        process = patina(*arguments, check=False)
        assert process.returncode == 2, arguments
        assert "Traceback" not in process.stderr
