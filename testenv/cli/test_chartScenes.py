# SPDX-License-Identifier: Apache-2.0
"""patina chart STAGE...: what its numbers mean, on synthetic data, and one small run through everything."""
import argparse
import csv
import importlib.util
import json
import math
import os
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from patina.chart import (front, lobes, png, sceneCharts, sceneCommand, sceneLadder, sceneMeasures, scenePage, sceneReference,
                          sceneRenders, sceneResults)
from patina.chart.axes import Axis
from patina.chart.plot import Plot
from patina.cli import chart, compiled, errors, main
import usda

STAGE = usda.stage(
    usda.camera(at=(0, 1, 6)),
    usda.prim("Sphere", "ball", at=(0, 1, 0)),
    usda.prim("Cube", "ground", size=20, at=(0, -10, 0)),
    usda.prim("SphereLight", "light", intensity=30, radius=0.3, at=(2, 4, 2)))
HOSTILE = 'a<b>"&\'\x01<script>alert(1)<_script>.usda'  # no / can be in a name


@pytest.fixture(scope="module")
def charted(tmp_path_factory):
    """A run over a stage with a hostile name and one that is no stage. :returns: folder, exit status, JSON"""
    folder = tmp_path_factory.mktemp("charts")
    good, bad = folder / HOSTILE, folder / "broken.usda"
    good.write_text(STAGE)
    bad.write_text("#usda 1.0\ndef {")
    open(os.fsencode(folder) + b"/\xff.usda", "w").close()
    out = folder / "out"
    status = main.main(["chart", str(bad), str(good), str(folder / "missing.usda"),
                        str(folder / "\udcff.usda"), "--out", str(out), "--imageWidth", "32",
                        "--maxSamples", "20", "--tolerances", "0.5", "--method", "energyCompensation=randomWalk", "--quiet",
                        f"--json={folder / 'rows.json'}"])
    return out, status, json.loads((folder / "rows.json").read_text())


