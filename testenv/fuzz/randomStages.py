# SPDX-License-Identifier: Apache-2.0
"""Random legal stages of every prim type that USD's schemas have, with extreme values, rendered to a small image."""
import random as randoms

import materialDocuments
import outcomes
import values

EXTENSION = ".usda"
LINES = True  # an input is shrunk by lines
FAMILIES = ("Geom", "Lux", "Vol", "Shade", "Skel", "Render")
APIS = ("MaterialBindingAPI", "LightAPI", "ShadowAPI", "ShapingAPI", "SkelBindingAPI", "MotionAPI", "MeshLightAPI",
        "VolumeLightAPI")
SOUND = {  # geometry that fits together, so that what comes after it is met too
    "Mesh": ("int[] faceVertexCounts = [4, 3]", "int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, 4]",
             "point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 1)]"),
    "BasisCurves": ("int[] curveVertexCounts = [4]", "point3f[] points = [(-1, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 1)]",
                    "float[] widths = [0.1]"),
    "NurbsCurves": ("int[] curveVertexCounts = [4]", "int[] order = [4]", "double[] knots = [0, 0, 0, 0, 1, 1, 1, 1]",
                    "point3f[] points = [(-1, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 1)]"),
    "NurbsPatch": ("int uOrder = 2", "int vOrder = 2", "int uVertexCount = 2", "int vVertexCount = 2",
                   "double[] uKnots = [0, 0, 1, 1]",
                   "double[] vKnots = [0, 0, 1, 1]", "point3f[] points = [(-1, -1, 0), (1, -1, 0), (-1, 1, 0), (1, 1, 0)]"),
    "Points": ("point3f[] points = [(0, 0, 0), (1, 1, 0)]", "float[] widths = [0.5, 0.2]"),
    "TetMesh": ("int4[] tetVertexIndices = [(0, 1, 2, 3)]", "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]"),
    "PointInstancer": ("int[] protoIndices = [0, 0]", "point3f[] positions = [(0, 0, 0), (1, 0, 0)]", "rel prototypes = </p0>"),
    "Volume": ("rel field:density = </puff>",),
}
MOVES = ("double3 xformOp:translate", "float3 xformOp:rotateXYZ", "float3 xformOp:scale", "matrix4d xformOp:transform")
_table = {}


def _schemas():
    """:returns: dict of the type names that may be written to the attributes they have: (type, name, words allowed)"""
    if _table:
        return _table
    from pxr import Tf, Usd, UsdGeom, UsdLux, UsdRender, UsdShade, UsdSkel, UsdVol

    _ = UsdGeom, UsdLux, UsdRender, UsdShade, UsdSkel, UsdVol
    registry = Usd.SchemaRegistry()
    for derived in Tf.Type(Usd.Typed).GetAllDerivedTypes():
        name = registry.GetConcreteSchemaTypeName(derived)
        if not name or not registry.IsConcrete(name) or not any(f"Usd{f}" in derived.typeName for f in FAMILIES):
            continue
        definition = registry.FindConcretePrimDefinition(name)
        found = [(str(spec.typeName), spec.name, tuple(spec.allowedTokens or ()))
                 for spec in map(definition.GetSchemaAttributeSpec, definition.GetPropertyNames()) if spec]
        _table[name] = [a for a in sorted(found) if not a[1].startswith("xformOp")]
    return _table


