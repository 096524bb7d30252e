# SPDX-License-Identifier: Apache-2.0
"""Every schema with attributes of random names and wrong types: the reader goes on, whatever it meets."""
import random

import pytest

SEED, STAGES = 3, 40
TYPES = ("Mesh", "BasisCurves", "Points", "Sphere", "Cube", "Cone", "Cylinder", "Capsule", "Plane", "PointInstancer",
         "Camera", "DistantLight", "DomeLight", "SphereLight", "RectLight", "DiskLight", "CylinderLight",
         "GeometryLight", "NurbsPatch", "NurbsCurves", "HermiteCurves", "TetMesh", "SkelRoot", "Skeleton",
         "SkelAnimation", "BlendShape", "Material", "Shader", "GeomSubset", "Xform")
APIS = ("ShapingAPI", "ShadowAPI", "MeshLightAPI", "MaterialBindingAPI", "SkelBindingAPI", "GeomModelAPI", "LightAPI")
EXTRA = ("primvars:st", "primvars:normals", "primvars:displayColor", "primvars:st:indices",
         "primvars:skel:jointIndices", "primvars:skel:jointWeights", "model:drawMode", "model:cardTextureXPos",
         "xformOp:translate", "xformOp:transform")


def wrong_values():
    from pxr import Gf, Sdf, Vt
    names, nan = Sdf.ValueTypeNames, float("nan")
    return [(names.Int, 7), (names.String, "x"), (names.Token, "bad"), (names.Double, nan), (names.Bool, True),
            (names.Float, float("inf")), (names.Asset, Sdf.AssetPath("no.png")), (names.Matrix4d, Gf.Matrix4d(0)),
            (names.Double3, Gf.Vec3d(nan)), (names.Float2, Gf.Vec2f(0)), (names.TokenArray, Vt.TokenArray(["a"])),
            (names.FloatArray, Vt.FloatArray([1, nan, float("inf")])), (names.FloatArray, Vt.FloatArray()),
            (names.Point3fArray, Vt.Vec3fArray([Gf.Vec3f(nan)] * 3)), (names.Color3fArray, Vt.Vec3fArray(2)),
            (names.IntArray, Vt.IntArray([-5, 100000, 3])), (names.Int64Array, Vt.Int64Array([2 ** 40, -1])),
            (names.QuathArray, Vt.QuathArray(1))]


def author(layer, type_name, dice):
    """Adds one prim with six of its properties, each with a value or target that may not fit."""
    from pxr import Sdf, Usd, Vt
    definition = Usd.SchemaRegistry().FindConcretePrimDefinition(type_name)
    prim = Sdf.CreatePrimInLayer(layer, "/w/" + type_name)
    prim.specifier, prim.typeName = Sdf.SpecifierDef, type_name
    prim.SetInfo("apiSchemas", Sdf.TokenListOp.CreateExplicit(dice.sample(APIS, 3)))
    if dice.random() < 0.3:
        prim.SetInfo("kind", "component")
    for name in dice.sample(sorted({*definition.GetPropertyNames(), *EXTRA}), 6):
        if definition.GetSpecType(name) == Sdf.SpecTypeRelationship:
            Sdf.RelationshipSpec(prim, name).targetPathList.explicitItems = ["/w/" + dice.choice(TYPES)]
            continue
        value_type, value = dice.choice(wrong_values())
        attribute = Sdf.AttributeSpec(prim, name, value_type)
        if dice.random() < 0.5:
            attribute.default = value
        else:
            layer.SetTimeSample(attribute.path, 1.0, value)
            layer.SetTimeSample(attribute.path, 2.0, value)
    if "xformOpOrder" not in prim.attributes:
        order = Sdf.AttributeSpec(prim, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, Sdf.VariabilityUniform)
        order.default = Vt.TokenArray(["xformOp:translate", "xformOp:transform"])


@pytest.mark.parametrize("number", range(STAGES))
def test_random_stages_are_read(read, tmp_path, number):
    from pxr import Sdf
    dice = random.Random(SEED * 1000 + number)
    layer = Sdf.Layer.CreateNew(str(tmp_path / "random.usda"))
    with Sdf.ChangeBlock():
        for type_name in TYPES:
            author(layer, type_name, dice)
    layer.GetPrimAtPath("/w").specifier = Sdf.SpecifierDef
    layer.Save()
    reading = read(tmp_path / "random.usda", frame=dice.choice([None, 1.0]), shutter=dice.choice([None, (0.0, 0.5)]))
    assert reading.info.camera and reading.scene.version == 1
