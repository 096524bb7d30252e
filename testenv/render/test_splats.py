# SPDX-License-Identifier: Apache-2.0
"""Gaussian splats against closed forms.

Samples are at the pixels' middles, so images have no noise unless a test says so. Bounds: a kernel that is cut off lacks less
than CUT of alpha, so `n` kernels at a ray change its light by less than n CUT times the brightest colour; behind END of the
light nothing is shown; what is left is rounding: floats of kernels and rays, 2e-5 of values up to 1 for the sizes here."""
import numpy as np
import pytest
from pxr import Gf, Sdf, UsdGeom, UsdVol
from scipy.spatial.transform import Rotation

from rendering import pixels, record
from splatStages import (CUT, DOME, END, PANE, SUN, WHITE, Cloud, basis, floor, new_stage, off, place, placement, random_cloud,
                         rays, sharp_image)
import usda

if not hasattr(UsdVol, "ParticleField3DGaussianSplat"):
    pytest.skip("before OpenUSD 26.03", allow_module_level=True)

ROUNDING = 2e-5
PIXELS = 32
BOTH = pytest.mark.parametrize("backend", ["embree", "raster"])


def compare(images, light, alpha, bound=ROUNDING):
    """:param light, alpha: of the closed form, which cuts kernels off as the renderer does"""
    count = images["color"].shape[0]
    assert images["color"][..., :3].reshape(-1, 3) == pytest.approx(light, abs=bound)
    assert images["alpha"].reshape(count * count) == pytest.approx(alpha, abs=bound)


@pytest.mark.parametrize("rotate, axes, depth", [((0, 0, 0), (0, 1), 2), ((0, 90, 0), (2, 1), 0), ((-90, 0, 0), (0, 2), 1)])
@BOTH
def test_one_kernel_shows_its_projected_gaussian(tmp_path, backend, rotate, axes, depth):
    """Along each of its axes: opacity exp(-(x²/a² + y²/b²) / 2), written out here; missing where it is cut off."""
    scales, opacity, color = np.array([0.2, 0.3, 0.4]), 0.8, np.array([0.9, 0.4, 0.1])
    eye = np.zeros(3)
    eye[depth] = 10
    stage = new_stage(width=2.5, eye=eye, rotate=rotate)
    Cloud([0, 0, 0], scales, opacity, color).define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    x = (np.arange(PIXELS) + 0.5) / PIXELS * 2.5 - 1.25
    across, up = scales[list(axes)]
    alpha = opacity * np.exp(-0.5 * ((x[None] / across) ** 2 + (x[:, None] / up) ** 2))
    found = images["alpha"].reshape(PIXELS, PIXELS)
    assert np.abs(found - alpha).max() < CUT  # of the whole Gaussian
    assert found == pytest.approx(np.where(alpha > CUT, alpha, 0), abs=ROUNDING)
    assert images["color"][..., :3] == pytest.approx(found[..., None] * color, abs=ROUNDING)
    # It lacks CUT / opacity of its integral, 2 pi a b opacity; sums over pixels of smooth functions are integrals.
    whole, lacks = 2 * np.pi * across * up * opacity, 2 * np.pi * across * up * CUT
    assert found.sum() * (2.5 / PIXELS) ** 2 == pytest.approx(whole - lacks, rel=2e-3)


@pytest.mark.parametrize("first", [0, 1])
@BOTH
def test_two_kernels_are_composited_front_to_back(tmp_path, backend, first):
    stage = new_stage(width=0.01)
    colors, opacities = np.array([[1, 0.2, 0.1], [0.1, 0.3, 1]]), np.array([0.6, 0.7])
    Cloud([[0, 0, 1], [0, 0, -1]], 1.0, opacities[[first, 1 - first]], colors[[first, 1 - first]]).define(stage)
    images, _ = sharp_image(stage, tmp_path, 1, backend=backend)
    a, b = opacities[[first, 1 - first]]
    near, far = colors[[first, 1 - first]]
    assert images["color"][0, 0, :3] == pytest.approx(a * near + (1 - a) * b * far, abs=ROUNDING)
    assert images["alpha"].item() == pytest.approx(1 - (1 - a) * (1 - b), abs=ROUNDING)


