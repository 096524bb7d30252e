# SPDX-License-Identifier: Apache-2.0
"""Cryptomatte against closed forms of coverage, and read by programs that know only the specification."""
import json
import os

import numpy as np
import pytest

from inProcess import needs_opengl
from rendering import patina, record, shot
import usda

CAMERA = usda.camera(flat=(80, 40), at=(0, 0, 5))
QUAD = usda.mesh("quad", [(-2.5, -9, 0), (0.5, -9, 0), (0.5, 9, 0), (-2.5, 9, 0)], bind="red")
STAGE = usda.stage(
    CAMERA,
    usda.prim("DistantLight", "sun"),
    usda.preview("red"),
    usda.prim("Xform", "left", QUAD, meta=('kind = "component"',)),
    usda.mesh("right", [(0.5, -9, 0), (3, -9, 0), (3, 9, 0), (0.5, 9, 0)], 'string primvars:patina:cryptoAsset = "set"'),
    usda.prim("Scope", "Render",
        usda.prim("RenderSettings", "main", "rel camera = </camera>", "rel products = </Render/product>", resolution=(8, 4)),
        usda.prim("RenderProduct", "product", "rel orderedVars = [</Render/ci>, </Render/object>]", productName="product.exr"),
        usda.prim("RenderVar", "ci", sourceName="Ci"),
        usda.prim("RenderVar", "object", sourceName="crypto_object")))
# The image is 8 units wide, a pixel one: what each of them covers of the pixels of a row.
LEFT, RIGHT = [0, 0.5, 1, 1, 0.5, 0, 0, 0], [0, 0, 0, 0, 0.5, 1, 1, 0]
EXPECTED = {
    "crypto_object": {"/left/quad": LEFT, "/right": RIGHT}, "crypto_material": {"/red": LEFT, "default": RIGHT},
    "crypto_asset": {"/left": LEFT, "set": RIGHT}}
AOVS = [a for name in ("cryptoObject", "cryptoMaterial", "cryptoAsset") for a in ("--aov", name)]


@pytest.fixture(scope="module", params=["embree", "raster"])
def image(request, tmp_path_factory):
    needs_opengl(request.param)
    folder = tmp_path_factory.mktemp("cryptomatte")
    return shot(folder, STAGE, "-w", 8, "--samples", 64, "--filterRadius", 0.5, "--backend", request.param, *AOVS)


def layers(path):
    """:returns: dict of layer -> (manifest, dict of id bits -> coverage), by the specification's own words alone"""
    import _patina

    read = _patina.read_image(str(path))
    pixels = {name: read.pixels[:, :, i] for i, name in enumerate(read.channels)}
    found = {}
    for key, layer in read.metadata.items():
        if not (key.startswith("cryptomatte/") and key.endswith("/name")):
            continue
        head = key[:-len("name")]
        assert read.metadata[head + "hash"] == "MurmurHash3_32" and read.metadata[head + "conversion"] == "uint32_to_float32"
        coverage = {}
        for rank in range(3):
            for id_, share in ("RG", "BA"):
                bits = np.ascontiguousarray(pixels[f"{layer}{rank:02d}.{id_}"]).view(np.uint32)
                for number in np.unique(bits):
                    coverage[number] = coverage.get(number, 0) + np.where(bits == number, pixels[f"{layer}{rank:02d}.{share}"],
                                                                          0)
        found[layer] = (json.loads(read.metadata[head + "manifest"]), coverage)
    return found


def test_masks_are_what_each_covers(image):
    """A pixel's samples are spread evenly, so that half of 64 lie on each side of its middle up to one for each row of the
    points' net: within 8 of 64. Neither covers what is beside both."""
    found = layers(image)
    assert set(found) == set(EXPECTED)
    for layer, masks in EXPECTED.items():
        manifest, coverage = found[layer]
        assert set(manifest) == set(masks)
        for name, row in masks.items():
            mask = coverage[int(manifest[name], 16)]
            assert np.abs(mask - np.array(row)).max() <= 8 / 64
            assert (mask[:, np.array(row) == 1] == 1).all() and (mask[:, np.array(row) == 0] == 0).all()
        total = sum(coverage[int(manifest[name], 16)] for name in masks)
        assert np.allclose(total[:, 2:7], 1.0, atol=1e-6) and (total[:, [0, 7]] == 0.0).all()


def test_a_reader_of_others_finds_the_same(image):
    api = pytest.importorskip("cryptomatte_api", reason="cryptomatte-api (requirements-long.txt) is not installed")
    names = {frozenset(masks) for masks in EXPECTED.values()}
    for matte in api.Cryptomatte.load(str(image)):
        masks = matte.masks()
        assert frozenset(masks) in names
        expected = next(m for m in EXPECTED.values() if set(m) == set(masks))
        for name, mask in masks.items():
            assert np.abs(mask - np.array(expected[name])).max() <= 8 / 64


def test_threads_and_parts_change_no_bit(tmp_path):
    stage, flags = tmp_path / "stage.usda", ("-w", 16, "--samples", 48, *AOVS)
    stage.write_text(STAGE)
    record(stage, tmp_path / "one.exr", *flags, "--threads", 1)
    record(stage, tmp_path / "many.exr", *flags, "--threads", 3)
    parts = [tmp_path / f"{i}.part" for i in (1, 2)]
    for i, part in enumerate(parts, 1):
        record(stage, tmp_path / "merged.exr", *flags, "--part", f"{i}/1x2", "--partial", part)
    patina("merge", *parts, tmp_path / "merged.exr")
    import _patina

    first = _patina.read_image(str(tmp_path / "one.exr"))
    for other in ("many.exr", "merged.exr"):
        read = _patina.read_image(str(tmp_path / other))
        assert read.channels == first.channels and np.array_equal(read.pixels.view(np.uint32), first.pixels.view(np.uint32))
        for key, value in first.metadata.items():
            assert not key.startswith("cryptomatte/") or read.metadata[key] == value


def test_products_have_it_by_the_names_of_others(tmp_path, monkeypatch):
    (tmp_path / "stage.usda").write_text(STAGE)
    monkeypatch.chdir(tmp_path)
    patina("record", "stage.usda", "--settings", "/Render/main", "--samples", 4, "--quiet")
    assert set(layers(tmp_path / "product.exr")["crypto_object"][0]) == {"/left/quad", "/right"}


def test_only_openexr_holds_it(tmp_path):
    (tmp_path / "stage.usda").write_text(STAGE)
    failed = record(tmp_path / "stage.usda", tmp_path / "image.png", "--aov", "cryptoObject", check=False)
    assert failed.returncode == 1 and "only OpenEXR (.exr) holds AOV 'cryptoObject'" in failed.stderr
    assert not os.path.exists(tmp_path / "image.png")


def test_native_instances_have_their_own_paths(tmp_path):
    instances = [usda.prim("Xform", name, meta=("instanceable = true", "references = </proto>"), at=place)
                 for name, place in (("left", (0, 0, 0)), ("again", (1, 0, 1)))]
    text = usda.stage(CAMERA, usda.preview("red"), usda.prim("Xform", "proto", QUAD, specifier="class"), *instances)
    image = shot(tmp_path, text, "-w", 8, "--samples", 1, *AOVS)
    assert {"/left/quad", "/again/quad"} <= set(layers(image)["crypto_object"][0])
