# SPDX-License-Identifier: Apache-2.0
"""Normal maps in both back ends: the frame is that of the uv set which the map is read by, T along +u and B along +v."""
import numpy as np
import pytest

import inProcess
import usda

NORMAL = np.array([0.48, 0.36, 0.8])  # in the frame of the map, of unit length
PIXELS = 8                            # that a card is wide
TO_SUN = np.array([0.6, 0.0, 0.8])
ALBEDO = 0.8

PLAIN = [(0, 0), (1, 0), (1, 1), (0, 1)]
MIRRORED = [(1, 0), (0, 0), (0, 1), (1, 1)]
TURNED = [(0, 1), (0, 0), (1, 0), (1, 1)]  # +u is up, +v to the left
FLIPPED = [(0, 1), (1, 1), (1, 0), (0, 0)]
FRAMES = {"plain": ((1, 0), (0, 1)), "mirrored": ((-1, 0), (0, 1)), "turned": ((0, 1), (-1, 0)), "flipped": ((1, 0), (0, -1))}
UVS = {"plain": PLAIN, "mirrored": MIRRORED, "turned": TURNED, "flipped": FLIPPED}

# name -> (sets of the mesh by name, how its coordinates run; sets that the material reads; changes of the card)
CARDS = {
    "st": ({"st": "plain"}, ["st"], ""),
    "mirrored": ({"st": "mirrored"}, ["st"], ""),
    "flipped": ({"st": "flipped"}, ["st"], ""),
    "second": ({"st": "plain", "st1": "turned"}, ["st1"], ""),
    "named": ({"UVMap": "turned"}, ["UVMap"], ""),
    "two": ({"st": "flipped", "st1": "turned"}, ["st", "st1"], ""),
    "two the other way": ({"st": "turned", "other": "mirrored"}, ["other", "st"], ""),
    "subdivided": ({"st": "plain", "st1": "turned"}, ["st", "st1"], "subdivided"),
    "instance that mirrors": ({"st": "plain", "st1": "turned"}, ["st", "st1"], "instance"),
    "subset": ({"st": "plain", "st1": "mirrored"}, ["st1", "st"], "subset"),
}
SAMPLES = {"embree": "64", "raster": "4"}
LIT = {"lit": ({"st": "plain", "st1": "turned"}, "st1"), "lit by name": ({"UVMap": "mirrored"}, "UVMap")}

HEAD = usda.stage(
    usda.camera(flat=("%(across)d", 10), at="(%(middle)s, 0, 5)"),
    usda.prim("DistantLight", "sun", intensity=3.14159265, angle=0.1, normalize=True, turn="(0, %(turn).6f, 0)"))


def expected(run, mirrors=False):
    """:returns: the normal in world space of a card whose coordinates run so"""
    t, b = (np.array([*v, 0.0]) for v in FRAMES[run])
    normal = NORMAL[0] * t + NORMAL[1] * b + NORMAL[2] * np.array([0.0, 0.0, 1.0])
    return normal * (-1, 1, 1) if mirrors else normal


def glowing(name, sets):
    """A material that gives off the mean of its maps' normals, from 0 to 1 for -1 to 1."""
    nodes = {"surface": ("ND_surface_unlit", {"color3f emission_color": "<color>"}),
             "color": ("ND_convert_vector3_color3", {"float3 in": "<above>"}, "color3f out"),
             "above": ("ND_add_vector3FA", {"float3 in1": "<half>", "in2": 0.5}, "float3 out"),
             "half": ("ND_multiply_vector3FA", {"float3 in1": "<sum>" if len(sets) > 1 else "<map0>", "in2": 0.5 / len(sets)},
                      "float3 out")}
    if len(sets) > 1:
        nodes["sum"] = ("ND_add_vector3", {"float3 in1": "<map0>", "float3 in2": "<map1>"}, "float3 out")
    for i, uv in enumerate(sets):
        nodes[f"uv{i}"] = ("ND_geompropvalue_vector2", {"geomprop": uv}, "float2 out")
        nodes[f"image{i}"] = ("ND_image_vector3", {"file": "map.exr", "float2 texcoord": f"<uv{i}>"}, "float3 out")
        nodes[f"map{i}"] = ("ND_normalmap_float", {"float3 in": f"<image{i}>"}, "float3 out")
    return usda.material(name, nodes)


