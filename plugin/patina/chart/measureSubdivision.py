# SPDX-License-Identifier: Apache-2.0
"""Measures the choice point `subdivision`: how far a picture is off where edges on screen are longer than they could be.

Two closed shapes of one cage (a ball of 96 quads; the same with creases along the edges of its cube) are path traced as
large as 10, 20, 40 and 80 pixels, diffuse and as metals of eight roughnesses, under an even dome and two square lamps. The
error is the mean of |luminance - truth| over (truth + 0.01) over the pixels that the shape covers, before a dark background;
the truth are edges of half a pixel. Cages are scaled so that their longest edge is a power of two of a pixel: nothing is finer
than it has to be, as it mostly is. All pictures have the same random numbers.
"""
import time

import numpy as np

from patina.chart import probes
from patina.cli.compiled import _patina
from patina.experiment import LUMINANCE, draw, relative_error

POINT = "subdivision"
SIZES = (10, 20, 40, 80)   # about, in pixels: the four columns of a row
BINS = 8                   # of roughness, the root of alpha
SHAPES = ("smooth", "creased")
_FACES = 4                 # along each side of the cage's cube
_SAMPLES = {10: 256, 20: 64, 40: 16, 80: 8}
_BACKGROUND = 0.05         # luminance: dark beside the shapes, for the worst of their outlines
_TIMED = 64                # samples of the pictures that are timed


def rows(timed=True, shapes=SHAPES, sizes=SIZES, bins=range(BINS), samples=None):
    """:param samples: per pixel; None: as many as make noise small beside the errors of 8 pixels

    :returns: list of rows as measure_methods() gives them, with `triangles` besides; what was not asked for is 0
    """
    methods = [name for name, _ in dict(_patina.choice_points())[POINT]]
    found = []
    for shape in shapes:
        for kind in ("diffuse", "facets"):
            columns = {size: _Column(shape, kind, size, samples or _SAMPLES[size], bins) for size in sizes}
            for method in methods:
                found.append(_row(method, shape, kind, columns, bins, timed))
    return found


def _row(method, shape, kind, columns, bins, timed):
    errors, truths = np.zeros((BINS, len(SIZES))), np.zeros((BINS, len(SIZES)))
    for size, column in columns.items():
        where = SIZES.index(size)
        for b in bins if kind == "facets" else [0]:
            chosen = slice(b, b + 1) if kind == "facets" else slice(None)
            errors[chosen, where], truths[chosen, where] = column.error(b, method), 1.0
    known = errors[truths > 0.0]
    row = {"point": POINT, "method": method, "subject": f"{shape}, {kind}", "errorOf": "picture", "mean": float(known.mean()),
           "largest": float(known.max()), "rms": float(np.sqrt((known**2).mean())), "kind": kind, "reflectance": -1.0,
           "axis": "roughness", "axisEnd": 1.0, "errors": errors.ravel().tolist(), "truths": truths.ravel().tolist(),
           "ns": 0.0, "nsLow": 0.0, "nsHigh": 0.0}
    if timed:
        row.update(columns[max(columns)].times(method))
    return row


