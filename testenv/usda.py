# SPDX-License-Identifier: Apache-2.0
"""Stages of tests as text of .usda: prims by what they hold, materials by their nodes.

Values are written as Python has them; a dict holds values by time. A text stands as it is, so that it may be a template's
field, but for tokens, strings and files, which are quoted."""
import textwrap

SHAPES = ("Sphere", "Cube", "Cone", "Cylinder", "Capsule", "Plane")  # whose sizes are doubles
TYPES = {  # of attributes that are no floats
    "clippingRange": "float2", "projection": "token", "points": "point3f[]", "positions": "point3f[]", "widths": "float[]",
    "faceVertexCounts": "int[]", "faceVertexIndices": "int[]", "curveVertexCounts": "int[]", "protoIndices": "int[]",
    "subdivisionScheme": "uniform token", "doubleSided": "uniform bool", "type": "uniform token", "basis": "uniform token",
    "axis": "uniform token", "visibility": "token", "purpose": "uniform token", "filePath": "asset", "fieldName": "token",
    "sourceName": "string", "dataType": "token", "productName": "token", "resolution": "int2", "normals": "normal3f[]",
    "primvars:st": "texCoord2f[]", "scales": "float3[]", "opacities": "float[]",
    "radiance:sphericalHarmonicsCoefficients": "float3[]"}
INPUTS = {"color": "color3f", "normalize": "bool", "file": "asset", "enableColorTemperature": "bool"}  # of lights and shaders
WHOLE = ("useSpecularWorkflow", "index")  # inputs of shaders that are whole numbers
OUTPUTS = {"UsdPreviewSurface": "token surface", "UsdUVTexture": "float3 rgb", "UsdPrimvarReader_float2": "float2 result",
           "UsdPrimvarReader_float3": "float3 result"}
TRANSFORMS = {"at": "double3 xformOp:translate", "matrix": "matrix4d xformOp:transform", "turn": "float3 xformOp:rotateXYZ",
              "rotateX": "float xformOp:rotateX", "rotateY": "float xformOp:rotateY", "scale": "float3 xformOp:scale"}
ST = [(0, 0), (1, 0), (1, 1), (0, 1)]  # of a quad


def _text(kind, value):
    quotes = '"' if kind.rstrip("[]").endswith(("token", "string")) else "@" if kind == "asset" else ""
    if isinstance(value, str):
        return quotes + value + quotes
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (tuple, list)):
        ends = "()" if isinstance(value, tuple) else "[]"
        return ends[0] + ", ".join(_text(kind, part) for part in value) + ends[1]
    return str(value)


def attribute(declared, value):
    """:param declared: type and name
    :returns: a line"""
    kind = declared.rpartition(" ")[0]
    if isinstance(value, dict):
        return f"{declared}.timeSamples = {{{', '.join(f'{time}: {_text(kind, of)}' for time, of in value.items())}}}"
    return f"{declared} = {_text(kind, value)}"


def _declared(kind, name):
    if kind.endswith("Light"):
        return f"{INPUTS.get(name, 'float')} inputs:{name}"
    return f"{'double' if kind in SHAPES and name not in TYPES else TYPES.get(name, 'float')} {name}"


def prim(kind, name, *held, bind="", color=None, st=None, apis=(), meta=(), specifier="def", **values):
    """:param kind: its type, or empty
    :param held: lines of its own, and texts of prims below it
    :param bind: path of its material, which may leave out the first /
    :param color: its displayColor, or a light's own
    :param st: texture coordinates of its points
    :param apis: names of applied schemas
    :param meta: lines of metadata
    :param values: transforms, as TRANSFORMS has them and in that order, and attributes
    :returns: its text"""
    if kind.endswith("Light") and color is not None:
        values, color = {"color": color, **values}, None
    lines = [attribute(_declared(kind, key), value) for key, value in values.items() if key not in TRANSFORMS]
    lines += [] if color is None else [f"color3f[] primvars:displayColor = {_text('', [color])}"]
    lines += [] if st is None else [f'texCoord2f[] primvars:st = {_text("", st)} (interpolation = "vertex")']
    moves = [key for key in TRANSFORMS if values.get(key) is not None]
    lines += [attribute(TRANSFORMS[key], values[key]) for key in moves]
    if moves:
        lines.append(attribute("uniform token[] xformOpOrder", [TRANSFORMS[key].split()[1] for key in moves]))
    if bind:
        lines.append(f"rel material:binding = </{bind.lstrip('/')}>")
        apis = ("MaterialBindingAPI", *apis)
    meta = [attribute("prepend token[] apiSchemas", list(apis)).replace("token[] ", "")] * bool(apis) + list(meta)
    head = f'{specifier} {kind} "{name}"'.replace("  ", " ") + (" (\n" + _indented(meta) + ")\n" if meta else "\n")
    return head + "{\n" + _indented(lines + list(held)) + "}\n"


