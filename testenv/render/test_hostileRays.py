# SPDX-License-Identifier: Apache-2.0
"""Numbers that no ray can be made of: a message that names the prim, and no ray that ends the process."""
import numpy as np
import pytest

from patina import experiment
from patina.chart import probes
from usdaText import render_text
from rendering import patina
import usda


STAGE = (
    usda.camera("float4[] clippingPlanes = %(planes)s", clippingRange="%(range)s", focusDistance="%(focus)s",
                fStop="%(stop)s", at="%(translate)s", scale="%(scale)s")
    + usda.prim("DomeLight", "dome")
    + usda.prim("SphereLight", "lamp", at="(0, 0, %(light)s)")
    + usda.prim("Sphere", "ball")
    + usda.prim(
        "PointInstancer", "many", "rel prototypes = </many/cube>", "float3[] scales = [(1, 1, 1), %(instance)s]",
        usda.prim("Cube", "cube"),
        protoIndices=[0, 0], positions=[(30, 0, 0), (-30, 0, 0)])
    + usda.prim("Cube", "large", at="(0, %(height)s, 0)"))
SOUND = {"range": "(0.1, 1000)", "planes": "[]", "focus": 0, "stop": 0, "scale": "(1, 1, 1)", "translate": "(0, 0, 5)",
         "instance": "(1, 1, 1)", "height": 5, "light": 30}


def look(**changes):
    return render_text(STAGE % {**SOUND, **changes}, ("color", "alpha"), samples=2, domeLightCameraVisibility=False)


@pytest.mark.parametrize("changes, prim, word", [
    ({"range": "(nan, nan)"}, "/camera", "clippingRange"),
    ({"planes": "[(nan, 0, 0, 1), (0, 0, nan, nan)]"}, "/camera", "clippingPlanes"),
    ({"focus": "1e20", "stop": 200}, "/camera", "focusDistance"),
    ({"focus": "5", "stop": "1e-30"}, "/camera", "fStop"),
    ({"instance": "(1, 1, 1e-30)"}, "/many", "transform"),
    ({"instance": "(1e-30, 1e-30, 1e-30)"}, "/many", "transform"),
    ({"height": "1e19"}, "/large", "transform: has a value beyond 1e15"),
    ({"light": "1e19"}, "/lamp", "transform: has a value beyond 1e15"),
    ({"instance": "(1, 1e19, 1)"}, "/many", "transform: of an instance has a value beyond 1e15"),
])
def test_what_cannot_be_used_is_named_and_the_rest_is_drawn(changes, prim, word):
    images, warnings, _ = look(**changes)
    assert np.isfinite(images["color"]).all()
    assert images["alpha"][16, 16] == 1.0 and images["alpha"][0, 0] == 0.0  # the ball in the middle
    assert any(w.startswith(prim) and word in w for w in warnings), warnings


@pytest.mark.parametrize("changes, what", [
    ({"translate": "(0, 0, 1e19)"}, "has a value beyond 1e15"),
    ({"scale": "(1, 1, 1e30)"}, "has a value beyond 1e15"),
    ({"scale": "(1, 1, 1e-30)"}, "too small to have an inverse"),
])
def test_cameras_that_see_nothing_fail_by_name(changes, what):
    with pytest.raises(RuntimeError, match=f"transform of camera /camera .*{what}"):
        look(**changes)


def test_a_filter_beyond_all_pixels_ends_with_an_image():
    images, _, _ = render_text(STAGE % SOUND, samples=2, filterRadius=1e308)
    assert np.isfinite(images["color"]).all()
    process = patina("record", "absent.usda", "absent.exr", "--filterRadius", "1e308", check=False)
    assert process.returncode == 2 and "--filterRadius" in process.stderr


def test_an_instance_that_turns_halfway_within_the_shutter_is_drawn():
    """Halfway between the two samples of the motion its matrix is flat and has no inverse."""
    import _patina

    scene, film = _patina.Scene(), _patina.Film()
    turn = np.diag([-1.0, -1.0, 1.0, 1.0])
    with scene.edit() as edit:
        edit.set_implicit("/cube", shape="cube", group="A")
        edit.set_instancer("/turning", prototypes=["A"], prototype_indices=np.zeros(1, np.int32),
                           transforms=([0.0, 1.0], [np.eye(4)[None], turn[None]]))
        edit.set_camera("/camera", transform=probes.moved(0, 0, 6), shutter_open=0.0, shutter_close=1.0)
        edit.set_light("/dome", type="dome")
    settings = {"width": 16, "height": 16, "samples": 64, "threads": 1, "aovs": ["color", "alpha"],
                "domeLightCameraVisibility": False}
    experiment.draw(_patina.make_renderer("embree"), scene, "/camera", settings, film)
    assert np.isfinite(film.resolve("color")).all()
    alpha = np.array(film.resolve("alpha"))
    assert alpha[8, 8] > 0.7 and 0.1 < alpha[8, 3] < 0.7  # in the middle it is thin, but always there
