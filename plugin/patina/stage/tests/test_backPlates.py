# SPDX-License-Identifier: Apache-2.0
"""Back plates of cameras: pictures at the distance of focus."""
import numpy as np
import pytest

import _patina

CAMERA = """def Camera "%s" (prepend apiSchemas = ["BackPlateAPI:sky"]) {
    float focusDistance = %g
    float focalLength = 50
    float horizontalAperture = 20
    float verticalAperture = 10
    double3 xformOp:translate = (1, 2, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    asset backPlate:sky:image = @sky.png@
    %s
}
"""


@pytest.fixture
def pictures(tmp_path):
    def write(name, channels):
        _patina.write_image(str(tmp_path / name), np.full((2, 2, channels), 0.5, np.float32))

    write("sky.png", 3)
    return write


def corners(reading, numbers):
    mesh = reading.prim("/camera/sky")
    return np.array(numbers(mesh["points"])).reshape(-1, 3), mesh


def test_a_plate_fills_the_frame_where_it_is_in_focus(read, numbers, pictures):
    reading = read(CAMERA % ("camera", 30, ""))
    points, mesh = corners(reading, numbers)
    assert not reading.warnings
    # 30 units away the frame is 30 * 20 / 50 wide.
    assert np.allclose(np.ptp(points, axis=0), (12, 6, 0)) and np.allclose(points.mean(axis=0), 0)
    assert np.allclose(numbers(mesh["transform"])[12:15], (1, 2, 3 - 30)), mesh
    assert reading.prim("/camera/sky/material")["kind"] == "Material"


def test_tweaks_are_about_the_middle_of_the_plate(read, numbers, pictures):
    reading = read(CAMERA % ("camera", 30, """float2 backPlate:sky:scale:tweak = (0.5, 2)
        float3 backPlate:sky:rotateXYZ:tweak = (0, 90, 0)
        float3 backPlate:sky:translate:tweak = (0, 0, 10)"""))
    points, mesh = corners(reading, numbers)
    assert np.allclose(np.ptp(points, axis=0), (6, 12, 0))
    matrix = np.array(numbers(mesh["transform"])).reshape(4, 4)
    assert np.allclose(matrix[3, :3], (1, 2, 3 - 20))
    assert np.allclose(matrix[0, :3], (0, 0, -1), atol=1e-6)  # x turned to -z


def test_an_orthographic_plate_is_as_large_as_the_aperture(read, numbers, pictures):
    points, _ = corners(read(CAMERA % ("camera", 30, 'token projection = "orthographic"')), numbers)
    assert np.allclose(np.ptp(points, axis=0), (2, 1, 0))  # tenths of a unit


@pytest.mark.parametrize("seen, shown", [("all", ["camera", "other"]), ("solo", ["camera"]), ("mute", [])])
def test_a_plate_is_seen_by_all_cameras_or_by_its_own(read, pictures, seen, shown):
    line = f'token backPlate:sky:plateVisibility = "{seen}"'
    reading = read(CAMERA % ("camera", 30, line) + CAMERA % ("other", 30, line), camera="/camera")
    assert [name for name in ("camera", "other") if reading.has(f"/{name}/sky")] == shown


def test_what_cannot_be_shown_is_told(read, pictures):
    pictures("three.png", 3)
    reading = read(CAMERA % ("camera", 0, "") + CAMERA % ("other", 30, """token backPlate:sky:plateVisibility = "all"
        asset backPlate:sky:depth:image = @sky.png@
        asset backPlate:sky:alpha:image = @three.png@
        float3 backPlate:sky:luma:gamma = (0, 1, 1)"""), camera="/camera")
    told = "\n".join(reading.warnings)
    assert not reading.has("/camera/sky") and reading.has("/other/sky")
    for text in ("/camera focusDistance: gives the back plate sky no size", "/other backPlate:sky:depth:image: is not read",
                 "/other backPlate:sky:alpha:image: has 3 channels",
                 "/other backPlate:sky:luma:gamma: is not finite and above 0"):
        assert text in told, told
