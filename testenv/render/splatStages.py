# SPDX-License-Identifier: Apache-2.0
"""Stages of Gaussian splats for tests, and the closed form of what a ray sees of them.

The closed form is written from UsdVol's schema and the papers, in double precision, and shares nothing with the renderer."""
import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdVol, Vt
from scipy.spatial.transform import Rotation
from scipy.special import factorial, lpmv

import usda

CUT = 1 / 1024  # shaders/lib/splat.glsl: kernels end where their alpha is that
END = 1e-4  # and rays where so little is left
DC = 0.5 * np.sqrt(1 / np.pi)  # of the harmonic of degree 0


def basis(directions, degree):
    """:param directions: N x 3 of length 1
    :returns: N x (degree + 1)^2 real spherical harmonics, from -l to l in each band, with Condon and Shortley's sign"""
    x, y, z = np.asarray(directions, float).T
    phi = np.arctan2(y, x)
    columns = []
    for band in range(degree + 1):
        for m in range(-band, band + 1):
            k = abs(m)
            norm = np.sqrt((2 * band + 1) / (4 * np.pi) * factorial(band - k) / factorial(band + k))
            angle = np.sqrt(2) * np.cos(k * phi) if m > 0 else np.sqrt(2) * np.sin(k * phi) if m < 0 else 1.0
            columns.append(norm * lpmv(k, band, z) * angle)
    return np.stack(columns, 1)


class Cloud:
    """Kernels: rotations are scipy's, colours are those of harmonics of degree 0, unless coefficients are given.

    :param shape: of UsdVol's ParticleFieldKernel...API"""

    def __init__(self, positions, scales=1.0, opacities=1.0, colors=0.5, turns=None, coefficients=None,
                 shape="GaussianEllipsoid"):
        self.shape = shape
        self.positions = np.array(positions, float).reshape(-1, 3)
        count = len(self.positions)
        self.scales = np.broadcast_to(np.asarray(scales, float), (count, 3)).copy()
        self.opacities = np.broadcast_to(np.asarray(opacities, float), (count,)).copy()
        self.turns = turns if turns is not None else Rotation.identity(count)
        if coefficients is None:
            coefficients = (np.broadcast_to(np.asarray(colors, float), (count, 3)) - 0.5)[:, None] / DC
        self.coefficients = np.array(coefficients, float)  # particles x harmonics x 3
        self.degree = int(round(np.sqrt(self.coefficients.shape[1]))) - 1

    def define(self, stage, path="/splats", half=False):
        if self.shape == "GaussianEllipsoid":
            prim = UsdVol.ParticleField3DGaussianSplat.Define(stage, path).GetPrim()
        else:
            prim = UsdVol.ParticleField.Define(stage, path).GetPrim()
            for name in ("Kernel" + self.shape, "PositionAttribute", "OrientationAttribute", "ScaleAttribute",
                         "OpacityAttribute", "SphericalHarmonicsAttribute"):
                prim.ApplyAPI(f"ParticleField{name}API")
        x, y, z, w = self.turns.as_quat().T
        kind, quaternion, letter = (Vt.Vec3hArray, Vt.QuathArray, "h") if half else (Vt.Vec3fArray, Vt.QuatfArray, "")
        scalar = Vt.HalfArray if half else Vt.FloatArray
        single = Gf.Quath if half else Gf.Quatf
        numbers = np.float16 if half else np.float32
        prim.GetAttribute("positions" + letter).Set(kind.FromNumpy(self.positions.astype(numbers)))
        prim.GetAttribute("scales" + letter).Set(kind.FromNumpy(self.scales.astype(numbers)))
        prim.GetAttribute("opacities" + letter).Set(scalar.FromNumpy(self.opacities.astype(numbers)))
        prim.GetAttribute("orientations" + letter).Set(quaternion([single(*map(float, q)) for q in zip(w, x, y, z)]))
        prim.GetAttribute("radiance:sphericalHarmonicsDegree").Set(self.degree)
        prim.GetAttribute("radiance:sphericalHarmonicsCoefficients" + letter).Set(
            kind.FromNumpy(self.coefficients.reshape(-1, 3).astype(numbers)))
        return prim

    def seen(self, origins, directions, matrix=np.eye(4), background=0.0, cut=CUT):
        """:param origins, directions: N x 3
        :param matrix: places the cloud, for column vectors
        :returns: radiance (N x 3) and alpha (N) of rays, kernels composited in the order of their densest points"""
        inverse = np.linalg.inv(matrix)
        origins = np.asarray(origins, float) @ inverse[:3, :3].T + inverse[:3, 3]
        directions = np.asarray(directions, float) @ inverse[:3, :3].T
        toward = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        colors = np.maximum(0.5 + np.einsum("nb,pbc->npc", basis(toward, self.degree), self.coefficients), 0)
        unit = self.turns.as_matrix().transpose(0, 2, 1) / self.scales[:, :, None]
        o = np.einsum("pij,npj->npi", unit, origins[:, None] - self.positions[None])
        d = np.einsum("pij,nj->npi", unit, directions)
        is_flat = self.shape != "GaussianEllipsoid"
        t = -o[..., 2] / d[..., 2] if is_flat else -(o * d).sum(2) / (d * d).sum(2)
        away = ((o + d * t[:, :, None])[..., :2 if is_flat else 3] ** 2).sum(2)
        alphas = self.opacities * (away <= 1 if self.shape == "ConstantSurflet" else np.exp(-0.5 * away))
        alphas = np.where((alphas > cut) & (t > 0), alphas, 0)
        order = np.argsort(t, 1)
        alphas = np.take_along_axis(alphas, order, 1)
        colors = np.take_along_axis(colors, order[:, :, None], 1)
        left = np.cumprod(1 - alphas, 1)
        shares = alphas * np.concatenate([np.ones((len(left), 1)), left[:, :-1]], 1)
        light = (shares[:, :, None] * colors).sum(1) + left[:, -1:] * background
        return light, 1 - left[:, -1]


