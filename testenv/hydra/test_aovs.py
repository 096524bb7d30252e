# SPDX-License-Identifier: Apache-2.0
"""The contents of Hydra's outputs: depths against the camera's projection, normals, texture coordinates, and
ids that Hydra itself decodes to the prims and instances that are there."""
import json
import math

import numpy as np
import pytest

import hydraBuild
import inProcess
import usda

MODES = pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
NEAR, FAR = 2.0, 50.0
SIZE = 32
STAGE = usda.stage(
    usda.camera(lens=(50, 50, 50), clippingRange=(2, 50)),
    usda.mesh("wall", [(-20, -20, -10), (0, -20, -10), (20, -20, -10), (-20, 20, -10), (0, 20, -10), (20, 20, -10)],
              faces=[(0, 1, 4, 3), (1, 2, 5, 4)], st=[(0, 0), (0.5, 0), (1, 0), (0, 1), (0.5, 1), (1, 1)]))
INSTANCES = usda.stage(
    usda.camera(flat=(50, 50), clippingRange=(0.1, 100), focalLength=50),
    usda.prim("PointInstancer", "outer", "rel prototypes = [</outer/single>, </outer/inner>]",
        usda.card("single", 0.3),
        usda.prim("PointInstancer", "inner", "rel prototypes = </outer/inner/tile>",
            usda.card("tile", 0.2),
            protoIndices=[0, 0], positions=[(0, 0, 0), (0.6, 0, 0)]),
        protoIndices=[1, 0, 1], positions=[(-1.5, 1, -10), (0, 1, -10), (1.5, 1, -10)]),
    usda.prim("", "Library", usda.card("card", 0.3), specifier="class"),
    usda.prim("Xform", "first", meta=("instanceable = true", "references = </Library>"), at=(-1.5, -1, -10)),
    usda.prim("Xform", "second", meta=("instanceable = true", "references = </Library>"), at=(1.5, -1, -10)),
    usda.mesh("plain", [(-0.3, -1.3, -10), (0.3, -1.3, -10), (0.3, -0.7, -10), (-0.3, -0.7, -10)]))


def render(tmp_path, text, *arguments, scene_index, size=SIZE):
    """:returns: dict of channels, each (height, width), and the report of the host"""
    stage, image, report = tmp_path / "stage.usda", tmp_path / "image.exr", tmp_path / "report.json"
    stage.write_text(text)
    hydraBuild.run_host(stage, image, "--camera", "/camera", "--size", f"{size}x{size}", "--set", "samples=4",
                        "--json", report, *arguments, scene_index=scene_index)
    return inProcess.channels(image), json.loads(report.read_text())


def outputs(*names):
    return [word for name in names for word in ("--aov", name)]


@MODES
def test_depth_is_that_of_the_window(tmp_path, scene_index):
    channels, _ = render(tmp_path, STAGE, *outputs("depth", "cameraDepth"), scene_index=scene_index)
    z = 10.0
    window = 0.5 + 0.5 * ((FAR + NEAR) - 2.0 * FAR * NEAR / z) / (FAR - NEAR)
    assert channels["depth"] == pytest.approx(window, abs=1e-5)
    assert channels["cameraDepth"] == pytest.approx(z, rel=1e-5)


@MODES
def test_depth_where_nothing_is(tmp_path, scene_index):
    text = STAGE.replace("-20", "-2").replace("20", "2")
    channels, _ = render(tmp_path, text, *outputs("depth", "primId", "instanceId", "elementId"),
                         scene_index=scene_index)
    corner = {name: float(values[0, 0]) for name, values in channels.items()}
    assert corner == {"depth": 1.0, "primId": -1.0, "instanceId": -1.0, "elementId": -1.0}


@MODES
def test_normals_and_coordinates(tmp_path, scene_index):
    channels, _ = render(tmp_path, STAGE, *outputs("normal", "Neye", "primvars:st", "elementId"),
                         scene_index=scene_index)
    for name in ("normal", "Neye"):
        found = [channels[f"{name}.{axis}"] for axis in "xyz"]
        assert np.stack(found, -1).reshape(-1, 3) == pytest.approx(np.tile([0, 0, 1.0], (SIZE * SIZE, 1)), abs=1e-5)
    # At a depth of 10 the camera sees ten units of forty; within a pixel any place may be shown.
    middle = (np.arange(SIZE) + 0.5) / SIZE * 10.0 - 5.0
    s = np.tile((middle + 20.0) / 40.0, (SIZE, 1))
    pixel = 10.0 / SIZE / 40.0
    assert np.abs(channels["primvars:st.x"] - s).max() < pixel
    assert np.abs(channels["primvars:st.y"] - s.T[::-1]).max() < pixel
    half = SIZE // 2
    assert (channels["elementId"][:, :half - 1] == 0).all() and (channels["elementId"][:, half + 1:] == 1).all()


