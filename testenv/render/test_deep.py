# SPDX-License-Identifier: Apache-2.0
"""Deep images, read back by OpenImageIO: put over each other, their samples are the flat image; they lie where things are."""
import json

import numpy as np
import pytest

import _patina
import inProcess
from rendering import patina, record, scene, shot
import usda

# Surfaces, visible lights, domes, presence, media in glass, a volume, catchers with alpha between 0 and 1, motion, lenses.
SCENES = ["diffuseBox", "lightRect", "lightDome", "hair", "media", "volume", "catchers", "motionBlur", "depthOfField"]
HEAD = usda.stage(
    usda.camera(flat=(80, 40), at=(0, 0, 10)),
    usda.prim("DistantLight", "sun"),
    usda.preview("half", opacity=0.5, **{"token opacityMode": "presence"}))


def quad(name, left, right, z, material=""):
    binding = f"rel material:binding = </{material}>" if material else ""
    return usda.mesh(name, [(left, -9, z), (right, -9, z), (right, 9, z), (left, 9, z)], binding,
                     apis=("MaterialBindingAPI",))


def flat(path):
    """:returns: float array (height, width, 4) of R, G, B, A; of a deep image as OpenImageIO flattens it"""
    return inProcess.pixels(path, "RGBA").astype(np.float64)


def samples_of(path, x, y):
    """:returns: list of dicts of channel -> value, in the file's order"""
    channels, counts, values = _patina.read_deep(str(path))
    flat_counts = counts.ravel()
    first = flat_counts[:y * counts.shape[1] + x].sum()
    return [dict(zip(channels, map(float, values[first + i]))) for i in range(counts[y, x])]


def bound_of(deep, beauty):
    """Where n samples are put over each other, each was stored with three roundings, and takes two more: of floats, 2^-24 of
    the value each. OpenImageIO sums what is left of alpha, too: as many again."""
    _, counts, _ = _patina.read_deep(str(deep))
    return 10.0 * (counts[..., None] + 1) * 2.0 ** -24 * np.maximum(np.abs(beauty), 1.0)


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("most", [64, 4])
def test_flattened_it_is_the_beauty(tmp_path, name, most):
    image, deep = tmp_path / "image.exr", tmp_path / "deep.exr"
    record(scene(name), image, "-w", 48, "--samples", 16, "--deep", deep, "--deepSamples", most)
    beauty, found = flat(image), flat(deep)
    assert beauty[..., :3].max() > 0.0
    assert (np.abs(found - beauty) <= bound_of(deep, beauty)).all(), np.abs(found - beauty).max()
    channels, counts, values = _patina.read_deep(str(deep))
    assert counts.max() <= most and sorted(channels) == sorted(["R", "G", "B", "A", "Z", "ZBack"])
    front, back = (values[:, channels.index(c)] for c in ("Z", "ZBack"))
    ends = np.cumsum(counts.ravel())
    same_pixel = np.ones(len(front), bool)
    same_pixel[ends[ends < len(front)]] = False
    assert (front <= back).all() and (front[1:] >= back[:-1])[same_pixel[1:]].all()  # tidy: sorted, without overlap


def test_asking_for_it_changes_no_bit(tmp_path):
    for name, more in (("alone", ()), ("beside", ("--deep", tmp_path / "deep.exr"))):
        record(scene("media"), tmp_path / f"{name}.exr", "-w", 32, "--samples", 8, *more)
    assert np.array_equal(flat(tmp_path / "alone.exr"), flat(tmp_path / "beside.exr"))


def test_samples_of_coverage_and_presence(tmp_path):
    """A sheet of presence one half, 6 away, over the left half of the image and half of a pixel; a wall 8 away behind all."""
    deep = tmp_path / "deep.exr"
    text = HEAD + quad("sheet", -9, 0.5, 4, "half") + quad("wall", -9, 9, 2)
    shot(tmp_path, text, "-w", 8, "--samples", 256, "--filterRadius", 0.5, "--deep", deep)
    left, edge, right = (samples_of(deep, x, 2) for x in (1, 4, 6))
    assert [round(s["Z"], 4) for s in left] == [6, 8] and [round(s["Z"], 4) for s in right] == [8]
    # Fair coins, 256 of them: 4.5 deviations of 1/32 (by chance in 1 of 147000 seeds, and the seed is fixed).
    assert left[0]["A"] == pytest.approx(0.5, abs=4.5 / 32)
    assert edge[0]["A"] == pytest.approx(0.25, abs=4.5 * np.sqrt(3) / 64)
    assert left[1]["A"] == edge[1]["A"] == right[0]["A"] == 1.0  # nothing is seen past the wall
    assert all(s["Z"] == s["ZBack"] for s in left + edge + right)


