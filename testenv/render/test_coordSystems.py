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
WALL = """
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    uniform token subdivisionScheme = "none"
    rel material:binding = </look>
    double3 xformOp:translate = (0.5, 0.25, -0.5)
    float3 xformOp:rotateXYZ = (10, 20, 30)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
"""
HEAD = usda.stage(usda.camera(at=(0.5, 0.25, 6)), up="")
PROJECTOR = usda.prim("Xform", "projector", matrix="%s")
NEW = "rel coordSys:paint:binding = <%s>"
OLD = "rel coordSys:paint = <%s>"
APPLIED = ("CoordSysAPI:paint",)


def shader(name, id_, *lines):
    body = "\n        ".join([f'uniform token info:id = "{id_}"', *lines, "token outputs:out"])
    return f'    def Shader "{name}"\n    {{\n        {body}\n    }}\n'


def look(*nodes, color):
    """:returns: a material that glows in a color, which is connected"""
    parts = [*nodes, shader("edf", "ND_uniform_edf", f"color3f inputs:color.connect = </look/{color}.outputs:out>"),
             shader("surface", "ND_surface", "token inputs:edf.connect = </look/edf.outputs:out>")]
    terminal = "    token outputs:mtlx:surface.connect = </look/surface.outputs:out>\n"
    return 'def Material "look"\n{\n' + terminal + "".join(parts) + "}\n"


IMAGE = shader("image", "ND_image_color3", f"asset inputs:file = @{TEXTURE}@",
               "vector2f inputs:texcoord.connect = </look/place.outputs:out>")
NAMED = look(shader("place", "ND_position_vector3", 'string inputs:space = "paint"'), IMAGE, color="image")


def by_matrix(place):
    """:returns: the look of a projector at that place, as a matrix"""
    inverse = place.GetInverse()
    return look(shader("world", "ND_position_vector3", 'string inputs:space = "world"'),
                shader("place", "ND_transformmatrix_vector3M4", "vector3f inputs:in.connect = </look/world.outputs:out>",
                       f"matrix4d inputs:mat = {inverse}"), IMAGE, color="image")


def rendered(folder, text, backend="embree", name="stage.usda"):
    """:returns: an image, and the warnings"""
    path = folder / name
    path.write_text(HEAD + text)
    stage = Stage(path, "--camera", "/camera", "--imageWidth", 24, "--imageHeight", 16, "--samples", 4, "--backend", backend)
    return stage.image(1), [f"{w['prim']} {w['input']}: {w['message']}" for w in stage.scene.warnings()]


def applying(schemas):
    """:returns: metadata of a prim with these API schemas"""
    return f"(prepend apiSchemas = [{', '.join(map(repr, schemas))}])".replace("'", '"') if schemas else ""


def wall(binding="", schemas=()):
    return f'def Mesh "wall" {applying(("MaterialBindingAPI", *schemas))}\n{{{WALL}    {binding}\n}}\n'


def assert_alike(given, wanted):
    """Pixels beside an edge of the checker may differ by the rounding of coordinates: a few of all."""
    differ = np.abs(given - wanted).max(axis=2) > 1e-3
    assert wanted.max() > 0.5 and differ.mean() < 0.02, differ.sum()


@pytest.mark.parametrize("backend", ["embree", "raster"])
@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)
@pytest.mark.parametrize("binding, applied", [(NEW, APPLIED), (OLD, ())], ids=["applied", "old"])
def test_a_projection_is_that_of_its_matrix(tmp_path, binding, applied, place, backend):
    bound = wall(binding % "/projector", applied)
    given, warned = rendered(tmp_path, PROJECTOR % place + bound + NAMED, backend)
    wanted, _ = rendered(tmp_path, wall() + by_matrix(place), backend)
    assert_alike(given, wanted)
    assert not warned


