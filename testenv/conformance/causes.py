# SPDX-License-Identifier: Apache-2.0
"""Why stages of others fail, or look otherwise through Hydra: one row for each cause that is known."""
import fnmatch

SETS = {  # name of a set -> what it is
    "usdImaging": "OpenUSD's own tests of usdview, usdrecord, UsdImaging and UsdImagingGL (`pxr/usdImaging`).",
    "usd-wg": "The assets of the Alliance for OpenUSD's working group (`usd-wg/assets`).",
    "arnold-usd": "The test suite of Arnold's USD plugin (`Autodesk/arnold-usd`). Many of its materials are Arnold's own."}
_SKINNED = "Hydra skins points, and leaves normals as they are"
_UNAPPLIED = "MaterialBindingAPI is not applied, and scene indices bind nothing"
_CARDS = "the two sides of a cross of cards lie in one place in Hydra, and a renderer without culling shows either"
CAUSES = (  # (set, pattern of stages, pattern of ways, the cause)
    ("usdImaging", "*FileArguments/*", "read", "the file is meant to be invalid"),
    ("usdImaging", "*testUsdviewMaterialEdits/*", "sceneIndex", _UNAPPLIED),
    ("usdImaging", "*testUsdImagingDelegate/indexedPrimvars.usda", "*", "two meshes lie in the same place"),
    ("usdImaging", "*testUsdImagingDelegate/unvarying.usda", "*",
     "the command line moves points to the frame by their velocities; Hydra has no time of the sample"),
    ("usdImaging", "*GLCards/testCards.usda", "sceneIndex", "scene indices know a model's box by its extentsHint alone"),
    ("usdImaging", "*GLCards/*", "*", _CARDS),
    ("usdImaging", "*GLInstancing/instancedCubes2NoInstancing.usda", "*",
     "shapes that are instances themselves, of which OpenUSD warns"),
    ("usdImaging", "*/ni_ni_material_binding_resolution_3.usda", "sceneIndex",
     "OpenUSD loses the binding, as the stage's own comment says"),
    ("usdImaging", "*/ni_ni_material_binding_resolution*", "delegate",
     "UsdImagingDelegate binds materials of the first instance to all of nested instances"),
    *(("usdImaging", stages, "delegate", "coarse meshes of small balls, or of one that fills the picture")
      for stages in ("*MaterialXvsNative/*", "*/domeLightYup.usda", "*/pi_ni_material2.usda",
                     "*/ni_ni_material_outside_prototype.usda", "*MotionBlurTest/*", "*MaterialXBasic/*",
                     "*/simpleVolumes.usda")),
    ("usdImaging", "*/invalid_universal_surface.usda", "delegate",
     "UsdImagingDelegate takes a displayColor that the Material has"),
    ("usdImaging", "*/colorNode.usda", "*", "OpenUSD does not read definitions of nodes that have a namespace"),
    ("usdImaging", "*/sphereWithFloatRadius.usda", "sceneIndex", "scene indices do not read a radius of type float"),
    ("usdImaging", "*/standardSurfaceMarble.usda", "*",
     "OpenUSD's reader of MaterialX leaves out `parameter` elements, which a document of 1.38 no longer has"),
    ("usdImaging", "*MaterialXvsNative/materialX*", "sceneIndex",
     "scene indices do not enter a Material for the materials below it"),
    ("usd-wg", "*/Teapot/DrawModes.usd", "*", _CARDS),
    ("usd-wg", "*ElephantWithMonochord*", "*", _SKINNED),
    ("usd-wg", "*/USDZ/*", "*", _SKINNED),
    ("usd-wg", "*/NormalsTextureBiasAndScale/*", "*",
     "the command line reads inputs of lights by their names from before OpenUSD 21.05 too, here `angle`"),
    ("usd-wg", "*/stage_composition/over.usda", "sceneIndex", "scene indices of 26.08 draw a prim that no `def` makes"),
    ("usd-wg", "*/framesPerSecond_*", "read", "OpenUSD refuses a frame rate that is not above 0"),
    *(("arnold-usd", stages, "*", _SKINNED) for stages in ("test_1352/*", "test_1443/data/test.usda", "test_1837/*")),
    *(("arnold-usd", stages, "delegate", "coarse meshes of small balls, or of one that fills the picture")
      for stages in ("test_000[4679]/*", "test_1346/*", "test_1593/*")),
    *(("arnold-usd", stages, "delegate", "UsdImagingDelegate moves nothing by its velocities")
      for stages in ("test_0029/*", "test_015[07]/*", "test_021[34]/*", "test_1354/*", "test_1427.*", "test_1442/*",
                     "test_2127/*", "test_2231/*")),
    ("arnold-usd", "test_1329/*", "*",
     "velocities beside one sample at another frame: scene indices take it to be at this one"),
    ("arnold-usd", "test_1868/*", "*",
     "velocities beside positions without samples: UsdGeom does not use them, scene indices do"),
    ("arnold-usd", "test_1443/data/sphere_skin.usda", "delegate", "UsdImagingDelegate makes the bones of a Skeleton grey"),
    ("arnold-usd", "test_1524/*", "sceneIndex", "scene indices do not find prims inside of native instances in collections"),
    ("arnold-usd", "test_17642.2/*", "sceneIndex", _UNAPPLIED),
    ("usd-wg", "*/points_types/*", "delegate", "UsdImaging leaves out points of wrong types, which the reader can use"),
    ("usd-wg", "*/teapotScene.usd", "*", "hundreds of teapots, many within a pixel"),
)


def of(name, stage, way):
    """:returns: the cause, or an empty text"""
    return next((text for known, stages, ways, text in CAUSES if known == name and fnmatch.fnmatchcase(stage, stages)
                 and fnmatch.fnmatchcase(way, ways)), "")
