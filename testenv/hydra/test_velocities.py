# SPDX-License-Identifier: Apache-2.0
"""What velocities move through the shutter, and to a frame that lies between samples: by scene indices since OpenUSD 25.08."""
import pytest

import hydraBuild
import stages
from test_oneTruth import compare, rel_mse, render_with_hydra, render_with_reader

SHUTTER = """    double shutter:open = @open@
    double shutter:close = @close@
}
def DomeLight"""
TILE = """int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
"""
CORNERS = "[(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]"
TWO = "[(-2, 0, 0), (2, 0, 0)]"
# name -> (type, the rest of the prim, name of what moves, its value, velocities)
PRIMS = {
    "mesh": ("Mesh", TILE, "points", CORNERS, "[(24, 0, 0), (24, 0, 0), (48, 0, 0), (48, 0, 0)]"),
    "points": ("Points", "float[] widths = [0.5]", "points", TWO, "[(0, 30, 0), (0, -50, 0)]"),
    "curves": ("BasisCurves", """float[] widths = [0.5]
    int[] curveVertexCounts = [2]
    uniform token type = "linear\"""", "points", TWO, "[(0, 30, 0), (0, -50, 0)]"),
    "instances": ("PointInstancer", f"""rel prototypes = [</prim/tile>]
    int[] protoIndices = [0, 0]
    def Mesh "tile" {{ {TILE} point3f[] points = {CORNERS}
    }}""", "positions", TWO, "[(0, 30, 0), (0, -50, 0)]")}


@pytest.fixture(autouse=True)
def _new_enough():
    hydraBuild.skip_before(2508, "Hydra's scene index of velocities does not know the time codes per second")


def sampled(kind, name, value):
    """:returns: an attribute with the same value at two times"""
    return f"    {kind}[] {name}.timeSamples = {{ 0: {value}, 6: {value} }}\n"


def shot_of(tmp_path, prim, shutter, frame, more=""):
    kind, rest, moved, value, velocities = PRIMS[prim]
    head = f'def {kind} "prim" (prepend apiSchemas = ["MotionAPI"]) {{ {rest}'
    text = stages.front(8, 8).replace("}\ndef DomeLight", SHUTTER.replace("@open@", str(shutter[0]))
                                      .replace("@close@", str(shutter[1])))
    text = text.replace("#usda 1.0\n", f"#usda 1.0\n(startTimeCode = {frame})\n")
    tmp_path.mkdir(exist_ok=True)
    path = tmp_path / "moved.usda"
    path.write_text(text + head + "\n" + sampled("point3f", moved, value) + sampled("vector3f", "velocities", velocities)
                    + more + "}\n")
    return stages.Shot(str(path), tmp_path)


@pytest.mark.parametrize("shutter, frame", [((-0.5, 0.5), 0), ((0.0, 0.0), 0.75), ((0.0, 0.5), 2)])
@pytest.mark.parametrize("prim", PRIMS)
def test_hosts_agree(tmp_path, prim, shutter, frame):
    shot = shot_of(tmp_path, prim, shutter, frame)
    image, _ = render_with_hydra(shot, tmp_path, True)
    assert 0 < (image[..., 0] < 0.9).sum() < image[..., 0].size / 2
    compare(shot, image, True, 1e-4, "times of samples are rounded otherwise")


@pytest.mark.parametrize("prim, name, value", [
    ("mesh", "accelerations", "[(0, 6000, 0), (0, 6000, 0), (0, 0, 0), (0, 0, 0)]"),
    ("instances", "accelerations", "[(6000, 0, 0), (0, 0, 0)]"),
    ("instances", "angularVelocities", "[(0, 0, 2160), (0, 0, 0)]")])
def test_hosts_agree_where_the_way_is_bent(tmp_path, prim, name, value):
    orientations = sampled("quath", "orientations", "[(1, 0, 0, 0), (1, 0, 0, 0)]") if prim == "instances" else ""
    # Hydra is told of the count of instancers since OpenUSD 26.08; before, and without one, it is 3.
    told = prim == "mesh" or int(hydraBuild.folder("version")) >= 2608
    count = "    int motion:nonlinearSampleCount = 5\n" if told else ""
    shot = shot_of(tmp_path, prim, (-0.5, 0.5), 0, orientations + count + sampled("vector3f", name, value))
    straight = shot_of(tmp_path / "straight", prim, (-0.5, 0.5), 0, orientations)
    image, _ = render_with_hydra(shot, tmp_path, True)
    compare(shot, image, True, 1e-4, "times of samples are rounded otherwise")
    assert rel_mse(render_with_reader(straight), image) > 1e-3
