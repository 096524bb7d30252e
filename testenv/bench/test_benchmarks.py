# SPDX-License-Identifier: Apache-2.0
"""Benchmarks of a size that tells nothing but that they run, and what they make of the numbers they measure."""
import argparse
import json
import math
import os
import shutil
import sys

import pytest

import denoiseBench
import growthBench
import growthStages
import inProcess
import pathBench
import planBench
import rayBench
import viewportBench
from patina.cli import bench as command
from patina.cli.errors import CommandError


def found(bench, *arguments, folder):
    file = folder / "figures.json"
    assert bench.main([*map(str, arguments), "--runs", "1", "--json", str(file)]) == 0
    return json.loads(file.read_text())


@pytest.mark.parametrize("name", sorted(set(command.BENCHMARKS) - {"features"}))  # which writes charts
def test_figures_that_cannot_be_written_are_told_first(name, tmp_path):
    """Not after hours. What is no file stays what it is."""
    main = command._load(command.BENCHMARKS[name][0]).main
    for path, reason in (("/dev/zero", "a device"), (tmp_path / "none" / "figures.json", "does not exist")):
        with pytest.raises(CommandError, match=reason):
            main(["--json", str(path)])


def test_figures_go_where_they_are_sent(monkeypatch, tmp_path, capsys):
    """Over a file as a whole, and - is standard output."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(growthBench, "axis", lambda *_: [])
    monkeypatch.setattr(growthBench, "show", lambda *_: None)
    assert growthBench.main(["prims", "--json", "-"]) == 0
    shown = json.loads(capsys.readouterr().out)
    kept = tmp_path / "kept.json"
    kept.write_text("old")
    (tmp_path / "figures.json").hardlink_to(kept)  # whoever has the old file open reads on
    assert found(growthBench, "prims", folder=tmp_path) == {**shown, "runs": 1} and shown["axes"] == {"prims": []}
    assert kept.read_text() == "old" and sorted(p.name for p in tmp_path.iterdir()) == ["figures.json", "kept.json"]


@pytest.mark.parametrize("power", [0.0, 1.0, 2.0])
def test_exponents_are_slopes_of_logarithms(power):
    rows = [{"size": size, "first": 3.0 * size ** power} for size in (10, 100, 1000)]
    assert growthBench.exponents(rows, "first") == pytest.approx([power, power])


@pytest.mark.parametrize("name,drawn", [("triangles", 200), ("instanced", 1000), ("materials", 200), ("prims", 200),
                                        ("prototypes", 200), ("instances", 2), ("lights", 0), ("splats", 0)])
def test_stages_have_as_many_as_they_say(name, drawn, tmp_path):
    stage = inProcess.Stage(growthStages.AXES[name][0](str(tmp_path), 200 if name == "triangles" else 100), "-w", "8")
    image = stage.image(samples=1)
    floor = 8  # triangles
    held = stage.renderer.progress()["statistics"]["trianglesStored"] - floor
    assert held == drawn and not stage.warnings() and image.mean() > 0.0
    if name == "lights":
        assert len(stage.scene.paths("lights")) == 100
    if name == "materials":
        assert len(stage.scene.paths("materials")) == 100


def test_growth_of_prims(tmp_path):
    rows = found(growthBench, "prims", "--most", 10, "--size", "16x12", "--samples", 2, folder=tmp_path)["axes"]["prims"]
    assert [row["size"] for row in rows] == [1, 10]
    assert all(row["first"] > row["open"] and row["peak"] > 0.0 for row in rows)


def test_textures_stay_in_their_memory(tmp_path, monkeypatch):
    monkeypatch.setattr(growthBench, "TEXTURE_MEMORY", 2)
    monkeypatch.setitem(growthStages.AXES, "textures", (growthStages.textures, [1, 4]))
    rows = found(growthBench, "textures", "--size", "16x12", "--samples", 2, folder=tmp_path)["axes"]["textures"]
    assert all(0.0 < row["textures"] <= 2.0 + 10.0 for row in rows)  # ten megabytes are the least that files are read with


@pytest.mark.parametrize("plan,without,ratio", [
    ((2.0, 100, False, 0.0), (4.0, 100, False, 0.0), 0.5),
    ((2.0, 100, False, 0.0), (4.0, 10, True, 0.0), 0.5),     # a bound: without a plan it takes longer than that
    ((2.0, 100, True, 0.0), (4.0, 50, True, 0.0), 0.25),     # neither is done: the time of a sample
])
def test_ratios_of_renders_that_end_early(plan, without, ratio):
    assert planBench.ratio_of(plan, without) == ratio


def test_a_plan_beside_none(tmp_path):
    row = found(planBench, inProcess.scene("plastic"), "--width", 8, "--tolerance", 0.5, folder=tmp_path)["stages"]["plastic"]
    assert row["ratio"] > 0.0 and row["expected"] <= 0.5 and not row["plan"]["ended"]


def test_time_to_an_error_is_found_between_two():
    points = [(1.0, 0.4), (4.0, 0.1)]  # error x seconds is constant
    assert denoiseBench.time_to(points, 0.2) == (pytest.approx(2.0), "")
    assert denoiseBench.time_to(points, 0.5) == (1.0, "<")
    assert denoiseBench.time_to(points, 0.05) == (4.0, ">")


def test_cycles_is_that_of_a_python_with_bpy(monkeypatch, tmp_path):
    monkeypatch.setenv("PATINA_BPY_PYTHON", "/named/python")
    found = pathBench.peers("Cycles")
    assert [found[name][0] for name in ("Cycles", "Cycles guided")] == ["/named/python"] * 2
    monkeypatch.delenv("PATINA_BPY_PYTHON")
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    monkeypatch.setattr(pathBench.venv, "create", lambda folder, **_: os.mkdir(folder))
    for status in (1, 0):  # of pip; the next run asks it no more once bpy is there
        monkeypatch.setattr(pathBench.subprocess, "run", lambda *_, **__: argparse.Namespace(returncode=status))
        assert ("Cycles" in pathBench.peers("Cycles")) == (status == 0)
        if status:
            (tmp_path / "bpy").rmdir()
    monkeypatch.delattr(pathBench.subprocess, "run")
    assert pathBench.peers("Cycles")["Cycles"][0] == str(tmp_path / "bpy" / "bin" / "python")


def test_denoised_images_come_nearer(tmp_path):
    pytest.importorskip("pyoidn", reason="pyoidn is not installed")
    pytest.importorskip("flip_evaluator", reason="flip-evaluator is not installed")
    rungs = found(denoiseBench, "interior", "--size", "32x18", "--samples", "1,16", "--reference", 64, "--without", "Cycles",
                  folder=tmp_path)["scenes"]["interior"]["Patina"]
    assert [samples for samples, *_ in rungs] == [1, 16] and rungs[1][2] < rungs[0][2] < 1.0


@pytest.mark.skipif(not shutil.which("c++"), reason="there is no compiler")
def test_rays_of_a_frame_alone(tmp_path):
    row = found(rayBench, "interior", "--size", "16x9", "--samples", 2, folder=tmp_path)["scenes"]["interior"]
    assert row["intersect"] >= 16 * 9 * 2  # a ray of the camera for each sample
    assert row["occluded"] > 0 and 0 < row["hits"] <= row["intersect"] + row["occluded"]
    assert math.isfinite(row["frame"][0]) and row["bare"][0] > 0.0


def test_viewport_leaves_out_what_does_not_run(monkeypatch, capsys):
    """Storm does not run; hdEmbree, which sees no edit, is asked once and has no figure for one."""
    asked = []

    def host(stage, camera, renderer, options, edit="", image=""):
        asked.append((renderer, edit))
        return None if renderer == "Storm" else {
            "peakMemory": 1e6, "device": "none",
            "seconds": {"open": 1.0, "first": len(asked), "moved": [2.0, 3.0], "edited": [4.0, 8.0]},
            "seen": {"first": 0.5, "moved": [0.1, 0.2], "edited": [0.2, 0.4]}}

    monkeypatch.setattr(viewportBench, "host", host)
    options = argparse.Namespace(runs=1, images=None)
    found = viewportBench.measure("a", "a.usda", "/camera", {"material": "m", "light": "l"}, options)
    assert [edit for renderer, edit in asked if renderer == "hdEmbree"] == ["m"] and "Storm" not in found
    assert "material" not in found["hdEmbree"] and found["rasterizer"]["material"] == 6.0
    assert found["rasterizer"]["first"] == 1.0 + 1.5  # of two processes, the median
    assert found["rasterizer"]["first seen"] == 1.5 and found["rasterizer"]["material seen"] == pytest.approx(0.3)
    viewportBench.show("a", found)
    assert "hdEmbree" not in capsys.readouterr().out.split("edit of a material")[1].split("\n")[0]