@BOTH
def test_more_kernels_than_one_traversal_takes(tmp_path, backend):
    """100 kernels at a ray, 16 found at once, in no order of the array: sum of shares (1 - a)^k a."""
    random = np.random.default_rng(5)
    order = random.permutation(100)
    colors = random.uniform(0, 1, (100, 3))
    stage = new_stage(width=0.001)
    Cloud(np.stack([np.zeros(100), np.zeros(100), -0.01 * order], 1), 0.3, 0.05, colors).define(stage)
    images, _ = sharp_image(stage, tmp_path, 1, backend=backend)
    shares = 0.05 * 0.95 ** order
    assert images["color"][0, 0, :3] == pytest.approx((shares[:, None] * colors).sum(0), abs=ROUNDING)
    assert images["alpha"].item() == pytest.approx(1 - 0.95**100, abs=ROUNDING)


@BOTH
def test_kernels_of_one_place_have_an_order(tmp_path, backend):
    """The densest points coincide: the order of the array counts, through several traversals too."""
    colors = np.linspace(0, 1, 40)[:, None] * [1, 0.5, 0.25]
    stage = new_stage(width=0.001)
    Cloud(np.zeros((40, 3)), 0.5, 0.1, colors).define(stage)
    images, _ = sharp_image(stage, tmp_path, 1, backend=backend)
    assert images["color"][0, 0, :3] == pytest.approx(((0.1 * 0.9 ** np.arange(40))[:, None] * colors).sum(0), abs=ROUNDING)


@pytest.mark.parametrize("degree", [0, 1, 2, 3])
@BOTH
def test_many_turned_kernels_match_the_closed_form(tmp_path, backend, degree):
    """Thin kernels in any direction, whose densest points come in another order than their middles; and the harmonics of all
    degrees, from another axis than the cloud's."""
    cloud = random_cloud(200, 11 + degree, degree=degree)
    matrix = placement(Rotation.from_euler("xyz", [20, 130, 50], degrees=True))
    stage = new_stage()
    place(cloud.define(stage), matrix)
    images, _ = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    light, alpha = cloud.seen(*rays(PIXELS), matrix)
    # Two kernels at nearly the same distance may swap, and one at the cut come or go: a product of two alphas, or CUT.
    difference = off(images, light)
    assert np.mean(difference > 1e-4) < 0.01 and difference.max() < 0.05 + END
    assert images["alpha"].ravel() == pytest.approx(alpha, abs=2 * CUT)


@BOTH
@pytest.mark.parametrize("shape", ["GaussianSurflet", "ConstantSurflet"])
def test_flat_kernels_match_the_closed_form(tmp_path, backend, shape):
    """Disks that stand in each other: their order differs from pixel to pixel, and the constant ones have an edge. It takes one
    float more or less at a pixel on an edge: few pixels."""
    cloud = random_cloud(120, 21, size=0.3, degree=1)
    cloud.shape = shape
    matrix = placement(Rotation.from_euler("xyz", [40, 10, 70], degrees=True).as_matrix() @ np.diag([1, 0.6, 1.3]))
    stage = new_stage()
    place(cloud.define(stage), matrix)
    images, rendered = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    assert not rendered.warnings()
    light, alpha = cloud.seen(*rays(PIXELS), matrix)
    assert alpha.std() > 0.2
    assert np.mean(off(images, light) > 1e-4) < 0.01
    assert np.mean(np.abs(images["alpha"].ravel() - alpha) > 2 * CUT) < 0.01


@BOTH
def test_a_flat_kernel_is_seen_from_both_sides_and_not_along_its_plane(tmp_path, backend):
    for angle, seen in ((0, 0.5), (180, 0.5), (60, 0.5), (90, 0.0)):
        stage = new_stage(width=0.001)
        Cloud([0, 0.001, 0], 0.3, 0.5, 1.0, turns=Rotation.from_euler("x", [[angle]], degrees=True),
              shape="GaussianSurflet").define(stage)
        images, _ = sharp_image(stage, tmp_path, 1, backend=backend)
        assert images["alpha"].item() == pytest.approx(seen, abs=1e-4), angle


