# SPDX-License-Identifier: Apache-2.0
"""Whole files: broken ones, composition errors, models drawn as boxes, and every asset that is there."""
import os
from pathlib import Path

import numpy as np
import pytest

from patina.stage import StageError, open_stage


def test_files_that_cannot_be_opened(tmp_path):
    from pxr import Usd
    whole = tmp_path / "whole.usdc"
    stage = Usd.Stage.CreateNew(str(whole))
    stage.DefinePrim("/a", "Sphere")
    stage.Save()
    data = whole.read_bytes()
    (tmp_path / "cut.usdc").write_bytes(data[:len(data) // 2])
    (tmp_path / "text.usda").write_text("#usda 1.0\ndef Sphere {{{")
    (tmp_path / "noise.usd").write_bytes(os.urandom(256))
    (tmp_path / "empty.usdc").write_bytes(b"")
    (tmp_path / "cut.usdz").write_bytes(b"PK\3\4 and no more")
    for name in ("cut.usdc", "text.usda", "noise.usd", "empty.usdc", "cut.usdz", "missing.usda", "."):
        with pytest.raises(StageError) as error:
            open_stage(str(tmp_path / name))
        assert "\n" not in str(error.value) and str(tmp_path) in str(error.value)


def test_composition_errors_name_the_prim(read):
    reading = read("""(subLayers = [@./nolayer.usda@])
    def Xform "a" (references = @./nofile.usda@) { }
    def Xform "b" (payload = </nowhere>) { }
    def Sphere "fine" { }""")
    said = "\n".join(reading.warnings)
    assert "nolayer.usda" in said and "/a : " in said and "nofile.usda" in said and "/b : " in said
    assert reading.has("/fine")
    assert len(reading.warnings) == 3  # once each


def test_values_of_wrong_types_are_named(read):
    reading = read("""
    def Sphere "s" { token radius = "wide" }
    def Sphere "t" { string xformOp:translate = "far"  uniform token[] xformOpOrder = ["xformOp:translate"] }
    def Camera "c" { token focalLength = "long"  float clippingRange = 3  token shutter:open = "now" }
    def SphereLight "l" { float[] inputs:color = [1]  token inputs:intensity = "bright" }
    def RectLight "r" { float inputs:texture:file = 3 }""", frame=1.0)
    said = "\n".join(reading.warnings)
    for part in ("/s radius:", "/t xformOpOrder:", "/c focalLength:", "/c clippingRange:", "/c shutter:open:",
                 "/l inputs:color:", "/l inputs:intensity:", "/r inputs:texture:file:"):
        assert part in said, said
    for path in ("/s", "/t", "/c", "/l", "/r"):
        assert reading.has(path)


def test_models_drawn_as_boxes(read):
    reading = read("""def Xform "model" (kind = "component"; prepend apiSchemas = ["GeomModelAPI"]) {
        uniform token model:drawMode = "bounds"  float3 model:drawModeColor = (1, 0, 0)
        def Sphere "s" { } }
    def Xform "plain" (kind = "component") { def Sphere "s" { } }""")
    box = reading.prim("/model")
    assert box["kind"] == "Curves" and box["primvar displayColor constant x3"] == "1 0 0"
    assert not reading.has("/model/s") and reading.has("/plain/s")


def test_models_drawn_as_their_basis_vectors(read, numbers):
    """Of unit length, whatever the model's size, and where it has none."""
    reading = read("""def Xform "model" (kind = "component"; prepend apiSchemas = ["GeomModelAPI"]) {
        uniform token model:drawMode = "origin"  %s }""" % 'def Sphere "s" { double radius = 9 }')
    axes = reading.prim("/model")
    assert numbers(axes["points"]) == [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]
    empty = read("""def Xform "model" (kind = "component"; prepend apiSchemas = ["GeomModelAPI"]) {
        uniform token model:drawMode = "origin" }""")
    assert empty.prim("/model")["points"] == axes["points"]


def test_models_drawn_as_cards(read, numbers, tmp_path):
    (tmp_path / "x.png").write_bytes(b"png")
    text = """def Xform "model" (kind = "component"; prepend apiSchemas = ["GeomModelAPI"]) {
        uniform token model:drawMode = "cards"  uniform token model:cardGeometry = "%s"  %s
        def Cube "c" { double size = 2 } }"""
    box = read(text % ("box", "asset model:cardTextureXPos = @./x.png@"))
    assert numbers(box.prim("/model/cardXPos")["points"]) == [1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1]
    assert box.prim("/model/cardXNeg")["material"] == '"/model/cardXNeg/material"'
    assert box.prim("/model/cardXPos/material")["filename file"] == f'"{tmp_path}/x.png"'
    made = box.prim("/model/cardXPos/material")  # with the roughness that UsdPreviewSurface has, as in UsdImaging
    assert not any("roughness" in field for field in made) and sum(value == '"clamp"' for value in made.values()) == 2, made
    assert not box.has("/model/cardYPos") and not box.has("/model/c")
    cross = read(text % ("cross", "asset model:cardTextureXPos = @./none.png@"))
    assert numbers(cross.prim("/model/cardZPos")["points"])[2::3] == [0, 0, 0, 0]
    assert not cross.has("/model/cardZNeg")
    assert any("model:cardTextureXPos: there is no file" in w for w in cross.warnings)


def test_cards_stand_where_their_pictures_were_taken(read, numbers, tmp_path):
    import _patina

    # Takes the model's square of 4 by 2 units around (10, 0, 3) to the screen.
    matrix = "0.5, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, -5, 0, -3, 1"
    for name, metadata in (("x", {"worldtoscreen": matrix}), ("old", {"worldToNDC": matrix}), ("none", {})):
        _patina.write_image(str(tmp_path / (name + ".png")), np.ones((2, 2, 4), np.float32), metadata=metadata)
    cards = read("""def Xform "model" (kind = "component"; prepend apiSchemas = ["GeomModelAPI"]) {
        uniform token model:drawMode = "cards"  uniform token model:cardGeometry = "fromTexture"
        asset model:cardTextureXPos = @./x.png@  asset model:cardTextureZNeg = @./old.png@
        asset model:cardTextureYPos = @./none.png@
        def Cube "c" { double size = 2 } }""")
    for name in ("XPos", "ZNeg"):
        assert numbers(cards.prim("/model/card" + name)["points"]) == [8, -1, 3, 12, -1, 3, 12, 1, 3, 8, 1, 3]
    assert not cards.has("/model/cardYPos") and not cards.has("/model/cardXNeg")
    assert any("no worldtoscreen matrix" in w for w in cards.warnings)


def test_metadata(read):
    info = read('(metersPerUnit = 1; upAxis = "Z"; startTimeCode = 3; endTimeCode = 9; timeCodesPerSecond = 30)').info
    assert (info.meters_per_unit, info.up_axis, info.start_time_code, info.end_time_code,
            info.time_codes_per_second) == (1.0, "Z", 3.0, 9.0, 30.0)


def test_reading_twice_gives_the_same(read):
    text = 'def Sphere "s" { color3f[] primvars:displayColor = [(1, 0, 0)] }'
    assert read(text).text == read(text).text


def _assets():
    root = os.environ.get("PATINA_ASSETS")
    if not root:
        return [pytest.param(None, marks=pytest.mark.skip(reason="PATINA_ASSETS is not set"))]
    return sorted(os.path.join(folder, name) for folder, _, names in os.walk(root) for name in names
                  if name.endswith((".usd", ".usda", ".usdc", ".usdz")))


@pytest.mark.parametrize("path", _assets(), ids=lambda p: os.path.basename(p or "none"))
def test_every_asset_is_read(read, path):
    try:
        open_stage(path)
    except StageError as error:
        pytest.skip(str(error))
    reading = read(Path(path))
    assert reading.info.camera
    assert not [w for w in reading.warnings if "cannot be read" in w]
