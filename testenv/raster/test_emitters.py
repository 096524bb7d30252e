# SPDX-License-Identifier: Apache-2.0
"""Emitters of all kinds, in view and out of it, light a floor and a block as they do in the path tracer's direct light.

Both back ends render everything with 8 seeds (0 to 7). Means of 8 x 8 pixels and of the whole image are held together by
Welch's test with 7 degrees of freedom at a significance of 0.001 over all of them (Sidak), beyond a margin of 1 % of the value
(0.05 % of the image's mean where it is dark).
"""
import numpy as np
import pytest
from pxr import Sdf, Usd

import _patina
import mtlx
import bothBackEnds
from floorLights import PROFILE
from patina import experiment
from patina import stage as reader
import usda

SEEDS, WIDTH, TILE = 8, 32, 8
MARGIN = 0.01
# Student's t with 7 degrees of freedom at 1 - (1 - 0.999 ** (1 / 51)) / 2: 16 tiles and the whole image in three channels.
T = 9.9

STAGE = usda.stage(
    usda.prim("Xform", "World",
        usda.camera(lens=(24, 20.955, 20.955), clippingRange=(0.01, 1000),
                    matrix=((1, 0, 0, 0), (0, 0.6, -0.8, 0), (0, 0.8, 0.6, 0), (0, 5.6, 4.2, 1))),
        usda.floor("floor", 3, color=(0.6, 0.6, 0.6)),
        usda.prim("Cube", "block", size=0.8, at=(0.5, 0.4, 0), color=(0.6, 0.3, 0.2)),
        usda.preview("glow", inside="/World", diffuseColor=(0, 0, 0), **{"color3f emissiveColor": "(%(glow)s)"}),
        "%(more)s", matrix="((%(scale)s, 0, 0, 0), (0, %(scale)s, 0, 0), (0, 0, %(scale)s, 0), (%(at)s, 1))"),
    defaultPrim="World", metersPerUnit="%(meters)s")

ABOVE = ((0, 7, 0), (-90, 0, 0))
BEHIND = ((0.5, 4.5, 9), (-30, 3, 0))  # the camera
BESIDE = ((-8, 2, 0), (0, -90, 0))
HIGH = ((1, 60, 5), (-90, 0, 0))
IN_VIEW = ((-1, 1.2, -1), (-60, 0, 0))


def prim(kind, where, *lines, **values):
    return usda.prim(kind, "emitter", *lines, at=where[0], turn=where[1], **values)


GLOWS = {"bind": "World/glow"}
MESH_LIGHT = ("float inputs:intensity = 4",)


def quad(where, *lines, size=1.5, front=(3, 2, 1, 0), bind="World/glow", name="emitter", **more):
    """Shines along -z, as lights do."""
    h = 0.5 * size
    return usda.mesh(name, [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], *lines, faces=[front], st=usda.ST, bind=bind,
                     at=where[0], turn=where[1], **more)


KINDS = {
    "glowingQuad": quad,
    "meshLight": lambda where: quad(where, *MESH_LIGHT, apis=("MeshLightAPI",), bind=""),
    "glowingSphere": lambda where: prim("Sphere", where, radius=0.5, **GLOWS),
    "glowingCube": lambda where: prim("Cube", where, size=1, **GLOWS),
    "rect": lambda where: prim("RectLight", where, intensity=4, width=1.5, height=1.5),
    "disk": lambda where: prim("DiskLight", where, intensity=4, radius=0.7),
    "sphere": lambda where: prim("SphereLight", where, intensity=4, radius=0.5),
    "cylinder": lambda where: prim("CylinderLight", where, intensity=4, radius=0.2, length=2),
}
CASES = [(kind, where) for kind in ("glowingQuad", "meshLight") for where in (ABOVE, BEHIND, BESIDE)]
CASES += [("glowingSphere", BEHIND), ("glowingCube", ABOVE), ("glowingQuad", HIGH), ("rect", ABOVE), ("disk", BEHIND),
          ("sphere", BESIDE), ("cylinder", ABOVE)]
NAMES = {ABOVE: "above", BEHIND: "behind", BESIDE: "beside", HIGH: "high", IN_VIEW: "inView"}


@pytest.fixture(scope="module")
def renderers():
    bothBackEnds.needs_opengl()
    return {name: _patina.make_renderer(name) for name in ("raster", "embree")}


def load(more, glow="4, 3, 2", scale=1.0, at="0, 0, 0"):
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(STAGE % {"more": more, "glow": glow, "scale": scale, "at": at, "meters": 1.0 / scale})
    scene = _patina.Scene()
    with scene.edit() as edit:
        info = reader.read_stage(Usd.Stage.Open(layer), edit, reader.StageOptions(headlight=False))
    return scene, info.camera


def render(renderer, stage, samples, seed):
    film = _patina.Film()
    settings = {"width": WIDTH, "height": WIDTH, "samples": samples, "seed": seed, "maxDepth": 1}
    experiment.draw(renderer, *stage, settings, film)
    return np.array(film.resolve("color"))[..., :3].astype(np.float64)