def test_harmonics_of_a_known_direction():
    """Bands 0 and 1 as 3D Gaussian splatting writes them, so that the closed form's signs are not its own."""
    x, y, z = direction = np.array([0.48, -0.6, 0.64])
    assert basis([direction], 1)[0] == pytest.approx([0.28209479, -0.48860251 * y, 0.48860251 * z, -0.48860251 * x])


@pytest.mark.parametrize("degree", [1, 2, 3])
@BOTH
def test_harmonics_of_one_kernel(tmp_path, backend, degree):
    random = np.random.default_rng(degree)
    cloud = Cloud([0, 0, 0], 1.0, 1.0, coefficients=random.normal(0, 0.2, (1, (degree + 1) ** 2, 3)))
    for turn in Rotation.random(4, random_state=degree):
        matrix = placement(turn)
        stage = new_stage(width=0.001)
        place(cloud.define(stage), matrix)
        images, _ = sharp_image(stage, tmp_path, 1, backend=backend)
        assert images["color"][0, 0, :3] == pytest.approx(cloud.seen([[0, 0, 10]], [[0, 0, -1]], matrix)[0][0], abs=ROUNDING)


def test_a_mirror_shows_what_is_behind_the_camera(tmp_path):
    cloud = random_cloud(40, 3, 0.8, degree=2)
    cloud.positions[:, 2] += 6
    mirror = floor("generalized_schlick_bsdf", color0=(1, 1, 1), color90=(1, 1, 1), roughness=(0, 0))
    stage = new_stage(mirror, eye=(0, 0, 3))
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS)
    origins, directions = rays(PIXELS, height=0.0)
    light, _ = cloud.seen(origins, -directions)
    assert np.quantile(off(images, light), 0.99) < 1e-4
    assert images["alpha"] == pytest.approx(1.0)  # the mirror's


def test_glass_shows_what_is_behind_it(tmp_path):
    cloud = random_cloud(40, 4, 0.8, degree=1)
    cloud.positions[:, 2] -= 3
    stage = new_stage(floor(**PANE))
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS)
    light, _ = cloud.seen(*rays(PIXELS))
    assert np.quantile(off(images, light), 0.99) < 1e-4


@BOTH
def test_a_surface_hides_what_is_behind_it(tmp_path, backend):
    """By the point where a kernel is densest, as a whole."""
    cloud = random_cloud(60, 6)
    stage = new_stage(floor())
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    origins, directions = rays(PIXELS)
    parts = cloud.seen(-directions * 0 + origins * [1, 1, 0], -directions)  # upwards from the floor: the same kernels
    assert images["alpha"] == pytest.approx(1.0)
    assert images["color"][..., :3].max() > 0.1
    # Their light is that of the same kernels seen from the camera, with those below taken away.
    inverse = cloud.turns.as_matrix().transpose(0, 2, 1) / cloud.scales[:, :, None]
    o = np.einsum("pij,npj->npi", inverse, origins[:, None] - cloud.positions[None])
    d = np.einsum("pij,nj->npi", inverse, directions)
    t = -(o * d).sum(2) / (d * d).sum(2)
    alphas = cloud.opacities * np.exp(-0.5 * ((o + d * t[..., None]) ** 2).sum(2)) * (t < 10)
    alphas[alphas < CUT] = 0
    left = np.prod(1 - alphas, 1)
    assert 1 - parts[1] == pytest.approx(left, abs=2 * CUT)


