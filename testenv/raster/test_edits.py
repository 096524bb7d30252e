# SPDX-License-Identifier: Apache-2.0
"""Edits rebuild what they touch, and the image is that of a renderer which has drawn nothing before."""
import os

import numpy as np
import pytest

import _patina
import bothBackEnds
import rasterTimes
from patina import experiment
from patina.chart import probes

pytestmark = pytest.mark.usefixtures("opengl")

SIZE = (64, 36)


def frames_of(name):
    return rasterTimes.Frames(os.path.join(bothBackEnds.SCENES, name + ".usda"), SIZE, "raster")


def draw(frames):
    """:returns: the image, and counts of what was built since the renderer was made"""
    frames.draw(0.0)
    counts = frames.renderer.progress()["statistics"]
    return frames.film.resolve("color"), {k: counts[k] for k in ("surfacesBuilt", "instancesWritten", "programsBuilt")}


def shown(scene, renderer, samples=2, aovs=(), film=None):
    """:returns: the image and its AOVs, and the renderer's statistics"""
    film = film or _patina.Film()
    settings = {"width": 48, "height": 32, "samples": samples, "aovs": list(aovs)}
    state = experiment.draw(renderer, scene, "/camera", settings, film, renderer.progress()["backend"])
    return [film.resolve(name) for name in ("color", *aovs)], state["statistics"]


EDITS = {  # what an edit may build: shapes, buffers of instances, programs
    "camera": (lambda f: f.move(1), (0, 0, 0)),
    # Carries an instance to a distance at which others have another tessellation: both are there, their lists change.
    "camera farther": (lambda f: f.move(3), (0, 1, 0)),
    "material": (lambda f: f.edit("/World/materials/green/diffuse", "color", [0.5, 0.1, 0.1]), (0, 0, 0)),
    "light": (lambda f: f.edit("/World/key", "intensity", 3.0), (0, 0, 0)),
    "nothing": (lambda f: None, (0, 0, 0)),
}


@pytest.mark.parametrize("name", sorted(EDITS))
def test_edits_build_only_what_they_touch(name):
    edit, allowed = EDITS[name]
    frames, fresh = frames_of("instances"), frames_of("instances")
    before, first = draw(frames)
    edit(frames)
    after, second = draw(frames)
    edit(fresh)
    expected, _ = draw(fresh)
    np.testing.assert_array_equal(after, expected)
    assert np.array_equal(before, after) == (name == "nothing")
    assert tuple(second[k] - first[k] for k in ("surfacesBuilt", "instancesWritten", "programsBuilt")) == allowed


def test_a_moved_camera_tessellates_by_powers_of_two():
    """A sphere is built anew where its level changes, which a move by a seventh mostly does not."""
    scene, renderer, film = _patina.Scene(), _patina.make_renderer("raster"), _patina.Film()
    found = []
    for step in range(12):
        with scene.edit() as edit:
            if step == 0:
                edit.set_implicit("/ball", shape="sphere", radius=1.0)
            edit.set_camera("/camera", transform=probes.moved(0, 0, 4.0 * 1.15 ** step))
        counts = shown(scene, renderer, 1, film=film)[1]
        found.append((counts["surfacesBuilt"], counts["trianglesStored"]))
    assert found[0][0] == 1
    changes = [(built - before, now < finer) for (before, finer), (built, now) in zip(found, found[1:])]
    assert set(changes) == {(0, False), (1, True)}, found
    assert changes.count((1, True)) <= 2, found  # distances grow by 4.7: chords by the root of that, one or two levels


def test_a_prim_that_changes_is_built_anew():
    """Alone; the others keep their buffers."""
    points = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], dtype=np.float32)

    def mesh(edit, path, y, lift=0.0, transform=None):
        values = {"points": points + np.float32([0, y, 0]) + np.float32([0, lift, 0]) * points[:, :1],
                  "face_vertex_counts": [4], "face_vertex_indices": [0, 3, 2, 1]}
        edit.set_mesh(path, **values, **({} if transform is None else {"transform": transform}))

    def scene_with(changes):
        scene = _patina.Scene()
        with scene.edit() as edit:
            mesh(edit, "/a", 0.0)
            mesh(edit, "/b", 0.5)
            edit.set_light("/sun", type="distant", intensity=3.0, angle=1.0)
            edit.set_camera("/camera", transform=probes.moved(0, 0.3, 6))
        drawn = run(scene)
        for change in changes:
            with scene.edit() as edit:
                change(edit)
        return scene, drawn

    renderer = _patina.make_renderer("raster")

    def run(scene, by=None):
        (image,), found = shown(scene, by or renderer)
        return image, found["surfacesBuilt"]

    shift = probes.moved(0.5, 0, 0)
    for change, built in ((lambda e: mesh(e, "/b", 0.5, lift=0.2), 1), (lambda e: mesh(e, "/b", 0.5), 0),
                          (lambda e: mesh(e, "/b", 0.5, transform=shift), 0), (lambda e: mesh(e, "/c", 0.2), 1)):
        scene, (before, first) = scene_with([change])
        after, second = run(scene)
        assert second - first == built
        np.testing.assert_array_equal(after, run(scene, _patina.make_renderer("raster"))[0])


