# SPDX-License-Identifier: Apache-2.0
"""The parts of a stage that a page shows: its lights, its domes, and the prims that show a material."""
import numpy as np

from patina import messages
from patina.cli import openStage
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError

MAX_SHAPES = 4
MAX_ENVIRONMENTS = 16  # domes; each is a texture of the page
MAX_LIGHTS = 256  # each is a row of a texture, a folder of the panel, and work of every sample


class StageScene:
    def __init__(self, file, set_texts):
        self.file = file
        _, self.scene, info = openStage.scene_of(file, set_texts, headlight=False)
        self.z_up = info.up_axis == "Z"
        found = _patina.web_lights(self.scene)
        self.lights = [{"name": path.removesuffix("/light_of_mesh").rpartition("/")[2], "row": [float(x) for x in row]}
                       for path, row in found["lights"][:MAX_LIGHTS]]
        self.domes, self.light_table = found["domes"][:MAX_ENVIRONMENTS], found["table"]
        self.warnings = found["warnings"]
        lights, domes = len(found["lights"]) - MAX_LIGHTS, len(found["domes"]) - MAX_ENVIRONMENTS
        if lights > 0:
            self.warnings.append(messages.warning("", "", "pageLightsTooMany", lights, MAX_LIGHTS))
        if domes > 0:
            self.warnings.append(messages.warning("", "", "pageDomesTooMany", domes, MAX_ENVIRONMENTS))

    def shapes(self, wanted, material_paths):
        """
        :param wanted: prim paths; without any, the first prims that show one of the materials
        :returns: list of (name, mesh, columns of the transform)
        """
        known = _patina.web_shapes(self.scene)
        paths = [path for path, _ in known]
        if wanted:
            for path in wanted:
                if path not in paths:
                    raise CommandError(f"--shape: {self.file} has no mesh or implicit prim {path}")
            chosen = wanted
        else:
            chosen = [path for path, material in known if material in material_paths][:MAX_SHAPES]
        made = []
        for path in chosen:
            try:
                mesh = _patina.web_mesh(self.scene, path)
            except ValueError as error:
                raise CommandError(f"--shape: {error}") from error
            made.append((path.rpartition("/")[2], _finished(mesh), list(mesh["toWorld"])))
        return made


def _finished(mesh):
    """Adds what the mesh lacks: flat normals, texture coordinates, tangents along u."""
    points = np.asarray(mesh["points"], np.float64)
    count = len(points)
    corners = points.reshape(-1, 3, 3)
    e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    flat = np.cross(e1, e2)
    flat /= np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-30)
    normals = mesh.get("normals")
    normals = np.repeat(flat, 3, axis=0) if normals is None else np.asarray(normals, np.float64)
    uv = np.asarray(mesh.get("uv", np.zeros((count, 2))), np.float64)
    d = uv.reshape(-1, 3, 2)
    du1, dv1 = (d[:, 1] - d[:, 0]).T
    du2, dv2 = (d[:, 2] - d[:, 0]).T
    area = du1 * dv2 - du2 * dv1
    sign = np.where(area < 0.0, -1.0, 1.0)
    tangent = (e1 * dv2[:, None] - e2 * dv1[:, None]) * sign[:, None]
    tangents = np.concatenate([np.repeat(tangent, 3, axis=0), np.repeat(sign, 3)[:, None]], axis=1)
    made = {"points": points, "normals": normals, "uv": uv, "tangents": tangents, "indices": np.arange(count)}
    if "colors" in mesh:
        made["colors"] = np.asarray(mesh["colors"])
    return _indexed(made)


def _indexed(mesh):
    """Corners that are alike become one vertex."""
    names = [name for name in mesh if name != "indices"]
    rows = np.concatenate([np.asarray(mesh[name], "<f4") for name in names], axis=1)
    _, first, inverse = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return {**{name: np.asarray(mesh[name])[first] for name in names}, "indices": inverse.ravel()}


def bounds(mesh, columns):
    """:returns: radius and centre in the world"""
    matrix = np.array(columns).reshape(4, 4)
    world = np.concatenate([mesh["points"], np.ones((len(mesh["points"]), 1))], axis=1) @ matrix
    low, high = world[:, :3].min(axis=0), world[:, :3].max(axis=0)
    return max(float(np.linalg.norm(world[:, :3] - 0.5 * (low + high), axis=1).max()), 1e-6), 0.5 * (low + high)