def test_the_shadow_of_a_kernel(tmp_path):
    """A white floor under a sun has 1 / pi times what the kernel lets through."""
    stage = new_stage(floor(**WHITE), SUN, eye=(0, 0, 2))
    Cloud([0, 0, 4], [0.3, 0.5, 0.1], 0.9, 0.0).define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS)
    x = (np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1
    alpha = 0.9 * np.exp(-0.5 * ((x[None] / 0.3) ** 2 + (x[:, None] / 0.5) ** 2))
    alpha[alpha < CUT] = 0
    assert images["color"][..., :3] == pytest.approx(np.repeat((1 - alpha)[..., None], 3, 2) / np.pi, rel=1e-4)


def test_shadows_of_many_kernels_multiply(tmp_path):
    cloud = random_cloud(200, 8)
    cloud.coefficients[:] = -10  # black: the floor does not see them shine
    cloud.positions[:, 2] += 5
    stage = new_stage(floor(**WHITE), SUN, eye=(0, 0, 2))
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS)
    _, alpha = cloud.seen(*rays(PIXELS))
    assert images["color"][..., 0].ravel() * np.pi == pytest.approx(1 - alpha, abs=2 * CUT + END)


def test_kernels_light_a_floor(tmp_path):
    """A ball of opacity 1 that is small and far above: its integral 2 pi s² times the cosine over the distance squared. Paths
    find it by chance: 64 x 64 x 256 of them, and the bound is five standard errors of what they find."""
    stage = new_stage(floor(**WHITE), width=0.01, eye=(0, 0, 2))
    Cloud([0, 0, 6], 0.5, 1.0, 1.0).define(stage)
    means = [sharp_image(stage, tmp_path, 16, 256, ("--seed", seed))[0]["color"][..., 0].mean() for seed in range(8)]
    # Over directions of the angle a: the ray passes at 6 sin a, the albedo over pi times the cosine of each.
    angle = np.linspace(0, np.pi / 2, 20001)
    alpha = np.exp(-0.5 * (6 * np.sin(angle) / 0.5) ** 2)
    alpha[alpha < CUT] = 0
    expected = np.trapezoid(2 * alpha * np.cos(angle) * np.sin(angle), angle)
    assert np.mean(means) == pytest.approx(expected, abs=5 * np.std(means, ddof=1) / np.sqrt(8))
    assert np.std(means) / np.sqrt(8) < 0.05 * expected


def test_light_samples_keep_the_energy(tmp_path):
    """White kernels close to a white floor under a white sky: all of it has radiance 1, whatever shares light samples, which
    find clusters of kernels, and samples of the BSDF have of it. The bound is five standard errors."""
    cloud = random_cloud(100, 22)
    cloud.coefficients[:] = 0.5 / 0.28209479177
    cloud.positions[:, 2] += 0.9
    stage = new_stage(floor(**WHITE), DOME)
    cloud.define(stage)
    means = [sharp_image(stage, tmp_path, 16, 64, ("--seed", seed, "--maxDepth", 100))[0]["color"][..., :3].mean()
             for seed in range(8)]
    error = np.std(means, ddof=1) / np.sqrt(8)
    assert np.mean(means) == pytest.approx(1.0, abs=5 * error + END)
    assert error < 2e-3


@BOTH
def test_energy_in_a_white_world(tmp_path, backend):
    """White kernels under a white sky: everything has radiance 1, however the light is divided."""
    cloud = random_cloud(100, 9)
    cloud.coefficients[:] = 0.5 / 0.28209479177
    stage = new_stage(DOME)
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    assert images["color"][..., :3] == pytest.approx(1.0, abs=ROUNDING + END)
    alpha = cloud.seen(*rays(PIXELS))[1]
    assert alpha.max() > 0.9 and alpha.min() < 0.5


def test_absorption_of_a_medium_in_front(tmp_path):
    """In a box that absorbs, light of a kernel at the depth s is exp(-absorption s) of its own."""
    fog = usda.material("fog", {"vdf": ("ND_absorption_vdf", {"float3 absorption": (0.2, 0.4, 0.8)}),
                                "volume": ("ND_volume", {"vdf": "<vdf>"})}, volume="volume")
    stage = new_stage(usda.prim("Cube", "box", size=4, bind="fog"), fog, width=0.001)
    Cloud([[0, 0, 1], [0, 0, -1]], 0.1, [0.5, 0.8], [[1, 0.5, 0.25], [0.2, 1, 0.4]]).define(stage)
    images, _ = sharp_image(stage, tmp_path, 1)
    fades = [np.exp(-np.array([0.2, 0.4, 0.8]) * s) for s in (1, 3)]
    expected = 0.5 * np.array([1, 0.5, 0.25]) * fades[0] + 0.5 * 0.8 * np.array([0.2, 1, 0.4]) * fades[1]
    assert images["color"][0, 0, :3] == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize("unit, far", [(1.0, 0.0), (1000.0, 0.0), (0.001, 0.0), (1.0, 1e6), (0.01, -3e5)])