@MODES
def test_eye_normals_turn_with_the_camera(tmp_path, scene_index):
    turned = STAGE.replace('float verticalAperture = 50', 'float verticalAperture = 50\n    float xformOp:rotateY = 30\n'
                           '    uniform token[] xformOpOrder = ["xformOp:rotateY"]')
    channels, _ = render(tmp_path, turned, *outputs("normal", "Neye"), scene_index=scene_index)
    middle = SIZE // 2
    world = [channels[f"normal.{axis}"][middle, middle] for axis in "xyz"]
    eye = [channels[f"Neye.{axis}"][middle, middle] for axis in "xyz"]
    angle = math.radians(-30.0)
    assert world == pytest.approx([0.0, 0.0, 1.0], abs=1e-5)
    assert eye == pytest.approx([math.sin(angle), 0.0, math.cos(angle)], abs=1e-5)


def _at(x, y):
    """:returns: the pixel that shows a place of the orthographic view, 5 units wide"""
    return (int((x + 2.5) / 5.0 * 100), int((2.5 - y) / 5.0 * 100))


@MODES
def test_ids_are_those_of_prims_and_instances(tmp_path, scene_index):
    wanted = {  # place -> (path, outermost instancer, its instance)
        (-1.5, 1): ("/outer/inner/tile", "/outer", 0), (-0.9, 1): ("/outer/inner/tile", "/outer", 0),
        (0, 1): ("/outer/single", "/outer", 1),
        (1.5, 1): ("/outer/inner/tile", "/outer", 2), (2.1, 1): ("/outer/inner/tile", "/outer", 2),
        (-1.5, -1): ("/first/card", "", -1), (1.5, -1): ("/second/card", "", -1), (0, -1): ("/plain", "", -1)}
    picks = [word for place in wanted for word in ("--pick", "{},{}".format(*_at(*place)))]
    _, report = render(tmp_path, INSTANCES, *outputs("primId", "instanceId", "elementId"), *picks, size=100,
                       scene_index=scene_index)
    found = {place: (pick["path"], pick["instancer"], pick["index"])
             for place, pick in zip(wanted, report["picks"])}
    assert {place: hit[0] for place, hit in found.items()} == {place: hit[0] for place, hit in wanted.items()}
    for place, hit in wanted.items():
        if hit[1]:
            assert found[place] == hit, place
    # The two tiles of one inner instancer differ in their ids, and so do the two outer ones.
    ids = [pick["instanceId"] for pick in report["picks"]]
    assert len({ids[0], ids[1], ids[3], ids[4]}) == 4
    nothing = hydraBuild.run_host(tmp_path / "stage.usda", "--camera", "/camera", "--pick", "50,50", "--size",
                                  "100x100", *outputs("primId", "instanceId"), "--json", "-", scene_index=scene_index)
    assert json.loads(nothing.stdout)["picks"][0]["path"] == ""


@MODES
def test_light_paths_and_groups(tmp_path, scene_index):
    """Two suns, each of a light group, on a wall: each has its part of the colour."""
    suns = (usda.prim("DistantLight", "key", 'custom string inputs:ri:light:lightGroup = "key"', intensity=1.0, angle=0)
            + usda.prim("DistantLight", "fill", 'custom string primvars:lightGroup = "fill"', intensity=2.0, angle=0))
    names = ("color", "diffuse", "specular", "lpe:C.*<L.'key'>", "lpe:C.*<L.'fill'>")
    channels, _ = render(tmp_path, STAGE + suns, *outputs(*names), "--set", "samples=64", scene_index=scene_index)
    diffuse, specular, key, other = (channels[f"{name}.x"].mean() for name in names[1:])
    total = channels["R"].mean()
    assert total > 0.0 and diffuse + specular == pytest.approx(total, rel=1e-5)
    assert key + other == pytest.approx(total, rel=1e-5)
    assert key / total == pytest.approx(1.0 / 3.0, rel=0.05)  # 65536 choices between two lights: one standard error is 0.4 %
