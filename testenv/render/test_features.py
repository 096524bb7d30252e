# SPDX-License-Identifier: Apache-2.0
"""End-to-end checks of what no closed-form light test covers: links, opacity, emission, media, AOVs."""
import math

import numpy as np
import pytest

import inProcess
from rendering import color, shot
import usda
from usda import material

HEAD = usda.stage()
CAMERA = usda.camera(lens=(50, 20, 20), clippingRange=(0.01, 1000), at=(0, 0, 10))


def quad(name, z, size=1.0, x=0.0, material="white", *held, **more):
    points = [(x + sx * size, sy * size, z) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return usda.mesh(name, points, *held, bind=material, st=usda.ST, **more)


def lambert(name, value):
    return usda.lobe(name, "oren_nayar_diffuse_bsdf", color=(value, value, value))


def glow(name, rgb):
    return material(name, {"edf": ("ND_uniform_edf", {"color": rgb}), "surface": ("ND_surface", {"edf": "<edf>"})})


def distant(name, *lines, intensity=math.pi, **more):
    """From the camera's side; a facing white Lambertian surface of albedo 0.5 shows intensity * 0.5 / pi."""
    return usda.prim("DistantLight", name, *lines, intensity=intensity, angle=0, **more)


def render(tmp_path, *parts, samples=64, arguments=(), channels="RGB"):
    image = shot(tmp_path, HEAD + CAMERA + "".join(parts), "--camera", "/camera", "--imageWidth", 32, "--imageHeight", 32,
                 "--samples", samples, "--filterRadius", 0.5, "--disableCameraLight", *arguments)
    return color(image, channels)


def test_light_linking_leaves_out_what_is_not_linked(tmp_path):
    sun = distant("sun", "prepend rel collection:lightLink:excludes = </right>",
                  "uniform bool collection:lightLink:includeRoot = 1", apis=("CollectionAPI:lightLink",))
    image = render(tmp_path, sun, quad("left", 0, 0.9, -1), quad("right", 0, 0.9, 1), lambert("white", 0.5))
    assert image[16, 8] == pytest.approx(0.5, rel=1e-4)
    assert image[16, 24] == pytest.approx(0.0, abs=1e-6)


def test_shadow_linking_lets_light_through_what_is_not_linked(tmp_path):
    links = ("prepend rel collection:shadowLink:excludes = </blocker>", "uniform bool collection:shadowLink:includeRoot = 1")
    linked = distant("sun", *links, apis=("CollectionAPI:shadowLink",), rotateY=45)
    # Light from the right passes the blocker, which stands beside the view of the floor's centre.
    for sun, expected in ((distant("sun", rotateY=45), 0.0), (linked, 0.5 * math.cos(math.pi / 4))):
        image = render(tmp_path, sun, quad("floor", 0, 1.5), quad("blocker", 3, 1.0, 3.0), lambert("white", 0.5))
        assert image[16, 16] == pytest.approx(expected, rel=1e-3, abs=1e-6)


@pytest.mark.parametrize("opacity, expected", [(1.0, 0.0), (0.0, 2.0)])
def test_presence_shows_what_is_behind(tmp_path, opacity, expected):
    surface = material("card", {"surface": ("ND_surface", {"opacity": opacity})})
    image = render(tmp_path, quad("front", 1, material="card"), quad("back", 0, material="glow"), surface,
                   glow("glow", (2, 2, 2)))
    assert image[16, 16] == pytest.approx(expected, abs=1e-6)


def test_half_presence_is_the_mean_and_casts_half_a_shadow(tmp_path):
    surface = material("card", {"surface": ("ND_surface", {"opacity": 0.5})})
    image = render(tmp_path, quad("front", 1, material="card"), quad("back", 0, material="glow"), surface,
                   glow("glow", (2, 2, 2)), samples=1024)
    # Binomial: 8 x 8 pixels of 1024 samples, deviation of the mean 2 * 0.5 / 256; 5 of them.
    assert image[12:20, 12:20].mean() == pytest.approx(1.0, abs=5 * 1.0 / 256)
    lit = render(tmp_path, distant("sun"), quad("floor", 0, 3), quad("front", 1, 0.5, 0.0, "card"), lambert("white", 0.5),
                 surface, samples=1024)
    through = lit[14:18, 14:18].mean()
    assert through == pytest.approx(0.5 * 0.5 * 0.5, rel=0.06)  # half of the camera's rays see the floor, half lit


def test_opacity_threshold_cuts_out(tmp_path):
    for opacity, expected in ((0.4, 2.0), (0.6, 0.0)):
        card = usda.preview("card", opacity=opacity, opacityThreshold=0.5, diffuseColor=(0, 0, 0), useSpecularWorkflow=1,
                            specularColor=(0, 0, 0))
        image = render(tmp_path, quad("front", 1, material="card"), quad("back", 0, material="glow"), card,
                       glow("glow", (2, 2, 2)))
        assert image[16, 16] == pytest.approx(expected, abs=2e-3)


def floor_under(panel):
    return quad("floor", 0, 1.0) + panel + lambert("white", 0.5)


def test_glowing_mesh_mesh_light_and_rect_light_light_a_floor_alike(tmp_path):
    """A panel of 2 x 2 at a distance of 6, behind the camera's near plane: the same floor thrice."""
    black = lambert("black", 0.0)
    # Facing the floor: the panel's front looks along -z.
    turned = 'uniform token orientation = "leftHanded"'
    glowing = render(tmp_path, floor_under(quad("panel", 12, 2.0, 0, "glow", turned)), glow("glow", (3, 3, 3)), samples=1024)
    mesh = quad("panel", 12, 2.0, 0, "black", turned, "float inputs:intensity = 3", apis=("MeshLightAPI",))
    as_light = render(tmp_path, floor_under(mesh), black, samples=1024)
    rect = usda.prim("RectLight", "panel", intensity=3, width=4, height=4, at=(0, 0, 12))
    as_rect = render(tmp_path, floor_under(rect), samples=1024)
    centre = np.s_[12:20, 12:20]
    assert as_rect[centre].mean() > 0.05
    assert glowing[centre].mean() == pytest.approx(as_rect[centre].mean(), rel=5e-3)
    assert as_light[centre].mean() == pytest.approx(as_rect[centre].mean(), rel=5e-3)


def test_absorption_follows_beers_law(tmp_path):
    """A clear cube of ior 1 and absorption (0.5, 1, 2), two units thick, in front of a glow of 1."""
    glass = material("glass", {
        "interface": ("ND_dielectric_bsdf", {"ior": 1, "roughness": (0, 0), "scatter_mode": "RT"}),
        "inside": ("ND_absorption_vdf", {"float3 absorption": (0.5, 1, 2)}),
        "layer": ("ND_layer_vdf", {"top": "<interface>", "base": "<inside>"}),
        "surface": ("ND_surface", {"bsdf": "<layer>"})})
    cube = usda.prim("Cube", "cube", size=2, bind="glass")
    camera = usda.camera(name="ortho", flat=(10, 10), at=(0, 0, 10))
    text = HEAD + camera + cube + quad("back", -3, 3.0, 0, "glow") + glass + glow("glow", (1, 1, 1))
    image = shot(tmp_path, text, "--camera", "/ortho", "--imageWidth", 16, "--imageHeight", 16, "--samples", 16)
    assert color(image)[8, 8] == pytest.approx(np.exp([-1.0, -2.0, -4.0]), rel=1e-3)


def test_aovs_of_a_plain_quad(tmp_path):
    text = HEAD + CAMERA + quad("a", 0, 1.5) + quad("b", 4, 0.25) + lambert("white", 0.5) + distant("sun")
    image = shot(tmp_path, text, "--imageWidth", 33, "--imageHeight", 33, "--samples", 16,
                 *[f for name in ("depth", "cameraDepth", "normal", "Neye", "position", "albedo", "primvars:st", "primId",
                                  "instanceId", "elementId", "sampleCount", "variance") for f in ("--aov", name)])
    data = inProcess.channels(image)
    middle, side = (16, 16), (16, 24)
    assert data["depth.Z"][middle] == pytest.approx(6, abs=1e-4)
    assert data["depth.Z"][side] == pytest.approx(10, abs=1e-4)
    for name in ("normal", "Neye"):  # the camera looks along -z
        assert [data[f"{name}.{axis}"][side] for axis in "XYZ"] == pytest.approx([0, 0, 1], abs=1e-6)
    assert data["primId"][side] == 0 and data["primId"][middle] == 1 and data["primId"][0, 0] == -1
    assert data["instanceId"][side] == -1 and data["elementId"][side] == 0
    assert data["albedo.G"][side] == pytest.approx(0.5, abs=1e-3)
    assert (data["sampleCount"] == 16).all()
    assert data["A"][side] == 1 and data["A"][0, 0] == 0
    x = data["position.X"][side]
    u = [v for k, v in data.items() if k.startswith("primvars:st")][0][side]
    assert u == pytest.approx((x + 1.5) / 3, abs=1e-4)


def test_instances_look_like_copies(tmp_path):
    """A point instancer inside a point instancer against the same meshes written out."""
    mesh = quad("leaf", 0, 0.3)
    inner = usda.prim("PointInstancer", "inner", "rel prototypes = </outer/inner/leaf>", mesh,
                      positions=[(-0.5, 0, 0), (0.5, 0, 0)], protoIndices=[0, 0])
    nested = usda.prim("PointInstancer", "outer", "rel prototypes = </outer/inner>", inner,
                       positions=[(0, -0.6, 0), (0, 0.6, 0.5)], protoIndices=[0, 0])
    copies = "".join(usda.prim("Xform", f"x{k}", mesh, at=place) for k, place in enumerate(
        [(-0.5, -0.6, 0), (0.5, -0.6, 0), (-0.5, 0.6, 0.5), (0.5, 0.6, 0.5)]))
    rest = lambert("white", 0.5) + distant("sun")
    a, b = render(tmp_path, nested, rest, samples=16), render(tmp_path, copies, rest, samples=16)
    assert a.max() > 0.4
    assert np.allclose(a, b, atol=1e-4)


def test_light_multipliers_split_diffuse_and_specular(tmp_path):
    shiny = usda.preview("white", diffuseColor=(0.5, 0.5, 0.5), roughness=0.3)
    whole, diffuse, specular = (
        render(tmp_path, usda.prim("RectLight", "light", intensity=5, width=3, height=3, diffuse=d, specular=s, at=(0, 0, 12)),
               quad("floor", 0, 1.5), shiny, samples=256).mean() for d, s in ((1, 1), (1, 0), (0, 1)))
    assert diffuse > 0 and specular > 0
    assert whole == pytest.approx(diffuse + specular, rel=0.01)
