# SPDX-License-Identifier: Apache-2.0
"""Both hosts make the same scene of a stage: as text, and bit for bit as an image.

Values that Hydra changes on the way, which the text may therefore not show, are taken out of both texts by
sceneText; what it changes in the picture stands in the tables below, with the reason and a bound."""
import os

import numpy as np
import pytest

import hydraBuild
import sceneText
import stages
from patina import experiment
from rendering import color
import usda

HERE = os.path.dirname(os.path.abspath(__file__))

MODES = pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
SAMPLES = 4
SEED = 3

# scene -> (relMSE that is allowed, why it cannot be the same to the bit)
NOT_EQUAL = {"instances.usda": (1e-4, "Hydra multiplies a prototype's own transform into its instances: rounding differs")}
# UsdImagingDelegate makes coarse meshes without texture coordinates of spheres, cubes and the like. Pictures of
# such scenes agree in their mean only.
MEAN_DIFFERS = 0.1
# asset -> mode -> (relMSE that is allowed, or None where the two show different things; why)
OLD_LIGHT = (None, "its light has the names of inputs from before OpenUSD 21.02, which UsdImaging does not read")
WRONG_POINTS = (0.05, "UsdImaging leaves out points of wrong types, which the reader can use")
DRAW_MODES = (None, "both make cards, boxes and origins, each of its own shapes and materials; how they look is not compared")
SKELETON = {"delegate": (0.01, "UsdImagingDelegate skins points, but not normals"),
            "sceneIndex": (None, "this release's scene index of UsdSkelImaging skins nothing")}
ASSETS_NOT_EQUAL = {
    "Teapot/DrawModes.usd": {"delegate": DRAW_MODES, "sceneIndex": DRAW_MODES},
    "test_assets/NormalsTextureBiasAndScale/NormalsTextureBiasAndScale.usda": {
        "delegate": OLD_LIGHT, "sceneIndex": OLD_LIGHT},
    "test_assets/NormalsTextureBiasAndScale/NormalsTextureBiasAndScale.usdz": {
        "delegate": OLD_LIGHT, "sceneIndex": OLD_LIGHT},
    "test_assets/USDZ/BrainStem/BrainStem.usdz": SKELETON,
    "test_assets/USDZ/CesiumMan/CesiumMan.usdz": SKELETON,
    "test_assets/foundation/stage_composition/over.usda": {
        "sceneIndex": (0.01, "UsdImaging's scene index draws a prim of which there are only overs")},
    "test_assets/schemaTests/usdGeom/meshes/points_types/pointsTypes.usda": {
        "delegate": WRONG_POINTS, "sceneIndex": WRONG_POINTS},
}


def render_with_reader(shot):
    """:returns: float array (height, width, 3): what the Python host renders

    Interactive, as Hydra is: Embree's quick hierarchies decide otherwise between triangles with a common edge."""
    import _patina

    film, renderer = _patina.Film(), _patina.make_renderer("embree")
    settings = {"width": shot.size[0], "height": shot.size[1], "samples": SAMPLES, "seed": SEED,
                "interactive": True}
    experiment.draw(renderer, shot.scene, shot.camera, settings, film)
    return np.array(film.resolve("color"))[..., :3]


def render_with_hydra(shot, folder, scene_index):
    """:returns: the same through Hydra, and the scene as text"""
    image, dump = folder / "hydra.exr", folder / "hydra.txt"
    hydraBuild.run_host(shot.stage, image, *shot.host_flags(), "--set", f"samples={SAMPLES}", "--set", f"seed={SEED}",
                        "--dump", dump, scene_index=scene_index)
    return color(image), dump.read_text()


def rel_mse(found, wanted):
    return float(((found - wanted) ** 2 / (wanted ** 2 + 0.01)).mean())


def compare(shot, image, scene_index, bound=0.0, reason=""):
    """Asserts that Hydra's picture is the reader's: to the bit, or within a bound of relMSE, for a reason."""
    wanted = render_with_reader(shot)
    assert np.isfinite(image).all()
    if bound is None:
        return
    if not scene_index and "\nImplicit " in shot.scene.dump():
        # Of the light, not of the mean: where a light takes some away, the mean is near zero.
        assert image.mean() == pytest.approx(wanted.mean(), abs=MEAN_DIFFERS * float(np.abs(wanted).mean()))
    elif bound > 0:
        assert rel_mse(image, wanted) <= bound, reason
    else:
        different = (image != wanted).any(axis=2)
        assert int(different.sum()) == 0, f"pixels differ, relMSE {rel_mse(image, wanted)}"


