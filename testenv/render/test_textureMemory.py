# SPDX-License-Identifier: Apache-2.0
"""Textures beyond memory: the same bits, whatever --textureMemory is, within it."""
import json
import os
import shutil
import subprocess

import numpy as np
import pytest

import tiledTiff
from rendering import color, patina, record
import usda

MIB = 1 << 20
SMALL = ("--imageWidth", 48, "--imageHeight", 32, "--samples", 4, "--threads", 2)


def stage(folder, files, repeats=1):
    """Quads that glow as textures do, beside each other and tilted, so that all levels are seen. :returns: its path"""
    prims = []
    for i, file in enumerate(files):
        x = i - 0.5 * len(files)
        prims.append((
            usda.mesh(f"q{i}", [(x, -0.8, 1), (x + 0.95, -0.8, 1), (x + 0.95, 1.2, -9), (x, 1.2, -9)],
                      f'texCoord2f[] primvars:st = [(0, 0), ({repeats}, 0), ({repeats}, {repeats}), (0, {repeats})] '
                      f'(interpolation = "vertex")',
                      scheme="", bind=f"m{i}")
            + usda.material(f"m{i}", {
                            "s": ("UsdPreviewSurface", {"color3f emissiveColor": "<t>", "diffuseColor": (0, 0, 0)}),
                            "t": ("UsdUVTexture",
                                  {"file": file, "token wrapS": "repeat", "token wrapT": "mirror", "float2 st": "<p>"}),
                            "p": ("UsdPrimvarReader_float2", {"varname": "st"})},
                            surface="s")))
    path = os.path.join(folder, "stage.usda")
    with open(path, "w", encoding="utf-8") as text:
        text.write(usda.stage(
            usda.camera(lens=(40 / len(files) ** 0.5, 36, 24), clippingRange=(0.01, 100), at=(0, 0, 3)),
            up="") + "\n".join(prims) + "\n")
    return path


def render(path, image, *arguments):
    """:returns: pixels, the frame's statistics"""
    numbers = str(image) + ".json"
    record(path, image, *SMALL, *arguments, f"--json={numbers}")
    with open(numbers, encoding="utf-8") as file:
        return color(image), json.load(file)["frames"][0]


@pytest.mark.parametrize("levels", [True, False])
def test_ten_times_the_memory_shows_the_same_bits_within_it(levels, tmp_path):
    texels = 0
    for i in range(4):
        texels += tiledTiff.write(tmp_path / f"{i}.tif", 1024, seed=i, levels=levels)
    path = stage(tmp_path, [f"{i}.tif" for i in range(4)], repeats=2)
    whole, facts = render(path, tmp_path / "whole.exr")
    assert facts["textureBytes"] >= texels and "textureTileBytes" not in facts
    tiled, facts = render(path, tmp_path / "tiled.exr", "--textureMemory", "1MiB")
    assert texels >= 10 * MIB
    assert 0 < facts["textureTilePeakBytes"] <= facts["textureTileCapacity"] <= MIB
    assert np.ptp(whole) > 0.1 and np.array_equal(whole, tiled)
    plenty, facts = render(path, tmp_path / "plenty.exr", "--textureMemory", "1TiB")
    assert "textureTileBytes" not in facts and np.array_equal(whole, plenty)


def test_the_setting_of_a_stage(tmp_path):
    tiledTiff.write(tmp_path / "0.tif", 1024)
    path = stage(tmp_path, ["0.tif"])
    with open(path, "a", encoding="utf-8") as text:
        text.write("""
def RenderSettings "few" { double patina:textureMemory = 1 }
def RenderSettings "less" { double patina:textureMemory = -3 }
""".replace("{ ", "{\n    ").replace(" }", "\n}"))
    _, facts = render(path, tmp_path / "a.exr", "--settings", "/few")
    assert 0 < facts["textureTileCapacity"] <= MIB
    told = patina("record", path, tmp_path / "b.exr", *SMALL, "--settings", "/less").stderr
    assert "patina:textureMemory" in told and "/less" in told
    _, facts = render(path, tmp_path / "c.exr", "--settings", "/few", "--textureMemory", "1GiB")
    assert "textureTileCapacity" not in facts


def test_gigabytes_of_texels_in_a_few_megabytes(tmp_path):
    """Each file alone is larger than what is read whole."""
    texels = tiledTiff.write(tmp_path / "0.tif", 65536)
    for i in range(1, 8):
        os.link(tmp_path / "0.tif", tmp_path / f"{i}.tif")
    assert 8 * texels > 100e9
    path = stage(tmp_path, [f"{i}.tif" for i in range(8)])
    _, facts = render(path, tmp_path / "a.exr", "--textureMemory", "64MiB")
    assert facts["textureTilePeakBytes"] <= facts["textureTileCapacity"] <= 64 * MIB
    assert color(tmp_path / "a.exr").max() > 0.1
    refused = patina("record", path, tmp_path / "b.exr", *SMALL)
    assert "takes more bytes than" in refused.stderr and "--textureMemory" in refused.stderr


@pytest.mark.skipif(not shutil.which("maketx"), reason="maketx is not installed")
def test_files_of_maketx(tmp_path):
    tiledTiff.write(tmp_path / "plain.tif", 1024, levels=False)
    subprocess.run(["maketx", tmp_path / "plain.tif", "-o", tmp_path / "made.tx"], check=True)
    path = stage(tmp_path, ["made.tx"])
    whole, _ = render(path, tmp_path / "whole.exr")
    tiled, facts = render(path, tmp_path / "tiled.exr", "--textureMemory", "1MiB")
    assert facts["textureTilesMade"] > 0 and np.array_equal(whole, tiled)


@pytest.mark.parametrize("value", ["0", "-1", "much", "4 parsecs", "0.5MiB", "nan", "inf", "1e400", "GiB", ""])
def test_sizes_that_are_none(value, tmp_path):
    wrong = patina("record", "a.usda", "b.png", f"--textureMemory={value}", check=False)
    assert wrong.returncode == 2 and "size (1 MiB or more" in wrong.stderr


@pytest.mark.parametrize("value, mebibytes", [("500", 500), ("500MiB", 500), ("4GiB", 4096), ("1.5 gib", 1536),
                                              ("2TiB", 2 << 20), ("1GB", 1e9 / MIB)])
def test_sizes(value, mebibytes):
    from patina.cli import settingFlags

    parse = settingFlags._size_parser(settingFlags.table()["textureMemory"])
    assert parse(value) == pytest.approx(mebibytes)