def means(image):
    """:returns: of the tiles and of the whole, each in three channels"""
    n = WIDTH // TILE
    tiles = image.reshape(n, TILE, n, TILE, 3).mean(axis=(1, 3)).reshape(-1, 3)
    return np.concatenate([tiles, image.mean(axis=(0, 1))[None]])


def apart(renderers, stage, passes, samples):
    """:returns: how far the back ends are apart beyond the margin, in standard errors; and signed, in parts of the value"""
    found = {}
    for name, count in (("raster", passes), ("embree", samples)):
        every = np.array([means(render(renderers[name], stage, count, seed)) for seed in range(SEEDS)])
        found[name] = every.mean(axis=0), every.var(axis=0, ddof=1) / SEEDS
    (r, r_var), (t, t_var) = found["raster"], found["embree"]
    assert t[-1].min() > 1e-6, "nothing is lit"
    beyond = np.maximum(np.abs(r - t) - MARGIN * t - 5e-4 * t[-1], 0.0)
    error = np.sqrt(r_var + t_var) + 1e-9 * t[-1]
    assert (error[-1] < 0.02 * t[-1]).all(), "too noisy to tell anything"
    return beyond / error, (r - t) / np.maximum(t, 1e-3 * t[-1])


def hold(renderers, stage, passes=4, samples=32):
    found, parts = apart(renderers, stage, passes, samples)
    i, channel = np.unravel_index(np.argmax(found), found.shape)
    where = "the image" if i == len(found) - 1 else f"tile {i}"
    assert found.max() <= T, (f"{where} is {100 * parts[i, channel]:+.1f} % off in channel {channel}, {found[i, channel]:.0f} "
                              f"standard errors beyond the margin; the whole {100 * parts[-1].mean():+.1f} %")


@pytest.mark.parametrize("kind,where", CASES, ids=lambda value: NAMES.get(value, value))
def test_emitters_out_of_view(kind, where, renderers):
    """An emitter has half its light where its own plane hides it."""
    # How many samples fall on the seen faces of a cube is a whole number: by 1/43 of 16 passes.
    passes = {"glowingCube": 16, "glowingSphere": 12, "glowingQuad": 4, "meshLight": 4}.get(kind, 32)
    hold(renderers, load(KINDS[kind](where), "400, 300, 200" if where == HIGH else "4, 3, 2"), passes)


@pytest.mark.parametrize("scale", [100.0, 0.01])
def test_emitters_in_other_units(scale, renderers):
    hold(renderers, load(quad(ABOVE), scale=scale))


def test_emitters_far_from_the_origin(renderers):
    """The same image as near it: the rasterizer's own, since only this is about its numbers."""
    near = render(renderers["raster"], load(quad(ABOVE)), 8, 0)
    far = render(renderers["raster"], load(quad(ABOVE), at="100000, 0, 50000"), 8, 0)
    np.testing.assert_allclose(means(far), means(near), rtol=0.02)


def test_a_small_lamp_in_view_hides_its_own_far_side(renderers):
    """1/1250 of what is seen: nearer to its places than shadow maps begin."""
    lamp = prim("Sphere", IN_VIEW, radius=0.004, **GLOWS)
    hold(renderers, load(lamp, "40000, 30000, 20000"), passes=32)


@pytest.mark.parametrize("kind", ["rect", "glowingQuad"])
def test_a_panel_in_the_plane_of_an_emitter_hides_nothing(kind, renderers):
    """As wide as a room's ceiling around a lamp that is set into it."""
    panel = usda.card("panel", 3.0, color=(0, 0, 0), at=ABOVE[0], turn=ABOVE[1])
    hold(renderers, load(KINDS[kind](ABOVE) + panel))


def shaped(kind, inputs, **more):
    """A material with that EDF, for quad(). :param more: nodes that it is connected to"""
    return usda.material("shaped", {"surface": ("ND_surface", {"edf": "<edf>"}), "edf": (kind, inputs), **more,
                                    "even": ("ND_uniform_edf", {"color": (4, 3, 2)})}, "/World")


WARM = {"color": (4, 3, 2)}
EDFS = {
    "conical": ("ND_conical_edf", {**WARM, "inner_angle": 20, "outer_angle": 70}),
    "inclined": ("ND_conical_edf", {**WARM, "inner_angle": 30, "outer_angle": 70, "float3 normal": (0.5, -0.8, 0.2)}),
    "inclinedNarrow": ("ND_conical_edf", {"color": (80, 60, 40), "inner_angle": 10, "outer_angle": 20,
                                          "float3 normal": (0.2, -0.9, -0.2)}),
    "hard": ("ND_conical_edf", {**WARM, "inner_angle": 40, "outer_angle": 40}),
    "schlick": ("ND_generalized_schlick_edf", {"color0": (0, 0.1, 0.2), "color90": (1, 1, 1), "exponent": 3, "base": "<even>"}),
    "measured": ("ND_measured_edf", {**WARM, "file": "lamp.ies"}),
}