@pytest.mark.parametrize("name", ["lightRect", "lightDome", "motionBlur"])
def test_resuming_equals_one_render(tmp_path, name):
    """Also where passes leave something to later ones, as the maps of the sky are."""
    frames = frames_of(name)

    def render(samples, film, **settings):
        frames.renderer.start(frames.scene, frames.info.camera,
                              dict(frames.settings, samples=samples, aovs=["depth", "normal"], **settings), film)
        frames.renderer.wait()
        return {name: film.resolve(name) for name in ("color", "alpha", "variance", "depth", "normal", "sampleCount")}

    whole = render(7, _patina.Film())
    half = _patina.Film()
    half.resume_token = "same"
    render(3, half)
    half.save_checkpoint(str(tmp_path / "half"))
    loaded = _patina.Film()
    loaded.load_checkpoint(str(tmp_path / "half"))
    loaded.resume_token = "same"
    for name, values in render(7, loaded).items():
        np.testing.assert_array_equal(values, whole[name], err_msg=name)


def test_tolerance_ends_a_render():
    frames = frames_of("lightRect")

    def render(film=None, **settings):
        film = film or _patina.Film()
        frames.renderer.start(frames.scene, frames.info.camera, dict(frames.settings, **settings), film)
        frames.renderer.wait()
        count = np.unique(film.resolve("sampleCount"))
        assert len(count) == 1
        return int(count[0]), film

    def error(film):
        return film.relative_error(shared=True)

    few, film = render(samples=4, minSamples=4)
    assert few == 4
    tolerance = 0.5 * error(film)
    taken, film = render(samples=512, minSamples=4, tolerance=tolerance)
    looks = [4, 8, 16, 32, 48, 64, 96, 128, 192, 256, 384]
    assert taken in looks[1:]
    assert error(film) <= tolerance
    _, before = render(samples=looks[looks.index(taken) - 1], minSamples=4)
    assert error(before) > 0.9 * tolerance  # noise gets no more: a tenth is kept for lengths of paths
    # The most samples, the fewest, and a render that continues: it ends where the whole one did.
    assert render(samples=5, minSamples=2, tolerance=tolerance * 1e-3)[0] == 5
    assert render(samples=64, minSamples=32, tolerance=10.0)[0] == 32
    part = _patina.Film()
    part.resume_token = "same"
    render(part, samples=max(3, taken - 2), minSamples=4)
    assert render(part, samples=512, minSamples=4, tolerance=tolerance)[0] == taken
    np.testing.assert_array_equal(part.resolve("color"), film.resolve("color"))


