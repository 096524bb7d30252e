# SPDX-License-Identifier: Apache-2.0
"""AOVs of what is seen against closed forms, in both back ends: geometric normals, texture coordinates, reference positions and
motion vectors; in other units, scaled, and far from the origin."""
import json

import numpy as np
import pytest

import inProcess
from rendering import record
import usda

SIZE, DISTANCE = 32, 8.0
PIXELS = SIZE / DISTANCE  # a unit across at that distance; the aperture is as wide as the focal length
WHERE = [dict(metersPerUnit=1), dict(metersPerUnit=0.01, unit=100.0), dict(metersPerUnit=1, far=1e5)]
places = pytest.mark.parametrize("where", WHERE, ids=["metres", "centimetres", "far"])
backends = pytest.mark.parametrize("backend", ["embree", "raster"])


def sheet(*lines, name="sheet", half=20.0, z=-DISTANCE, **values):
    """A sheet across the view."""
    return usda.card(name, half, *lines, z=z, **values)


def moved(points, unit=1.0):
    """:param points: dict of time code -> place, in units of the stage over `unit`"""
    return {time: tuple(float(x) * unit for x in place) for time, place in points.items()}


def stage_text(prims, *camera, far=0.0, unit=1.0, metersPerUnit=1.0, shutter=(0.0, 0.0), **values):
    """:param camera, values: lines and transforms of the camera"""
    times = [f"double shutter:{end} = {time}" for end, time in zip(("open", "close"), shutter)]
    shot = usda.camera(*camera, *times, lens=(50, 50, 50), clippingRange=(0.1 * unit, 1000 * unit), **values)
    return usda.stage(usda.prim("Xform", "world", shot, prims, at=(far, far, 0)), usda.prim("DistantLight", "sun"),
                      metersPerUnit=metersPerUnit, startTimeCode=5, endTimeCode=5)


def render(tmp_path, text, aovs, backend="embree", *arguments, samples=4):
    """:returns: dict of channel -> array, and the command's report"""
    inProcess.needs_opengl(backend)
    stage, image, report = tmp_path / "stage.usda", tmp_path / "image.exr", tmp_path / "report.json"
    stage.write_text(text)
    record(stage, image, "-w", SIZE, "--samples", samples, "--frames", 5, "--backend", backend, "--filterRadius", 0.5,
           f"--json={report}",
           *[a for aov in aovs for a in ("--aov", aov)], *arguments)
    return inProcess.channels(image), json.loads(report.read_text())


def vectors(channels, name, axes="XY"):
    return np.stack([channels[f"{name}.{axis}"] for axis in axes], -1)


def rounding(where):
    """Pixels by which a motion vector may be off: places of hits are floats of at most 64 views from the origin of their space
    (path tracer: seenOrigin.h), and some sixteen roundings of 2^-24 each lie on their way."""
    return 16 * 64 * SIZE * 2.0 ** -24


MOTION = ("motionForward", "motionBackward")
FASTER = {4: (0, 0, 0), 5: (0.25, 0.5, 0), 6: (1, 0, 0)}


@backends
@places
def test_a_camera_that_moves(tmp_path, backend, where):
    """It goes 0.5 to the right and 0.25 up a frame: the sheet goes left and down in the image."""
    unit = where.get("unit", 1.0)
    text = stage_text(sheet(scale=(unit,) * 3), at=moved({0: (-2.5, -1.25, 0), 10: (2.5, 1.25, 0)}, unit), **where)
    channels, _ = render(tmp_path, text, MOTION, backend)
    way = np.array([-0.5, 0.25]) * PIXELS
    assert vectors(channels, "motionForward") == pytest.approx(np.broadcast_to(way, (SIZE, SIZE, 2)), abs=rounding(where))
    assert vectors(channels, "motionBackward") == pytest.approx(np.broadcast_to(-way, (SIZE, SIZE, 2)), abs=rounding(where))


@backends
@places
def test_a_prim_that_gathers_speed(tmp_path, backend, where):
    """0, 1 and 4 quarters to the right at frames 4, 5 and 6; what is later is not what was earlier."""
    unit = where.get("unit", 1.0)
    faster = sheet(at=moved(FASTER, unit), scale=(unit,) * 3)
    channels, _ = render(tmp_path, stage_text(faster, **where), MOTION, backend)
    for name, way in (("motionForward", (0.75, 0.5)), ("motionBackward", (-0.25, 0.5))):
        expected = np.broadcast_to(np.array(way) * PIXELS, (SIZE, SIZE, 2))
        assert vectors(channels, name) == pytest.approx(expected, abs=rounding(where))


