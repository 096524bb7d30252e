# SPDX-License-Identifier: Apache-2.0
"""AOVs of what is seen through Hydra's buffers: closed forms of geometric normals, reference positions and motion vectors, and
the layers of Cryptomatte with the bits of the command line's file."""
import json

import numpy as np
import pytest

import hydraBuild
from rendering import pixels, record
import usda

MODES = pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
SIZE, DISTANCE = 32, 8.0
PIXELS = SIZE / DISTANCE  # a unit across at that distance; the aperture is as wide as the focal length
ROUNDING = 16 * 64 * SIZE * 2.0 ** -24  # as in testenv/render/test_namedAovs.py


def quad(*lines, half=20, name="sheet", **values):
    return usda.card(name, half, *lines, z=-8, st=usda.ST, **values)


def stage_of(prims, shutter=(0, 0), **camera):
    times = [f"double shutter:{end} = {time}" for end, time in zip(("open", "close"), shutter)]
    return usda.stage(usda.camera(*times, lens=(50, 50, 50), clippingRange=(0.1, 1000), **camera), prims)


def render(tmp_path, prims, aovs, scene_index, shutter=(0, 0), settings=(), **camera):
    """:returns: dict of channels, and the host's report"""
    import _patina

    stage, image, report = tmp_path / "stage.usda", tmp_path / "image.exr", tmp_path / "report.json"
    stage.write_text(stage_of(prims, shutter, **camera))
    hydraBuild.run_host(stage, image, "--camera", "/camera", "--size", f"{SIZE}x{SIZE}", "--frame", 5, "--json", report,
                        *[word for aov in aovs for word in ("--aov", aov)],
                        *[word for item in ("samples=4", *settings) for word in ("--set", item)], scene_index=scene_index)
    found = _patina.read_image(str(image))
    with open(report, encoding="utf-8") as file:
        return dict(zip(found.channels, np.moveaxis(pixels(image), -1, 0))), json.load(file)


def vectors(channels, name, axes="xy"):
    return np.stack([channels[f"{name}.{axis}"] for axis in axes], -1)


def whole(*numbers):
    return np.broadcast_to(numbers, (SIZE, SIZE, len(numbers)))


# UsdImagingDelegate samples while the shutter is open, and not beyond.
@pytest.mark.parametrize("scene_index,shutter", [(True, (0, 0)), (True, (-0.25, 0.25)), (False, (-0.25, 0.25))])
def test_motion_of_camera_and_prim(tmp_path, scene_index, shutter):
    """The camera goes right by 0.5 a frame; the sheet goes up, by 1 before the frame and by 2 after it."""
    sheet = quad(at={4: (0, -1, 0), 5: (0, 0, 0), 6: (0, 2, 0)})
    channels, _ = render(tmp_path, sheet, ("motionForward", "motionBack"), scene_index, shutter,
                         at={0: (-2.5, 0, 0), 10: (2.5, 0, 0)})
    assert vectors(channels, "motionForward") == pytest.approx(whole(-0.5 * PIXELS, -2 * PIXELS), abs=ROUNDING)
    assert vectors(channels, "motionBack") == pytest.approx(whole(0.5 * PIXELS, PIXELS), abs=ROUNDING)


@pytest.mark.parametrize("scene_index,shutter", [(True, (0, 0)), (False, (-0.25, 0.25))])
def test_motion_of_points(tmp_path, scene_index, shutter):
    points = {time: [(x - 20, -20, -8), (x + 20, -20, -8), (x + 20, 20, -8), (x - 20, 20, -8)] for time, x in ((5, 0), (6, 1))}
    moves = usda.prim("Mesh", "sheet", points=points, faceVertexCounts=[4], faceVertexIndices=[0, 1, 2, 3],
                      subdivisionScheme="none")
    channels, _ = render(tmp_path, moves, ("motionFore", "motionBackward"), scene_index, shutter=shutter)
    assert vectors(channels, "motionFore") == pytest.approx(whole(PIXELS, 0.0), abs=ROUNDING)
    assert np.abs(vectors(channels, "motionBackward")).max() < ROUNDING


@MODES
@pytest.mark.parametrize("blur", ["true", "false"])
def test_prims_stay_where_the_frame_has_them(tmp_path, scene_index, blur):
    """Samples of a turn are ten frames apart: the picture is of the frame's own time, with vectors and without."""
    turn = quad(half=3, turn={0: (0, 0, 0), 10: (0, 0, 90)})
    settings = (f"enableMotionBlur={blur}",)
    alone, _ = render(tmp_path, turn, ("color", "position"), scene_index, settings=settings)
    beside, _ = render(tmp_path, turn, ("color", "position", "motionForward"), scene_index, settings=settings)
    for channel in alone:
        assert np.abs(alone[channel] - beside[channel]).max() < 1e-5, channel