@BOTH
def test_other_units_and_far_away(tmp_path, backend, unit, far):
    """All lengths times `unit`, and all places moved by `far` of them: the same image. Beside the origin of the file's floats
    nothing is lost, since places are kept in double precision."""
    cloud = random_cloud(100, 12, degree=1)
    light, alpha = cloud.seen(*rays(PIXELS))
    scaled = Cloud(cloud.positions * unit, cloud.scales * unit, cloud.opacities, turns=cloud.turns,
                   coefficients=cloud.coefficients)
    offset = np.array([far, -0.5 * far, 0.25 * far])
    stage = new_stage(eye=np.array([0, 0, 10]) + offset, unit=unit)
    place(scaled.define(stage), placement(np.eye(3), offset * unit))
    images, _ = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    assert np.mean(off(images, light) > 1e-3) < 0.01
    assert images["alpha"].ravel() == pytest.approx(alpha, abs=2 * CUT + END)


def copy(name):
    """:returns: text of an instance of /prototype"""
    return usda.prim("Xform", name, meta=("instanceable = true", "references = </prototype>"))


@BOTH
def test_instances_with_any_transform(tmp_path, backend):
    """Three placements beside each other along the view, stretched and sheared: each as its own closed form."""
    cloud = random_cloud(60, 13, 0.5, degree=2)
    matrices = []
    for i, turn in enumerate(Rotation.random(3, random_state=2)):
        stretched = turn.as_matrix() @ np.diag([0.3, 1.5, 0.8]) @ np.array([[1, 0.4, 0], [0, 1, 0], [0, 0, 1]])
        matrices.append(placement(stretched, [0.3 * i - 0.3, 0.1, 4 - 4 * i]))
    stage = new_stage(*(copy(f"copy{i}") for i in range(3)))
    cloud.define(stage, "/prototype/splats")
    stage.GetPrimAtPath("/prototype").SetSpecifier(Sdf.SpecifierOver)
    for i, matrix in enumerate(matrices):
        place(stage.GetPrimAtPath(f"/copy{i}"), matrix)
    images, _ = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    light, left = np.zeros((PIXELS**2, 3)), np.ones((PIXELS**2, 1))
    for matrix in matrices:
        part, alpha = cloud.seen(*rays(PIXELS), matrix)
        light, left = light + left * part, left * (1 - alpha[:, None])
    assert np.mean(off(images, light) > 1e-4) < 0.01
    assert images["alpha"].ravel() == pytest.approx(1 - left.ravel(), abs=3 * CUT + END)


