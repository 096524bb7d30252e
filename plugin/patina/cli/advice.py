# SPDX-License-Identifier: Apache-2.0
"""Advice on a warning, by its words.

The first row that a message matches counts. testenv/lint/test_messages.py holds the table to the texts in the code: each has
a row, and each row has a text.
"""
import re

# (words of the message, what to do)
_ROWS = (
    (r"back plate|plate is opaque|not finite and above 0; 1|levels of detail|is no heuristic|lod:|whose type",
     "correct the camera's BackPlateAPI, or the LODRootAPI and its heuristics, as their schemas in OpenUSD 26.08 say"),
    # Back ends and drivers.
    (r"the path tracer renders instead|goes on without a first image",
     "install Mesa or a driver with OpenGL 4.5 and EGL (`PATINA_EGL_PLATFORM` chooses one), or ask for `--backend embree`"),
    (r"follows no light paths|driver does not take|shown with|primvars:… is left empty|clips by the first|by the "
     r"rasterizer$|draws no shadow|^the rasterizer (draws|has no room|shows)",
     "this is a limit of the rasterizer or the driver; `--backend embree` has none"),
    (r"the image stays as it is", "install Open Image Denoise (`./patina` fetches pyoidn for `--denoise`)"),
    (r"start too far away, or have no direction", "look for transforms and points that are far too large or not finite"),
    (r"caustics, not photons", "change the part that the message names, or take `--method caustics=paths`"),
    # Limits.
    (r"\(--limit|nodes than|bytes than|is longer than|the scene has more|included documents than|levels deep than|"
     r"nodes follow each other|wherever it is placed, than",
     "raise the limit with `--limit`, or with PATINA_LIMITS in other hosts, where the file is trusted; "
     "[limits](limits.md) lists them"),
    # Lights' filters and portals.
    (r"OpenUSD knows; the light filter",
     "install the schema of that type, or name the type as `lightFilter:shaderId` of a LightFilter"),
    (r"filter is left out|unknown type '…'", "correct the light's `light:filters`: its targets are light filters of a "
     "type that [lights](../design/lights.md#filters) lists"),
    (r"ramp whose knots", "write the ramp's knots in ascending order, and a value for each"),
    (r"is no light filter", "correct the light's `light:filters`: its targets are prims of LightFilter"),
    (r"is no PortalLight", "correct the dome's `portals`: its targets are PortalLights"),
    (r"nothing of the sky", "give the PortalLight a size above 0, and turn its -z axis away from the sky that it lets in"),
    # Inputs.
    (r"has no such input|no such input|such an input|has no output|no such output|has no input|does not exist; the default",
     "spell the name as in the node's definition; `patina explain` lists the inputs"),
    (r"has an unknown value|rays of this kind see the prim", "take a primvar and a value that [marks](marks.md) lists"),
    (r"camera attribute is left out|this projection can show|both eyes see|neither a number nor a text",
     "take an attribute and a value that [cameras](cameras.md) lists"),
    # Files and textures.
    (r"lens does not distort", "check the path; the map is an image that holds places in red and green"),
    (r"names no file|names no IES file|no file is given", "set the asset path, or disconnect the node"),
    (r"magenta|emits the same everywhere|not shaped by it|card is plain",
     "check the path as the message spells it, against the layer that authors it"),
    (r"values that are NaN or infinite", "write the texture again; the program that made it divides by zero or overflows"),
    (r"ICC profile", "convert the image to sRGB, or author its `sourceColorSpace`"),
    (r"colour space", "name one that `patina` knows: those of OCIO's configuration ($OCIO), sRGB, raw, `lin_rec709`"),
    (r"no OpenVDB", "build with OpenVDB (Debian: libopenvdb-dev)"),
    (r"^grid|field is left out|volume has no field|fields of type|is not read; it is left out|field moves with",
     "give the volume a `field:density` that is an OpenVDBAsset with a float or vector grid; its transform is the volume's "
     "own"),
    (r"layers and frame ranges|file name varies", "name one file, or tiles by `<UDIM>` or `<UVTILE>`"),
    (r"there is no unit", "name a unit of MaterialX's library, as `inch` or `radian`, or define it by a `unitdef`"),
    (r"to inherit from|no such property of the geometry|there is no version|channels come from|thin_surface that no",
     "check the file with MaterialX's `mxvalidate.py`, and correct what it names"),
    (r"included document|includes itself|included documents", "correct the `xi:include` of the MaterialX document"),
    (r"the document is ignored|the file …$|the folder cannot be read",
     "check the file with MaterialX's `mxvalidate.py`, and correct what it names"),
    (r"there is no file|^… has no …$|mtlx has no", "check the reference: the file, and the prim that is asked for in it"),
    (r"lights of documents", "make the light a prim of UsdLux"),
    # Geometry.
    (r"different normals", "connect fewer different `normal` inputs to the lobes of the material"),
    (r"handed on by UsdImaging", "render with `patina record`, which reads their widths, or write Bezier curves"),
    (r"cannot be computed by the host",
     "correct the skeleton, or whatever else deforms the prim; `patina record` skins by itself"),
    (r"name instances that it has no", "give the PointInstancer a position for each of its `protoIndices`"),
    (r"crease|corners|subdivisionScheme|OpenSubdiv|loop needs|refine|than the limits|use a point twice|sharpness",
     "correct the mesh, or set `subdivisionScheme` to none to draw it as polygons"),
    (r"weights|knots|patch|trim|cut out|… curves are not drawn|lines join the points",
     "compare the counts of points, orders, knots and weights with UsdGeom's schema; trim curves are not supported"),
    (r"tetrahedra", "correct `tetVertexIndices`"),
    (r"subset|elementType|already in another|indices are out of range and ignored",
     "correct the GeomSubset's indices and its `elementType`"),
    (r"number from the points|number from the curves|basis|bezier|nonperiodic|no curve|curves …|there are no "
     r"curves|tangents|Hermite",
     "compare `type`, `basis`, `wrap` and the vertex counts with UsdGeom's schema"),
    (r"normals|faces are drawn flat|have no direction",
     "remove the normals, or write them anew: they are computed where there are none"),
    (r"belong to no face|no faces|no points|^… …\.\.\.|\(first: …\)|no array (of|with)",
     "correct counts and indices of the prim; `usdchecker` finds such prims"),
    (r"no primvar is named|primvars of this type", "name a primvar of type float, vector or colour"),
    (r"primvar|components per element|elements where|indices are out of range and read|index out of range; the first|"
     r"multiple of its elementSize|values for … instances|values per instance",
     "compare the number of values with the interpolation, and the indices with the values"),
    (r"sample times|time samples in the shutter|number of points changes|sample is left out",
     "write samples with the same topology; Patina blurs these alone"),
    (r"displayed|not drawn; a cross|card is left out", "correct `model:cardGeometry`, or set `model:drawMode` to default"),
    (r"prims of type", "convert the prim to a shape of UsdGeom that [features](../features.md) lists"),
    (r"has no interpolation", "write constant, uniform, varying, vertex or faceVarying as the primvar's interpolation"),
    (r"drawn without them", "compare the lengths of the BlendShape's `offsets` and `pointIndices` with the mesh's points"),
    (r"skel|skinned|rest pose",
     "bind a skeleton whose joints fit: `skel:skeleton`, `primvars:skel:jointIndices` and `jointWeights`"),
    # Transforms and cameras.
    (r"^of an instance", "look for a scale of 0, or a number that overflowed, among the instances' transforms"),
    (r"not a positive number", "write a positive `metersPerUnit` into the stage's metadata"),
    (r"transform|none is used|has no inverse|flat",
     "look for a scale of 0, or a number that overflowed, in the prim's xformOps"),
    (r"finite|not a number|NaN|is negative|are negative|is no finite number|three finite numbers",
     "write a number in the range that the schema gives; look at the program that exported it"),
    (r"extents to frame", "give the stage a camera, and its prims an `extent`"),
    (r"perspective is used|shutter|clippingRange|two numbers|clip nothing|ends before it starts|axis|is none of X",
     "correct the attribute; the schema of UsdGeomCamera or of the shape lists its values"),
    # Instances.
    (r"the host has no instancer", "move the prototypes into the asset that draws them, or set "
     "`USDIMAGINGGL_ENGINE_ENABLE_SCENE_INDEX=0`"),
    (r"not of length 1", "write quaternions of length 1 into the PointInstancer's `orientations`"),
    (r"protoIndices|prototype|holds itself|instances|instance is",
     "correct `protoIndices` and `prototypes` of the PointInstancer"),
    # Lights.
    (r"below zero",
     "render the lights of negative intensity and the others as two images, and denoise each"),
    (r"mesh light|names no mesh", "apply MeshLightAPI to a Mesh, which gives the light its shape"),
    (r"cannot be used; the light", "correct the light's collections `lightLink` and `shadowLink`"),
    (r"light filters do not change", "take `--method domeLight=sampled` or `filtered`, or no method"),
    (r"light is off|no size|not evaluated",
     "author the value on the light itself, as an input of UsdLux: nothing else of a light is evaluated"),
    # Materials.
    (r"does not exist; displayColor|binding is left out|which …; the", "correct `material:binding`: its target is a Material"),
    (r"a grey one is shown", "bind a material with a volume terminal (`ND_volume`)"),
    (r"can be shown; displayColor|no usable surface|is not a surface|not a displacement|is not a volume|terminal",
     "connect `outputs:surface` (or mtlx:surface) to a node of type surfaceshader"),
    (r"is not modelled|cannot be used at this place|coats only as the top",
     "use another node; [nodes](../generated/nodes.md) lists all of them"),
    (r"nested too deeply|too large|more than … lobes|share too many|too much would",
     "split the material, or bake parts of it to textures (`patina bake`)"),
    (r"unknown space|unknown address|unknown wrap|wrap mode|is not known",
     "use one of the values of the MaterialX specification"),
    (r"channels", "name channels that the connected value has, by the letters rgba or xyzw"),
    (r"is unknown;|unknown value", "use one of the values that the schema of the prim's type lists"),
    (r"wrong type|of type|the default is used", "give it a value of the type that the definition has"),
    (r"without a reason", "Embree gives no reason; report it, with the stage"),
    (r"shading model|no translation", "ask for one of UsdPreviewSurface, gltf_pbr, standard_surface, open_pbr_surface"),
    # Render settings and products.
    (r"left out of Cryptomatte", "give instances that need no id of their own one name, by `primvars:patina:cryptoObject`"),
    (r"product|AOV|UsdRenderProduct|orderedVars",
     "correct the UsdRender prim; [AOVs](aovs.md) lists the names"),
    (r"setting|back end|is not allowed|purpose|rendering in|holds no pixel|beyond the image",
     "correct the UsdRenderSettings prim; [flags](flags.md) lists settings and ranges"),
    (r"there is no prim", "correct the relationship: no prim has that path"),
    (r"cannot be read and is not drawn|cannot be used|cannot be read",
     "the rest of the message is OpenUSD's or the library's own reason"),
)
_COMPILED = tuple((re.compile(pattern, re.IGNORECASE), text) for pattern, text in _ROWS)


def row_of(message):
    """:returns: the place of the row that counts for a message, or None"""
    return next((i for i, (pattern, _) in enumerate(_COMPILED) if pattern.search(message)), None)


def advice(message):
    """:returns: what to do about a warning, in Markdown; empty where nothing is known"""
    found = row_of(message)
    return "" if found is None else _COMPILED[found][1]


def count():
    """:returns: how many rows there are"""
    return len(_ROWS)
