# SPDX-License-Identifier: Apache-2.0
"""Environments that are hard: one texel of 1e5, harmonics that ring below zero, texels that are no numbers.

Stages are rendered: a white ball under a dome, one row of pixels across it, so that an image is a sweep over the normal.
"""
import os
import tempfile

import numpy as np

from patina.chart.sweeps import Sweep
from patina.cli import main
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError

WIDTH, SIDE = 48, 32
RASTER = ("sampled", "filtered", "prefiltered", "harmonics")
BACKGROUND, BRIGHT = 0.1, 1e5
STAGE = """#usda 1.0
(
    upAxis = "Y"
)
def Camera "camera"
{
    token projection = "orthographic"
    float2 clippingRange = (0.1, 100)
    float horizontalAperture = 20
    float verticalAperture = %(aperture)r
    double3 xformOp:translate = (0, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "sky"
{
    asset inputs:texture:file = @%(sky)s@
}
def Sphere "ball" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    double radius = 1
    rel material:binding = </white>
}
def Material "white"
{
    token outputs:mtlx:surface.connect = </white/surface.outputs:out>
    def Shader "surface"
    {
        uniform token info:id = "ND_surface"
        token inputs:bsdf.connect = </white/bsdf.outputs:out>
        token outputs:out
    }
    def Shader "bsdf"
    {
%(bsdf)s
        token outputs:out
    }
}
"""
DIFFUSE = """        uniform token info:id = "ND_oren_nayar_diffuse_bsdf"
        color3f inputs:color = (1, 1, 1)"""
METAL = """        uniform token info:id = "ND_generalized_schlick_bsdf"
        color3f inputs:color0 = (1, 1, 1)
        float2 inputs:roughness = (0.3, 0.3)"""


def directions():
    """:returns: of the sky's texels, SIDE x 2 SIDE x 3, and their solid angles"""
    v, u = (np.arange(SIDE) + 0.5) / SIDE, (np.arange(2 * SIDE) + 0.5) / (2 * SIDE)
    theta, phi = np.pi * v[:, None], 2.0 * np.pi * (u[None] - 0.25)
    d = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta) + 0.0 * phi, np.sin(theta) * np.sin(phi)], axis=-1)
    return d, np.broadcast_to(np.sin(theta) * (np.pi / SIDE) ** 2, d.shape[:2])


def normals():
    """:returns: of the pixels but the outermost, and their angles in degrees"""
    x = ((np.arange(WIDTH) + 0.5) * 2.0 / WIDTH - 1.0)[1:-1]
    return np.column_stack([x, np.zeros_like(x), np.sqrt(1.0 - x * x)]), np.degrees(np.arcsin(x))


def one_texel(towards=(0.8, 0.3, 0.5)):
    sky = np.full((SIDE, 2 * SIDE, 3), BACKGROUND, np.float32)
    d, _ = directions()
    sky.reshape(-1, 3)[int(np.argmax(d.reshape(-1, 3) @ np.asarray(towards)))] = BRIGHT
    return sky


def irradiance(sky, order=None):
    """Of the normals, over pi; with an order, from the spherical harmonics of order 2 without a window."""
    d, area = directions()
    d, light = d.reshape(-1, 3), (sky[..., 0] * area).reshape(-1)
    n, _ = normals()
    if order is None:
        return (np.maximum(n @ d.T, 0.0) @ light) / np.pi
    # The clamped cosine of order 2: 1/4 + c / 2 + 5 (3 c^2 - 1) / 32.
    c = n @ d.T
    return ((0.25 + 0.5 * c + 5.0 / 32.0 * (3.0 * c * c - 1.0)) @ light) / np.pi


def render(sky, bsdf, backend, samples, *arguments):
    """:returns: red of the middle row"""
    with tempfile.TemporaryDirectory() as folder:
        stage, texture, image = (os.path.join(folder, name) for name in ("ball.usda", "sky.exr", "image.exr"))
        _patina.write_image(texture, np.ascontiguousarray(sky, np.float32))
        with open(stage, "w", encoding="utf-8") as file:
            file.write(STAGE % {"sky": texture, "bsdf": bsdf, "aperture": 60.0 / WIDTH})
        code = main.main(["record", stage, image, "--quiet", "--backend", backend, "--samples", str(samples), "-w", str(WIDTH),
                          "--maxDepth", "1", *arguments])
        if code != 0:
            raise CommandError(f"the ball of the atlas does not render with {backend}")
        found = _patina.read_image(image)
        pixels = np.array(found.pixels)
        return pixels[pixels.shape[0] // 2, 1:-1, found.channels.index("R")].astype(float)


def has_raster():
    """:returns: whether the rasterizer runs here"""
    try:
        _patina.RasterProbe(_patina.display_color_network())
    except (AttributeError, RuntimeError, TypeError):
        return False
    return True


def _texel():
    sky, (_, x) = one_texel(), normals()
    truth = irradiance(sky)
    curves = {"embree": render(sky, DIFFUSE, "embree", 1024), "harmonics, no window": irradiance(sky, 2)}
    return [Sweep("one texel of 1e5, diffuse", "sky", "Harmonics without a window ring: light of less than nothing behind.",
                  "degrees of the normal", list(x), "reflected", {k: list(v) for k, v in curves.items()}, truth=list(truth),
                  chosen="embree", bound=0.06 * max(truth), failing="harmonics, no window", shows=1.2)]


def _not_numbers(count):
    x, clean = list(np.linspace(0.0, 0.5, count)), np.full((SIDE, 2 * SIDE, 3), 0.5, np.float32)
    found, plain, truth = [], [], []
    for share in x:
        sky = clean.copy()
        rows = np.random.default_rng(3).permutation(SIDE * 2 * SIDE)[:int(share * SIDE * 2 * SIDE)]
        sky.reshape(-1, 3)[rows] = np.nan
        found.append(float(render(sky, DIFFUSE, "embree", 64).mean()))
        plain.append(float(sky.mean()))
        truth.append(0.5 * (1.0 - share))
    return [Sweep("texels that are no numbers", "sky", "One NaN in the mean of a texture darkens or blackens every pixel.",
                  "share of the sky", x, "mean of the ball under a sky of 0.5", {"as black": found, "taken as they are": plain},
                  truth=truth, chosen="as black", bound=0.05, failing="taken as they are")]


def drawn(samples=64):
    """The ways of the rasterizer to light by a dome; seconds each where the driver is software."""
    found, (_, x) = [], normals()
    sky = one_texel()
    for name, bsdf, failing, fails in (
            ("diffuse", DIFFUSE, "filtered",
             "Samples of the lobe rarely find the texel, and blur it where they do; directions drawn "
             "by the sky's own brightness, and harmonics, find it."),
            ("metal of alpha 0.3", METAL, "prefiltered", "Maps made at load know one width of the lobe: no stretch towards the "
             "horizon.")):
        truth = irradiance(sky) if bsdf is DIFFUSE else render(sky, bsdf, "embree", 4096)
        curves = {m: list(render(sky, bsdf, "raster", samples, "--method", "domeLight=" + m)) for m in RASTER}
        curves["embree"] = list(render(sky, bsdf, "embree", 4 * samples))
        found.append(Sweep(f"rasterizer, one texel of 1e5, {name}", "sky", fails, "degrees of the normal", list(x), "reflected",
                           curves, truth=list(truth), chosen="embree", bound=0.1 * max(truth), failing=failing))
    return found


def sweeps(count):
    found = [*_texel(), *_not_numbers(max(4, min(count // 4, 10)))]
    return found + (drawn() if count >= 40 and has_raster() else [])
