# SPDX-License-Identifier: Apache-2.0
"""Random legal stages of what both back ends draw alike: shapes of all sorts with opaque, rough materials under all lights.
Tiles of the two images are held together by testenv/raster/equivalence.py, with the margin of every other stage."""
import os
import random as randoms
import sys

import numpy as np
from scipy import stats  # noqa: F401  loaded once, before any fork

import outcomes

sys.path[1:1] = [os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", folder))
                 for folder in ("", "raster")]
import equivalence  # noqa: E402
import inProcess  # noqa: E402
import usda  # noqa: E402

EXTENSION = ".usda"
LINES = False  # a stage of fewer prims is another picture
CPU_SECONDS = 200  # a driver in software compiles for half a minute before it draws
WIDTH, HEIGHT, TILE = 48, 36, 12
ALIKE = 8  # seeds in a row have the same kinds of materials and lights, and so their programs
RENDERS, PASSES, SAMPLES = 12, 16, 32  # of each back end; of few passes outlines are off by percents, with any seed
SIGNIFICANCE = 1e-6  # for a stage: of a thousand that are right, all are called so with probability 0.999
SEEN = (
    usda.camera(focalLength=22, matrix="((1, 0, 0, 0), (0, 0.9, -0.436, 0), (0, 0.436, 0.9, 0), (0, 3.1, 5.4, 1))"),
    usda.floor("floor", 5, bind="look0"))
TRIANGLES = ("int[] faceVertexCounts = [3, 3, 3, 3]", "int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]",
             "point3f[] points = [(-1, -1, 1), (1, -1, 1), (0, -1, -1), (0, 1, 0)]")
CAGE = ("int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]",
        "int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]",
        "point3f[] points = [(-1, -1, -1), (-1, -1, 1), (-1, 1, -1), (-1, 1, 1), (1, -1, -1), (1, -1, 1), (1, 1, -1), "
        "(1, 1, 1)]")
SHAPES = {"Sphere": (), "Cube": (), "Cone": (), "Cylinder": (), "Capsule": (), "Plane": (),
          "Mesh": (*TRIANGLES, 'uniform token subdivisionScheme = "none"'),
          "Mesh ": (*CAGE, 'uniform token subdivisionScheme = "catmullClark"'),
          "Points": ("point3f[] points = [(-0.6, 0, 0), (0.6, 0.3, 0), (0, -0.5, 0.6)]", "float[] widths = [0.8, 0.5, 0.6]")}
LIGHTS = {"DomeLight": (), "DistantLight": (("angle", 0.5, 8),), "RectLight": (("width", 0.3, 2), ("height", 0.3, 2)),
          "DiskLight": (("radius", 0.2, 1),), "SphereLight": (("radius", 0.1, 0.7),),
          "CylinderLight": (("radius", 0.1, 0.4), ("length", 0.5, 2))}
POWER = {"DomeLight": (0.2, 1), "DistantLight": (0.5, 3)}  # the others: 5 to 40


def _numbers(r, low, high, count=3):
    return "(" + ", ".join(f"{r.uniform(low, high):.4f}" for _ in range(count)) + ")"


def _look(r, kinds, name):
    """A material of a structure that there are few of, so that few programs are compiled: only its values are random."""
    color, rough = _numbers(r, 0.05, 0.9), f"{r.uniform(0.3, 1):.4f}"
    node, values = kinds.choice((
        ("UsdPreviewSurface", {"color3f diffuseColor": color, "float roughness": rough, "float metallic": "0"}),
        ("UsdPreviewSurface", {"color3f diffuseColor": color, "float roughness": rough, "float metallic": "1"}),
        ("ND_standard_surface_surfaceshader", {"color3f base_color": color, "float specular_roughness": rough}),
        ("ND_standard_surface_surfaceshader", {"color3f base_color": color, "float specular_roughness": rough,
                                               "float metalness": f"{r.uniform(0.2, 0.8):.4f}"}),
        ("ND_standard_surface_surfaceshader", {"color3f base_color": color, "float specular": "0",
                                               "float diffuse_roughness": f"{r.uniform(0.1, 1):.4f}"}),
        ("ND_standard_surface_surfaceshader", {"color3f base_color": color, "float sheen": f"{r.uniform(0.2, 1):.4f}",
                                               "float specular_roughness": rough}),
        ("ND_open_pbr_surface_surfaceshader", {"color3f base_color": color, "float specular_roughness": rough})))
    return usda.material(name, {"s": (node, values, "token surface")}, surface="s")


