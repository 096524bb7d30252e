"""`patina bsdf` and `patina explain` on materials of both kinds of file."""
import io
import json
import math
import sys

import numpy as np
import pytest

_patina = pytest.importorskip("_patina")

from patina.cli import main  # noqa: E402

DIFFUSE = """<?xml version="1.0"?>
<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="diffuse" type="BSDF">
    <input name="color" type="color3" value="0.5, 0.25, 0.125"/>
  </oren_nayar_diffuse_bsdf>
  <surface name="surface" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="diffuse"/>
  </surface>
  <surfacematerial name="matte" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="surface"/>
  </surfacematerial>
</materialx>
"""
STAGE = """#usda 1.0
def Material "a"
{
    token outputs:surface.connect = </a/s.outputs:surface>
    def Shader "s"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0.5, 0.5, 0.5)
        token outputs:surface
    }
}
def Material "b" (
    inherits = </a>
)
{
}
"""


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
    path.write_text(DIFFUSE.replace("oren_nayar_diffuse_bsdf", "generalized_schlick_bsdf").replace(
        'name="color" type="color3" value="0.5, 0.25, 0.125"', 'name="roughness" type="vector2" value="1, 1"'))
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
    path.write_text(DIFFUSE.replace("oren_nayar_diffuse_bsdf", "dielectric_bsdf").replace(
        'name="color" type="color3" value="0.5, 0.25, 0.125"', 'name="scatter_mode" type="string" value="RT"').replace(
        '<surface name', '<surface  name').replace('</surface>', '<input name="thin_walled" type="boolean" value="true" /></surface>'))
    assert main.main(["explain", str(path)]) == 0
    assert "method thinWalled = slab" in capsys.readouterr().out
    assert main.main(["explain", str(path), "--method", "thinWalled=solid"]) == 0
    assert "method thinWalled = solid" in capsys.readouterr().out
    (slab,) = lines(capsys, "albedo", str(path))
    (solid,) = lines(capsys, "albedo", str(path), "--method", "thinWalled=solid")
    assert solid["albedo"][0] > 0.9  # reflected and refracted; the slab's light goes straight on
    assert slab["albedo"] != solid["albedo"]
