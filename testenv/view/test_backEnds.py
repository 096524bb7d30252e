# SPDX-License-Identifier: Apache-2.0
"""The page beside Patina's rasterizer, at the same view and sample count. The light is such that both are done with few
samples, so that what differs are the materials and not the noise."""
import os

import numpy as np
import pytest

from patina.cli import compiled, imageMetrics, materials
from patina.view import compareImages, images, reference, shapes
from usda import prim, stage

DEMOS = os.path.join(os.path.dirname(__file__), "..", "..", "plugin", "patina", "view", "demos")
TEN = {"classic": ("lambert", "phong", "blinnPhong", "ward", "cookTorrance", "rust"),
       "layers": ("specular", "metal", "coat", "sheen")}
WIDTH, SAMPLES = 32, 64
HARD_ONES = ("lambert", "metal", "coat", "sheen")
ALL = {"soft": sum(TEN.values(), ()), "hard": HARD_ONES}
FEW = {"soft": ("coat",), "hard": ("metal",)}  # each takes ten seconds of OpenGL in software, and so does each demo
SOFT = stage(
    prim("DistantLight", "sun", angle=0, intensity=1.2, turn=(-35, -40, 0)),
    prim("SphereLight", "lamp", "color3f inputs:color = (1, 0.7, 0.5)", "bool treatAsPoint = 1", intensity=90, radius=0.2,
         at=(3, 1, 2)),
    up="")
# A low sun, a small lamp near by, a panel, and a bright window in a dark room.
HARD = stage(
    prim("DistantLight", "lowSun", angle=4, intensity=800, turn=(-35, -40, 0)),
    prim("SphereLight", "bulb", "color3f inputs:color = (1, 0.7, 0.5)", intensity=60, radius=0.15, at=(3, 1, 2)),
    prim("RectLight", "panel", intensity=8, width=1, height=2, at=(-2.5, 1.5, 1), turn=(-20, -70, 0)),
    up="")
CASES = {"soft": ("sun", "lamp"), "hard": ("lowSun", "bulb", "panel")}


def soft_sky():
    """An environment without edges, brighter above and on one side."""
    v, u = np.meshgrid((np.arange(32) + 0.5) / 32, (np.arange(64) + 0.5) / 64, indexing="ij")
    up, across = np.cos(np.pi * v), np.sin(np.pi * v) * np.cos(2.0 * np.pi * u)
    return (0.45 + 0.3 * up[..., None] * np.array([0.7, 0.9, 1.2])
            + 0.15 * across[..., None] * np.array([1.2, 1.0, 0.7])).astype(np.float32)


def hard_sky():
    sky = 0.2 * soft_sky()
    sky[8:13, 20:27] = 6.0
    return sky


def pictures(chromium, make, folder, wanted):
    """Yields (case, name, the page's picture, a way to draw it with a back end) for each material and case."""
    module = compiled.load()
    lights = {"soft": str(folder / "soft.usda"), "hard": str(folder / "hard.usda")}
    skies = {"soft": str(folder / "softSky.exr"), "hard": str(folder / "hardSky.exr")}
    for case, text, sky in (("soft", SOFT, soft_sky()), ("hard", HARD, hard_sky())):
        with open(lights[case], "w", encoding="utf-8") as file:
            file.write(text)
        module.write_image(skies[case], sky)
    both = folder / "both.usda"
    both.write_text("#usda 1.0\n(\n    subLayers = [@soft.usda@, @hard.usda@]\n)\n")
    for demo, names in TEN.items():
        if not {*names} & {name for of_case in wanted.values() for name in of_case}:
            continue
        file = os.path.join(DEMOS, demo + ".usda")
        chromium.open(make(f"ten-{demo}.html", file, "--stage", both, "--environment", skies["soft"], "--environment",
                           skies["hard"]), f"?width={WIDTH}")
        data = chromium.evaluate("page.paused = true; const d = page.data; return { environments: d.environments, "
                                 "camera: d.camera, eye: d.start.eye, toWorld: d.shapes[0].toWorld, "
                                 "names: d.materials.map(m => m.name), lights: d.lights.map(l => l.name) }")
        assert sorted(data["lights"]) == sorted(CASES["soft"] + CASES["hard"])
        networks = {name.rpartition("/")[2]: network for name, network in materials.load(file, every=True)[0]}
        for name in names:
            for case in (case for case in CASES if name in wanted[case]):
                at = list(CASES).index(case)
                on = [int(light in CASES[case]) for light in data["lights"]]
                own = chromium.picture(f"""page.choose({data["names"].index(name)}); page.state.samples = {SAMPLES};
                    page.state.environment = {at};
                    page.state.lights.forEach((l, i) => {{ l.on = Boolean({on}[i]); }})""")
                environment = {**data["environments"][at], "pixels": images.unpacked(data["environments"][at])}

                def drawn(backend, samples, network=networks[name], environment=environment, lit=lights[case]):
                    # A sphere alone casts no shadow that its own back does not.
                    return reference.render(network, shapes.sphere(64), data["toWorld"], environment, data["camera"],
                                            data["eye"], WIDTH, samples, backend, compareImages.lit_scene(lit),
                                            enableShadows=backend != "raster")

                yield case, name, own, drawn
        assert chromium.messages() == []


def flip(a, b):
    return imageMetrics.mean_flip(images.display_values(a), images.display_values(b), False)


@pytest.mark.slow
@pytest.mark.parametrize("wanted", [pytest.param(FEW, id="few"), pytest.param(ALL, id="all")])
def test_materials_look_as_in_the_rasterizer(wanted, chromium, make, tmp_path):
    try:
        compiled.load().make_renderer("raster")
    except RuntimeError as error:
        pytest.skip(f"no rasterizer: {error}")
    found, light = {}, {}
    for case, name, own, drawn in pictures(chromium, make, tmp_path, wanted):
        picture = drawn("raster", SAMPLES)
        found[case, name] = flip(own, picture)
        light[case, name] = float(own.mean() / picture.mean() - 1.0)
        print(case, name, found[case, name], light[case, name])
    if None in found.values():
        pytest.skip("flip-evaluator is not installed")
    assert len(found) == sum(map(len, wanted.values()))
    assert max(value for (case, _), value in found.items() if case == "soft") <= 0.02, found
    # Edges of light in the sky are where the rasterizer's few samples differ: the page is nearer to the path tracer.
    assert max(found.values()) <= 0.035, found
    assert max(map(abs, light.values())) <= 0.03, light