def random_cloud(count, seed, extent=1.0, size=0.15, degree=0):
    """Any cloud of a ball's size, some kernels thin"""
    random = np.random.default_rng(seed)
    coefficients = random.normal(0, 0.3, (count, (degree + 1) ** 2, 3))
    coefficients[:, 0] = random.uniform(-1, 1, (count, 3))
    return Cloud(random.uniform(-extent, extent, (count, 3)), size * random.uniform(0.1, 1, (count, 3)),
                 random.uniform(0.1, 1, count), turns=Rotation.random(count, random_state=seed), coefficients=coefficients)


def new_stage(*prims, lines=(), width=2.0, eye=(0, 0, 10), rotate=None, meters=1.0, unit=1.0, near=1.0, far=100.0, lens=None,
              **camera):
    """A stage with an orthographic camera that looks along -z, and sees a square of this width; with `lens` a perspective.

    :param prims: text of others
    :param lines, camera: of the camera, as usda.camera() takes them
    :param unit: factor of all lengths"""
    view = {"lens": lens} if lens else {"flat": (10 * width * unit, 10 * width * unit)}
    at = tuple((np.array(eye, float) * unit).tolist())
    seen = usda.camera(*lines, clippingRange=(near * unit, far * unit), at=at, turn=rotate, **view, **camera)
    stage = Usd.Stage.CreateInMemory()
    stage.GetRootLayer().ImportFromString(usda.stage(seen, *prims, metersPerUnit=meters))
    return stage


def placement(turn, at=(0.0, 0.0, 0.0)):
    """:param turn: scipy's rotation, or a matrix
    :returns: a matrix for column vectors"""
    matrix = np.eye(4)
    matrix[:3, :3] = turn.as_matrix() if isinstance(turn, Rotation) else turn
    matrix[:3, 3] = at
    return matrix


def place(prim, matrix):
    """:param matrix: for column vectors, as numpy multiplies them"""
    UsdGeom.Xformable(prim).MakeMatrixXform().Set(Gf.Matrix4d(*np.asarray(matrix, float).T.ravel().tolist()))


def rays(pixels, width=2.0, height=10.0):
    """:returns: origins, directions through the pixels' middles of new_stage()'s camera, row by row from the top left"""
    x = (np.arange(pixels) + 0.5) / pixels * width - width / 2
    grid = np.stack(np.meshgrid(x, -x), -1).reshape(-1, 2)
    origins = np.concatenate([grid, np.full((len(grid), 1), height)], 1)
    return origins, np.broadcast_to([0.0, 0.0, -1.0], origins.shape)


def floor(lobe="oren_nayar_diffuse_bsdf", z=0.0, **inputs):
    """A square that faces +z, with one lobe. :returns: its text"""
    return usda.card("floor", 5.0, z=z, scheme="", bind="paint") + usda.lobe("paint", lobe, **inputs)


WHITE = {"color": (1, 1, 1)}
PANE = {"lobe": "dielectric_bsdf", "ior": 1.0, "scatter_mode": "RT", "roughness": (0, 0)}  # that does not bend light
SUN = usda.prim("DistantLight", "sun", intensity=1, angle=0)  # straight down, irradiance 1 on a floor
DOME = usda.prim("DomeLight", "dome", intensity=1)


def off(images, light):
    """:returns: how far the colour of each pixel is off at most"""
    return np.abs(images["color"][..., :3].reshape(-1, 3) - light).max(1)


def sharp_image(stage, folder, pixels=32, samples=1, settings=(), aovs=("color", "alpha"), backend="embree"):
    """:returns: images by AOV, every sample at its pixel's middle"""
    from inProcess import Stage, needs_opengl

    needs_opengl(backend)
    path = folder / "stage.usda"
    stage.Export(str(path))
    rendered = Stage(path, "--camera", "/camera", "--imageWidth", pixels, "--imageHeight", pixels, "--disableCameraLight",
                     "--backend", backend, *settings)
    film = rendered.film(filterRadius=0.0, samples=samples, aovs=list(aovs))
    return {aov: np.array(film.resolve(aov)) for aov in aovs}, rendered
