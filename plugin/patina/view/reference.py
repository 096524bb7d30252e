# SPDX-License-Identifier: Apache-2.0
"""Renders what a page shows with Patina's own back ends: one shape in one environment, from the
page's first camera. The pictures are linear and square."""
import os
import tempfile

import numpy as np

from patina.cli.compiled import _patina
from patina.experiment import draw

FOCAL_LENGTH = 50.0


def _look_at(eye, target, up):
    back = np.asarray(eye, float) - target
    back /= np.linalg.norm(back)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    over = np.cross(back, right)
    return [*right, 0.0, *over, 0.0, *back, 0.0, *eye, 1.0]


def _camera(edit, camera, eye):
    aperture = 2.0 * FOCAL_LENGTH * np.tan(np.radians(camera["fov"] * 0.5))
    edit.set_camera("/camera", transform=_look_at(eye, camera["target"], camera["up"]), focal_length=FOCAL_LENGTH,
                    horizontal_aperture=aperture, vertical_aperture=aperture, f_stop=0.0,
                    clip_near=camera["radius"] * 0.01, clip_far=camera["radius"] * 100.0)


def _dome(edit, folder, environment):
    """:param environment: dict of pixels (linear, top row first), radiance and toLocal"""
    file = os.path.join(folder, "environment.exr")
    _patina.write_image(file, np.ascontiguousarray(environment["pixels"], np.float32))
    transform = np.eye(4)
    # Columns of the way there are rows here; the way back is its transpose.
    transform[:3, :3] = np.array(environment["toLocal"]).reshape(3, 3).T
    edit.set_light("/environment", type="dome", transform=transform.ravel().tolist(), texture_file=file,
                   color=list(map(float, environment["radiance"])), intensity=1.0)


def _mesh(edit, mesh, to_world):
    """:param mesh: dict of points, normals, uv, indices as in view/shapes.py"""
    count = len(mesh["indices"]) // 3
    edit.set_mesh("/shape", points=np.asarray(mesh["points"], np.float32),
                  face_vertex_counts=np.full(count, 3, np.int32),
                  face_vertex_indices=np.asarray(mesh["indices"], np.int32), scheme="none", material="/material",
                  transform=list(map(float, to_world)),  # columns, as Gf has row vectors: the very same numbers
                  primvars=[("normals", "vertex", np.asarray(mesh["normals"], np.float32)),
                            ("st", "vertex", np.asarray(mesh["uv"], np.float32))])


def render(network, mesh, to_world, environment, camera, eye, width, samples, backend="embree", scene=None,
           **more):
    """
    :param mesh: see _mesh(), or a function of a scene's edit that draws `/shape` with `/material` itself
    :param environment: see _dome(); None for none
    :param scene: a `_patina.Scene` whose lights (but no domes) light the shape too, or None
    :param more: further render settings
    :returns: float array (width, width, 3), top row first
    """
    scene = scene or _patina.Scene()
    film = _patina.Film()
    settings = dict(_patina.default_render_settings(), width=width, height=width, samples=samples, tolerance=-1.0,
                    filterRadius=0.5, **more)
    with tempfile.TemporaryDirectory() as folder:
        with scene.edit() as edit:
            _camera(edit, camera, eye)
            if environment:
                _dome(edit, folder, environment)
            edit.set_material("/material", network)
            if callable(mesh):
                mesh(edit)
            else:
                _mesh(edit, mesh, to_world)
        draw(_patina.make_renderer(backend), scene, "/camera", settings, film)
    return np.asarray(film.resolve("color"))[..., :3].copy()