@backends
def test_what_comes_nearer_goes_outwards(tmp_path, backend):
    """From distance 8 to 7: a place at x pixels from the middle goes to 8/7 x. Within half a pixel of the centre any may be
    shown, whose way differs by a fourteenth."""
    channels, _ = render(tmp_path, stage_text(sheet(at={5: (0, 0, 0), 6: (0, 0, 1)})), MOTION, backend)
    from_middle = np.arange(SIZE) + 0.5 - SIZE / 2
    x, y = np.meshgrid(from_middle, from_middle)
    assert np.abs(vectors(channels, "motionForward") - np.stack([x, y], -1) / 7).max() < 0.5 / 7 + rounding({})
    assert np.abs(vectors(channels, "motionBackward")).max() < rounding({})


@backends
def test_instances_inside_of_instances(tmp_path, backend):
    """The outer instancer goes right, the inner one up, and the sheet back to the left: 1, 0.5 and -0.25 a frame."""
    def instancer(name, prototype, x, y, held):
        return usda.prim("PointInstancer", name, f"rel prototypes = </world/outer/{prototype}>", held, protoIndices=[0],
                         positions={4: [(x, y, 0)], 6: [(-x, -y, 0)]})

    inner = instancer("inner", "inner/sheet", 0, -0.5, sheet(at={4: (0.25, 0, 0), 6: (-0.25, 0, 0)}))
    outer = instancer("outer", "inner", -1, 0, inner)
    channels, _ = render(tmp_path, stage_text(outer), MOTION, backend)
    expected = np.broadcast_to(np.array([0.75, -0.5]) * PIXELS, (SIZE, SIZE, 2))
    assert vectors(channels, "motionForward") == pytest.approx(expected, abs=rounding({}))
    assert vectors(channels, "motionBackward") == pytest.approx(-expected, abs=rounding({}))


def deforming(name="sheet", z=-DISTANCE, scheme="none"):
    """2 to the right in the next frame; nothing before."""
    points = {time: [(x - 20, -20, z), (x + 20, -20, z), (x + 20, 20, z), (x - 20, 20, z)] for time, x in ((5, 0), (6, 2))}
    return usda.prim("Mesh", name, points=points, faceVertexCounts=[4], faceVertexIndices=[0, 1, 2, 3],
                     subdivisionScheme=scheme)


@pytest.mark.parametrize("scheme", ["none", "catmullClark"])
def test_points_that_move(tmp_path, scheme):
    channels, _ = render(tmp_path, stage_text(deforming(scheme=scheme)), MOTION)
    assert vectors(channels, "motionForward") == pytest.approx(
        np.broadcast_to(np.array([2.0, 0.0]) * PIXELS, (SIZE, SIZE, 2)), abs=rounding({}))
    assert np.abs(vectors(channels, "motionBackward")).max() < rounding({})


