"""The rasterizer beside the path tracer, where both have the same answer: direct light.

The limits are what was measured with these very settings, and a little more. Both images are made of fixed seeds, so that
a difference is a change of the code.
"""
import subprocess
import sys

import pytest

import bothBackEnds

# Scene: samples, largest bias of the mean, largest relative difference of an 8x8 block.
LIMITS = {
    "furnace": (64, 0.005, 0.03),  # an albedo under a white sky: the answer is the albedo itself
    "lightRect": (32, 0.02, 0.15),
    "lightSpot": (32, 0.02, 0.2),
    "lightDome": (32, 0.03, 0.2),
    "texturedDiffuse": (32, 0.02, 0.15),
}


def _has_opengl():
    import _patina

    try:
        _patina.make_renderer("raster")
    except RuntimeError as error:
        return str(error)
    return ""


@pytest.fixture(scope="module", autouse=True)
def opengl():
    reason = _has_opengl()
    if reason:
        pytest.skip(reason)


@pytest.mark.parametrize("name", sorted(LIMITS))
def test_direct_light_is_the_path_tracers(name, tmp_path):
    samples, bias, worst = LIMITS[name]
    row = bothBackEnds.pair(name, str(tmp_path), samples, 48 if name == "furnace" else 96, 1)
    report = f"{row['command']}: bias {row['bias']:+.4f}, worst block {row['worst']:.3f}"
    assert abs(row["bias"]) <= bias, report
    assert row["worst"] <= worst, report


def test_aovs_are_the_path_tracers(tmp_path):
    import numpy as np

    import _patina

    stage = bothBackEnds.SCENES + "/texturedMesh.usda"
    found = {}
    for backend in ("raster", "embree"):
        image = str(tmp_path / (backend + ".exr"))
        aovs = [x for name in ("depth", "normal", "primId", "instanceId") for x in ("--aov", name)]
        bothBackEnds.record(stage, image, "--backend", backend, "--samples", "2", "--filterRadius", "0", "-w", "96", *aovs)
        read = _patina.read_image(image)
        found[backend] = {c: np.array(read.pixels)[..., i] for i, c in enumerate(read.channels)}
    assert set(found["raster"]) == set(found["embree"])
    for channel, values in found["raster"].items():
        if channel in "RGBA":
            continue
        same = np.isclose(values, found["embree"][channel], rtol=1e-3, atol=2e-3)
        assert same.mean() > 0.985, (channel, same.mean())  # silhouettes may fall to either side


def test_without_opengl_the_command_says_why(tmp_path):
    import os

    process = subprocess.run([sys.executable, "-m", "patina", "record", bothBackEnds.SCENES + "/lightRect.usda",
                              str(tmp_path / "x.png"), "--backend", "raster"], capture_output=True, text=True,
                             env=dict(os.environ, PATINA_EGL_PLATFORM="none"))
    assert process.returncode == 1
    assert process.stderr.strip().count("\n") == 0 and "EGL" in process.stderr
    assert not (tmp_path / "x.png").exists()