def _indented(texts):
    return "".join(textwrap.indent(text.rstrip("\n") + "\n", "    ") for text in texts if text.strip())


def stage(*prims, up="Y", **metadata):
    """:param up: its axis; empty: that of the schema
    :returns: a layer's text"""
    known = {**({"upAxis": up} if up else {}), **metadata}
    lines = [f"{name} = {_text('' if str(value)[:1] in '[@%' else 'string', value)}" for name, value in known.items()]
    return "#usda 1.0\n" + (f"(\n{_indented(lines)})\n" if lines else "") + "".join(
        text.rstrip("\n") + "\n" for text in prims)


def camera(*held, name="camera", lens=None, flat=None, **values):
    """:param lens: focal length and apertures, across and upwards, of a perspective
    :param flat: apertures of an orthographic projection"""
    if lens:
        values = {**dict(zip(("focalLength", "horizontalAperture", "verticalAperture"), lens)), **values}
    if flat:
        values = {"projection": "orthographic", **dict(zip(("horizontalAperture", "verticalAperture"), flat)), **values}
    return prim("Camera", name, *held, **values)


def mesh(name, points, *held, faces=None, scheme="none", **values):
    """:param points: their places
    :param faces: numbers of points of each face; none: one face of all"""
    faces = faces or [tuple(range(len(points)))]
    return prim("Mesh", name, *held, faceVertexCounts=[len(face) for face in faces],
                faceVertexIndices=[corner for face in faces for corner in face], points=list(points),
                **({"subdivisionScheme": scheme} if scheme else {}), **values)


def card(name, half, *held, z=0, **values):
    """A quad that looks along z. :param half: of its width, or of its width and height"""
    x, y = half if isinstance(half, tuple) else (half, half)
    return mesh(name, [(-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)], *held, **values)


def floor(name, half, *held, y=0, **values):
    """A square that looks up."""
    return mesh(name, [(-half, y, half), (half, y, half), (half, y, -half), (-half, y, -half)], *held, **values)


def material(name, nodes, inside="", **terminals):
    """:param nodes: dict of a node's name to its definition, its inputs, and type and name of its output where OUTPUTS has them
        not. Inputs are a dict of a name, or `type name`, to a value, or to `<node>`, whose output is connected
    :param inside: path of the prim that it is below
    :param terminals: `surface`, `displacement`, `volume` and the node that gives it; none: the node `surface`"""
    outputs = {node: (*given, OUTPUTS.get(given[0], "token out"))[2] for node, given in nodes.items()}

    def linked(node):
        return f"<{inside}/{name}/{node}.outputs:{outputs[node].split()[1]}>"

    lines = []
    for terminal, node in (terminals or {"surface": "surface"}).items():
        target = "" if nodes[node][0].startswith("Usd") else "mtlx:"
        lines.append(f"token outputs:{target}{terminal}.connect = {linked(node)}")
    for node, (definition, inputs, *_) in nodes.items():
        own = [f'uniform token info:id = "{definition}"']
        for key, value in inputs.items():
            kind, _, key = key.rpartition(" ")
            if isinstance(value, str) and value.startswith("<"):
                own.append(f"{kind or 'token'} inputs:{key}.connect = {linked(value[1:-1])}")
            else:
                own.append(attribute(f"{kind or _kind_of(key, value)} inputs:{key}", value))
        lines.append(prim("Shader", node, *own, outputs[node].replace(" ", " outputs:")))
    return prim("Material", name, *lines)


def _kind_of(name, value):
    if name in INPUTS:
        return INPUTS[name]
    if isinstance(value, (bool, str)):
        return "bool" if isinstance(value, bool) else "string"
    return {2: "float2", 3: "color3f"}[len(value)] if isinstance(value, tuple) else "int" if name in WHOLE else "float"


def lobe(name, category, inside="", **inputs):
    """A material of one lobe. :param category: of its node"""
    return material(name, {"bsdf": (f"ND_{category}", inputs), "surface": ("ND_surface", {"bsdf": "<bsdf>"})}, inside)


def preview(name, inside="", **inputs):
    """A material of UsdPreviewSurface."""
    return material(name, {"surface": ("UsdPreviewSurface", inputs)}, inside)


def fill(layer, path, **arrays):
    """Sets attributes of a prim to numpy's arrays: large ones take long as text."""
    from pxr import Sdf, Vt

    spec = layer.GetPrimAtPath(path)
    for name, values in arrays.items():
        made = spec.attributes.get(name) or Sdf.AttributeSpec(spec, name, Sdf.ValueTypeNames.Find(TYPES[name]))
        whole = TYPES[name] == "int[]"
        kind = f"Vec{values.shape[1]}f" if values.ndim == 2 else "Int" if whole else "Float"
        made.default = getattr(Vt, kind + "Array").FromNumpy(values.astype("int32" if whole else "float32"))