def cones(**cones_of):
    """An emitter's EDF of two hard cones, each `(half angle, color, normal)`, as ND_add_edf has it."""
    nodes = {name: ("ND_conical_edf", {"color": color, "inner_angle": 2 * angle, "outer_angle": 2 * angle,
                                       "float3 normal": normal}) for name, (angle, color, normal) in cones_of.items()}
    return shaped("ND_add_edf", {"in1": "<first>", "in2": "<second>"}, **nodes)


NEAR = ((-1, 6, 0.5), (-80, 20, 0))
CONES = {
    "wide": (((30, (6, 3, 1), (0.3, -0.9, 0.2)), (20, (1, 4, 6), (-0.1, -0.9, -0.3))), 8, 64),
    "narrow": (((8, (60, 30, 10), (0.3, -0.9, 0.2)), (6, (10, 60, 90), (-0.1, -0.9, -0.3))), 64, 512),
}


@pytest.mark.parametrize("name", CONES)
def test_light_follows_cones_of_several_axes(name, renderers):
    given, passes, samples = CONES[name]
    stage = load(quad(NEAR, bind="World/shaped") + cones(first=given[0], second=given[1]))
    if name == "wide":
        hold(renderers, stage, passes, samples)
        return
    # Edges of narrow ones are soft by the steps of a table, but all of their light is there.
    found, parts = apart(renderers, stage, passes, samples)
    assert found[-1].max() <= T, parts[-1]


@pytest.mark.parametrize("name", sorted(EDFS))
def test_light_follows_the_direction_that_an_edf_has(name, renderers, tmp_path):
    kind, inputs = EDFS[name]
    (tmp_path / "lamp.ies").write_text(PROFILE)
    inputs = {**inputs, "file": str(tmp_path / "lamp.ies")} if "file" in inputs else inputs
    stage = load(quad(NEAR, bind="World/shaped") + shaped(kind, inputs))
    # Few samples lie where a narrow cone reaches.
    hold(renderers, stage, *((64, 512) if name == "inclinedNarrow" else (4, 32)))
    # A light without direction would be seen as such: the floor is not lit as by an even one.
    even = load(quad(NEAR, bind="World/shaped") + shaped("ND_uniform_edf", WARM))
    found, plain = (means(render(renderers["raster"], s, 8, 0))[:-1, 0] for s in (stage, even))
    ratio = found / plain
    assert ratio.max() > 1.5 * ratio.min(), ratio


def test_the_camera_sees_the_profile_of_a_measured_edf(tmp_path, renderers):
    (tmp_path / "lamp.ies").write_text(PROFILE)
    network = tmp_path / "lamp.mtlx"
    edf = ("measured_edf EDF", {"color": (1, 2, 3), "filename file": str(tmp_path / "lamp.ies")})
    network.write_text(mtlx.document({"edf": edf, **mtlx.shader("m", "surface", {"edf": "<edf>"})}))
    (read,) = _patina.read_mtlx(str(network))
    traced, drawn = _patina.MaterialProbe(read, {}), _patina.RasterProbe(read, {})
    assert drawn.warnings == traced.warnings == []
    angle, turn = np.meshgrid(np.radians([0.0, 13.0, 45.0, 71.0, 89.0, 140.0]), np.radians([0.0, 40.0, 160.0, 250.0, 359.0]))
    wo = np.stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], axis=-1).reshape(-1, 3)
    expected = traced.emission(wo.astype(np.float32))
    assert expected.max() > 5.0 * expected[expected > 0].min(), "the profile is flat"
    # The table has steps of a degree and of 15; the profile is linear between 0, 20, ... and 0, 90, ...
    np.testing.assert_allclose(drawn.emission(wo.astype(np.float32)), expected, rtol=0.01, atol=0.01)


def test_light_follows_the_places_on_an_emitter(renderers):
    """Its corners glow in four colours, by a primvar; it is as wide as the floor."""
    material = usda.material("places", {
        "surface": ("UsdPreviewSurface", {"diffuseColor": (0, 0, 0), "color3f emissiveColor": "<color>"}),
        "color": ("UsdPrimvarReader_float3", {"varname": "glow"})}, "/World")
    glow = 'color3f[] primvars:glow = [(8, 0, 1), (0, 0, 1), (0, 0, 9), (0, 4, 0)] (interpolation = "vertex")'
    hold(renderers, load(quad(((-1, 6, 1.2), (-80, 0, 0)), glow, bind="World/places", size=5.0) + material), passes=16)


def test_the_back_of_a_mesh_light_shines_by_its_material_alone(renderers):
    """materialSyncMode independent: the light is added to the front."""
    quads = quad(((-1.2, 6, 0), (-90, 0, 0)), *MESH_LIGHT, 'uniform token light:materialSyncMode = "independent"',
                 apis=("MeshLightAPI",), front=(0, 1, 2, 3))
    hold(renderers, load(quads, "0.4, 0.3, 0.2"))
