# SPDX-License-Identifier: Apache-2.0
"""One page of one material, in a browser: nothing is complained about, and every part does its work."""
import json
import os
import urllib.parse

import numpy as np
import pytest

from usda import lobe, prim, stage

MATERIAL = stage(
    prim("Scope", "look",
        prim("SphereLight", "lamp", intensity=40, radius=0.3, at=(3, 2, 3)),
        lobe("red", "oren_nayar_diffuse_bsdf", inside="/look", color=(0.8, 0.1, 0.05))),
    up="")
CONTROLS = {"presets": [{"name": "blue", "values": {"/look/red/bsdf.color": [0.05, 0.1, 0.8]}}],
            "sentences": {"red": "A sentence."}}
COLOR = "page.state.values[0][page.state.current.inputs.findIndex(i => i.input.endsWith('bsdf.color'))]"
SMALL = "?width=96"


@pytest.fixture(scope="module")
def page(make, tmp_path_factory):
    folder = tmp_path_factory.mktemp("material")
    (folder / "red.usda").write_text(MATERIAL)
    (folder / "controls.json").write_text(json.dumps(CONTROLS))
    return make("red.html", folder / "red.usda", "--controls", folder / "controls.json", "--compare",
                "--compareWidth", 48, "--compareSamples", 64)


@pytest.fixture
def shown(page, chromium):
    chromium.open(page, SMALL)
    chromium.evaluate("page.state.samples = 4; viewer.invalidate(); viewer.settle();")
    yield chromium
    assert chromium.messages() == []


