# SPDX-License-Identifier: Apache-2.0
"""Surfaces that are half there: two of them, one behind the other, hide three quarters, wherever their triangles come from.
What glows glows with its whole light, however much of what is behind it shows through."""
import numpy as np
import pytest

import inProcess
import usda

pytestmark = pytest.mark.usefixtures("opengl")

SIZE, SAMPLES = 32, 64
CAMERA = usda.stage(usda.camera(lens=(50, 10, 10), at=(0, 0, 10)), up="")
HALF = "float[] primvars:displayOpacity = [0.5]"
CARD = [(-2, -2), (2, -2), (2, 2), (-2, 2)]


def mesh(name, depths, *lines, apart=0, **more):
    """:param depths: z of each card
    :param apart: triangles between the first card and the others, none of which the camera sees"""
    points, faces = [(x, y, depths[0]) for x, y in CARD], [(0, 1, 2), (0, 2, 3)]
    beside = len(points)
    points += [(50, 0, 0), (51, 0, 0), (50, 1, 0)]
    faces += [(beside, beside + 1, beside + 2)] * apart
    for z in depths[1:]:
        first = len(points)
        points += [(x, y, z) for x, y in CARD]
        faces += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return usda.mesh(name, points, *lines, faces=faces, doubleSided=1, **more)


def subset(name, faces):
    return usda.prim("GeomSubset", name, 'uniform token elementType = "face"', 'uniform token familyName = "materialBind"',
                     f"int[] indices = {faces}", apis=("MaterialBindingAPI",))


# Two of these, half there, are drawn apart. llvmpipe draws 16,384 triangles at once at most: see heldFences.h.
STAGES = {
    "prims": mesh("front", [1], HALF) + mesh("back", [0], HALF),
    "triangles": mesh("both", [1, 0], HALF),
    "draws": mesh("both", [1, 0], HALF, apart=16382),
    "subsets": mesh("both", [1, 0], HALF, subset("front", [0, 1]), subset("back", [2, 3])),
    "instances": usda.prim("PointInstancer", "cards", "rel prototypes = </cards/card>", mesh("card", [0], HALF),
                           protoIndices=[0, 0], positions=[(0, 0, 0), (0, 0, 1)]),
}


def alpha(folder, stage):
    image = inProcess.shot(folder, CAMERA + stage, "--camera", "/camera", "-w", SIZE, "--samples", SAMPLES, "--backend",
                           "raster", "--seed", "1")
    return inProcess.pixels(image, "A")


@pytest.mark.parametrize("name", sorted(STAGES))
def test_what_lies_behind_each_other_is_drawn_apart(tmp_path, name):
    # Six standard errors of as many independent numbers, which one in 5e8 exceeds; where both are drawn by one number, a
    # half is hidden.
    error = np.sqrt(0.75 * 0.25 / (SIZE * SIZE * SAMPLES))
    assert abs(alpha(tmp_path, STAGES[name]).mean() - 0.75) < 6.0 * error


def test_prims_keep_their_random_numbers_when_others_come(tmp_path):
    before = alpha(tmp_path, STAGES["prims"])
    other = mesh("another", [0], HALF, at=(90, 0, 0))
    np.testing.assert_array_equal(alpha(tmp_path, other + STAGES["prims"]), before)
    assert 0.0 < before.std()


def pane(name, opacity, emission, x, z):
    """A card that glows; thin, so that nothing bends what is behind it."""
    looks = usda.preview(f"{name}Looks", emissiveColor=(emission, 0, 0), diffuseColor=(0, 0, 0), opacity=opacity, ior=1)
    return looks + mesh(name, [z], bind=f"{name}Looks", at=(x, 0, 0), scale=(0.14, 1, 1))


def test_glow_is_not_scaled_by_opacity(tmp_path):
    """As UsdPreviewSurface 2.6 has it where its opacityMode is transparent. Three pairs of panes stand side by side."""
    opacities, width, samples = (0, 0.5, 1), 24, 16
    file = tmp_path / "stage.usda"
    file.write_text(CAMERA + "".join(
        pane(f"front{i}", opacity, 0.5, 0.6 * (i - 1), 1) + pane(f"back{i}", 1, 0.25, 0.66 * (i - 1), 0)
        for i, opacity in enumerate(opacities)), encoding="utf-8")
    for backend in ("embree", "raster"):
        image = inProcess.Stage(str(file), "--backend", backend, "--camera", "/camera", "-w", str(width), "--samples",
                                str(samples), "--disableCameraLight").image(1)
        for i, opacity in enumerate(opacities):
            inside = image[:, 8 * i + 2:8 * i + 6, 0]
            # Six standard errors of the back pane's light, which is seen by chance.
            error = 0.25 * np.sqrt(opacity * (1 - opacity) / (inside.size * samples))
            rounded = samples * 2.0**-24  # sums of so many floats
            assert abs(inside.mean() - 0.5 - 0.25 * (1 - opacity)) < 6 * error + rounded, (backend, opacity)