@MODES
@pytest.mark.parametrize("stage", [s for s in stages.scenes() if stages.name_of(s) != "portals.usda"], ids=stages.name_of)
def test_scene(tmp_path, stage, scene_index):
    name = stages.name_of(stage)
    if name == "motionBlur.usda":
        hydraBuild.skip_before(2411, "scene indices hand on no samples of motion" if scene_index else
                               "UsdImagingDelegate hands on values of the shutter's ends in place of the samples beyond")
    if name == "lightCylinder.usda" and scene_index:
        hydraBuild.skip_before(2411, "scene indices leave cylinder lights out")
    shot = stages.Shot(stage, tmp_path)
    image, text = render_with_hydra(shot, tmp_path, scene_index)
    assert sceneText.difference(text, shot.scene.dump(), native_shapes=scene_index) == ""
    compare(shot, image, scene_index, *NOT_EQUAL.get(name, ()))


@MODES
def test_portals(tmp_path, scene_index):
    """A UsdImagingDelegate passes no portals on: its picture is that of a dome without them, to the bit."""
    stage = os.path.join(stages.SCENES, "portals.usda")
    wanted = stages.Shot(stage, tmp_path)
    if not scene_index:
        with open(stage, encoding="utf-8") as file:
            text = file.read().replace("@textures/", f"@{stages.SCENES}/textures/")
        line = "        rel portals = </World/window>\n"
        assert line in text
        plain = tmp_path / "plain.usda"
        plain.write_text(text.replace(line, ""))
        wanted = stages.Shot(str(plain), tmp_path)
    image, dump = render_with_hydra(stages.Shot(stage, tmp_path), tmp_path, scene_index)
    assert sceneText.difference(dump, wanted.scene.dump(), native_shapes=scene_index) == ""
    compare(wanted, image, scene_index)


LENSES = {
    "fisheye": ('token patina:projection = "fisheyeEquisolid"', "float patina:fieldOfView = 150"),
    "spherical": ('string arnold:camera = "spherical_camera"',),
    "cylindrical": ('token primvars:patina:projection = "cylindrical"', "float patina:verticalFieldOfView = 70"),
    "stereo": ('token patina:stereo = "overUnder"', "float patina:interocularDistance = 0.3",
               "float patina:convergenceDistance = 6"),
    "blades": ("int ri:camera:aperturensides = 5", "float patina:apertureAspect = 2", "float fStop = 1",
               "float focusDistance = 4"),
    "distortion": ("float patina:distortionK1 = -0.2",)}


@MODES
@pytest.mark.parametrize("lens", LENSES)
def test_lenses(tmp_path, lens, scene_index):
    with open(os.path.join(stages.SCENES, "lightSphere.usda"), encoding="utf-8") as file:
        text = file.read()
    line = "        float2 clippingRange = (0.01, 10000)\n"
    assert line in text
    shot = stages.shot_of(text.replace(line, line + "".join(f"        {attribute}\n" for attribute in LENSES[lens])), tmp_path)
    image, dump = render_with_hydra(shot, tmp_path, scene_index)
    plain = stages.Shot(os.path.join(stages.SCENES, "lightSphere.usda"), tmp_path)
    assert sceneText.difference(dump, plain.scene.dump(), native_shapes=scene_index) != ""
    assert sceneText.difference(dump, shot.scene.dump(), native_shapes=scene_index) == ""
    compare(shot, image, scene_index)


@pytest.mark.slow
@MODES
@pytest.mark.parametrize("stage", stages.assets(), ids=stages.name_of)
def test_asset(tmp_path, stage, scene_index):
    """By the picture alone: names, paths and types that mean the same are spelt in many ways."""
    from patina import stage as reader

    try:
        shot = stages.Shot(stage, tmp_path)
    except reader.StageError as error:
        pytest.skip(f"this usd-core does not open it: {error}"[:160])
    unreadable = hydraBuild.unreadable(reader.open_stage(stage))
    if unreadable:
        pytest.skip(unreadable)
    image, _ = render_with_hydra(shot, tmp_path, scene_index)
    reasons = ASSETS_NOT_EQUAL.get(stages.name_of(stage), {})
    compare(shot, image, scene_index, *reasons.get("sceneIndex" if scene_index else "delegate", ()))


