# SPDX-License-Identifier: Apache-2.0
"""Stages with a feature and without it, for `patina bench features`: text of stages, and arguments of `patina record`."""
import dataclasses
import os

from usda import camera, floor, lobe, material, mesh, prim, stage

SCENES = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes"))


@dataclasses.dataclass(frozen=True)
class Variant:
    text: str
    arguments: tuple = ()


@dataclasses.dataclass(frozen=True)
class Pair:
    """`with_` has the feature, `without` has not; nothing else differs."""
    with_: Variant
    without: Variant
    samples: int = 64


def scene(name):
    with open(os.path.join(SCENES, name + ".usda"), encoding="utf-8") as file:
        return file.read().replace("@textures/", f"@{SCENES}/textures/").replace("@./textures/", f"@{SCENES}/textures/")


def swapped(text, old, new):
    assert old in text, f"the stage has no '{old}'"
    return text.replace(old, new)


def _without_filters(text):
    return swapped(text, "rel light:filters", "custom rel unused")


def costs():
    """:returns: dict: name of a feature -> Pair"""
    instances, values, caught = scene("instances"), scene("instanceValues"), scene("catchers")
    filters, lens, negative = scene("lightFilters"), scene("depthOfField"), scene("lightNegative")
    blades = swapped(lens, "float focalLength", "custom int patina:apertureBlades = 6\n        float focalLength")
    bent = swapped(lens, "float focalLength", "custom float patina:distortionK1 = 1e-6\n        float focalLength")
    crypto = tuple(f"--aov={name}" for name in ("cryptoObject", "cryptoMaterial", "cryptoAsset"))
    raster = ("--backend", "raster")
    seen = tuple(f"--aov={name}" for name in ("Ng", "uv", "Pref"))
    moving, vectors = scene("motionBlur"), ("--aov=motionForward", "--aov=motionBackward")
    smoke = scene("volume")
    return {
        "Cryptomatte, three of them": Pair(Variant(instances, crypto), Variant(instances)),
        "AOVs Ng, uv and Pref": Pair(Variant(instances, seen), Variant(instances)),
        "AOVs Ng, uv and Pref, rasterizer": Pair(Variant(instances, seen + raster), Variant(instances, raster), 16),
        "vectors of motion": Pair(Variant(moving, vectors), Variant(moving)),
        "vectors of motion, rasterizer": Pair(Variant(moving, vectors + raster), Variant(moving, raster), 16),
        "a deep image": Pair(Variant(instances, ("--deep", "deep.exr")), Variant(instances)),
        "a deep image of a volume": Pair(Variant(smoke, ("--deep", "deep.exr")), Variant(smoke)),
        "values per instance": Pair(Variant(values), Variant(swapped(swapped(values, "primvars:tint", "primvars:other"),
                                                                     "primvars:shine", "primvars:others"))),
        "catchers": Pair(Variant(caught), Variant(swapped(swapped(caught, "shadowCatcher = 1", "shadowCatcher = 0"),
                                                          "reflectionCatcher = 1", "reflectionCatcher = 0"))),
        "light filters": Pair(Variant(filters), Variant(_without_filters(filters))),
        "light filters, rasterizer": Pair(Variant(filters, raster), Variant(_without_filters(filters), raster), 16),
        "negative lights": Pair(Variant(negative), Variant(swapped(negative, "intensity = -20", "intensity = 20"))),
        "a lens of six blades": Pair(Variant(blades), Variant(lens)),
        "distortion of a lens": Pair(Variant(bent), Variant(lens)),
    }


FLOOR = stage(camera(lens=(24, 20.955, 20.955), clippingRange=(0.01, 1000), at=(0, 0.9, 2.4), turn=(-20, 0, 0)),
              floor("floor", 4, color=(0.5, 0.5, 0.5)))
BARN = prim("LightFilter", "opening", 'uniform token lightFilter:shaderId = "PxrBarnLightFilter"', "float inputs:width = 1",
            "float inputs:height = 0.5", "float inputs:radius = 0", at=(0, 1.8, 0), turn=(-90, 0, 0))


def _lamp(*lines):
    return prim("SphereLight", "lamp", *lines, intensity=300, radius=0.15, at=(0, 2.4, 0))