def preview(name, uv):
    return usda.material(name, {
        "surface": ("UsdPreviewSurface", {"diffuseColor": (ALBEDO, ALBEDO, ALBEDO), "roughness": 1, "ior": 1,
                                          "normal3f normal": "<map>"}),
        "map": ("UsdUVTexture", {"file": "map.exr", "token sourceColorSpace": "raw", "float4 scale": (2, 2, 2, 1),
                                 "float4 bias": (-1, -1, -1, 0), "float2 st": "<uv>"}),
        "uv": ("UsdPrimvarReader_float2", {"varname": uv})})


def card(name, material, sets, x, how=""):
    """A square of width 1 about (x, 0, 0); its points are from -2 to 2 along x, which its transform makes narrower."""
    points = [(-2, -1, 0), (2, -1, 0), (2, 1, 0), (-2, 1, 0)]
    held = [f'texCoord2f[] primvars:{uv} = {UVS[run]} (interpolation = "vertex")' for uv, run in sets.items()]
    place = {"at": (x, 0, 0), "scale": (-0.25 if how == "instance" else 0.25, 0.5, 3)}
    if how == "instance":
        source = usda.prim("", f"{name}_source", usda.mesh("mesh", points, *held), specifier="class")
        meta = ("instanceable = true", f"inherits = </{name}_source>")
        return source + usda.prim("Xform", name, meta=meta, bind=material, **place)
    if how == "subset":
        held.append(usda.prim("GeomSubset", "all", 'uniform token elementType = "face"', "int[] indices = [0]",
                              'uniform token familyName = "materialBind"', bind=material))
    return usda.mesh(name, points, *held, scheme="catmullClark" if how == "subdivided" else "none",
                     bind="" if how == "subset" else material, **place)


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    import _patina

    folder = tmp_path_factory.mktemp("tangentSets")
    texel = (0.5 * NORMAL + 0.5).astype(np.float32)
    _patina.write_image(str(folder / "map.exr"), np.broadcast_to(texel, (4, 4, 3)).copy(), ["R", "G", "B"], {"half": False})
    count = len(CARDS) + len(LIT)
    text = HEAD % {"across": 10 * count, "middle": 0.5 * (count - 1),
                   "turn": np.degrees(np.arctan2(TO_SUN[0], TO_SUN[2]))}
    for i, (sets, read, how) in enumerate(CARDS.values()):
        text += glowing(f"m{i}", read) + card(f"c{i}", f"m{i}", sets, i, how)
    for i, (sets, read) in enumerate(LIT.values(), len(CARDS)):
        text += preview(f"m{i}", read) + card(f"c{i}", f"m{i}", sets, i)
    (folder / "stage.usda").write_text(text, encoding="utf-8")
    return str(folder / "stage.usda"), count


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_frames_follow_the_set_of_the_map(stage, backend):
    inProcess.needs_opengl(backend)
    path, count = stage
    image = inProcess.Stage(path, "--backend", backend, "--camera", "/camera", "-w", str(PIXELS * count),
                            "--samples", SAMPLES[backend], "--disableCameraLight", image_height=PIXELS).image(1)
    found = image[2:-2].reshape(PIXELS - 4, count, PIXELS, 3)[:, :, 2:-2].mean(axis=(0, 2))
    for i, (name, (sets, read, how)) in enumerate(CARDS.items()):
        wanted = np.mean([expected(sets[uv], how == "instance") for uv in read], axis=0)
        # Half floats of textures and of targets keep eleven bits.
        np.testing.assert_allclose(2.0 * found[i] - 1.0, wanted, atol=2e-3, err_msg=name)
    for i, (name, (sets, read)) in enumerate(LIT.items(), len(CARDS)):
        # The path tracer looks for the sun with an interface too, which has no light at ior 1. Pixels of 64
        # samples deviate by 0.0014, the mean of 16 of them by a sixth of the bound.
        # The sun is 0.1 degrees wide: its light differs by less than its half angle, and no sample misses it.
        np.testing.assert_allclose(found[i], ALBEDO * (expected(sets[read]) @ TO_SUN), atol=2e-3, err_msg=name)
