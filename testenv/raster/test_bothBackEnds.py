"""The rasterizer beside the path tracer, where both have the same answer: direct light.

The limits are what was measured with these very settings, and a little more. Both images are made of fixed seeds, so that
a difference is a change of the code.
"""
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


@pytest.fixture(scope="module", autouse=True)
def opengl():
    reason = bothBackEnds.without_opengl()
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