def _cards():
    """A sheet about the same opening: black, so that nothing but light through the opening reaches the floor."""
    wide, across, along, up = 40.0, 0.5, 0.25, 1.8
    parts = ((-wide, -across, -wide, wide), (across, wide, -wide, wide), (-across, across, -wide, -along),
             (-across, across, along, wide))
    return "".join(mesh(f"card{i}", [(left, up, near), (left, up, far), (right, up, far), (right, up, near)], color=(0, 0, 0))
                   for i, (left, right, near, far) in enumerate(parts))


DEEP = ("--maxDepth", "8")
MANY = 24  # balls along a side
PAINT = material("paint", {"surface": ("UsdPreviewSurface", {"color3f diffuseColor": "<tint>"}),
                           "tint": ("UsdPrimvarReader_float3", {"varname": "tint"})})
SKY = prim("DomeLight", "sky", intensity=1)
POLISHED = FLOOR + SKY + prim("DistantLight", "sun", intensity=1e5, angle=0.53, turn=(-50, 30, 0)) + "".join(
    prim("Sphere", f"ball{i}", bind="metal", radius=0.3, at=(0.7 * i - 0.7, 0.3, 0)) for i in range(3)) + lobe(
        "metal", "conductor_bsdf", roughness=(0.05, 0.05))


def _ball(name, *lines, **more):
    corners = [(x, y, z) for y, z in ((0, .1), (.2, .1), (.2, -.1), (0, -.1)) for x in (-.1, .1)]
    faces = [(0, 1, 3, 2), (2, 3, 5, 4), (4, 5, 7, 6), (6, 7, 1, 0), (1, 7, 5, 3), (6, 0, 2, 4)]
    return mesh(name, corners, *lines, faces=faces, scheme="catmullClark", bind="paint", **more)


def _places():
    for i in range(MANY):
        for k in range(MANY):
            yield (0.16 * (i - MANY / 2), 0.0, 0.16 * (k - MANY / 2) - 0.6), (0.2 + 0.7 * i / MANY, 0.5, 0.2 + 0.7 * k / MANY)


def _instanced():
    places, tints = zip(*_places())
    return prim("PointInstancer", "balls", "rel prototypes = </balls/ball>",
                f'color3f[] primvars:tint = {list(tints)} (interpolation = "vertex")', _ball("ball"),
                positions=list(places), protoIndices=[0] * len(places))


def _copied():
    return "".join(_ball(f"ball{i}", f"color3f[] primvars:tint = [{tint}]", at=place)
                   for i, (place, tint) in enumerate(_places()))


@dataclasses.dataclass(frozen=True)
class Curve:
    """A chart: error over time of the renderer with the feature and without it."""
    title: str
    variants: dict  # name of a line -> Variant; the first has the feature, or no bias, and makes the reference
    samples: tuple = (4, 16, 64)
    reference: int = 1024
    width: int = 48


def curves():
    """:returns: dict: name of a file -> Curve"""
    portals, caustics, box = scene("portals"), scene("caustics"), scene("diffuseBox")
    return {
        "feature_portals": Curve("A room with a window, lit by a dome", {
            "with a portal": Variant(portals),
            "without": Variant(swapped(portals, "rel portals", "custom rel unused"))}),
        "feature_caustics": Curve("Glass under a small lamp", {
            "photons": Variant(caustics, ("--method", "caustics=photons")),
            "paths alone": Variant(caustics)}),
        "feature_sharedLight": Curve("A closed room", {
            "each path its own light": Variant(box, DEEP),
            "shared": Variant(box, (*DEEP, "--method", "indirectLight=shared"))}, reference=2048, width=160),
        "feature_indirectRoughness": Curve("Polished metal in the sun", {
            "every surface as it is": Variant(POLISHED, DEEP),
            "rougher to paths from rough ones": Variant(POLISHED, (*DEEP, "--indirectRoughness", "0.3"))},
            reference=2048, width=96),
        "feature_filters": Curve("A lamp over an opening", {
            "barn doors": Variant(FLOOR + _lamp("rel light:filters = </opening>") + BARN),
            "a sheet with a hole": Variant(FLOOR + _lamp() + _cards())}),
        "feature_instances": Curve(f"{MANY * MANY} balls, each of its own colour", {
            "values per instance": Variant(FLOOR + PAINT + SKY + _instanced()),
            "a prim for each": Variant(FLOOR + PAINT + SKY + _copied())}),
    }