def test_rows(charted):
    out, status, found = charted
    assert status == 1  # one stage is broken, one is not there, one has a name that USD cannot open
    with open(out / "scenes.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == sceneResults.COLUMNS
    traced = [r for r in rows if r["backend"] == "embree" and not r["tolerance"]]
    assert [r["samples"] for r in traced] == ["1", "4", "16", "20"]
    assert all(float(r["secondsInAll"]) > float(r["seconds"]) > 0.0 for r in rows)
    # Sixteen times the samples: neither time nor error can stand still, however busy the machine.
    assert float(traced[2]["seconds"]) > float(traced[0]["seconds"])
    assert float(traced[2]["relMSE"]) < 0.5 * float(traced[0]["relMSE"])
    assert [r["tolerance"] for r in rows if r["tolerance"]][:1] == ["0.5"]
    assert [bool(s["problem"]) for s in found["stages"]] == [True, False, True, True]
    reference = found["stages"][1]["references"]["all"]
    assert reference["samples"] == 16 * 20 and 0.0 < reference["noise"] < float(traced[2]["relMSE"])


def test_page_and_charts(charted):
    out, _, found = charted
    page = (out / "index.html").read_text(encoding="utf-8")
    assert "<script" not in page and "&lt;script&gt;" in page
    assert "broken.usda" in page and "missing.usda" in page
    policy = re.compile(r"<meta http-equiv=\"Content-Security-Policy\"[^>]*>")  # names kinds of addresses, and is none
    addresses = re.findall(r'(?:src|href|url\()\s*=?\s*"?([^">]{1,30})', policy.sub("", page))
    assert addresses and all(a.startswith("data:image/png;base64,") for a in addresses)
    assert re.findall(r"https?://[^\"]*", page) == ["http://www.w3.org/2000/svg"] * page.count("<svg")
    charts = sorted(out.glob("*.svg"))
    assert {path.name.rsplit("-", 1)[1] for path in charts} >= {"relMSE.svg", "rmse.svg"}
    for path in charts:
        assert re.fullmatch(r"[\w-]+\.svg", path.name)
        assert ElementTree.parse(path).getroot().tag.endswith("svg")
    machine = found["machine"]
    assert machine["processor"] in page.replace("&amp;", "&") and int(machine["cores"]) >= 1


def test_references_are_kept(charted, capsys):
    out, _, _ = charted
    before, = [p for p in (out / "references").iterdir()
               if compiled.load().read_image(str(p)).metadata["patina:seed"] == sceneReference.SEED_STEP]
    stamp = before.stat().st_mtime_ns
    stage = out.parent / HOSTILE
    assert main.main(["chart", str(stage), "--out", str(out), "--imageWidth", "32", "--maxSamples", "4", "--backend", "embree",
                      "--tolerances", "none", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["stages"][0]
    assert before.stat().st_mtime_ns == stamp and found["references"]["all"]["seconds"] == 0.0
    assert {r["backend"] for r in found["rows"]} == {"embree"}
    # The same image as reference by hand gives the same errors, for the seeds are the same.
    assert main.main(["chart", str(stage), "--imageWidth", "32", "--maxSamples", "4", "--backend", "embree", "--json",
                      "--tolerances", "none", "--reference", str(before)]) == 0
    again = json.loads(capsys.readouterr().out)["stages"][0]
    assert [r["rmse"] for r in again["rows"]] == pytest.approx([r["rmse"] for r in found["rows"]], rel=0.3)


@pytest.mark.parametrize("arguments, words", [
    (["x.usda", "--lobes"], "say what to chart"), (["x.usda", "y.usda", "--reference", "r.exr"], "--reference"),
    (["x.usda", "--tolerances", "0"], "--tolerances"), (["x.usda", "--tolerances", "0.1,nan"], "--tolerances"),
    (["x.usda", "--reference", "none.exr"], "there is no file none.exr"),
    (["x.usda", "--method", "thinFilm=guess"], "--method"), (["x.usda", "--out", "/dev/null/x"], "cannot make")])
def test_wrong_usage(arguments, words, capsys):
    assert main.main(["chart", *arguments]) in (1, 2)
    error = capsys.readouterr().err
    assert words in error and "Traceback" not in error and len(error.strip().splitlines()) == 1


def test_without_a_rasterizer(charted, monkeypatch, capsys):
    """It is said, the path tracer is charted all the same, and the exit status tells."""
    monkeypatch.setenv("PATINA_EGL_PLATFORM", "none")
    stage = charted[0].parent / "plain.usda"
    stage.write_text(STAGE)
    arguments = ["chart", str(stage), "--imageWidth", "16", "--maxSamples", "4", "--tolerances", "none", "--quiet"]
    assert main.main([*arguments, f"--json={stage}.json"]) == 1
    assert "no rasterizer here" in capsys.readouterr().err
    found = json.loads((stage.parent / "plain.usda.json").read_text())["stages"][0]
    assert [r["backend"] for r in found["rows"]] == ["embree", "embree"] and not found["crossovers"]
    assert main.main([*arguments, "--backend", "raster"]) == 1
    output = capsys.readouterr()
    assert "no rasterizer here" in output.err and not output.out.strip()


def test_a_black_stage(charted, capsys):
    stage = charted[0].parent / "black.usda"
    stage.write_text("#usda 1.0\n")
    assert main.main(["chart", str(stage), "--imageWidth", "16", "--maxSamples", "4", "--quiet",
                      "--out", str(charted[0].parent / "black")]) == 0
    assert "the reference is black" in capsys.readouterr().out


def _not_json(text):
    pytest.fail(f"{text} is no JSON")


@pytest.fixture
def small(tmp_path):
    """:returns: a chart's command, the reference that it keeps, and the size of its images"""
    stage, out = tmp_path / "stage.usda", tmp_path / "out"
    stage.write_text(STAGE)
    command = ["chart", str(stage), "--imageWidth", "8", "--maxSamples", "4", "--tolerances", "none", "--quiet",
               f"--json={tmp_path / 'rows.json'}", f"--out={out}"]
    assert main.main([*command, "--backend", "embree"]) == 0
    kept, = (out / "references").iterdir()
    found = json.loads((tmp_path / "rows.json").read_text())["stages"][0]
    return command, str(kept), (found["height"], found["width"], 3)


@pytest.mark.parametrize("backend", ["both", "embree"])
def test_a_reference_has_numbers(backend, small, tmp_path, capsys):
    command, path, image = [*small[0], "--backend", backend], str(tmp_path / "mine.exr"), np.full(small[2], np.nan, np.float32)
    compiled.load().write_image(path, image)
    capsys.readouterr()
    assert main.main([*command, "--reference", path]) == 1
    said = [line for line in capsys.readouterr().err.splitlines() if "FLIP" not in line and "no rasterizer" not in line]
    assert len(said) == 1 and said[0].endswith(f"{path} has no pixel that is a number")
    image[-1, 0] = -0.01  # of the ground; where 0.01 is added, the sum is 0
    compiled.load().write_image(path, image)
    main.main([*command, "--reference", path])  # a rasterizer may be missing
    found = json.loads((tmp_path / "rows.json").read_text(), parse_constant=_not_json)["stages"][0]
    assert not found["problem"] and all(row["relative"] > 0.0 for row in found["rows"])


def test_a_reference_is_told_by_its_name_before_it_is_read(tmp_path):
    (tmp_path / "stage.usda").write_text(STAGE)
    with pytest.raises(errors.CommandError, match="stage.usda: a reference has linear values"):
        sceneReference.brought(str(tmp_path / "stage.usda"), None)


def test_renders_without_numbers_have_no_errors(tmp_path):
    """The light that the others are compared with is one that can be compared with."""
    nothing, grey = np.full((4, 4, 3), np.nan, np.float32), np.full((4, 4, 3), 0.5, np.float32)
    found = sceneMeasures.errors(nothing, grey)
    assert {found[name] for name in ("relMSE", "rmse", "flip", "meanError", "relative")} == {None}
    renders = [sceneRenders.Render(grey + 0.1 / n, 0.1, 0.1, 1.0, n, n, 0.0) for n in (1, 4)]
    rungs = [sceneLadder.Rung("raster", r.samples, 0.0, True, [r]) for r in renders]
    references = {name: sceneReference.Reference(image, "", 0.0, 0.0, 0.0)
                  for name, image in (("all", nothing), ("direct", grey))}
    ladder = sceneLadder.Ladder(None, rungs, references=references)
    assert sceneResults._slopes(ladder, "raster")["against"] == "direct"
    table = tmp_path / "scenes.csv"
    row = {**dict.fromkeys(sceneResults.COLUMNS, ""), "stage": "a", "backend": "raster", "seconds": 1.0, "samples": 4.0}
    sceneResults.write_csv([sceneResults.StageResult("a", rows=[row])], table)
    found, = sceneResults.read_csv(table)
    found.rows[0].update(tolerance=0.5, told=0.1)
    assert found.rows[0]["relative"] is None and "<td>-</td>" in scenePage._tolerances(found)[-2]


@pytest.mark.parametrize("value, shape, samples, noise", [
    (0.5, (1, 1, 3), 1e6, 0.0), (0.5, (5, 3, 3), 1e6, 0.0), (0.5, None, "inf", 0.0), (0.5, None, 1e6, "nan"),
    (math.nan, None, 1e6, 0.0)])
def test_a_kept_reference_is_one_of_these_images(value, shape, samples, noise, small, tmp_path):
    """Any other is rendered anew."""
    command, kept, size = small
    compiled.load().write_image(kept, np.full(shape or size, value, np.float32), ["R", "G", "B"], {},
                                {"patina:samples": samples, "patina:noise": noise})
    assert main.main([*command, "--backend", "embree"]) == 0
    image = compiled.load().read_image(kept)
    assert image.pixels.shape[:2] == size[:2] and float(image.metadata["patina:samples"]) == 64.0
    found = json.loads((tmp_path / "rows.json").read_text(), parse_constant=_not_json)["stages"][0]
    assert found["references"]["all"]["samples"] == 64.0


def test_counts():
    assert sceneLadder.counts(1) == [1]
    assert sceneLadder.counts(64) == [1, 4, 16, 64]
    assert sceneLadder.counts(100) == [1, 4, 16, 64, 100]


def test_errors_of_known_images():
    reference = np.full((8, 8, 3), 0.5, np.float32)
    found = sceneMeasures.errors(reference + 0.1, reference)
    assert found["rmse"] == pytest.approx(0.1, rel=1e-5)
    assert found["relMSE"] == pytest.approx(0.01 / 0.26, rel=1e-5)
    assert found["meanError"] == pytest.approx(0.2, rel=1e-5)
    assert found["relative"] == pytest.approx(0.1 / 0.51, rel=1e-5)
    broken = reference.copy()
    broken[0, 0, 0] = math.nan
    assert sceneMeasures.errors(broken, reference)["notFinite"] == 1
    both = sceneMeasures.averaged([{"rmse": 3.0, "flip": None}, {"rmse": 4.0, "flip": 0.5}])
    assert both == {"rmse": pytest.approx(math.sqrt(12.5)), "flip": 0.5}


def test_slope_of_noise():
    """Independent samples: -0.5. The means of 4096 normal numbers per count err by 1.1 % each, so that the slope over
    three powers of 4 errs by less than 0.02 at six standard errors (seed 5)."""
    random = np.random.default_rng(5)
    counts = [4, 16, 64, 256]
    reference = np.zeros((64, 64, 3))
    images = [np.repeat(random.normal(size=(64, 64, 1)), 3, axis=2) / math.sqrt(n) for n in counts]
    assert sceneMeasures.slope(counts, [sceneMeasures.rmse(i, reference) for i in images]) == pytest.approx(-0.5, abs=0.02)
    biased = [i + np.where(np.arange(64)[None, :, None] < 11, 5.0, 0.0) for i in images]  # the first column of tiles
    tiles = sceneMeasures.tile_slopes(counts, [sceneMeasures.tile_errors(i, reference) for i in biased])
    assert tiles["median"] == pytest.approx(-0.5, abs=0.05)
    assert tiles["shallowest"] > -0.05 and tiles["tile"][0] == 0 and tiles["tile"][2] == 11
    assert sceneMeasures.slope([4], [1.0]) is None and sceneMeasures.slope([4, 16], [0.0, 0.0]) is None


def test_tiles_cover_the_image():
    image, reference = np.zeros((13, 31, 3)), np.zeros((13, 31, 3))
    image[12, 30] = 1.0
    tiles = sceneMeasures.tile_errors(image, reference)
    assert sum((x1 - x0) * (y1 - y0) for x0, y0, x1, y1 in tiles) == 13 * 31
    assert [t for t, e in tiles.items() if e > 0.0] == [max(tiles)]


def test_floor():
    counts = [1, 4, 16, 64]
    assert sceneMeasures.floor(counts, [0.02 + 1.0 / n for n in counts], 1.0) == pytest.approx(0.02, rel=1e-6)
    assert sceneMeasures.floor(counts, [0.1 + 0.3 / n**0.5 for n in counts], 0.5) == pytest.approx(0.1, rel=1e-6)
    assert sceneMeasures.floor(counts, [0.3, 0.3, 0.3, 0.3], 1.0) == pytest.approx(0.3)
    assert sceneMeasures.floor(counts, [0.2, 0.25, 0.26, 0.27], 1.0) == pytest.approx(0.25, rel=0.1)
    assert sceneMeasures.floor(counts, [1.0 / n for n in counts], 1.0) is None
    assert sceneMeasures.floor(counts[:2], [1.0, 0.9], 1.0) is None


def test_pareto():
    points = [(4, 1, "d"), (1, 5, "a"), (2, 6, "b"), (3, 1, "c"), (2, 3, "e"), (2, 2, "f")]
    assert front.pareto(points) == [(1, 5, "a"), (2, 2, "f"), (3, 1, "c")]
    random = np.random.default_rng(3)
    cloud = [tuple(p) for p in random.random((200, 2))]
    kept = front.pareto(cloud)
    for p in cloud:
        beaten = any(q != p and q[0] <= p[0] and q[1] <= p[1] for q in cloud)
        assert beaten != (p in kept)


def test_crossover():
    # The path tracer's relMSE is 1 / seconds; the rasterizer has 0.1 from a tenth of a second on: level at 10 s.
    traced = [(4.0**k / 4.0, 4.0 / 4.0**k) for k in range(5)]
    found = sceneMeasures.crossover(traced, [(0.1, 0.1), (1.0, 0.1)])
    assert found["better"] == [[pytest.approx(0.1), pytest.approx(10.0, rel=0.01)]] and not found["open"]
    assert sceneMeasures.crossover_text(found) == "the rasterizer is better from 0.1 s to 10 s"
    never = sceneMeasures.crossover(traced, [(0.5, 3.0)])
    assert never["at"] is None and "path tracer is better at every time" in sceneMeasures.crossover_text(never)
    late = sceneMeasures.crossover(traced, [(1e3, 1e-9)])
    assert late["better"] == []
    assert never["below"] == pytest.approx(1.0 / 3.0) and "from 0.33 s on" in sceneMeasures.crossover_text(never)
    still = sceneMeasures.crossover(traced, [(0.1, 0.001)])
    assert still["open"] and still["until"] == 64.0 and still["below"] is None
    expected = sceneMeasures.expected_level(traced, [(0.1, 0.001)], 1.0)
    assert expected == pytest.approx(1000.0)
    assert "1000 s" in sceneMeasures.crossover_text(still, expected)
    # The rasterizer comes later than the path tracer, overtakes it, and is overtaken.
    twice = sceneMeasures.crossover(traced, [(1.0, 0.05)])
    assert twice["better"] == [[pytest.approx(1.0), pytest.approx(20.0, rel=0.01)]]


def test_time_is_kept(tmp_path, capsys):
    """A limit that so many samples would exceed many times over: fewer are taken, or the stage says that it was too short."""
    stage = tmp_path / "stage.usda"
    stage.write_text(STAGE)
    status = main.main(["chart", str(stage), "--imageWidth", "24", "--maxSamples", "65536", "--tolerances", "none", "--backend",
                        "embree", "--seconds", "1", "--json"])
    output = capsys.readouterr()
    if status == 1:
        assert "too short" in output.err
        return
    found = json.loads(output.out)["stages"][0]
    assert any("--seconds 1 " in note for note in found["notes"])
    assert max(r["samples"] for r in found["rows"]) < 65536


def test_methods_of_the_reference():
    """A forced approximation is judged; a choice of meaning is that of the reference, too."""
    assert sceneCommand.truth({"thinFilm": "table", "thinWalled": "auto"}) == {"thinWalled": "auto"}


def test_file_names():
    taken = set()
    assert sceneCharts.file_name("/x/Box.usda", taken) == "Box"
    assert sceneCharts.file_name("/y/box.usd", taken) == "box-2"
    assert sceneCharts.file_name("/y/<&>.usd", taken) == "___"
    assert sceneCharts.file_name("/y/\u00e9.usd", taken) == "_"


def test_plot_takes_any_numbers():
    plot = Plot("a < b", "x", "y")
    plot.add("s & t", [(1.0, 0.0, ""), (0.0, 1.0, ""), (1e-9, 1e9, "<"), (2.0, None, "")], "#000")
    plot.add("none", [], "#000")
    plot.add_floor("floor", 1e9, "#000")
    plot.add_guide(-0.5, "guide")
    ElementTree.fromstring(plot.svg())
    assert Axis([], 0.0, 1.0).at(1.0) == pytest.approx(0.5)
    axis = Axis([0.0, 1.0, 1000.0], 0.0, 100.0, margin=0.0)
    assert axis.at(10.0) == pytest.approx(100.0 / 3.0) and axis.at(0.0) == 0.0
    assert axis.ticks() == [(1.0, "1"), (10.0, "10"), (100.0, "100"), (1000.0, "1000")]


def test_signed_errors():
    reference = np.full((1, 3, 3), 0.5)
    shown = scenePage.signed(reference * [[[1.0], [1.6], [0.3]]], reference)[0]
    assert list(shown[0]) == [1.0, 1.0, 1.0]
    assert shown[1, 0] > 0.7 > 0.2 > shown[1, 2] and shown[2, 2] > 0.8 > 0.2 > shown[2, 0]


def test_labels_of_a_scatter_do_not_cover_each_other():
    drawn = lobes.scatter("t", [(10.0, 0.01, "schlick"), (11.0, 0.0101, "f82"), (10.5, 0.0099, "exact"), (2.0, 0.0, "none")],
                          "y")
    found = {words: (float(x) - 6.1 * len(words) * {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor], float(y))
             for x, y, anchor, words in
             re.findall(r'x="([\d.]+)" y="([\d.]+)" text-anchor="(\w+)"[^>]* font-weight="bold" paint[^>]*>([^<]+)<', drawn)}
    assert set(found) == {"schlick", "f82", "exact", "none (0)"}  # nothing is a front but the exact one alone
    places = sorted((y, x, x + 6.1 * len(words)) for words, (x, y) in found.items())
    for i, (y, begin, end) in enumerate(places):
        for other, start, stop in places[i + 1:]:
            assert other - y >= 11 or stop <= begin or end <= start


def test_png_holds_the_pixels(tmp_path):
    image = np.random.default_rng(2).random((5, 7, 3))
    path = tmp_path / "image.png"
    path.write_bytes(png.encode(image))
    back = np.array(compiled.load().read_image(str(path)).pixels)[..., :3]
    shown = np.where(image <= 0.0031308, 12.92 * image, 1.055 * image ** (1 / 2.4) - 0.055)
    assert back.shape == (5, 7, 3) and np.abs(back - shown).max() <= 0.5 / 255 + 1e-6


def test_the_projects_own_charts(monkeypatch):
    """Every kind of chart is regenerated, by flags that the command has."""
    path = os.path.join(os.path.dirname(__file__), "..", "charts.py")
    spec = importlib.util.spec_from_file_location("charts", path)
    charts = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(charts)
    assert set(charts.KINDS) == {"scenes", "features", "splats", *chart.CHARTS}
    parser = argparse.ArgumentParser(exit_on_error=False)
    chart.add_arguments(parser)
    monkeypatch.syspath_prepend(os.path.join(charts.ROOT, "testenv", "bench"))
    import featureBench

    for commands, quick, kept in charts.KINDS.values():
        for flags in (*commands, quick):
            if flags[0] == "bench":
                assert flags[1] == "features" and featureBench.make_parser().parse_args(flags[2:])
                continue
            found = parser.parse_args(flags)
            # The knot is made on the way.
            assert all(stage == "knot" or os.path.exists(os.path.join(charts.ROOT, stage)) for stage in found.stages)
        assert kept
