# SPDX-License-Identifier: Apache-2.0
"""Every kind of direct light on the page beside the path tracer, one at a time. None stands before the
camera, which sees the path tracer's lights."""
import urllib.parse

import numpy as np
import pytest

from patina.cli import compiled, imageMetrics, materials
from patina.view import compareImages, images, reference, shapes
import usda

WIDTH = 40
STAGE = usda.stage(
    usda.material("plastic", {"surface": ("ND_standard_surface_surfaceshader", {
        "base_color": (0.5, 0.5, 0.5), "specular_roughness": 0.3})}),
    usda.prim("RectLight", "picture", "asset inputs:texture:file = @picture.exr@", intensity=6, width=3, height=2,
              at=(0.5, 1, 3), turn=(-20, 10, 30)),
    usda.prim("CylinderLight", "tube", intensity=20, length=2, radius=0.1, at=(-1, 2, 2), turn=(0, 0, 40)),
    usda.prim("SphereLight", "profile", "asset inputs:shaping:ies:file = @lamp.ies@", intensity=6, radius=0.2,
              apis=("ShapingAPI",), at=(-1.2, 2.2, 2.2), turn=(-45, -28, 0)),
    usda.prim("CylinderLight", "thread", intensity=10, length=2, radius=0, normalize=True, at=(1.5, 1.5, 1.5),
              turn=(0, 0, 70)),
    usda.mesh("panel", [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.7, 0), (-0.5, 0.5, 0.3)], "float inputs:intensity = 30",
              faces=[(0, 2, 1), (0, 3, 2)], apis=("MeshLightAPI",), at=(-3, 1.2, 1), turn=(0, -70, 15)),
    up="")
# Brighter to one side, and off its axis.
PROFILE = """IESNA:LM-63-1995
TILT=NONE
1 1000 1 4 3 1 2 0 0 0
1 1 1
0 30 60 90
0 90 180
10 14 3 0
10 8 2 0
10 3 1 0
"""
NAMES = ("panel", "picture", "profile", "thread", "tube")


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lights")
    (folder / "stage.usda").write_text(STAGE)
    (folder / "lamp.ies").write_text(PROFILE)
    picture = np.zeros((8, 12, 3), np.float32)
    picture[:4, :6], picture[4:, 6:], picture[:4, 6:] = (1.0, 0.1, 0.1), (0.1, 0.2, 1.0), (0.1, 0.1, 0.1)
    compiled.load().write_image(str(folder / "picture.exr"), picture)
    return str(folder / "stage.usda")


@pytest.mark.parametrize("wanted", [pytest.param(("profile",), id="one"), pytest.param(NAMES, id="all")])
def test_each_light_is_as_in_the_path_tracer(wanted, chromium, make, stage):
    chromium.open(make("lights.html", stage), f"?width={WIDTH}")
    data = chromium.evaluate("""page.paused = true; const d = page.data; page.state.samples = 96;
        page.state.environment = d.environments.findIndex(e => e.name === "none");
        return { camera: d.camera, eye: d.start.eye, toWorld: d.shapes[0].toWorld,
                 lights: d.lights.map(l => l.name), notes: d.notes };""")
    assert tuple(sorted(data["lights"])) == NAMES and data["notes"] == []
    network = materials.load(stage, every=True)[0][0][1]
    for i, name in ((i, name) for i, name in enumerate(data["lights"]) if name in wanted):
        own = chromium.picture(f"page.state.lights.forEach((l, i) => {{ l.on = i === {i}; }})")
        scene = compareImages.lit_scene(stage)
        with scene.edit() as edit:
            for path in (*scene.paths("lights"), *scene.paths("geometry")):
                if path.split("/")[1] != name:
                    edit.remove(path)
        traced = reference.render(network, shapes.sphere(64), data["toWorld"], None, data["camera"], data["eye"], WIDTH,
                                  256, "embree", scene)
        error = imageMetrics.mean_flip(images.display_values(own), images.display_values(traced), False)
        print(name, error, float(own.mean() / traced.mean() - 1.0))
        assert traced.mean() > 0.01 and own.mean() == pytest.approx(traced.mean(), rel=0.03), name
        assert error is None or error < 0.03, name
    assert chromium.messages() == []


def test_lights_that_cannot_be_shown_are_named(tmp_path, make, chromium, capsys):
    file = tmp_path / "lost.usda"
    file.write_text(STAGE.replace("@lamp.ies@", "@none.ies@").replace(
        "float inputs:length = 2", "float inputs:length = 0").replace("@picture.exr@", "@none.exr@"))
    chromium.open(make("lost.html", file), f"?width={WIDTH}")
    notes = " ".join(chromium.evaluate("return page.data.notes"))
    assert "/tube gives none" in notes and "/profile" in notes and "/picture" in notes
    assert "/tube gives none" in capsys.readouterr().err


def test_a_page_has_room_for_so_many_lights(tmp_path, make, chromium, capsys, monkeypatch):
    """The rest is left out with its number. Domes of one file read it once, and share its texture."""
    file, read = tmp_path / "many.usda", []
    compiled.load().write_image(str(tmp_path / "sky.exr"), np.full((4, 8, 3), 0.5, np.float32))
    domes = [f'def DomeLight "dome{i}"\n{{\n    asset inputs:texture:file = @sky.exr@\n}}\n' for i in range(40)]
    rects = [f'def RectLight "rect{i}"\n{{\n    double3 xformOp:translate = (0, 0, {3 + i})\n'
             '    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n' for i in range(300)]
    plain = usda.lobe("plain", "oren_nayar_diffuse_bsdf")
    file.write_text("#usda 1.0\n" + plain + "".join(domes + rects))
    latlong = images.latlong
    monkeypatch.setattr(images, "latlong", lambda path, largest: read.append(path) or latlong(path, largest))
    chromium.open(make("many.html", file), "?width=16#" + urllib.parse.quote('{"samples":4}'))
    assert len(read) == 1
    texts = ["44 more lights are left out: a page shows at most 256", "24 more domes are left out: a page shows at most 16"]
    told = capsys.readouterr().err
    assert all(text in told for text in texts)
    lights, notes, names, texels, shared = chromium.evaluate("""page.paused = true; const d = page.data, e = d.environments;
        const textures = viewer.parts.environments.map(x => x.texture);
        return [d.lights.length, d.notes, e.map(x => x.name), e.map(x => Boolean(x.data)), new Set(textures).size];""")
    assert lights == 256 and notes == texts and len(names) == 16 + 3 and shared == 1 + 3
    assert texels == [True] + 15 * [False] + 3 * [True]
    first, last = (chromium.picture(f"page.state.lights.forEach(l => {{ l.on = false; }}); "
                                    f"page.state.environment = {at}") for at in (0, 15))
    assert first.mean() > 0.05 and np.allclose(first, last, atol=1e-4) and chromium.messages() == []
    scene = compareImages.lit_scene(str(file))
    assert len(scene.paths("lights")) == 256
