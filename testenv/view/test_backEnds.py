"""The page beside Patina's rasterizer, at the same view and sample count. The light is such that both are done with few
samples, so that what differs are the materials and not the noise."""
import os

import numpy as np
import pytest

from patina.cli import compiled, imageMetrics, materials
from patina.view import compareImages, images, reference, shapes

DEMOS = os.path.join(os.path.dirname(__file__), "..", "..", "plugin", "patina", "view", "demos")
TEN = {"classic": ("lambert", "phong", "blinnPhong", "ward", "cookTorrance", "rust"),
       "layers": ("specular", "metal", "coat", "sheen")}
WIDTH, SAMPLES = 64, 64
LIGHTS = """#usda 1.0
def DistantLight "sun"
{
    float inputs:angle = 0
    float inputs:intensity = 1.2
    float3 xformOp:rotateXYZ = (-35, -40, 0)
    uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
}
def SphereLight "lamp"
{
    color3f inputs:color = (1, 0.7, 0.5)
    float inputs:intensity = 90
    float inputs:radius = 0.2
    bool treatAsPoint = 1
    double3 xformOp:translate = (3, 1, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def soft_sky():
    """An environment without edges, brighter above and on one side."""
    v, u = np.meshgrid((np.arange(32) + 0.5) / 32, (np.arange(64) + 0.5) / 64, indexing="ij")
    up, across = np.cos(np.pi * v), np.sin(np.pi * v) * np.cos(2.0 * np.pi * u)
    return (0.45 + 0.3 * up[..., None] * np.array([0.7, 0.9, 1.2])
            + 0.15 * across[..., None] * np.array([1.2, 1.0, 0.7])).astype(np.float32)


@pytest.mark.slow
def test_ten_materials_look_as_in_the_rasterizer(chromium, make, tmp_path):
    module = compiled.load()
    try:
        module.make_renderer("raster")
    except RuntimeError as error:
        pytest.skip(f"no rasterizer: {error}")
    lights, sky = str(tmp_path / "lights.usda"), str(tmp_path / "sky.exr")
    with open(lights, "w", encoding="utf-8") as file:
        file.write(LIGHTS)
    module.write_image(sky, soft_sky())
    found = {}
    for demo, names in TEN.items():
        file = os.path.join(DEMOS, demo + ".usda")
        chromium.open(make(f"ten-{demo}.html", file, "--stage", lights, "--environment", sky), f"?width={WIDTH}")
        data = chromium.evaluate("page.paused = true; const d = page.data; return { environment: d.environments[0], "
                                 "camera: d.camera, eye: d.start.eye, toWorld: d.shapes[0].toWorld, "
                                 "names: d.materials.map(m => m.name), lights: d.lights.length }")
        assert data["lights"] == 2
        environment = {**data["environment"], "pixels": images.unpacked(data["environment"])}
        networks = {name.rpartition("/")[2]: network for name, network in materials.load(file, every=True)[0]}
        for name in names:
            own = chromium.picture(f"page.choose({data['names'].index(name)}); page.state.samples = {SAMPLES}")
            # A sphere alone casts no shadow that its own back does not.
            drawn = reference.render(networks[name], shapes.sphere(64), data["toWorld"], environment, data["camera"],
                                     data["eye"], WIDTH, SAMPLES, "raster", compareImages.lit_scene(lights),
                                     enableShadows=False)
            found[name] = imageMetrics.mean_flip(images.display_values(own), images.display_values(drawn), False)
            print(name, found[name], float(own.mean() / drawn.mean() - 1.0))
        assert chromium.messages() == []
    if None in found.values():
        pytest.skip("flip-evaluator is not installed")
    assert len(found) == 10 and np.mean(list(found.values())) <= 0.02, found
    assert max(found.values()) <= 0.04, found