def make(seed):
    """:returns: the bytes of an input"""
    r, kinds = randoms.Random(seed), randoms.Random(f"materials and lights of {seed // ALIKE}")
    looks = kinds.randint(1, 3)
    prims = [*SEEN, *(_look(r, kinds, f"look{k}") for k in range(looks))]
    for k in range(r.randint(1, 4)):
        kind = r.choice(sorted(SHAPES))
        held = [*SHAPES[kind], *(["uniform bool doubleSided = true"] if kind == "Plane" else [])]
        look = f"look{r.randrange(looks)}"
        scale = _numbers(r, 0.3, 0.9) if kind != "Points" else "(0.6, 0.6, 0.6)"  # else they differ by design
        place = f"({r.uniform(-1.5, 1.5):.4f}, {r.uniform(0.3, 1.3):.4f}, {r.uniform(-2, 1):.4f})"
        prims.append(usda.prim(kind.strip(), f"shape{k}", *held, bind=look, at=place, turn=_numbers(r, -90, 90), scale=scale))
    for k in range(kinds.randint(1, 3)):
        kind = kinds.choice(sorted(LIGHTS))
        inputs = {"color": _numbers(r, 0.2, 1), "intensity": f"{r.uniform(*POWER.get(kind, (5, 40))):.4f}"}
        inputs.update((name, f"{r.uniform(low, high):.4f}") for name, low, high in LIGHTS[kind])
        place = f"({r.uniform(-3, 3):.4f}, {r.uniform(3, 5):.4f}, {r.uniform(-2, 3):.4f})"
        turn = f"({r.uniform(-130, -50):.4f}, {r.uniform(-40, 40):.4f}, 0)"
        prims.append(usda.prim(kind, f"light{k}", at=place, turn=turn, **inputs))
    return usda.stage(*prims).encode()


def verdict(path):
    """:returns: what equivalence.py says of a stage's two pictures, and their means (height, width, 3)
    :raises RuntimeError: where one fails, or is drawn by another back end"""
    flags = ("--camera", "/camera", "-w", WIDTH, "--threads", 1, "--maxDepth", 1)
    raster = inProcess.Stage(path, *flags, "--backend", "raster", "--samples", PASSES, image_height=HEIGHT)
    traced = inProcess.Stage(path, *flags, "--backend", "embree", "--samples", SAMPLES, image_height=HEIGHT)
    drawn = np.array([raster.image(1 + k) for k in range(RENDERS)])
    truth = np.array([traced.image(100001 + k) for k in range(RENDERS)])
    power = equivalence.Power(widest=5 * equivalence.MARGIN, samples=PASSES, traced=SAMPLES, looks=(RENDERS,), spare=1.0,
                              tile=TILE)
    found = equivalence.compare(equivalence.tiles(drawn, TILE), equivalence.tiles(truth, TILE), power, SIGNIFICANCE)
    return found, drawn.mean(axis=0), truth.mean(axis=0)


def execute(path, folder):
    """Renders an input by both back ends, in a process that may die. :returns: its exit status"""
    os.chdir(folder)
    outcomes.tell_swallowed()
    if inProcess.without_opengl():
        return 0
    found, _, truth = verdict(path)
    if not (truth >= 0.0).all():
        return outcomes.broken("the image holds negative values")
    if found.differs.any():
        return outcomes.broken(f"the back ends differ: {found.text()}")
    return 0