@MODES
def test_package(tmp_path, scene_index):
    """Textures inside of packages are found."""
    from pxr import UsdUtils

    package = tmp_path / "package.usdz"
    assert UsdUtils.CreateNewUsdzPackage(os.path.join(stages.SCENES, "texturedMesh.usda"), str(package))
    shot = stages.Shot(str(package), tmp_path)
    image, _ = render_with_hydra(shot, tmp_path, scene_index)
    plain = stages.Shot(os.path.join(stages.SCENES, "texturedMesh.usda"), tmp_path)
    compare(plain, image, scene_index)


TILED = (
    usda.prim("Mesh", "@name@", bind="@name@Look", faceVertexCounts=[4], faceVertexIndices=[0, 1, 2, 3],
              points="[(-2, @low@, 0), (2, @low@, 0), (2, @high@, 0), (-2, @high@, 0)]", subdivisionScheme="none",
              st=[(0, 0), (2, 0), (2, 1), (0, 1)])
    + usda.material("@name@Look", {
                    "surface": ("UsdPreviewSurface", {"diffuseColor": (0, 0, 0), "color3f emissiveColor": "<tiles>"}),
                    "tiles": ("UsdUVTexture", {"file": "@file@", "float2 st": "<st>"}),
                    "st": ("UsdPrimvarReader_float2", {"varname": "st"})}))


@MODES
@pytest.mark.parametrize("prefix", ["", "./"])
def test_tiles_in_and_beside_a_package(tmp_path, scene_index, prefix):
    """Paths that begin with a dot stay in the package, as OpenUSD resolves them; what is not there is magenta."""
    import _patina
    from pxr import Sdf

    text = stages.front(4, 4)
    for name, low, file in (("inside", 0, "in/a.<UDIM>.png"), ("beside", -2, "out/b.<UDIM>.png")):
        tiled = TILED.replace("@@file@@", f"@{prefix}{file}@")
        text += tiled.replace("@name@", name).replace("@low@", str(low)).replace("@high@", str(low + 2))
    (tmp_path / "stage.usda").write_text(text)
    for folder in ("in", "out"):
        (tmp_path / folder).mkdir()
        for tile, level in ((1001, 1.0), (1002, 0.25)):
            pixels = np.full((2, 2, 3), level, np.float32) * ((1, 0, 0) if folder == "in" else (0, 1, 0))
            _patina.write_image(str(tmp_path / folder / f"{'a' if folder == 'in' else 'b'}.{tile}.png"), pixels)
    package = str(tmp_path / "package.usdz")
    with Sdf.ZipFileWriter.CreateNew(package) as writer:
        for file in ("stage.usda", "in/a.1001.png", "in/a.1002.png"):
            writer.AddFile(str(tmp_path / file), file)
    shot = stages.Shot(package, tmp_path)
    image, _ = render_with_hydra(shot, tmp_path, scene_index)
    compare(shot, image, scene_index)
    assert image[8, 8].argmax() == 0 and (image[48:, :32].argmin(axis=2) == 1).all() == bool(prefix)


BOUND_TWICE = usda.stage(
    usda.mesh("triangle", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], "rel material:binding:full = </full>",
              "rel material:binding:preview = </preview>", scheme="", apis=("MaterialBindingAPI",)),
    usda.preview("full", diffuseColor=(1, 0, 0)),
    usda.prim("Material", "preview"),
    up="")


@MODES
def test_purpose_of_bindings(tmp_path, scene_index):
    """Final renders use the materials that are bound for them."""
    _, text = render_with_hydra(stages.shot_of(BOUND_TWICE, tmp_path), tmp_path, scene_index)
    assert 'material = "/full"' in text


