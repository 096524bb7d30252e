# SPDX-License-Identifier: Apache-2.0
"""Objects that overlap, with dielectric priorities: what is seen equals a scene that was cut by booleans, where each surface
has the ior of its one side over that of the other.

A path takes the same random numbers through both scenes, as a surface that is not there takes none. So images differ by the
rounding of ray origins and of ior quotients alone: all but some pixels, whose paths choose otherwise, are equal to 1e-3.
How many pixels may choose otherwise is chosen, not derived: an ior that is not divided changes nearly all behind the glass."""
import numpy as np
import pytest

from rendering import color, patina, shot
import usda

GLASS, WATER, ICE = 1.5, 1.33, 1.31


def head(unit=1.0, at=(0.0, 0.0, 0.0)):
    """:param unit: units of the stage for one of the test's lengths"""
    def place(y, z):
        return f"{at[0]:g}", f"{at[1] + y * unit:g}", f"{at[2] + z * unit:g}"

    return usda.stage(
        usda.camera(lens=(50, 20, 20), clippingRange=(0.001, 100000), at=place(0, 8)),
        usda.prim("DomeLight", "dome", intensity=0.3),
        usda.prim("RectLight", "lamp", color=(1, 0.6, 0.3), width=f"{3 * unit:g}", height=f"{3 * unit:g}", intensity=8,
                  at=place(3, 2), rotateX=-60),
        up="", metersPerUnit=float(f"{0.01 / unit:g}"))


def material(name, ior, absorption=None):
    """Clear, or with a medium that absorbs so much per unit of length; a second bounce of each is coloured by that alone."""
    nodes = {"surface": ("ND_surface", {"bsdf": "<bsdf>"}),
             "bsdf": ("ND_dielectric_bsdf", {"float ior": f"{ior:.9g}", "scatter_mode": "RT", "roughness": (0, 0)})}
    if absorption is None:
        return usda.material(name, nodes)
    nodes.update(volume=("ND_volume", {"vdf": "<vdf>"}), vdf=("ND_absorption_vdf", {"float3 absorption": tuple(absorption)}))
    return usda.material(name, nodes, surface="surface", volume="volume")


def sphere(name, radius, paint, priority=0, inside_out=False, at=(0.0, 0.0, 0.0), unit=1.0):
    lines = ['uniform token orientation = "leftHanded"'] * inside_out
    lines += [f"int primvars:patina:dielectricPriority = {priority}"] if priority else []
    return usda.prim("Sphere", name, *lines, radius=f"{radius * unit:.9g}", bind=paint, at=tuple(f"{x:.9g}" for x in at))


def image(folder, name, text, *flags):
    return color(shot(folder, text, "--camera", "/camera", "--imageWidth", 48, "--imageHeight", 48, "--samples", 16,
                      "--strict", *flags, name=name))


def assert_equal(found, truth, but=0.02):
    """:param but: share of the pixels that may differ, as some of 16 paths take the other way at an interface"""
    apart = np.abs(found - truth).max(axis=-1) > 1e-3 * np.maximum(truth.max(axis=-1), 1e-3)
    assert apart.mean() <= but, apart.mean()
    assert found.mean(axis=(0, 1)) == pytest.approx(truth.mean(axis=(0, 1)), rel=5e-3)


@pytest.mark.parametrize("unit, at", [(1.0, (0, 0, 0)), (30.0, (4e4, -2e4, 1e4))], ids=["origin", "farAway"])
def test_water_that_reaches_into_its_glass(tmp_path, unit, at):
    """A hollow glass ball full of water: the water is modelled too large, and the wall counts where both are."""
    absorption = [x / unit for x in (0.1, 0.5, 1.2)]
    text = head(unit, at) + material("glass", GLASS) + material("water", WATER, absorption)
    nested = text + sphere("wall", 1.5, "glass", 2, at=at, unit=unit)
    nested += sphere("hollow", 1.2, "glass", 2, True, at=at, unit=unit)
    nested += sphere("drink", 1.35, "water", 1, at=at, unit=unit)
    # Cut: the water's surface is the hollow's, and has the ior of water over that of glass.
    cut = head(unit, at) + material("glass", GLASS) + material("filling", WATER / GLASS, absorption)
    cut += sphere("wall", 1.5, "glass", at=at, unit=unit) + sphere("drink", 1.2, "filling", at=at, unit=unit)
    assert_equal(image(tmp_path, "nested", nested), image(tmp_path, "cut", cut))