def test_equal_implicit_prims_share_their_buffers():
    """And look as prims do that differ in something that nobody sees."""
    def draw(tell_apart):
        scene = _patina.Scene()
        with scene.edit() as edit:
            for i in range(12):
                more = {"primvars": [("mark", "constant", np.float32([i]), None)]} if tell_apart else {}
                edit.set_implicit(f"/ball{i}", shape="sphere", radius=0.2,
                                  transform=probes.moved(0.5 * (i % 4) - 0.75, 0.5 * (i // 4) - 0.5, -4), **more)
            edit.set_light("/sun", type="distant", intensity=3.0)
            edit.set_camera("/camera")
        (image,), found = shown(scene, _patina.make_renderer("raster"), 1)
        return image, found["surfacesBuilt"]

    (together, few), (apart, many) = draw(False), draw(True)
    assert (few, many) == (1, 12)
    np.testing.assert_array_equal(together, apart)


def test_shapes_that_were_replaced_are_forgotten():
    """However often a prim takes another shape: up to 64 that nobody shows are left to be looked for."""
    scene, renderer, film = _patina.Scene(), _patina.make_renderer("raster"), _patina.Film()
    with scene.edit() as edit:
        edit.set_light("/sun", type="distant", intensity=3.0)
        edit.set_camera("/camera")

    def draw(radius):
        """:returns: bytes in buffers"""
        with scene.edit() as edit:
            edit.set_implicit("/ball", shape="sphere", radius=radius, transform=probes.moved(0, 0, -4))
        settings = {"width": 8, "height": 8, "samples": 1}
        return experiment.draw(renderer, scene, "/camera", settings, film)["statistics"]["bytes"]

    draw(0.5)
    one = draw(0.6)
    for i in range(150):
        last = draw(0.6 + 0.001 * i)
    assert 0 < last <= 66 * one


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_edits_look_at_what_they_touch_however_many_prims_there_are(backend):
    """And the image is that of a renderer which has looked at everything."""
    points = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32) * np.float32(0.045)

    def mesh(edit, i, nearer=0.0, material="/others", **more):
        matrix = probes.moved(0.1 * (i % 20) - 0.95, 0.1 * (i // 20), nearer - 1.2)
        edit.set_mesh(f"/mesh{i:04}", points=points, face_vertex_counts=[4], face_vertex_indices=[0, 1, 2, 3],
                      transform=matrix, material=material, **more)

    def color(edit, path, red):
        edit.set_material(path, probes.network("oren_nayar_diffuse_bsdf", color=(red, 0.4, 0.2)))

    def render(scene, renderer):
        images, found = shown(scene, renderer, aovs=("primId", "normal"))
        return images, found["primsLookedAt"]

    edits = {
        "color of one": (lambda e: color(e, "/one", 0.9), 1),
        "color of three": (lambda e: color(e, "/three", 0.9), 3),
        "place": (lambda e: mesh(e, 5, nearer=1.0), 1),
        "outermost place": (lambda e: mesh(e, 0, nearer=-3.0), 1),
        "binding": (lambda e: mesh(e, 6, material="/one"), 1),
        "light": (lambda e: e.set_light("/sun", type="distant", intensity=1.0, angle=1.0), 0),
        "nothing": (lambda e: mesh(e, 5, nearer=1.0), 1),
    }
    for count in (40, 200):
        scene, renderer = _patina.Scene(), _patina.make_renderer(backend)
        with scene.edit() as edit:
            for path in ("/one", "/three", "/others"):
                color(edit, path, 0.1)
            for i in range(count):
                mesh(edit, i, material="/one" if i == 30 else "/three" if i < 3 else "/others")
            edit.set_light("/sun", type="distant", intensity=3.0, angle=1.0)
            edit.set_camera("/camera", transform=probes.moved(0, 0.5, 4))
        before, looked = render(scene, renderer)
        assert looked >= count
        for name, (change, touched) in edits.items():
            with scene.edit() as edit:
                change(edit)
            after, now = render(scene, renderer)
            assert now - looked == touched, f"{name} of {count}"
            assert name == "nothing" or not all(np.array_equal(a, b) for a, b in zip(before, after)), name
            if count == 40:
                for a, b in zip(after, render(scene, _patina.make_renderer(backend))[0]):
                    np.testing.assert_array_equal(a, b, err_msg=name)
            before, looked = after, now


def test_what_shows_values_of_instances_is_drawn_anew():
    """Where a material reads what instances have, an edit looks at all prims; the image is that of a fresh renderer."""
    def reader(edit, name):
        network = _patina.Network("/painted")
        network.add_node("/painted/tint", "ND_geompropvalue_color3")
        network.set_input("/painted/tint", "geomprop", "string", name)
        network.add_node("/painted/bsdf", "ND_oren_nayar_diffuse_bsdf")
        network.connect("/painted/bsdf", "color", "/painted/tint")
        network.add_node("/painted/surface", "ND_surface")
        network.connect("/painted/surface", "bsdf", "/painted/bsdf")
        network.set_terminal("surface", "/painted/surface")
        edit.set_material("/painted", network)

    def plain(edit, red):
        edit.set_material("/plain", probes.network("oren_nayar_diffuse_bsdf", color=(red, 0.4, 0.2)))

    def ball(edit, **more):
        edit.set_implicit("/ball", shape="sphere", radius=0.25, group="A", **dict({"material": "/painted"}, **more))

    def render(scene, renderer):
        (image,), found = shown(scene, renderer)
        return image, found["primsLookedAt"]

    scene, renderer = _patina.Scene(), _patina.make_renderer("raster")
    others = 20
    with scene.edit() as edit:
        reader(edit, "tint")
        plain(edit, 0.1)
        ball(edit)
        colours = np.float32([[0.9, 0.1, 0.1], [0.1, 0.9, 0.1], [0.1, 0.1, 0.9]])
        edit.set_instancer("/balls", prototypes=["A"], prototype_indices=np.zeros(3, np.int32),
                           transforms=np.stack([probes.moved(x, 0, 0) for x in (-0.55, 0, 0.55)]),
                           primvars=[("tint", "vertex", colours), ("shade", "vertex", colours[::-1].copy())])
        for i in range(others):
            edit.set_implicit(f"/other{i:02}", shape="cube", size=0.1, material="/plain",
                              transform=probes.moved(0.08 * i - 0.8, -0.5, 0))
        edit.set_light("/sun", type="distant", intensity=3.0)
        edit.set_camera("/camera", transform=probes.moved(0, 0, 4))
    before, looked = render(scene, renderer)
    edits = [("what nobody reads of instances", lambda e: plain(e, 0.9), False),
             ("another value", lambda e: reader(e, "shade"), True),
             ("a value of its own",
              lambda e: ball(e, primvars=[("shade", "constant", np.float32([[0.8, 0.8, 0.1]]))]), True),
             ("no value of its own", ball, True),
             ("another material", lambda e: ball(e, material="/plain"), True)]
    for name, change, of_all in edits:
        with scene.edit() as edit:
            change(edit)
        after, now = render(scene, renderer)
        assert not np.array_equal(before, after), name
        np.testing.assert_array_equal(after, render(scene, _patina.make_renderer("raster"))[0], err_msg=name)
        assert (now - looked > others) == of_all, (name, now - looked)
        before, looked = after, now