@MODES
def test_mixed_shaders_and_back_shaders(tmp_path, scene_index):
    """One card mixes two surfaces; the other shows its back, which is green."""
    shot = stages.Shot(os.path.join(os.path.dirname(__file__), "mergeSurfaceShaders.usda"), tmp_path, width=32)
    image, text = render_with_hydra(shot, tmp_path, scene_index)
    assert sceneText.difference(text, shot.scene.dump(), native_shapes=scene_index) == ""
    compare(shot, image, scene_index)
    assert (np.abs(image - (0.0, 1.0, 0.0)) < 0.01).all(axis=2).sum() > 20


MODEL = usda.stage(
    usda.prim(
        "Xform", "model", 'uniform token model:drawMode = "%s"', "float3 model:drawModeColor = (1, 0.5, 0.1)",
        "float3[] extentsHint = [(0, 0, 0), (4, 3, 1)]",
        usda.mesh("triangle", [(0, 0, 0), (4, 0, 1), (0, 3, 0)], "float3[] extent = [(0, 0, 0), (4, 3, 1)]", scheme=""),
        meta=('kind = "component"; prepend apiSchemas = ["GeomModelAPI"]',)),
    up="")


@MODES
@pytest.mark.parametrize("draw_mode", ["bounds", "origin"])
def test_models_drawn_as_lines(tmp_path, draw_mode, scene_index):
    """Thin ones, where UsdImaging says that they are 1 wide: it means pixels."""
    shot = stages.shot_of(MODEL % draw_mode, tmp_path)
    image, _ = render_with_hydra(shot, tmp_path, scene_index)
    compare(shot, image, scene_index)
    assert 0 < (np.abs(image - image[0, 0]) > 1e-3).any(axis=2).sum() < 0.3 * image[..., 0].size


OWN = usda.material("material", {
    "surface": ("UsdPreviewSurface", {"color3f diffuseColor": "<own>"}),
    "own": ("UsdPrimvarReader_float3", {"varname": "own"})})
MATERIAL_PRIMVAR = usda.stage(
    usda.mesh("triangle", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], scheme="", bind="material"),
    OWN.replace("{\n", "{\n    color3f primvars:own = (1, 0.2, 0)\n", 1),
    up="")


def test_primvars_of_a_material_are_those_of_its_prims(tmp_path):
    """By scene indices alone: UsdImagingDelegate hands on none."""
    shot = stages.shot_of(MATERIAL_PRIMVAR, tmp_path)
    image, _ = render_with_hydra(shot, tmp_path, True)
    compare(shot, image, True)
    assert (image[..., 0] > 2.0 * image[..., 1]).any()


@MODES
def test_forms_that_hydra_has_no_place_for(tmp_path, scene_index):
    """NURBS patches and curves, tetrahedra and planes are what the stage says, not what hosts make of them."""
    if scene_index:
        hydraBuild.skip_before(2411, "scene indices leave planes out, and cut tetrahedra in an order of their own")
    shot = stages.Shot(os.path.join(HERE, "otherForms.usda"), tmp_path)
    image, text = render_with_hydra(shot, tmp_path, scene_index)
    assert sceneText.difference(text, shot.scene.dump(), native_shapes=scene_index) == ""
    compare(shot, image, scene_index)


@MODES
def test_hermite_curves(tmp_path, scene_index):
    """UsdImagingDelegate hands on no widths, so the stage has none there."""
    stage = os.path.join(HERE, "hermiteCurves.usda")
    if not scene_index:
        with open(stage, encoding="utf-8") as file:
            text = file.read()
        begin = text.index("    float[] widths")
        stage = str(tmp_path / "withoutWidths.usda")
        with open(stage, "w", encoding="utf-8") as file:
            file.write(text[:begin] + text[text.index(")", text.index("interpolation", begin)) + 1:])
    shot = stages.Shot(stage, tmp_path)
    image, dump = render_with_hydra(shot, tmp_path, scene_index)
    assert sceneText.difference(dump, shot.scene.dump()) == ""
    compare(shot, image, scene_index)


def test_widths_of_hermite_curves_are_missed_aloud(tmp_path):
    shot = stages.Shot(os.path.join(HERE, "hermiteCurves.usda"), tmp_path)
    process = hydraBuild.run_host(shot.stage, tmp_path / "hydra.exr", *shot.host_flags(), "--set", "samples=1")
    assert any("widths" in warning and "Hermite" in warning for warning in hydraBuild.warnings_of(process))