def test_samples_of_a_volume_fill_it(tmp_path):
    """Its samples lie within its own depths, and have a thickness where several collisions are one."""
    image, deep = tmp_path / "image.exr", tmp_path / "deep.exr"
    record(scene("volume"), image, "-w", 32, "--samples", 64, "--deep", deep, "--deepSamples", 8, "--aov", "depth")
    channels, counts, values = _patina.read_deep(str(deep))
    thick = values[:, channels.index("ZBack")] > values[:, channels.index("Z")]
    assert thick.any()
    assert counts.max() > 1


def test_products_of_type_deep_raster(tmp_path):
    render = usda.prim("Scope", "Render",
        usda.prim("RenderSettings", "main", "rel camera = </camera>", "rel products = [</Render/flat>, </Render/deep>]",
                  resolution=(8, 4)),
        usda.prim("RenderProduct", "flat", productName="flat.exr"),
        usda.prim("RenderProduct", "deep", 'token productType = "deepRaster"',
                  "rel orderedVars = [</Render/ci>, </Render/normal>]", productName="deep.exr"),
        usda.prim("RenderVar", "ci", sourceName="Ci"),
        usda.prim("RenderVar", "normal", sourceName="N"))
    stage, report = tmp_path / "stage.usda", tmp_path / "report.json"
    stage.write_text(HEAD + quad("sheet", -9, 0.5, 4, "half") + quad("wall", -9, 9, 2) + render)
    patina("record", stage, "--settings", "/Render/main", "--outputFolder", tmp_path, "--samples", 16, "--quiet",
           f"--json={report}")
    beauty = flat(tmp_path / "flat.exr")
    assert (np.abs(flat(tmp_path / "deep.exr") - beauty) <= bound_of(tmp_path / "deep.exr", beauty)).all()
    with open(report, encoding="utf-8") as file:
        assert [w["id"] for w in json.load(file)["warnings"]] == ["deepVarLeftOut"]


def test_the_rasterizer_says_that_it_has_none(tmp_path):
    inProcess.needs_opengl("raster")
    report = tmp_path / "report.json"
    record(scene("diffuseBox"), tmp_path / "image.exr", "-w", 16, "--samples", 1, "--backend", "raster", "--deep",
           tmp_path / "deep.exr", f"--json={report}")
    assert not (tmp_path / "deep.exr").exists() and (tmp_path / "image.exr").exists()
    with open(report, encoding="utf-8") as file:
        assert [w["id"] for w in json.load(file)["warnings"]] == ["deepLeftOut"]


@pytest.mark.parametrize("arguments,words", [
    (("--deep", "deep.png"), "deep images are OpenEXR"),
    (("--deep", "deep.exr", "--resume"), "a checkpoint has no depths"),
    (("--deep", "deep.exr", "--part", "1/2", "--partial", "one.part"), "has no depths"),
])
def test_what_does_not_go_together(tmp_path, arguments, words):
    end = record(scene("diffuseBox"), tmp_path / "image.exr", *arguments, check=False)
    assert end.returncode and words in end.stderr


def test_frames_of_a_sequence(tmp_path):
    image = tmp_path / "image.##.exr"
    record(scene("diffuseBox"), image, "-w", 8, "--samples", 1, "--frames", "1:2", "--deep", tmp_path / "deep.##.exr")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["deep.01.exr", "deep.02.exr", "image.01.exr", "image.02.exr"]
    end = record(scene("diffuseBox"), image, "--frames", "1:2", "--deep", tmp_path / "deep.exr", check=False)
    assert end.returncode == 2 and "has no place for the frame" in end.stderr
