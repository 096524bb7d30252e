# SPDX-License-Identifier: Apache-2.0
"""Faces that the camera passes by, in both back ends: depth tells which side of a cube is seen."""
import numpy as np
import pytest

import inProcess
import usda

HEAD = usda.stage(usda.camera(flat=(120, 30), at=(0, 0, 10)))
CUBE = """def %(kind)s "%(name)s"
{
    uniform bool doubleSided = %(doubleSided)d
    uniform token orientation = "%(orientation)s"
    %(shape)s
    double3 xformOp:translate = (%(x)s, 0, 0)
    float3 xformOp:scale = %(scale)s
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
}
"""
BOX = """point3f[] points = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 1, 2, 6, 5, 0, 4, 7, 3]
    uniform token subdivisionScheme = "none\""""
NEAR, FAR = 9.0, 11.0
# What is seen of: a cube, one whose outside is in, one that its transform mirrors, a mesh that has two sides.
SEEN = {"nothing": (NEAR, NEAR, NEAR, NEAR), "back": (NEAR, FAR, NEAR, NEAR), "front": (FAR, NEAR, FAR, FAR),
        "backUnlessDoubleSided": (NEAR, FAR, NEAR, NEAR), "frontUnlessDoubleSided": (FAR, NEAR, FAR, NEAR)}


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    cubes = [("rightHanded", 0, "(1, 1, 1)", "Cube"), ("leftHanded", 0, "(1, 1, 1)", "Cube"),
             ("rightHanded", 0, "(-1, 1, 1)", "Mesh"), ("rightHanded", 1, "(1, 1, 1)", "Mesh")]
    text = HEAD
    for i, (orientation, double_sided, scale, kind) in enumerate(cubes):
        text += CUBE % {"kind": kind, "name": f"cube{i}", "x": 3 * i - 4.5, "orientation": orientation, "scale": scale,
                        "doubleSided": double_sided, "shape": BOX if kind == "Mesh" else "double size = 2"}
    path = tmp_path_factory.mktemp("cullStyle") / "stage.usda"
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_the_camera_passes_faces_by(stage, backend, tmp_path):
    inProcess.needs_opengl(backend)
    shot = inProcess.Stage(stage, "--backend", backend, "--camera", "/camera", "-w", "32", image_height=8)
    for style, wanted in SEEN.items():
        film = shot.film(samples=1, cullStyle=style, aovs=["depth", "alpha"])
        depth, alpha = np.array(film.resolve("depth"))[4], np.array(film.resolve("alpha"))[4]
        # Pixels in the middle of each cube, from its front through its back; a step of a 32-bit depth is far smaller.
        np.testing.assert_allclose(depth[4::8].reshape(-1), wanted, atol=1e-3, err_msg=style)
        np.testing.assert_array_equal(alpha[4::8].reshape(-1), 1.0)
