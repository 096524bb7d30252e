# SPDX-License-Identifier: Apache-2.0
"""The stages that both back ends must draw alike, and the light that they are held together by.

Three sorts: test scenes, emitters out of view, and stages that were not made for this (in $PATINA_ASSETS). A feature that the
rasterizer draws otherwise by design is named in byDesign.py, and its stages are not here.
"""
import dataclasses
import os

import byDesign
import equivalence
import outOfView
import pairs

DIRECT, WHOLE = pairs.DIRECT, pairs.WHOLE


@dataclasses.dataclass(frozen=True)
class Case:
    """`file`: below testenv/scenes, below the assets, or the name of an emitter. `depth`: of the path tracer; `tile`: pixels"""
    name: str
    sort: str
    file: str
    depth: int = DIRECT
    arguments: tuple = ()
    tier: str = "full"
    tile: int = equivalence.TILE


# Chosen by cost: what two cores decide within half a minute each, and at least a third of it stages that were not made for
# this. All others are held in the long tier.
FULL = {
    "curves", "lightDome", "roughConductor",
    "outOfView/rect", "outOfView/disk", "outOfView/sphere", "outOfView/point", "outOfView/line", "outOfView/spot",
    "outOfView/profile", "outOfView/sun", "outOfView/meshLight", "outOfView/glowingMesh", "assets/Teapot",
    "assets/NormalsTextureBiasAndScale", "assets/TextureCoordinateTest", "assets/AnimatedCube", "assets/CesiumMan",
    "assets/InterpolationTest", "assets/axis", "assets/pointsTypes", "assets/complex_transform", "assets/xforms_nested",
}

ASSETS = (  # file below the assets, further arguments
    "SubdivisionSurfaces/Creases_SpinningPyramids.usda",
    "StandardShaderBall/standard_shader_ball_scene.usda",
    "Teapot/Teapot.usd",
    "test_assets/AlphaBlendModeTest/AlphaBlendModeTest.usd",
    "test_assets/AlphaBlendSortTest/AlphaBlendSortTest.usda",
    "test_assets/MaterialXTest/basic.usda",
    "test_assets/MaterialXTest/basicTextured.usda",
    "test_assets/NormalsTextureBiasAndScale/NormalsTextureBiasAndScale.usda",
    "test_assets/RoughnessTest/RoughnessTest.usdz",
    "test_assets/TextureCoordinateTest/TextureCoordinateTest.usda",
    "test_assets/TextureCoordinateTest/TextureCoordinateTestMaterialX.usda",
    "test_assets/TextureFileFormatTests/all_files.usda",
    "test_assets/TextureTransformTest/TextureTransformTest.usd",
    "test_assets/USDZ/AnimatedCube/AnimatedCube.usdz",
    "test_assets/USDZ/BrainStem/BrainStem.usdz",
    "test_assets/USDZ/CesiumMan/CesiumMan.usdz",
    "test_assets/USDZ/InterpolationTest/InterpolationTest.usdz",
    "test_assets/_common/axis.usda",
    "test_assets/_common/teapot.usda",
    "test_assets/foundation/stage_composition/purpose.usda",
    "test_assets/schemaTests/usdGeom/meshes/doubleSided/doubleSided_quad.usda",
    "test_assets/schemaTests/usdGeom/meshes/normals_types/normalsTypes.usda",
    "test_assets/schemaTests/usdGeom/meshes/points_types/pointsTypes.usda",
    "test_assets/schemaTests/usdGeom/meshes/singleSided/singleSided.usda",
    "test_assets/schemaTests/usdGeom/meshes/subdiv_catmullClark/subdiv_catmullClark.usda",
    "test_assets/schemaTests/usdGeom/primitives/all_primitives.usda",
    "test_assets/schemaTests/usdGeom/transforms/complex_transform.usda",
    "test_assets/schemaTests/usdGeom/transforms/xforms_nested.usda",
)


# Layers of cards that pass nearly all light, by chance in both back ends: after 768 passes a tile of 8 x 8 pixels has a
# standard error of 1 to 11 %, the whole image one of 0.6 %. So it is held as a whole.
COARSE = {"assets/AlphaBlendSortTest": 64}


def cases():
    """:returns: list of Case"""
    made = [Case(name, "scene", name) for name in pairs.names() if name not in byDesign.SCENES]
    made += [Case(f"outOfView/{name}", "emitter", name) for name in outOfView.EMITTERS]
    made += [Case(f"outOfView/{name}/all", "alone", name, WHOLE) for name in outOfView.WITHOUT_BLOCK]
    made += [Case("assets/" + os.path.splitext(os.path.basename(file))[0], "asset", file) for file in ASSETS]
    return [dataclasses.replace(case, tier="full" if case.name in FULL else "long",
                                tile=COARSE.get(case.name, equivalence.TILE))
            for case in made]


def path_of(case, folder):
    """:param folder: where stages of emitters are written
    :returns: the stage's path, or None where there are no assets"""
    if case.sort in ("emitter", "alone"):
        return outOfView.write(case.file, str(folder), block=case.sort == "emitter")
    if case.sort == "scene":
        return os.path.join(pairs.SCENES, *case.file.split("/")) + ".usda"
    path = os.path.join(os.environ.get("PATINA_ASSETS", ""), *case.file.split("/"))
    return path if os.environ.get("PATINA_ASSETS") and os.path.exists(path) else None