@pytest.mark.parametrize("kind", ["curves", "points"])
def test_curves_and_points_that_move(tmp_path, kind):
    if kind == "points":
        text = usda.prim("Points", "balls", points={5: [(0, 0, -8)], 6: [(0.5, 0, -8)]}, widths=[4])
    else:
        text = usda.prim("BasisCurves", "fibres", type="linear", curveVertexCounts=[2], widths=[4, 4],
                         points={5: [(0, -9, -8), (0, 9, -8)], 6: [(0.5, -9, -8), (0.5, 9, -8)]})
    channels, _ = render(tmp_path, stage_text(text), MOTION)
    middle = (SIZE // 2, SIZE // 2)
    assert vectors(channels, "motionForward")[middle] == pytest.approx((0.5 * PIXELS, 0), abs=rounding({}))


def test_the_rasterizer_says_that_it_does_not_follow_points(tmp_path):
    channels, report = render(tmp_path, stage_text(deforming()), MOTION, "raster")
    assert np.abs(vectors(channels, "motionForward")).max() < rounding({})
    assert [w["prim"] for w in report["warnings"] if w["id"] == "motionOfPointsLeftOut"] == ["/world/sheet"]


def test_a_film_that_is_no_plane(tmp_path):
    text = stage_text(sheet(at={4: (0, 0, 0), 6: (1, 0, 0)}), 'token patina:projection = "spherical"')
    channels, report = render(tmp_path, text, MOTION)
    assert not vectors(channels, "motionForward").any()
    assert [w["id"] for w in report["warnings"]] == ["motionAovsEmpty"]


@backends
@pytest.mark.parametrize("shutter", [(0.0, 0.5), (-0.25, 0.25), (0.0, 0.0)])
def test_without_blur_prims_are_where_the_frame_has_them(tmp_path, backend, shutter):
    """A card whose left edge crosses the view: it turns about the view's axis, which interpolated matrices do not."""
    text, still = (stage_text(sheet(half=3.0, turn=turn), shutter=shutter)
                   for turn in ({0: (0, 0, 0), 10: (0, 0, 90)}, (0, 0, 45)))
    found, _ = render(tmp_path, text, ("position", *MOTION), backend, "--disableMotionBlur")
    expected, _ = render(tmp_path, still, ("position",), backend, "--disableMotionBlur")
    for channel, values in expected.items():
        # The planes of one stage are interpolated between neighbours, those of the other are not: their bits may differ.
        assert np.abs(found[channel] - values).max() < 1e-5, channel
    # 9 degrees a frame, of a place that turns by them: the mean over a symmetric card is 0, its length the sine's.
    seen = found["A"] == 1
    way, place = vectors(found, "motionForward")[seen], vectors(found, "position")[seen]
    turn = np.radians(9.0)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    moved = (place @ rotation.T - place) * PIXELS * (1, -1)
    assert np.abs(way - moved).max() < 1e-3


@backends
def test_asking_for_motion_changes_no_picture(tmp_path, backend):
    text = stage_text(sheet(half=3.0, at=FASTER) + deforming("back", z=-12), shutter=(-0.25, 0.25))
    alone, _ = render(tmp_path, text, (), backend)
    beside, _ = render(tmp_path, text, MOTION, backend)
    for channel in "RGBA":
        assert np.array_equal(alone[channel], beside[channel]), channel


def test_a_product_without_blur(tmp_path):
    """The prim's own flag of UsdRender, and its name for the vectors."""
    from rendering import patina

    settings = usda.prim("Scope", "Render",
        usda.prim("RenderSettings", "main", "rel camera = </world/camera>", "rel products = </Render/product>",
                  "bool disableMotionBlur = 1", resolution=(32, 32)),
        usda.prim("RenderProduct", "product",
                  "rel orderedVars = [</Render/ahead>, </Render/flat>, </Render/place>, </Render/st>, </Render/P>]",
                  productName="product.exr"),
        usda.prim("RenderVar", "ahead", dataType="float2", sourceName="motionFore"),
        usda.prim("RenderVar", "flat", dataType="normal3f", sourceName="Ngn"),
        usda.prim("RenderVar", "place", dataType="point3f", sourceName="__Pref"),
        usda.prim("RenderVar", "st", dataType="texCoord2f", sourceName="st"),
        usda.prim("RenderVar", "P", sourceName="P"))
    (tmp_path / "stage.usda").write_text(
        stage_text(sheet(at={0: (-5, 0, 0), 10: (5, 0, 0)}), shutter=(0.5, 0.75)) + settings)
    patina("record", tmp_path / "stage.usda", "--settings", "/Render/main", "--outputFolder", tmp_path, "--frames", 5,
           "--samples", 4, "--quiet")
    channels = inProcess.channels(tmp_path / "product.exr")
    assert {name.split(".")[0] for name in channels} == {"motionForward", "Ng", "Pref", "uv", "position"}
    assert vectors(channels, "motionForward") == pytest.approx(
        np.broadcast_to((PIXELS, 0.0), (SIZE, SIZE, 2)), abs=rounding({}))
    # At frame 5 the sheet stands in the middle, so that places in the world are those in its own space.
    assert vectors(channels, "Pref", "XYZ") == pytest.approx(vectors(channels, "position", "XYZ"), abs=1e-5)


@backends
@places
def test_geometric_normal_of_a_tilted_sheet(tmp_path, backend, where):
    """The authored normals point elsewhere: they are the shading normal alone."""
    unit = where.get("unit", 1.0)
    normals = f'normal3f[] normals = {[(0.6, 0, 0.8)] * 4} (interpolation = "vertex")'
    tilted = sheet(normals, z=0.0, half=40.0, at=(0, 0, -DISTANCE * unit), rotateX=30, scale=(unit, 2 * unit, unit))
    channels, _ = render(tmp_path, stage_text(tilted, **where), ("Ng", "normal"), backend)
    expected = np.broadcast_to((0.0, -0.5, np.sqrt(0.75)), (SIZE, SIZE, 3))
    assert vectors(channels, "Ng", "XYZ") == pytest.approx(expected, abs=1e-5)
    # (0.6, 0, 0.8) turned by 30 degrees about x
    expected = np.broadcast_to((0.6, -0.4, 0.8 * np.sqrt(0.75)), (SIZE, SIZE, 3))
    assert vectors(channels, "normal", "XYZ") == pytest.approx(expected, abs=1e-5)


@backends
def test_texture_coordinates(tmp_path, backend):
    """(x + 4) / 8 over the view; a prim without them has zeros."""
    channels, _ = render(tmp_path, stage_text(sheet(half=4.0, st=usda.ST)), ("uv", "primvars:st", "Ng", "Pref"), backend)
    across = (np.arange(SIZE) + 0.5) / SIZE
    s, t = np.meshgrid(across, across[::-1])
    found = vectors(channels, "uv", "UV")
    assert np.abs(found - np.stack([s, t], -1)).max() <= 0.5 / SIZE + 1e-6  # any place of a pixel may be shown
    assert np.array_equal(found, vectors(channels, "primvars:st"))
    without, _ = render(tmp_path, stage_text(sheet()), ("uv",), backend)
    assert not vectors(without, "uv", "UV").any()


@backends
@places
@pytest.mark.parametrize("scheme", ["none", "catmullClark", "loop"])
def test_reference_position(tmp_path, backend, where, scheme):
    """A mesh that a deformer has moved by (5, 0, 0): its Pref follows the same surface, at every level of subdivision. Both are
    sums of the same corners with the same weights, so that roundings alone part them."""
    unit = where.get("unit", 1.0)
    grid = np.array([(x, y, -DISTANCE + 0.3 * np.sin(2 * x + y)) for y in range(-5, 6) for x in range(-5, 6)]) * unit
    faces = [(r * 11 + c, r * 11 + c + 1, r * 11 + c + 12, r * 11 + c + 11) for r in range(10) for c in range(10)]
    if scheme == "loop":
        faces = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    rest, bent = (list(map(tuple, (grid + move).tolist())) for move in (0, (5 * unit, 0, 0)))
    prim = usda.mesh("cloth", bent, f'point3f[] primvars:Pref = {rest} (interpolation = "vertex")', faces=faces, scheme=scheme,
                     at=(-5 * unit, 0, 0))
    channels, _ = render(tmp_path, stage_text(prim, **where), ("Pref", "position"), backend)
    seen = channels["A"] == 1
    found = vectors(channels, "Pref", "XYZ")[seen]
    world = vectors(channels, "position", "XYZ")[seen] - np.array([1, 1, 0]) * where.get("far", 0.0)
    # Positions in the file are floats of the world; sums over up to 16 corners within 10 units of the origin, twice.
    bound = 2.0 ** -23 * where.get("far", 0.0) + 32 * 10 * unit * 2.0 ** -24
    assert np.abs(found - world).max() < bound


@backends
def test_reference_position_without_the_primvar(tmp_path, backend):
    """The place in the prim's own space; and where it is asked for by the primvar's name, nothing."""
    text = stage_text(sheet(at=(1, 2, 0), scale=(2, 2, 1)))
    channels, _ = render(tmp_path, text, ("Pref", "position", "primvars:Pref"), backend)
    own = (vectors(channels, "position", "XYZ") - (1, 2, 0)) / (2, 2, 1)
    assert vectors(channels, "Pref", "XYZ") == pytest.approx(own, abs=1e-5)
    assert not vectors(channels, "primvars:Pref", "XYZ").any()


@backends
def test_equal_spheres_that_share_their_triangles(tmp_path, backend):
    """Twenty of them, each with ways of its own: to the right before the frame, up after it."""
    places_ = [((i % 5 - 2) * 1.5, (i // 5 - 1.5) * 1.5) for i in range(20)]
    prims = "".join(usda.prim("Sphere", f"s{i:02d}", radius=0.7, at={
        4: (x - 0.1 * i, y, -8), 5: (x, y, -8), 6: (x, y + 0.05 * i, -8)}) for i, (x, y) in enumerate(places_))
    channels, _ = render(tmp_path, stage_text(prims), ("Pref", "position", "primId", *MOTION), backend)
    for i, (x, y) in enumerate(places_):
        seen = channels["primId"] == i
        place = vectors(channels, "position", "XYZ")[seen]
        assert len(place) > 4
        assert vectors(channels, "Pref", "XYZ")[seen] == pytest.approx(place - (x, y, -8), abs=rounding({}) / PIXELS)
        pixels = SIZE / -place[:, 2:]
        assert vectors(channels, "motionForward")[seen] == pytest.approx(pixels * (0, -0.05 * i), abs=rounding({}))
        assert vectors(channels, "motionBackward")[seen] == pytest.approx(pixels * (-0.1 * i, 0), abs=rounding({}))


def test_the_rasterizer_has_targets_for_three_primvars_beside_the_normal(tmp_path):
    values = [f"float3 primvars:{name} = (0.25, 0.5, 0.75)" for name in "abcd"]
    aovs = ("Ng", *(f"primvars:{name}" for name in "abcd"))
    channels, report = render(tmp_path, stage_text(sheet(*values)), aovs, "raster")
    for name in "abc":
        assert vectors(channels, f"primvars:{name}", "XYZ") == pytest.approx(
            np.broadcast_to((0.25, 0.5, 0.75), (SIZE, SIZE, 3)), abs=1e-6)
    assert vectors(channels, "Ng", "XYZ") == pytest.approx(np.broadcast_to((0.0, 0.0, 1.0), (SIZE, SIZE, 3)), abs=1e-6)
    assert [(w["id"], w["fields"]["name"]) for w in report["warnings"]] == [("primvarAovEmpty", "d")]
