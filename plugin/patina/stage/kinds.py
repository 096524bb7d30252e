# SPDX-License-Identifier: Apache-2.0
"""Which prims are drawn, and as what."""
import functools

import _patina
from pxr import Tf, Usd, UsdGeom

GPRIMS = {
    "Mesh": "mesh", "BasisCurves": "curves", "Points": "points", "Sphere": "sphere", "Cube": "cube",
    "Cone": "cone", "Cylinder": "cylinder", "Cylinder_1": "cylinder", "Capsule": "capsule",
    "Capsule_1": "capsule", "Plane": "plane",
    "Volume": "volume", "NurbsPatch": "nurbsPatch", "TetMesh": "tetMesh",
    "NurbsCurves": "nurbsCurves", "HermiteCurves": "hermiteCurves", "ParticleField": "splats", "Skeleton": "skeleton",
}
UNSUPPORTED = {"PortalLight", "PluginLight"}
LIGHTS = {schema: word for schemas, word in _patina.light_types().items() for schema in schemas.split()}  # for set_light()
OTHER = {"Camera": "camera", "PointInstancer": "instancer", "SkelRoot": "skelRoot"}


@functools.lru_cache(maxsize=None)
def _schemas(type_):
    """:returns: names of a schema and of those that it derives from, the nearest first"""
    names = [Usd.SchemaRegistry.GetSchemaTypeName(t) for t in (type_, *type_.GetAllAncestorTypes())]
    return tuple(name for name in dict.fromkeys(names) if name)


def schemas_of(prim):
    """:returns: names of the prim's schema, or of the known one that the stage's `fallbackPrimTypes` put in its place, and of
        those that it derives from, the nearest first"""
    type_ = prim.GetPrimTypeInfo().GetSchemaType()
    return _schemas(type_) if type_ != Tf.Type.Unknown else (str(prim.GetTypeName()),)  # newer than this OpenUSD


def schema_among(prim, names):
    """:returns: the nearest of the prim's schemas that is among names, or None"""
    return next((name for name in schemas_of(prim) if name in names), None)


class Kinds:
    """Looks up type names."""

    def __init__(self):
        self._known = {"": (None, False)}

    def of(self, prim):
        """:returns: (kind, whether it is imageable); kinds are the values above, `unsupported` or None"""
        name = prim.GetTypeName()
        if name not in self._known:
            self._known[name] = (self._kind(prim), prim.IsA(UsdGeom.Imageable))
        return self._known[name]

    @staticmethod
    def _kind(prim):
        for name in schemas_of(prim):
            if name in GPRIMS or name in OTHER:
                return GPRIMS.get(name) or OTHER[name]
            if name in LIGHTS:
                return "light"
            if name in UNSUPPORTED:
                return "unsupported"
        definition = Usd.SchemaRegistry().FindConcretePrimDefinition(prim.GetPrimTypeInfo().GetSchemaTypeName())
        is_light = definition and "LightAPI" in definition.GetAppliedAPISchemas()  # by its type, whatever this prim applies
        return "unsupported" if is_light or prim.IsA(UsdGeom.Gprim) else None


GPRIM_KINDS = frozenset(GPRIMS.values())