@MODES
def test_without_blur_a_shutter_that_opens_early_shifts_nothing(tmp_path, scene_index):
    moves = quad(at={0: (-5, 0, 0), 10: (5, 0, 0)})
    channels, _ = render(tmp_path, moves, ("Pref", "position"), scene_index, shutter=(-0.5, 0.25),
                         settings=("enableMotionBlur=false",))
    # At frame 5 the sheet stands in the middle: its places in the world are those in its own space.
    assert vectors(channels, "position", "xyz") == pytest.approx(vectors(channels, "Pref", "xyz"), abs=1e-5)


@MODES
def test_normals_coordinates_and_reference_positions(tmp_path, scene_index):
    tilted = usda.mesh(
        "sheet", [(-20, -20, -8), (20, -20, -8), (20, 20, -20), (-20, 20, -20)],
        "normal3f[] normals = [(0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1)]",
        'point3f[] primvars:Pref = [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)] (interpolation = "vertex")', st=usda.ST)
    channels, _ = render(tmp_path, tilted, ("Ng", "Ngn", "normal", "uv", "Pref", "primvars:st"), scene_index)
    expected = np.array([0.0, 12.0, 40.0]) / np.hypot(12.0, 40.0)
    assert vectors(channels, "Ng", "xyz") == pytest.approx(whole(*expected), abs=1e-5)
    assert np.array_equal(vectors(channels, "Ngn", "xyz"), vectors(channels, "Ng", "xyz"))
    assert vectors(channels, "normal", "xyz") == pytest.approx(whole(0.0, 0.0, 1.0), abs=1e-5)
    assert np.array_equal(vectors(channels, "uv"), vectors(channels, "primvars:st"))
    # Pref is st with a third component
    assert np.abs(vectors(channels, "Pref") - vectors(channels, "uv")).max() < 1e-6
    assert vectors(channels, "Pref", "xyz")[..., 2] == pytest.approx(np.ones((SIZE, SIZE)), abs=1e-6)


CRYPTO = "".join(quad(half=0.7, name=f"card{i}", at=(x, 0, 0)) for i, x in enumerate((-2.1, -0.7, 0.7, 2.1)))


@MODES
@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_layers_of_cryptomatte_have_the_bits_of_files(tmp_path, scene_index, backend):
    import _patina
    from inProcess import needs_opengl

    needs_opengl(backend)
    layers = [f"crypto_{kind}{rank:02d}" for kind in ("object", "material") for rank in range(3)]
    channels, report = render(tmp_path, CRYPTO, ("color", *layers, "crypto_object07"), scene_index,
                              settings=(f"backend={backend}",))
    record(tmp_path / "stage.usda", tmp_path / "file.exr", "-w", SIZE, "--frames", 5, "--samples", 4, "--backend", backend,
           "--aov", "cryptoObject", "--aov", "cryptoMaterial")
    file = _patina.read_image(str(tmp_path / "file.exr"))
    for layer in layers:
        for own, other in zip("xyzw", "RGBA"):
            expected = np.ascontiguousarray(np.array(file.pixels)[..., file.channels.index(f"{layer}.{other}")])
            found = np.ascontiguousarray(channels[f"{layer}.{own}"])
            assert np.array_equal(found.view(np.uint32), expected.view(np.uint32)), (layer, own)
    assert len(np.unique(channels["crypto_object00.x"])) == 5  # four cards and nothing
    assert not any(channels[f"crypto_object07.{c}"].any() for c in "xyzw")  # of ids that no pixel has
    manifests = {key: value for key, value in file.metadata.items() if key.startswith("cryptomatte/")}
    assert manifests and {key: report["stats"].get(key) for key in manifests} == manifests


@MODES
def test_a_buffer_that_would_change_ids_stays_empty(tmp_path, scene_index):
    stage = tmp_path / "stage.usda"
    stage.write_text(stage_of(CRYPTO))
    end = hydraBuild.run_host(stage, tmp_path / "image.exr", "--camera", "/camera", "--size", "8x8", "--aov", "color", "--aov",
                              "crypto_object00=float16vec4", "--aov", "crypto_object", "--set", "samples=1",
                              scene_index=scene_index)
    assert "crypto_object00 needs a buffer of four 32-bit floats" in end.stderr
