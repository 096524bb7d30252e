# SPDX-License-Identifier: Apache-2.0
"""Light that paths share: against closed forms where it is the same everywhere, beside paths where it is not."""
import numpy as np
import pytest
import scipy.stats

from inProcess import Stage
from rendering import scene
import usda
from usda import camera, lobe, mesh, prim

SEEDS = range(8)
SIGNIFICANCE = 1e-4  # of each test; fixed seeds
SMALL = ("--imageWidth", 24, "--samples", 32, "--disableCameraLight")
INWARD = [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]


def images(path, *arguments, method="shared"):
    stage = Stage(path, *SMALL, *arguments, "--method", f"indirectLight={method}")
    return np.array([stage.image(seed) for seed in SEEDS])


def box(folder, scale=1.0, far=0.0):
    """A closed box, all of which glows and reflects alike: what arrives is the same everywhere."""
    corners = [(x * scale + far, y * scale, z * scale) for z in (-1, 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    path = folder / "box.usda"
    path.write_text(usda.stage(
        camera(at=(far, 0, 0), lens=(20, 20, 20), clippingRange=(1e-3 * scale, 100 * scale)),
        mesh("box", corners, faces=INWARD, bind="glow", doubleSided=True),
        usda.material("glow", {"surface": ("ND_standard_surface_surfaceshader", {
            "base": 1, "base_color": (0.6, 0.3, 0.9), "specular": 0, "emission": 1, "emission_color": (1, 1, 1)})})))
    return path


@pytest.mark.parametrize("scale, far", [(1.0, 0.0), (100.0, 0.0), (0.01, 1000.0)])
@pytest.mark.parametrize("bounces", [1, 2, 5])
def test_a_box_that_glows_is_its_series(tmp_path, bounces, scale, far):
    """Le (1 + a + a^2 ...), with as many terms as the paths may have bounces: light that is shared is of no other depth."""
    found = images(box(tmp_path, scale, far), "--maxDepth", bounces).mean((1, 2))
    for c, albedo in enumerate((0.6, 0.3, 0.9)):
        wanted = sum(albedo ** k for k in range(bounces + 1))
        assert scipy.stats.sem(found[:, c]) < 0.005 * wanted
        assert abs(found[:, c].mean() - wanted) < 1e-5 * wanted or \
            scipy.stats.ttest_1samp(found[:, c], wanted).pvalue > SIGNIFICANCE, (found[:, c].mean(), wanted)


def leaf(folder, name, color):
    """A wall that no light meets straight, beside an endless sheet between a red sun above and a blue one below."""
    path = folder / "leaf.usda"
    size = 1e5  # a strip of 1e-5 is missing at the horizon
    path.write_text(usda.stage(
        camera(flat=(10, 10), at=(0, 1, 5)),
        mesh("sheet", [(-size, 0, size), (size, 0, size), (size, 0, -size), (-size, 0, -size)], bind="leaf", doubleSided=True),
        mesh("wall", [(-9, 0.1, 0), (9, 0.1, 0), (9, 9, 0), (-9, 9, 0)], bind="white", doubleSided=True),
        lobe("leaf", name, color=color), lobe("white", "oren_nayar_diffuse_bsdf", color=(1, 1, 1)),
        prim("DistantLight", "above", intensity=1, angle=0, color=(1, 0, 0), turn=(-90, 0, 0)),
        prim("DistantLight", "below", intensity=1, angle=0, color=(0, 0, 1), turn=(90, 0, 0))))
    return path


@pytest.mark.parametrize("name, channel", [("oren_nayar_diffuse_bsdf", 0), ("translucent_bsdf", 2)])
def test_both_sides_of_a_leaf_have_their_light(tmp_path, name, channel):
    """The wall sees the sheet in its lower half, so what it shows is half of the sheet's radiance, and no other light."""
    found = images(leaf(tmp_path, name, (0.8, 0.8, 0.8)), "--maxDepth", 2).mean((1, 2))
    sun = images(leaf(tmp_path, name, (0.8, 0.8, 0.8)), "--maxDepth", 1)
    assert sun.max() < 1e-12  # of what cosines are rounded to
    assert scipy.stats.sem(found[:, channel]) < 0.01 * found[:, channel].mean()
    assert scipy.stats.ttest_1samp(found[:, channel], 0.5 * 0.8 / np.pi).pvalue > SIGNIFICANCE, found.mean(0)
    others = [c for c in range(3) if c != channel]
    assert found[:, others].max() < 1e-12


@pytest.mark.parametrize("node, inputs", [
    ("oren_nayar_diffuse_bsdf", {"vector3f normal": (0.7071068, 0.7071068, 0)}), ("oren_nayar_diffuse_bsdf", {"roughness": 1}),
    ("burley_diffuse_bsdf", {"roughness": 1}), ("sheen_bsdf", {"roughness": 0.5})])
def test_what_lobes_make_of_light_stays_theirs(tmp_path, node, inputs):
    """The wall sees a floor, under a low sun that does not reach the wall, whose lobes are no Lambert lobes or have a normal of
    their own."""
    path = tmp_path / "tilted.usda"
    path.write_text(usda.stage(
        camera(flat=(10, 10), at=(0, 1, 5)), usda.floor("ground", 50, bind="soil", doubleSided=True),
        mesh("wall", [(-9, 0.1, 0), (9, 0.1, 0), (9, 9, 0), (-9, 9, 0)], bind="white", doubleSided=True),
        lobe("soil", node, color=(0.8, 0.8, 0.8), **inputs), lobe("white", "oren_nayar_diffuse_bsdf", color=(1, 1, 1)),
        prim("DistantLight", "sun", intensity=1, angle=0, turn=(-20, 90, 0))))
    found = {}
    for method in ("shared", "paths"):
        stage = Stage(path, "--imageWidth", 96, "--samples", 16, "--disableCameraLight", "--maxDepth", 2, "--method",
                      f"indirectLight={method}")
        found[method] = [stage.image(seed).mean() for seed in range(4)]
    assert scipy.stats.ttest_ind(*found.values(), equal_var=False).pvalue > SIGNIFICANCE, found
    assert np.mean(found["shared"]) == pytest.approx(np.mean(found["paths"]), rel=0.01)


@pytest.mark.parametrize("name", ["diffuseBox", "lightMesh", "plastic", "roughGlass", "media", "prism"])
def test_means_are_those_of_paths(name):
    """What cells blur shows in no mean: their error is smaller than the noise."""
    shared, paths = (images(scene(name), "--maxDepth", 6, method=method).mean((1, 2, 3)) for method in ("shared", "paths"))
    assert scipy.stats.ttest_ind(shared, paths, equal_var=False).pvalue > SIGNIFICANCE, (shared.mean(), paths.mean())


def test_a_room_has_less_noise_and_fewer_rays():
    """Of the pixels in the middle of the order: edges have theirs either way."""
    noise, rays = [], []
    for method in ("shared", "paths"):
        stage = Stage(scene("diffuseBox"), *SMALL, "--maxDepth", 6, "--branches", 4, "--lightSamples", 4, "--method",
                      f"indirectLight={method}")
        noise.append(np.median(np.var([stage.image(seed) for seed in SEEDS], axis=0, ddof=1)))
        rays.append(stage.state["statistics"]["rays"])
    assert rays[0] < rays[1] and noise[0] < noise[1]


def test_bits_depend_on_no_threads_and_no_parts(tmp_path):
    one, three = (Stage(scene("diffuseBox"), *SMALL, "--method", "indirectLight=shared", "--threads", n) for n in (1, 3))
    whole = one.image(5)
    assert np.array_equal(whole, three.image(5)) and whole.any()
    crop = three.image(5, dataWindow=(3, 2, 9, 8))
    assert np.array_equal(crop[2:9, 3:10], whole[2:9, 3:10])


@pytest.mark.parametrize("arguments, reason", [
    (("--aov", "key=lpe:C.*<L.'key'>"), "an AOV asks for light paths"), ((), "a light is linked to some surfaces")])
def test_where_light_cannot_be_shared_paths_find_it(tmp_path, arguments, reason):
    lamp = prim("SphereLight", "lamp", *([] if arguments else [
        "rel collection:lightLink:includes = </ball>", "uniform bool collection:lightLink:includeRoot = false"]),
        apis=("CollectionAPI:lightLink",), radius=0.2, intensity=20, at=(0, 2, 0))
    path = tmp_path / "lamp.usda"
    path.write_text(usda.stage(camera(at=(0, 0.5, 5)), usda.floor("floor", 4, y=-1), prim("Sphere", "ball", radius=1), lamp))
    shared, paths = (Stage(path, *SMALL, *arguments, "--method", f"indirectLight={method}") for method in ("shared", "paths"))
    assert np.array_equal(shared.image(1), paths.image(1))
    told = [w for w in shared.warnings() if "its own light" in str(w)]
    assert len(told) == 1 and reason in str(told[0])
    assert not [w for w in paths.warnings() if "its own light" in str(w)]


def test_an_open_shutter_shares_nothing():
    stage = Stage(scene("motionBlur"), *SMALL, "--samples", 1, "--method", "indirectLight=shared")
    stage.image(1)
    assert [w for w in stage.warnings() if "the shutter is open" in w]
