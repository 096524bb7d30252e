# SPDX-License-Identifier: Apache-2.0
"""Spaces that materials name (UsdShadeCoordSysAPI): the picture is that of the same matrix, written into the material."""
import os

import numpy as np
import pytest
from pxr import Gf

from inProcess import Stage
from rendering import SCENES
import usda

TEXTURE = os.path.join(SCENES, "textures", "checker.png")
PLACES = {"moved": Gf.Matrix4d().SetTranslate((0.3, -0.2, 0.5)),
          "turned": Gf.Matrix4d().SetScale(2) * Gf.Matrix4d().SetRotate(Gf.Rotation((1, 2, 3), 40))
          * Gf.Matrix4d().SetTranslate((0.1, 0.4, -1))}
HEAD = usda.stage(usda.camera(at=(0.5, 0.25, 6)), up="")
NEW = "rel coordSys:paint:binding = <%s>"
OLD = "rel coordSys:paint = <%s>"
APPLIED = ("CoordSysAPI:paint",)


def projector(place, name="projector"):
    """:param place: a matrix, or several by time"""
    return usda.prim("Xform", name, matrix=place)


def look(color="image", /, **nodes):
    """:returns: a material that glows in a color, which is connected"""
    return usda.material("look", {"surface": ("ND_surface", {"edf": "<edf>"}),
                                  "edf": ("ND_uniform_edf", {"color3f color": f"<{color}>"}), **nodes})


IMAGE = ("ND_image_color3", {"file": TEXTURE, "float2 texcoord": "<place>"}, "color3f out")
NAMED = look(place=("ND_position_vector3", {"space": "paint"}), image=IMAGE)


def by_matrix(place):
    """:returns: the look of a projector at that place, as a matrix"""
    placed = ("ND_transformmatrix_vector3M4", {"float3 in": "<world>", "matrix4d mat": str(place.GetInverse())})
    return look(world=("ND_position_vector3", {"space": "world"}), place=placed, image=IMAGE)


def rendered(folder, text, backend="embree", name="stage.usda"):
    """:returns: an image, and the warnings"""
    path = folder / name
    path.write_text(HEAD + text)
    stage = Stage(path, "--camera", "/camera", "--imageWidth", 24, "--imageHeight", 16, "--samples", 4, "--backend", backend)
    return stage.image(1), [f"{w['prim']} {w['input']}: {w['message']}" for w in stage.scene.warnings()]


def wall(*bindings, schemas=()):
    return usda.card("wall", 1, *bindings, bind="look", apis=schemas, at=(0.5, 0.25, -0.5), turn=(10, 20, 30))


def assert_alike(given, wanted):
    """Pixels beside an edge of the checker may differ by the rounding of coordinates: a few of all."""
    differ = np.abs(given - wanted).max(axis=2) > 1e-3
    assert wanted.max() > 0.5 and differ.mean() < 0.02, differ.sum()


@pytest.mark.parametrize("backend", ["embree", "raster"])
@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)
@pytest.mark.parametrize("binding, applied", [(NEW, APPLIED), (OLD, ())], ids=["applied", "old"])
def test_a_projection_is_that_of_its_matrix(tmp_path, binding, applied, place, backend):
    bound = wall(binding % "/projector", schemas=applied)
    given, warned = rendered(tmp_path, projector(place) + bound + NAMED, backend)
    wanted, _ = rendered(tmp_path, wall() + by_matrix(place), backend)
    assert_alike(given, wanted)
    assert not warned


def test_bindings_are_inherited_and_the_nearest_counts(tmp_path):
    def nested(*nearer):
        part = usda.prim("Xform", "part", *nearer, wall(), apis=APPLIED)
        both = projector(PLACES["turned"]) + projector(PLACES["moved"], "other")
        return rendered(tmp_path, both + usda.prim("Xform", "set", NEW % "/other", part, apis=APPLIED) + NAMED)[0]

    wanted = {name: rendered(tmp_path, wall() + by_matrix(place))[0] for name, place in PLACES.items()}
    assert_alike(nested(), wanted["moved"])
    assert_alike(nested(NEW % "/projector"), wanted["turned"])


@pytest.mark.parametrize("kind, value", [("point", (0.3, -0.7, 0.2)), ("vector", (0.3, -0.7, 0.2)), ("normal", (0.6, 0, 0.8))])
def test_there_and_back(tmp_path, kind, value):
    """From one named space to another, as matrices say it: points with the translation, normals by the inverse transpose."""
    a, b = PLACES["turned"], Gf.Matrix4d().SetScale((1, 2, 3)) * PLACES["moved"]
    nodes = {
        "moved": (f"ND_transform{kind}_vector3", {"float3 in": value, "fromspace": "a", "tospace": "b"}),
        "shifted": ("ND_add_vector3FA", {"float3 in1": "<moved>", "in2": 5}),  # nothing glows below zero
        "halved": ("ND_multiply_vector3FA", {"float3 in1": "<shifted>", "in2": 0.1}),
        "color": ("ND_convert_vector3_color3", {"float3 in": "<halved>"})}
    bound = wall("rel coordSys:a:binding = </a>", "rel coordSys:b:binding = </b>", schemas=("CoordSysAPI:a", "CoordSysAPI:b"))
    image, _ = rendered(tmp_path, projector(a, "a") + projector(b, "b") + bound + look("color", **nodes))
    there = a * b.GetInverse()
    if kind == "point":
        wanted = np.array(there.Transform(Gf.Vec3d(value)))
    elif kind == "vector":
        wanted = np.array(there.TransformDir(Gf.Vec3d(value)))
    else:
        wanted = np.array(there.GetInverse().GetTranspose().TransformDir(Gf.Vec3d(value)).GetNormalized())
    assert image[8, 12] == pytest.approx(0.5 + 0.1 * wanted, abs=1e-5)


def test_a_space_of_a_prototype_moves_with_its_instances(tmp_path):
    """Two instances look alike, each from before itself: a projector among the prims of both."""
    def placed(**places):
        copies = (usda.prim("Xform", name, meta=("instanceable = true", "prepend inherits = </kind>"), at=(x, 0, 0))
                  for name, x in places.items())
        return rendered(tmp_path, kind + "".join(copies) + NAMED)[0]

    kind = usda.prim("", "kind", projector(PLACES["turned"]), wall(NEW % "/kind/projector", schemas=APPLIED), specifier="class")
    first, second = placed(one=0, two=7), placed(one=7, two=0)
    wanted, _ = rendered(tmp_path, wall() + by_matrix(PLACES["turned"]))
    assert_alike(first, wanted)
    assert_alike(second, wanted)


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_what_is_not_bound_is_told(tmp_path, backend):
    image, warned = rendered(tmp_path, wall() + NAMED, backend)
    assert_alike(image, rendered(tmp_path, wall() + by_matrix(Gf.Matrix4d(1)), backend)[0])
    assert warned == ["/wall coordSys:paint: the material names a space that is not bound to the prim; world space is used"]
    flat = projector(Gf.Matrix4d().SetScale((1, 0, 1)))
    for target, more in (("/nothing", ""), ("/projector", flat)):
        _, warned = rendered(tmp_path, more + wall(NEW % target, schemas=APPLIED) + NAMED, backend)
        assert (f"/wall coordSys:paint: names {target}, which does not exist or has no transform with an inverse; "
                "world space is used") in warned
