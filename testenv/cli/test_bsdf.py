# SPDX-License-Identifier: Apache-2.0
"""`patina bsdf` and `patina explain` on materials of both kinds of file."""
import io
import json
import math
import os
import sys

import numpy as np
import pytest

import _patina
import mtlx
from patina.cli import main, materials
import usda

DIFFUSE = mtlx.document(mtlx.lobe("matte", "oren_nayar_diffuse_bsdf", {"color": (0.5, 0.25, 0.125)}, node="diffuse"))
STAGE = usda.stage(
    usda.preview("a", diffuseColor=(0.5, 0.5, 0.5)),
    usda.prim("Material", "b", meta=("inherits = </a>",)),
    up="")


@pytest.fixture
def document(tmp_path):
    path = tmp_path / "matte.mtlx"
    path.write_text(DIFFUSE)
    return str(path)


@pytest.fixture
def stage(tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(STAGE)
    return str(path)


def lines(capsys, *arguments):
    assert main.main(["bsdf", *arguments, "--json"]) == 0
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


def test_lambert_in_closed_form(document, capsys):
    (result,) = lines(capsys, "eval", document, "--wo", "0,0,1", "--wi", "-0.6,0,0.8")
    assert result["f"] == pytest.approx([0.5 / math.pi, 0.25 / math.pi, 0.125 / math.pi], rel=1e-5)
    assert result["pdf"] == pytest.approx(0.8 / math.pi, rel=1e-5)
    (result,) = lines(capsys, "albedo", document + ":matte", "--wo", "0.3,0,0.5")
    assert result["albedo"] == pytest.approx([0.5, 0.25, 0.125], rel=1e-4)


def test_samples_agree_with_eval(stage, capsys):
    samples = lines(capsys, "sample", stage + ":/a", "--wo", "0.6,0,0.8", "--count", "200", "--seed", "4")
    assert len(samples) == 200
    assert len({s["pdf"] for s in samples}) > 100
    found = [s for s in samples if s["pdf"] > 0]
    probe = _patina.MaterialProbe(dict(read(stage))["/a"])
    wi = np.array([s["wi"] for s in found])
    f, pdf = probe.eval(np.tile([[0.6, 0, 0.8]], (len(found), 1)), wi)
    assert pdf == pytest.approx(np.array([s["pdf"] for s in found]), rel=1e-3)
    weight = f * np.abs(wi[:, 2:]) / pdf[:, None]
    assert weight == pytest.approx(np.array([s["weight"] for s in found]), rel=1e-3, abs=1e-6)


def read(stage):
    from patina.cli import openStage
    from patina.stage import read_materials

    return read_materials(openStage.open_stage(stage))


def test_standard_input(document, capsys, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO("0 0 1  0 0 1\n\n0,0,2, 0.6,0,0.8\n"))
    results = lines(capsys, "eval", document, "--wo", "-", "--wi", "-")
    assert [r["pdf"] for r in results] == pytest.approx([1 / math.pi, 0.8 / math.pi], rel=1e-5)
    monkeypatch.setattr(sys, "stdin", io.StringIO("0 0 1\n1 2\n"))
    assert main.main(["bsdf", "albedo", document, "--wo", "-"]) == 1
    assert "line 2" in capsys.readouterr().err


def test_set(document, stage, capsys):
    (result,) = lines(capsys, "albedo", document, "--set", "/diffuse.color=0.75,0.5,0.25")
    assert result["albedo"] == pytest.approx([0.75, 0.5, 0.25], rel=1e-4)
    (before,) = lines(capsys, "albedo", stage + ":/a")
    (after,) = lines(capsys, "albedo", stage + ":/a", "--set", "/a.diffuseColor=0.9")
    assert after["albedo"][0] > before["albedo"][0] + 0.2


@pytest.mark.parametrize("arguments", [["absent.mtlx"], ["DOCUMENT:nothing"], ["STAGE"], ["STAGE:/nowhere"],
                                       ["DOCUMENT", "--set", "/diffuse.nothing=1"], ["DOCUMENT", "--set", "nonsense"]])
def test_what_is_not_there(document, stage, arguments, capsys):
    arguments = [a.replace("DOCUMENT", document).replace("STAGE", stage) for a in arguments]
    assert main.main(["bsdf", "albedo", *arguments]) in (1, 2)
    error = capsys.readouterr().err
    assert "Traceback" not in error and len(error.strip().splitlines()) == 1


def test_explain(document, stage, capsys):
    assert main.main(["explain", document]) == 0
    assert "oren_nayar" in capsys.readouterr().out
    assert main.main(["explain", stage, "--json"]) == 0
    names = [m["name"] for m in json.loads(capsys.readouterr().out)["materials"]]
    assert names == ["/a", "/b"]


def test_methods(capsys, tmp_path):
    path = tmp_path / "metal.mtlx"
    path.write_text(mtlx.document(mtlx.lobe("metal", "generalized_schlick_bsdf", {"roughness": (1, 1)})))
    (compensated,) = lines(capsys, "albedo", str(path))
    (single,) = lines(capsys, "albedo", str(path), "--method", "energyCompensation=none")
    assert single["albedo"][0] < 0.7 < 0.95 < compensated["albedo"][0]


def test_methods_are_listed_and_checked(document, capsys):
    with pytest.raises(SystemExit) as end:
        main.main(["bsdf", "--method", "list"])
    assert not end.value.code and "energyCompensation" in capsys.readouterr().out
    for text in ("nowhere=none", "energyCompensation=nonsense", "energyCompensation"):
        assert main.main(["bsdf", "albedo", document, "--method", text]) == 2


def test_open_meanings_are_methods(capsys, tmp_path):
    path = tmp_path / "pane.mtlx"
    path.write_text(mtlx.document({"pane": ("dielectric_bsdf", {"scatter_mode": "RT"}),
                                   **mtlx.shader("matte", "surface", {"bsdf": "<pane>", "thin_walled": True})}))
    assert main.main(["explain", str(path)]) == 0
    assert "method thinWalled = slab" in capsys.readouterr().out
    assert main.main(["explain", str(path), "--method", "thinWalled=solid"]) == 0
    assert "method thinWalled = solid" in capsys.readouterr().out
    (slab,) = lines(capsys, "albedo", str(path))
    (solid,) = lines(capsys, "albedo", str(path), "--method", "thinWalled=solid")
    # Reflected and refracted; the slab's light goes straight on. Neither loses any.
    assert slab["albedo"] == solid["albedo"] == pytest.approx([1.0] * 3, abs=1e-5)


def _raster_probe(network):
    try:
        return _patina.RasterProbe(network)
    except AttributeError:
        pytest.skip("this build has no rasterizer")
    except RuntimeError as error:
        if "OpenGL" in str(error) or "EGL" in str(error):
            pytest.skip(str(error))
        raise


@pytest.mark.parametrize("scene", ["plastic", "roughGlass", "shaderball", "texturedDiffuse", "media"])
def test_both_back_ends_agree(scene, capsys):
    """Fixed directions and random numbers. Floats cancel near the peaks of narrow lobes, whoever computes: there one value
    in a hundred may be off by more than 1e-4, but none by 1e-3."""
    stage = os.path.join(os.path.dirname(__file__), "..", "scenes", scene + ".usda")
    found, _ = materials.load(stage, every=True)
    generator = np.random.default_rng(5)
    wo, wi = (_unit(generator.normal(size=(64, 3))) for _ in range(2))
    u = generator.random((64, 4), dtype=np.float32)
    for name, network in found[-1:]:  # a compilation takes the driver seconds
        embree, raster = _patina.MaterialProbe(network), _raster_probe(network)
        for probe in (embree, raster):
            probe.move_to(0.3, 0.6)
        (f, pdf), (g, density) = embree.eval(wo, wi), raster.eval(wo, wi)
        a, b = embree.sample(wo, u), raster.sample(wo, u)
        same = a["event"] == b["event"]
        assert same.all(), name
        np.testing.assert_allclose(b["wi"], a["wi"], atol=1e-4, err_msg=name)
        pairs = {"f": (g, f), "pdf": (density, pdf), "albedo": (raster.albedo(wo), embree.albedo(wo)),
                 "weight": (b["weight"], a["weight"])}
        for what, (got, wanted) in pairs.items():
            off = np.abs(got - wanted) / (np.abs(wanted) + 1e-3)
            assert off.max() < 1e-3, (name, what)
            assert np.mean(off > 1e-4) <= 0.01, (name, what)


def _unit(vectors):
    return (vectors / np.linalg.norm(vectors, axis=1)[:, None]).astype(np.float32)


def test_raster_prints_as_embree_does(document, capsys, monkeypatch):
    _raster_probe(_patina.display_color_network())
    printed = []
    for backend in ("embree", "raster"):
        monkeypatch.setattr(sys, "stdin", io.StringIO("0 0 1 0.6 0 0.8\n0.6 0 0.8 0 0.6 0.8\n"))
        assert main.main(["bsdf", "eval", document, "--wo", "-", "--wi", "-", "--backend", backend]) == 0
        printed.append(capsys.readouterr().out.splitlines())
    assert len(printed[0]) == len(printed[1]) == 2
    for a, b in zip(*printed):
        assert a.split()[0] == b.split()[0] == "f"
        np.testing.assert_allclose([float(x) for x in b.split()[1:4]], [float(x) for x in a.split()[1:4]], rtol=1e-5)


def write_images(path, nodes, last):
    """A matte material of a node's colour."""
    path.write_text(mtlx.document({"uv": ("texcoord vector2", {})}, nodes,
                                  mtlx.lobe("matte", "oren_nayar_diffuse_bsdf", {"color": f"<{last}>"})))


def image(file, wrap):
    return "image color3", {"filename file": file, "texcoord": "<uv>", "uaddressmode": wrap, "vaddressmode": wrap}


def _albedos(path, places):
    (_, network), = materials.load(str(path))[0]
    up = np.array([[0, 0, 1]], dtype=np.float32)
    probes = _patina.MaterialProbe(network), _raster_probe(network)
    found = []
    for probe in probes:
        for u, v in places:
            probe.move_to(u, v)
            found.append(probe.albedo(up)[0])
    return np.array(found[:len(places)]), np.array(found[len(places):]), probes[1].warnings


def test_tiles_of_textures_on_the_driver(tmp_path):
    colors = {1001: (1, 0, 0), 1002: (0, 1, 0), 1011: (0, 0, 1), 1012: (0.5, 0.25, 0.75)}
    for tile, color in colors.items():
        size = 8 if tile == 1001 else 4  # tiles need not be alike
        _patina.write_image(str(tmp_path / f"t.{tile}.exr"), np.full((size, size, 3), color, dtype=np.float32))
    path = tmp_path / "tiles.mtlx"
    write_images(path, {"a": image("t.<UDIM>.exr", "periodic")}, "a")
    places = [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (1.5, 1.25), (2.0, 0.5), (2.5, 0.5), (-0.5, 0.5)]
    embree, raster, _ = _albedos(path, places)
    np.testing.assert_allclose(embree[:4], list(colors.values()), atol=1e-3)
    np.testing.assert_allclose(raster, embree, atol=1e-4)


def test_more_textures_than_units_on_the_driver(tmp_path):
    wraps = ["periodic", "clamp", "mirror", "constant"]
    nodes, last = {}, "a0"
    for i in range(19):
        size = 16 if i < 15 else 8
        y, x = np.mgrid[0:size, 0:size] / size
        _patina.write_image(str(tmp_path / f"t{i}.exr"),
                            np.stack([x, y, np.full_like(x, i / 19)], axis=-1).astype(np.float32) / 19)
        nodes[f"a{i}"] = image(f"t{i}.exr", wraps[i % 4])
        if i:
            nodes[f"s{i}"] = ("add color3", {"in1": f"<{last}>", "in2": f"<a{i}>"})
            last = f"s{i}"
    path = tmp_path / "many.mtlx"
    write_images(path, nodes, last)
    # Texel centres of all sizes: where a filter would reach over an edge, the shared array has none.
    places = [(0.4375, 0.5625), (1.3125, 0.3125), (-0.6875, 1.6875)]
    embree, raster, warnings = _albedos(path, places)
    np.testing.assert_allclose(raster, embree, rtol=2e-2, atol=1e-3)
    assert any("more than 16 textures" in w["message"] for w in warnings)