def middle(picture):
    h, w = picture.shape[:2]
    return picture[h * 3 // 8:h * 5 // 8, w * 3 // 8:w * 5 // 8].mean(axis=(0, 1))


def test_a_page_of_one_material_is_small(page):
    assert os.path.getsize(page) < 3e6


def test_sliders_change_the_picture(shown):
    before = middle(shown.picture())
    assert before[0] > 3.0 * before[2]
    control = """const set = page.panel.gui.controllersRecursive().find(c => c._name === "color");
                 set.setValue([0, 0, 1]);"""
    after = middle(shown.picture(control))
    assert after[2] > 3.0 * after[0]


def test_presets_and_reset(shown):
    click = "page.panel.gui.controllersRecursive().find(c => c._name === 'blue').$button.click()"
    blue = middle(shown.picture(click))
    assert blue[2] > 3.0 * blue[0]
    red = middle(shown.picture("page.reset(); page.state.samples = 4"))
    assert red[0] > 3.0 * red[2]


def test_the_exported_picture_is_the_canvas(shown, tmp_path):
    path = str(tmp_path / "out.png")
    assert shown.download("[data-action=png] button", path) == "red.png"
    import _patina

    saved = np.asarray(_patina.read_image(path).pixels)[..., :3]
    canvas = shown.evaluate("""viewer.redraw(); viewer.step();
        const copy = document.createElement("canvas"); copy.width = viewer.width; copy.height = viewer.height;
        const context = copy.getContext("2d"); context.drawImage(viewer.canvas, 0, 0);
        return Array.from(context.getImageData(0, 0, copy.width, copy.height).data);""")
    canvas = np.array(canvas).reshape(96, 96, 4)[..., :3]
    assert np.array_equal(np.round(saved * 255.0), canvas) and canvas.std() > 10.0


def test_a_wedge_goes_along_an_input(shown):
    picture = shown.picture("""
        const input = page.state.current.inputs.findIndex(i => i.input.endsWith("bsdf.weight"));
        page.state.wedge = { input, component: 0, from: 0, to: 1, count: 4 }; page.state.backdrop = false""")
    steps = [picture[40:56, 24 * i + 8:24 * i + 16, 0].mean() for i in range(4)]
    assert steps[0] < 1e-3 and np.all(np.diff(steps) > 0.3 * np.diff(steps).mean())


def test_the_wipe_shows_the_path_traced_picture(shown):
    halves = shown.evaluate("""page.state.wipe = 0; viewer.redraw(); viewer.step();
        const copy = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
        copy.drawImage(viewer.canvas, 0, 0); const traced = Array.from(copy.getImageData(0, 0, 96, 96).data);
        page.state.wipe = 1; viewer.redraw(); viewer.step();
        copy.drawImage(viewer.canvas, 0, 0); return [traced, Array.from(copy.getImageData(0, 0, 96, 96).data)];""")
    traced, own = (np.array(x, float).reshape(96, 96, 4)[..., :3] for x in halves)
    assert not np.array_equal(traced, own)
    assert np.abs(traced.mean(axis=(0, 1)) - own.mean(axis=(0, 1))).max() < 6.0


def test_flip_is_that_of_its_authors(shown):
    pytest.importorskip("flip_evaluator")
    from patina.cli import imageMetrics
    from patina.view import images

    flip, reference = shown.evaluate("return [await page.measureFlip(), page.data.references[0].image]")
    own = shown.picture("page.paused = true; viewer.resize(48, 48)")
    a, b = (np.round(255.0 * images.display_values(x)).astype(np.float32) / 255.0
            for x in (own, images.unpacked(reference)))
    assert flip == pytest.approx(imageMetrics.mean_flip(a, b, False), abs=2e-3)
    shown.evaluate("page.state.rotation = 1;")
    assert shown.evaluate("return await page.measureFlip()") is None


def test_a_saved_layer_opens_again(shown, page, tmp_path, capsys):
    from patina.cli import main

    shown.evaluate(f"{COLOR}[0] = 0.25; {COLOR}[1] = 0.5; viewer.invalidate();")
    path = os.path.join(os.path.dirname(page), "saved.usda")
    assert shown.download("[data-action=layer] button", path) == "red.usda"
    assert main.main(["explain", path + ":/look/red"]) == 0
    reported = capsys.readouterr().out
    assert "0.25" in reported and "0.5" in reported and "ND_oren_nayar_diffuse_bsdf" in reported


def test_a_link_holds_the_values(shown, page, chromium):
    link = shown.evaluate(f"{COLOR}[0] = 0.125; page.state.exposure = 1.5; return page.state.toText()")
    chromium.open(page, SMALL + "#" + link)
    assert chromium.evaluate(f"return [{COLOR}[0], page.state.exposure]") == [0.125, 1.5]
    chromium.open(page, SMALL + "#%7B%22material%22%3A1e9%2C%22values%22%3A%22x%22%2C%22eye%22%3A%5B%22a%22%5D%7D")
    assert chromium.evaluate("return page.state.material") == 0


HARMFUL = {
    "no length": '{"values":{"0":{"length":0}}}',
    "lists of methods": '{"values":{"length":0,"map":{"0":[1]},"-1":{"0":[1]},"0":{"00":[1],"1e0":[1],"map":[1]}}}',
    "texts": '{"values":"0","choices":"0","lights":"0","methods":"0","wedge":"0"}',
    "infinite numbers": '{"rotation":1e999,"exposure":-1e999,"environmentGain":1e999,"ambient":[1e999,0,0],"samples":1e999}',
    "too large numbers": '{"rotation":1e300,"exposure":1e39,"eye":[1e39,0,0],"values":{"0":{"0":[1e39]}}}',
    "a choice of a method": '{"choices":["toString"]}', "choices in no list": '{"choices":[{"toString":1,"valueOf":1}]}',
    "choices without end": '{"choices":[[1e999]]}',
    "a wedge of a method": '{"wedge":{"input":"map","from":0,"to":1,"count":3}}',
    "a wedge without end": '{"wedge":{"input":0,"from":0,"to":1e999,"count":3}}',
    "lights without end": '{"lights":[{"on":true,"gain":1e999,"color":[1,1,1]}]}',
    "a list": "[]",
    "a length without end": '{"values":{"0":{"length":4294967295}}}',  # last: it stops a page that takes it
}
DIFFERS = """viewer.invalidate(); viewer.step();
    const { eye, ...changed } = JSON.parse(decodeURIComponent(page.state.toText()) || "{}");
    const { values, choices } = page.state, { inputs, choices: own } = page.state.current;
    const fits = values.length === 1 && values[0].length === inputs.length && values[0].every(v => Array.isArray(v)) &&
        choices.length === 1 && choices[0].length === own.length && page.state.eye.every(Number.isFinite);
    return [changed, fits];"""


def test_a_link_does_no_harm(page, chromium):
    """What does not fit is left out: the page is that of no link."""
    chromium.open(page, "?width=32#" + urllib.parse.quote(HARMFUL["infinite numbers"]))
    assert chromium.evaluate(DIFFERS) == [{}, True]
    for name, text in HARMFUL.items():
        link = json.dumps(urllib.parse.quote(text))
        assert chromium.evaluate(f"page.state.reset(); page.state.fromText({link});" + DIFFERS) == [{}, True], name
    wedge = {"input": 0, "component": {"valueOf": 1, "toString": 1}, "from": 0, "to": 1, "count": 3}
    link = json.dumps(urllib.parse.quote(json.dumps({"wedge": wedge})))
    assert chromium.evaluate(f"page.state.fromText({link}); return page.state.wedge") == {**wedge, "component": 0}
    chromium.open(page, "?width=32#" + urllib.parse.quote(HARMFUL["a length without end"]))
    assert chromium.evaluate(DIFFERS) == [{}, True] and chromium.messages() == []


def test_keys_turn_the_shape_and_change_exposure(shown):
    before = shown.evaluate("return page.state.eye")
    shown.evaluate("viewer.canvas.focus()")
    shown.press("ArrowLeft")
    shown.press("]")
    eye, exposure = shown.evaluate("page.beforeStep(); return [page.state.eye, page.state.exposure]")
    assert np.linalg.norm(np.subtract(eye, before)) > 0.1 and exposure == 0.5
    assert abs(np.linalg.norm(eye) - np.linalg.norm(before)) < 1e-3


def test_a_phone_has_the_panel_below(page, chromium):
    chromium.open(page, width=360, height=640, touch=True)
    boxes = chromium.evaluate("""const box = id => document.getElementById(id).getBoundingClientRect();
        return [box("view").width, box("view").bottom, box("panel").top, document.documentElement.scrollWidth]""")
    assert boxes[0] == 360 and boxes[1] <= boxes[2] and boxes[3] == 360
    assert chromium.messages() == []


def test_without_webgl2_the_page_says_so(page, chromium):
    chromium.open(page, gl=False)
    assert "WebGL 2" in chromium.evaluate("return document.getElementById('problem').textContent")
    assert chromium.messages() == []