@pytest.mark.parametrize("instanced", [False, True])
@BOTH
def test_motion_of_the_transform(tmp_path, backend, instanced):
    """A kernel that crosses the view while the shutter is open: the mean of its alpha over its way. Times are spread evenly,
    256 of them, so the standard error is below 0.5 / 16; the bound is five of these."""
    moving = copy("moving") if instanced else usda.prim("Xform", "moving")
    stage = new_stage(moving, lines=("double shutter:open = 0", "double shutter:close = 1"))
    stage.SetStartTimeCode(0)
    Cloud([0, 0, 0], 0.2, 0.8, 1.0).define(stage, "/prototype/splats" if instanced else "/moving/splats")
    if instanced:
        stage.GetPrimAtPath("/prototype").SetSpecifier(Sdf.SpecifierOver)
    operation = UsdGeom.Xform(stage.GetPrimAtPath("/moving")).AddTranslateOp()
    for time, x in ((0, -0.5), (1, 0.5)):
        operation.Set(Gf.Vec3d(x, 0, 0), time)
    images, _ = sharp_image(stage, tmp_path, PIXELS, 256, backend=backend)
    x = (np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1
    ways = np.linspace(-0.5, 0.5, 2001)
    along = np.exp(-0.5 * ((x[:, None] - ways) / 0.2) ** 2).mean(1)
    alpha = 0.8 * along[None] * np.exp(-0.5 * (x[:, None] / 0.2) ** 2)
    found = images["alpha"].reshape(PIXELS, PIXELS)
    assert found == pytest.approx(alpha, abs=5 * 0.5 / 16)
    assert found.mean() == pytest.approx(alpha.mean(), abs=CUT + 5 * 0.5 / 16 / PIXELS)


def test_thread_count_does_not_change_a_bit(tmp_path):
    stage = new_stage(floor(z=-2.0, **WHITE), DOME)
    cloud = random_cloud(3000, 14, degree=1)
    cloud.positions[:1000] = cloud.positions[1000:2000]  # ties
    cloud.define(stage)
    stage.Export(str(tmp_path / "stage.usda"))
    images = []
    for threads in (1, 2, 3):
        record(tmp_path / "stage.usda", tmp_path / f"{threads}.exr", "--camera", "/camera", "--imageWidth", 32, "--imageHeight",
               32, "--samples", 8, "--threads", threads)
        images.append(pixels(tmp_path / f"{threads}.exr"))
    assert np.array_equal(images[0], images[1]) and np.array_equal(images[0], images[2])


@BOTH
def test_depth_is_where_half_of_the_light_is_taken(tmp_path, backend):
    """Of three kernels of 0.3 the second leaves 0.49. A single one of 0.3 leaves the surface behind in view."""
    for count, depth in ((3, 10.0), (1, 13.0)):
        stage = new_stage(floor(z=-3.0, color=(0.8, 0.8, 0.8)), width=0.001)
        Cloud([[0, 0, 1 - i] for i in range(count)], 0.1, 0.3).define(stage)
        images, _ = sharp_image(stage, tmp_path, 1, aovs=("depth", "normal", "alpha", "position", "albedo"), backend=backend)
        assert images["depth"].item() == pytest.approx(depth, rel=1e-5)
        assert images["position"].ravel()[2] == pytest.approx(10 - depth, abs=1e-5)
        assert images["normal"].ravel()[2] == pytest.approx(float(count == 1))
        assert images["albedo"].ravel()[:3] == pytest.approx(0.8 * (count == 1), abs=0.05)


@BOTH
def test_colour_spaces(tmp_path, backend):
    """Radiance is a signal of sRGB where ColorSpaceAPI says so, and shown in the rendering space."""
    signal = np.array([0.8, 0.5, 0.2])
    linear = np.where(signal > 0.04045, ((signal + 0.055) / 1.055) ** 2.4, signal / 12.92)
    to_ap1 = np.array([[0.613097402, 0.339523146, 0.047379451], [0.070193722, 0.916353879, 0.013452398],
                       [0.020615593, 0.109569773, 0.869814634]])
    for space, flags, expected in ((None, (), signal), ("srgb_rec709_scene", (), linear),
                                   ("lin_rec709_scene", ("--renderingColorSpace", "acescg"), to_ap1 @ signal)):
        stage = new_stage(width=0.001)
        prim = Cloud([0, 0, 0], 1.0, 1.0, signal).define(stage)
        if space:
            prim.ApplyAPI("ColorSpaceAPI")
            prim.GetAttribute("colorSpace:name").Set(space)
        images, _ = sharp_image(stage, tmp_path, 1, settings=flags, backend=backend)
        assert images["color"][0, 0, :3] == pytest.approx(expected, abs=1e-4)


@BOTH
def test_marks(tmp_path, backend):
    """A matte takes light and alpha away; the camera does not see what it may not, and its shadow stays."""
    for mark, color, alpha in (("patina:matte", 0.5 * 0.4, 0.5 * 0.4), ("patina:visibility:camera", 0.4, 0.4)):
        stage = new_stage(width=0.001)
        Cloud([0, 0, -1], 1.0, 0.4, 1.0).define(stage, "/behind")
        prim = Cloud([0, 0, 1], 1.0, 0.5, 1.0).define(stage)
        value = mark == "patina:matte"
        UsdGeom.PrimvarsAPI(prim).CreatePrimvar(mark, Sdf.ValueTypeNames.Bool).Set(value)
        images, _ = sharp_image(stage, tmp_path, 1, backend=backend)
        assert images["color"][0, 0, 0] == pytest.approx(color, abs=ROUNDING)
        assert images["alpha"].item() == pytest.approx(alpha, abs=ROUNDING)


@BOTH
def test_broken_arrays_are_told_and_drawn_as_the_schema_says(tmp_path, backend):
    stage = new_stage()
    good = Cloud(np.zeros((4, 3)), 0.3, 0.5)
    prim = good.define(stage)
    prim.GetAttribute("scales").Set([(0.3, 0.3, 0)] * 2 + [(-0.3, 0.3, 0.3), (0, 0, 0)])
    prim.GetAttribute("opacities").Set([2.0, -1.0, float("nan"), 0.5, 0.7])
    prim.GetAttribute("orientations").Set([Gf.Quatf(0), Gf.Quatf(2, 0, 0, 0), Gf.Quatf(1), Gf.Quatf(1)])
    prim.GetAttribute("radiance:sphericalHarmonicsDegree").Set(2)
    images, rendered = sharp_image(stage, tmp_path, 9, backend=backend)
    told = "\n".join(rendered.warnings())
    for words in ("5 values where 4", "4 values where 36", "2 are outside of 0..1", "1 have no length",
                  "3 particles have sizes", "1 particles have no size", "1 particles have a value that is not finite"):
        assert words in told, told
    assert told.count("/splats: ") == len(told.split("\n"))
    # The first is opaque and grey, as coefficients of the wrong number are left out.
    assert images["color"][4, 4, :3] == pytest.approx(0.5, abs=ROUNDING)


@pytest.mark.parametrize("name, value", [
    ("positions", [(float("inf"), 0, 0), (1e30, 0, 0)]), ("scales", [(1e38, 1e38, 1e38)] * 2), ("scales", [(1e-38, 0, 0)] * 2),
    ("positions", []), ("orientations", [Gf.Quatf(float("nan"))] * 2), ("radiance:sphericalHarmonicsDegree", -5),
    ("radiance:sphericalHarmonicsDegree", 2**31 - 1),
    ("radiance:sphericalHarmonicsCoefficients", [(float("nan"), 0, 0), (float("inf"), 1e38, -1e38)])])
@BOTH
def test_hostile_values_do_no_harm(tmp_path, backend, name, value):
    stage = new_stage(DOME)
    prim = Cloud([[0, 0, 0], [0.1, 0, 0]], 0.3, 0.5).define(stage)
    prim.GetAttribute(name).Set(value)
    images, rendered = sharp_image(stage, tmp_path, 8, backend=backend)
    assert np.isfinite(images["color"]).all()
    assert rendered.warnings()


@BOTH
def test_a_transform_without_an_inverse_is_told(tmp_path, backend):
    stage = new_stage()
    place(Cloud([0, 0, 0]).define(stage), np.diag([1, 0, 1, 1]))
    images, rendered = sharp_image(stage, tmp_path, 4, backend=backend)
    assert not images["alpha"].any()
    assert any("/splats: has no inverse" in text or "no inverse" in text for text in rendered.warnings())


@BOTH
def test_several_hundred_thousand(tmp_path, backend):
    """They are drawn, and all of them count: the transmittance of a random cloud, whose closed form is taken at some pixels."""
    cloud = random_cloud(300_000, 15, size=0.01)
    cloud.opacities *= 0.02
    stage = new_stage()
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, 16, backend=backend)
    origins, directions = rays(16)
    some = np.array([20, 77, 130, 200, 251])
    light, alpha = cloud.seen(origins[some], directions[some])
    assert images["alpha"].ravel()[some] == pytest.approx(alpha, abs=5e-4)
    assert images["color"][..., :3].reshape(-1, 3)[some] == pytest.approx(light, abs=5e-4)