def test_bindings_are_inherited_and_the_nearest_counts(tmp_path):
    text = PROJECTOR % PLACES["turned"] + PROJECTOR.replace("projector", "other") % PLACES["moved"]
    part = f'def Xform "part" {applying(APPLIED)}\n{{\n%s{wall()}}}\n'
    inner = f'def Xform "set" {applying(APPLIED)}\n{{\n{NEW % "/other"}\n{part}}}\n'
    wanted = {name: rendered(tmp_path, wall() + by_matrix(place))[0] for name, place in PLACES.items()}
    assert_alike(rendered(tmp_path, text + inner % "" + NAMED)[0], wanted["moved"])
    assert_alike(rendered(tmp_path, text + inner % (NEW % "/projector" + "\n") + NAMED)[0], wanted["turned"])


@pytest.mark.parametrize("kind, value", [("point", (0.3, -0.7, 0.2)), ("vector", (0.3, -0.7, 0.2)), ("normal", (0.6, 0, 0.8))])
def test_there_and_back(tmp_path, kind, value):
    """From one named space to another, as matrices say it: points with the translation, normals by the inverse transpose."""
    a, b = PLACES["turned"], Gf.Matrix4d().SetScale((1, 2, 3)) * PLACES["moved"]
    node = shader("moved", f"ND_transform{kind}_vector3", f"vector3f inputs:in = {value}", 'string inputs:fromspace = "a"',
                  'string inputs:tospace = "b"')
    color = shader("color", "ND_convert_vector3_color3", "vector3f inputs:in.connect = </look/halved.outputs:out>")
    halved = shader("halved", "ND_multiply_vector3FA", "vector3f inputs:in1.connect = </look/shifted.outputs:out>",
                    "float inputs:in2 = 0.1")
    shifted = shader("shifted", "ND_add_vector3FA", "vector3f inputs:in1.connect = </look/moved.outputs:out>",
                     "float inputs:in2 = 5")  # nothing glows below zero
    bindings = "rel coordSys:a:binding = </a>\n    rel coordSys:b:binding = </b>"
    text = PROJECTOR.replace("projector", "a") % a + PROJECTOR.replace("projector", "b") % b
    image, _ = rendered(tmp_path, text + wall(bindings, ("CoordSysAPI:a", "CoordSysAPI:b"))
                        + look(node, shifted, halved, color, color="color"))
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
    text = 'class "kind"\n{\n' + PROJECTOR % PLACES["turned"] + wall(NEW % "/kind/projector", APPLIED) + "}\n"
    instances = "".join(f'def Xform "{n}" (instanceable = true\n prepend inherits = </kind>)\n{{\n'
                        f'    double3 xformOp:translate = ({x}, 0, 0)\n'
                        '    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
                        for n, x in (("one", 0), ("two", 7)))
    first, _ = rendered(tmp_path, text + instances + NAMED)
    away = instances.replace("(7, 0, 0)", "(0, 0, 0)").replace("= (0, 0, 0)", "= (7, 0, 0)", 1)
    second, _ = rendered(tmp_path, text + away + NAMED)
    wanted, _ = rendered(tmp_path, wall() + by_matrix(PLACES["turned"]))
    assert_alike(first, wanted)
    assert_alike(second, wanted)


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_what_is_not_bound_is_told(tmp_path, backend):
    image, warned = rendered(tmp_path, wall() + NAMED, backend)
    assert_alike(image, rendered(tmp_path, wall() + by_matrix(Gf.Matrix4d(1)), backend)[0])
    assert warned == ["/wall coordSys:paint: the material names a space that is not bound to the prim; world space is used"]
    flat = PROJECTOR % Gf.Matrix4d().SetScale((1, 0, 1))
    for target, more in (("/nothing", ""), ("/projector", flat)):
        _, warned = rendered(tmp_path, more + wall(NEW % target, APPLIED) + NAMED, backend)
        assert (f"/wall coordSys:paint: names {target}, which does not exist or has no transform with an inverse; "
                "world space is used") in warned