class _Writer:
    def __init__(self, seed, random=None):
        self.random = random or randoms.Random(seed)
        self.types = sorted(_schemas())
        self.count = 0

    def attribute(self, kind, name, allowed=()):
        r = self.random
        text = values.value(r, kind, allowed, r.random() < 0.5)
        if text is None:
            return []
        if r.random() < 0.06:
            return [f"{kind} {name}.timeSamples = {{ 0: {text}, 1: {values.value(r, kind, allowed)} }}"]
        return [f"{kind} {name} = {text}"]

    def primvar(self):
        r = self.random
        kind = r.choice(("color3f[]", "float[]", "texCoord2f[]", "int[]", "string[]", "quatf[]", "matrix4d[]", "normal3f[]",
                         "float3"))
        interpolation = r.choice(("constant", "uniform", "vertex", "varying", "faceVarying"))
        name = r.choice(("displayColor", "st", "normals", "displayOpacity", "patina:x", "widths", "skel:jointIndices"))
        return [f"{line} (interpolation = \"{interpolation}\")" if "timeSamples" not in line else line
                for line in self.attribute(kind, f"primvars:{name}")]

    def prim(self, depth=0):
        r = self.random
        kind = r.choice(self.types) if r.random() < 0.6 else r.choice(sorted(SOUND))
        name = f"p{self.count}"
        self.count += 1
        apis = [api for api in APIS if r.random() < 0.08]
        words = ["active = false"] if r.random() < 0.02 else []
        if apis:
            words.append("prepend apiSchemas = [" + ", ".join(map(values.quoted, apis)) + "]")
        if r.random() < 0.05:
            words.append("instanceable = true")
        if r.random() < 0.06:
            words.append(f"references = </p{r.randint(0, 9)}>")
        lines = [f'def {kind} "{name}" (' + "; ".join(words) + ")", "{"] if words else [f'def {kind} "{name}"', "{"]
        written = set()
        if kind in SOUND and r.random() < 0.8:
            lines += ["    " + line for line in SOUND[kind]]
            written = {line.split(" = ")[0].split()[-1] for line in SOUND[kind]}
        for typed, attribute, allowed in _schemas()[kind]:
            if attribute not in written and r.random() < 0.2:
                lines += ["    " + line for line in self.attribute(typed, attribute, allowed)]
        for _ in range(r.choice((0, 0, 1, 2))):
            lines += ["    " + line for line in self.primvar()]
        if r.random() < 0.3:
            move = r.choice(MOVES)
            lines += ["    " + line for line in self.attribute(*move.split())]
            lines.append(f'    uniform token[] xformOpOrder = ["{move.split()[1]}"]')
        if r.random() < 0.4:
            lines.append("    rel material:binding = </material>")
        while depth < 3 and r.random() < 0.25:
            lines += ["    " + line for line in self.prim(depth + 1)]
        return _once(lines) + ["}"]


def _once(lines):
    """USD refuses a layer whose prim says a thing twice: the first counts."""
    kept, names, depth = [], set(), 0
    for line in lines:
        head = line.partition(" = ")[0].strip() if " = " in line and not line.lstrip().startswith("def") else ""
        head = head.split()[-1].partition(".timeSamples")[0] if head else ""
        if depth == 1 and head and head in names:
            continue
        if depth == 1 and head:
            names.add(head)
        depth += line.strip() == "{"
        depth -= line.strip() == "}"
        kept.append(line)
    return kept


def make(seed):
    """:returns: the bytes of an input"""
    return stage(_Writer(seed))


def stage(writer):
    """:returns: the bytes of the stage that a writer's random numbers make"""
    r = writer.random
    head = ["#usda 1.0", "(", f'    upAxis = "{r.choice("YZ")}"',
            f"    metersPerUnit = {r.choice(('0.01', '1', '0', '-1', '1e-30', 'inf'))}", ")"]
    lines = [*head, 'def Camera "camera"', "{", "    double3 xformOp:translate = (0, 0, 6)",
             '    uniform token[] xformOpOrder = ["xformOp:translate"]']
    if r.random() < 0.3:
        for kind, name, allowed in _schemas()["Camera"]:
            if r.random() < 0.2:
                lines += ["    " + line for line in writer.attribute(kind, name, allowed)]
    lines += ["}", 'def DomeLight "dome"', "{", "}", 'def Volume "puff"', "{", "}"]
    lines += materialDocuments.usd_material(r)
    for _ in range(r.randint(1, 6)):
        lines += writer.prim()
    return "\n".join([*lines, ""]).encode(errors="replace")


def execute(path, folder):
    """Renders an input, in a process that may die. :returns: its exit status"""
    return outcomes.record(["record", path, "image.exr", "--camera", "/camera"], folder, _takes_light_away(path))


def _takes_light_away(path):
    """:returns: whether a number below 0 stands among the inputs of a light, each of which may be a factor of its light"""
    from pxr import Usd, UsdLux

    try:
        stage = Usd.Stage.Open(path)
    except Exception:  # Patina says why it does not open
        return False
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        if prim.HasAPI(UsdLux.LightAPI):
            for name in ("color", "intensity", "diffuse", "specular"):
                attribute = prim.GetAttribute("inputs:" + name)
                values = [attribute.Get(time) for time in (Usd.TimeCode.Default(), *attribute.GetTimeSamples())] \
                    if attribute else []
                if any(number < 0 for value in values if value is not None
                       for number in (value if hasattr(value, "__len__") else [value])):
                    return True
    return False


def without(path):
    """Opens an input with USD alone, as a host without Patina does. :returns: the exit status"""
    from pxr import Usd, UsdGeom

    stage = Usd.Stage.Open(path)
    cache = UsdGeom.XformCache(Usd.TimeCode(0))
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()) if stage else ():
        cache.GetLocalToWorldTransform(prim)
        for attribute in prim.GetAttributes():
            attribute.Get(0)
    return 0