def test_ice_in_a_drink(tmp_path):
    """Ice that lies whole in water replaces it: its surface has the ior of ice over that of water."""
    both = material("water", WATER)
    nested = head() + both + material("ice", ICE) + sphere("drink", 1.5, "water", 1) + sphere("cube", 0.8, "ice", 2)
    cut = head() + both + material("ice", ICE / WATER) + sphere("drink", 1.5, "water") + sphere("cube", 0.8, "ice")
    truth = image(tmp_path, "cut", cut)
    assert_equal(image(tmp_path, "nested", nested), truth)
    # Without priorities the ice has its ior over that of air.
    plain = image(tmp_path, "plain", nested.replace("int primvars:patina:dielectricPriority", "int primvars:other"))
    assert np.abs(plain - truth).mean() > 0.02 * truth.mean()


def test_an_ice_cube_that_looks_out_of_the_water(tmp_path):
    """Two balls that overlap in part: inside of the ice the water's surface is not there."""
    parts = material("water", WATER, (0.3, 0.2, 0.1)) + material("ice", ICE)
    images = [image(tmp_path, f"order{k}", head() + parts + sphere("drink", 1.2, "water", 1 + k) +
                    sphere("cube", 0.9, "ice", 2 - k, at=(0.9, 0.5, 0.3))) for k in (0, 1)]
    assert np.isfinite(images).all() and np.abs(images[0] - images[1]).mean() > 1e-3


@pytest.mark.parametrize("order", [(1, 2, 3), (3, 2, 1), (2, 3, 1)])
def test_no_light_is_lost_where_three_overlap(tmp_path, order):
    """Clear objects under an even sky of 0.3 look like it, however they overlap: interfaces send on all that meets them."""
    text = head()
    text = text[:text.index("def RectLight")]
    for k, (rank, ior) in enumerate(zip(order, (GLASS, WATER, ICE))):
        text += material(f"look{k}", ior) + sphere(f"ball{k}", 1.1, f"look{k}", rank, at=(0.7 * k - 0.7, 0.3 * k, -0.2 * k))
    # Smooth normals on polygons lose some grazing light: 3e-5 of it in a single ball, 1.3e-3 here.
    assert image(tmp_path, "furnace", text, "--maxDepth", 256).mean() == pytest.approx(0.3, rel=5e-3)


def test_a_camera_in_the_drink(tmp_path):
    """The media around the camera have their priorities and iors."""
    water, nothing = material("water", WATER, (0.02, 0.05, 0.1)), (1e-9, 1e-9, 1e-9)  # the ice's medium replaces the water
    nested = head() + water + material("ice", ICE, nothing) + sphere("sea", 30, "water", 1) + sphere("cube", 1.2, "ice", 2)
    cut = head() + water + material("ice", ICE / WATER, nothing) + sphere("sea", 30, "water") + sphere("cube", 1.2, "ice")
    assert_equal(image(tmp_path, "nested", nested), image(tmp_path, "cut", cut))


def test_photons_go_the_same_way(tmp_path):
    text = head() + usda.floor("floor", 6, y=-2, scheme="")
    text += material("water", WATER)
    nested = text + material("ice", ICE) + sphere("drink", 1.5, "water", 1) + sphere("cube", 0.8, "ice", 2)
    cut = text + material("ice", ICE / WATER) + sphere("drink", 1.5, "water") + sphere("cube", 0.8, "ice")
    flags = "--method", "caustics=photons"
    assert_equal(image(tmp_path, "nested", nested, *flags), image(tmp_path, "cut", cut, *flags), but=0.1)


@pytest.mark.parametrize("value", ["-1", "1.5"])
def test_a_priority_that_means_nothing_is_told(tmp_path, value):
    stage = tmp_path / "stage.usda"
    stage.write_text(head() + material("water", WATER) + sphere("drink", 1.5, "water", 7).replace(
        "int primvars:patina:dielectricPriority = 7", f"double primvars:patina:dielectricPriority = {value}"))
    process = patina("record", stage, tmp_path / "x.exr", "--imageWidth", 8, "--samples", 1)
    assert "/drink.primvars:patina:dielectricPriority: has an unknown value" in process.stderr


def test_the_rasterizer_says_that_it_ranks_nothing(tmp_path):
    stage = tmp_path / "stage.usda"
    stage.write_text(head() + material("water", WATER) + sphere("drink", 1.5, "water", 1))
    process = patina("record", stage, tmp_path / "x.exr", "--imageWidth", 8, "--samples", 1, "--backend", "raster")
    assert "dielectric priorities are not told apart by the rasterizer" in process.stderr