class _Column:
    """A shape of one kind of lobe in one size."""

    def __init__(self, shape, kind, size, samples, bins=range(BINS)):
        self.kind, self.samples = kind, samples
        points, counts, indices, creases = cage(shape == "creased")
        edge = max(np.linalg.norm(points[a] - points[b]) for a, b in _edges(indices))
        across = np.linalg.norm(points.max(0) - points.min(0)) / np.sqrt(3.0)
        pixels = 2.0 ** round(np.log2(size * edge / across)) * 0.9999
        self.pixel = edge / pixels  # world units
        self.width = int(np.ceil(1.15 * across / self.pixel))
        self.mesh = dict(points=points, face_vertex_counts=counts, face_vertex_indices=indices, scheme="catmullClark",
                         material="/material", transform=_turned(), **creases)
        self.truths = {}
        self.material, self.scene, self.renderer = None, None, None
        for b in bins if kind == "facets" else [0]:
            self.truths[b] = self._render(b, self._finest())[0]

    def error(self, b, method):
        truth, image = self.truths[b], self._render(b, method)[0]
        covered = (truth != _BACKGROUND) | (image != _BACKGROUND)
        return relative_error(image[covered], truth[covered])

    def times(self, method):
        """:returns: processor time of a whole new picture per sample, ns, and triangles"""
        spent = sorted(self._render(BINS // 2, method, _TIMED, build=True)[1] for _ in range(3))
        per = 1e9 / (_TIMED * self.width**2)
        return {"ns": spent[1] * per, "nsLow": spent[0] * per, "nsHigh": spent[2] * per,
                "triangles": self._render(BINS // 2, method, 1)[2]}

    def _finest(self):
        methods = dict(_patina.choice_points())[POINT]
        return min((name for name, _ in methods), key=lambda name: float(name[:-2]))

    def _render(self, b, method, samples=None, build=False):
        begin = time.process_time()
        if build or not self.renderer:
            self.scene, self.renderer = self._scene(), _patina.make_renderer("embree")
            self.material = None
        if self.material != b:  # what is tessellated stays
            with self.scene.edit() as edit:
                edit.set_material("/material", self._network(b))
            self.material = b
        film = _patina.Film()
        settings = {"width": self.width, "height": self.width, "samples": samples or self.samples, "filterRadius": 0.5,
                    "seed": 7, "lightSamples": 2, "branches": 1, "methods": {POINT: method}, "checkpointSeconds": 0.0}
        state = draw(self.renderer, self.scene, "/camera", settings, film)
        spent = time.process_time() - begin
        image = np.asarray(film.resolve("color"), np.float64) @ LUMINANCE + _BACKGROUND * (1.0 - film.resolve("alpha"))
        return image, spent, state["statistics"]["trianglesStored"]

    def _network(self, b):
        if self.kind == "diffuse":
            return probes.network("oren_nayar_diffuse_bsdf", color=(0.5, 0.5, 0.5), roughness=0.0)
        alpha = ((b + 0.5) / BINS) ** 2
        return probes.network("conductor_bsdf", ior=(0.2, 0.2, 0.2), extinction=(3.9, 3.9, 3.9), roughness=(alpha, alpha))

    def _scene(self):
        scene = _patina.Scene()
        aperture = 10.0 * self.pixel * self.width
        with scene.edit() as edit:
            edit.set_camera("/camera", transform=probes.moved(0.0, 0.0, 5.0), orthographic=True, horizontal_aperture=aperture,
                            vertical_aperture=aperture, clip_near=0.1)
            edit.set_mesh("/shape", **self.mesh)
            edit.set_light("/dome", type="dome", intensity=0.4, camera_visible=False)
            for name, axis, intensity in (("/key", (-0.5, 0.7, 0.5), 9.0), ("/rim", (0.9, 0.1, -0.1), 6.0)):
                edit.set_light(name, type="rect", transform=probes.facing(axis, 4.0), width=2.5, height=2.5,
                               intensity=intensity, camera_visible=False)
        return scene


def cage(creased):
    """The cage of a ball of radius 1/2: a cube of 4 x 4 quads a side, blown up.

    :returns: points, counts, indices, and the fields of set_mesh() that crease the edges of the cube
    """
    numbers, points, indices = {}, [], []

    def corner(p):
        if p not in numbers:
            numbers[p] = len(points)
            # Tangents space quads more evenly than the cube's own places.
            at = np.tan(np.array(p) / _FACES * np.pi / 2.0 - np.pi / 4.0)
            points.append(0.5 * at / np.linalg.norm(at))
        return numbers[p]

    for axis in range(3):
        for end in (0, _FACES):
            for i in range(_FACES):
                for k in range(_FACES):
                    quad = []
                    for u, v in ((i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1)):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = end, u, v
                        quad.append(corner(tuple(p)))
                    indices += quad if end else quad[::-1]
    fields = {}
    if creased:
        sharp = [pair for pair in sorted({tuple(sorted(e)) for e in _edges(indices)}) if _on_edge(pair, numbers)]
        fields = {"crease_indices": np.array(sharp, np.int32).ravel(), "crease_lengths": np.full(len(sharp), 2, np.int32),
                  "crease_sharpnesses": np.full(len(sharp), 10.0, np.float32)}
    return (np.array(points, np.float32), np.full(len(indices) // 4, 4, np.int32), np.array(indices, np.int32), fields)


def _on_edge(pair, numbers):
    """Whether both ends are on the same edge of the cube: two of their coordinates are the same ends."""
    at = {number: p for p, number in numbers.items()}
    a, b = at[pair[0]], at[pair[1]]
    return sum(x == y and x in (0, _FACES) for x, y in zip(a, b)) >= 2


def _edges(indices):
    quads = np.asarray(indices).reshape(-1, 4)
    return [(int(q[k]), int(q[(k + 1) % 4])) for q in quads for k in range(4)]


def _turned():
    """So that no edge of the cage is seen along an axis of the picture."""
    a, b = np.radians(31.0), np.radians(23.0)
    around_y = np.array([[np.cos(a), 0, -np.sin(a), 0], [0, 1, 0, 0], [np.sin(a), 0, np.cos(a), 0], [0, 0, 0, 1]])
    around_x = np.array([[1, 0, 0, 0], [0, np.cos(b), np.sin(b), 0], [0, -np.sin(b), np.cos(b), 0], [0, 0, 0, 1]])
    return (around_y @ around_x).astype(np.float32)
