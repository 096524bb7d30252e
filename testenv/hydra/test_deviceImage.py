# SPDX-License-Identifier: Apache-2.0
"""The rasterizer's image in an interactive host, which stays on the device, beside the film of another host, which asks for the
number of samples too."""
import json
import os

import numpy as np
import pytest

import hydraBuild
import inProcess
import stages

# 3: smoothed; 20: past the first image and the smoothing. Light that is taken away; a lens; fibres, which have a box of their
# own.
CASES = [("shaderball", 3), ("lightDome", 1), ("lightDome", 20), ("lightNegative", 20), ("depthOfField", 20), ("hair", 3)]
SIZE = "48x32"


def drawn(tmp_path, scene, samples, aovs):
    """:returns: the channels of all AOVs by name, of the device and of the film"""
    found = []
    for name, more in (("device", ()), ("film", ("sampleCount=float32",))):
        image = tmp_path / f"{name}.exr"
        hydraBuild.run_host(os.path.join(stages.SCENES, f"{scene}.usda"), image, "--camera", "/World/camera", "--size", SIZE,
                            "--set", "backend=raster", "--set", f"samples={samples}", "--set", "interactive=true",
                            *(word for aov in (*aovs, *more) for word in ("--aov", aov)))
        found.append({name: values.astype(np.float64) for name, values in inProcess.channels(image).items()})
    device, film = found
    assert (film.pop("sampleCount") == samples).all() and device.keys() == film.keys()
    return device, film


@pytest.mark.parametrize("scene, samples", CASES)
def test_is_the_films(tmp_path, scene, samples):
    aovs = ("color=float32vec4", "depth=float32", "cameraDepth=float32", "elementId=int32", "Neye=float32vec3")
    device, film = drawn(tmp_path, scene, samples, aovs)
    assert film["R"].std() > 0.01 and len(np.unique(film["elementId"])) > 1
    # Sums of so many floats, each with roundings of its own, beside sums in double.
    bound = 4 * (samples + 4) * 2.0 ** -24
    for name, values in film.items():
        assert np.abs(device[name] - values).max() <= bound * np.abs(values).max(), name


def test_tells_where_its_time_went(tmp_path):
    report = tmp_path / "report.json"
    hydraBuild.run_host(os.path.join(stages.SCENES, "diffuseBox.usda"), tmp_path / "image.exr", "--camera", "/World/camera",
                        "--size", SIZE, "--set", "backend=raster", "--set", "samples=1", "--json", report)
    stats = json.loads(report.read_text())["stats"]
    assert all(stats[f"patina:seconds{share}"] > 0.0 for share in ("Aovs", "Shadows", "Surfaces"))


@pytest.mark.parametrize("form, step", [("float16vec4", 2.0 ** -10), ("float16vec3", 2.0 ** -10), ("unorm8vec4", 1 / 255),
                                        ("float32vec3", 1e-6)])
def test_in_every_form(tmp_path, form, step):
    device, film = drawn(tmp_path, "shaderball", 1, [f"color={form}"])
    for name, values in film.items():
        assert np.abs(device[name] - values).max() <= 1.01 * step * max(1.0, values.max()), name
