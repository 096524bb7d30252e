# SPDX-License-Identifier: Apache-2.0
"""Which prims are drawn, and as what."""
import functools

from pxr import Tf, UsdGeom, UsdLux

GPRIMS = {
    "Mesh": "mesh", "BasisCurves": "curves", "Points": "points", "Sphere": "sphere", "Cube": "cube",
    "Cone": "cone", "Cylinder": "cylinder", "Cylinder_1": "cylinder", "Capsule": "capsule",
    "Capsule_1": "capsule", "Plane": "plane",
    "Volume": "volume", "NurbsPatch": "nurbsPatch", "TetMesh": "tetMesh",
    "NurbsCurves": "nurbsCurves", "HermiteCurves": "hermiteCurves",
}
UNSUPPORTED = {"PortalLight", "PluginLight", "ParticleField"}
OTHER = {"Camera": "camera", "PointInstancer": "instancer", "SkelRoot": "skelRoot"}


@functools.lru_cache(maxsize=None)
def lights():
    """:returns: UsdLux type -> word for set_light()"""
    import _patina

    return {schema: word for schemas, word in _patina.light_types().items() for schema in schemas.split()}


class Kinds:
    """Looks up type names; schemas derived from known ones count as those."""

    def __init__(self):
        self._known = {"": (None, False)}

    def of(self, prim):
        """:returns: (kind, whether it is imageable); kinds are the values above, `unsupported` or None"""
        name = prim.GetTypeName()
        if name not in self._known:
            self._known[name] = (self._kind(prim, name), prim.IsA(UsdGeom.Imageable))
        return self._known[name]

    @staticmethod
    def _kind(prim, name):
        for table in (GPRIMS, OTHER):
            if name in table:
                return table[name]
        if name in lights():
            return "light"
        if name in UNSUPPORTED:
            return "unsupported"
        for base in ("Mesh", "BasisCurves", "Points", "NurbsPatch", "TetMesh", "NurbsCurves",
                     "HermiteCurves", "PointInstancer", "Camera"):
            if prim.IsA(Tf.Type.FindByName("UsdGeom" + base)):
                return GPRIMS.get(base) or OTHER[base]
        if prim.IsA(UsdGeom.Gprim) or prim.HasAPI(UsdLux.LightAPI):
            return "unsupported"
        return None


GPRIM_KINDS = frozenset(GPRIMS.values())
