# SPDX-License-Identifier: Apache-2.0
"""The plan in the page: it lists what `patina explain` lists, and a method that was not taken changes the picture as its
numbers say."""
import json
import re

import numpy as np
import pytest

from accessibility import axe_script, violations
from usda import material
from test_hostile import EVIL, green

MATERIAL = "#usda 1.0\n" + material("metal", {
    "metal": ("ND_conductor_bsdf", {"roughness": (0.8, 0.8)}),
    "body": ("ND_mix_bsdf", {"fg": "<metal>", "bg": "<other>", "mix": 1}),
    "other": ("ND_oren_nayar_diffuse_bsdf", {}),
    "surface": ("ND_surface", {"bsdf": "<body>"}),
})
FAR = 60.0  # radii: light that the camera sees is all but parallel, so that a sphere shows every cosine by its share


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    file = tmp_path_factory.mktemp("plan") / "metal.usda"
    file.write_text(MATERIAL)
    return file


@pytest.fixture(scope="module")
def page(make, file):
    return make("plan.html", file)


@pytest.fixture
def shown(page, chromium):
    if not chromium.shows(page):
        chromium.open(page, "?width=48", width=1000, height=800)
    chromium.picture("page.reset(); page.state.samples = 4; page.drawer.close(); page.drawer.toggle(page.plan);")
    yield chromium
    assert chromium.messages() == []


def texts(browser, selector):
    return browser._page.locator(selector).all_inner_texts()


def test_it_lists_what_explain_lists(shown, file, tmp_path):
    from patina.cli import main

    assert main.main(["explain", str(file), f"--json={tmp_path / 'plan.json'}"]) == 0
    told = json.loads((tmp_path / "plan.json").read_text())["materials"][0]
    lines = told["text"].rstrip().split("\n\n")[-1].split("\n")
    assert texts(shown, "#planKept li") == [x for x in lines if not x.startswith(("left out: ", "method "))]
    left = [x[len("left out: "):] for x in lines if x.startswith("left out: ")]
    assert texts(shown, "#planLeftOut li") == left and any("background left out" in x for x in left)
    methods = dict(re.match(r"method (\w+) = (\w+)", x).groups() for x in lines if x.startswith("method "))
    pressed = shown.evaluate("return [...document.querySelectorAll('.plan [aria-pressed=true]')].map(b => b.ariaLabel)")
    assert pressed == [f"as planned: {point} {name}" for point, name in methods.items()]
    plan = {c["point"]: c for c in shown.evaluate("return page.state.current.plan.choices")}
    for choice in told["plan"]["choices"]:
        row = next(m for m in plan[choice["point"]]["methods"] if m["name"] == choice["method"])
        assert row["error"] == (choice["error"] if choice["measured"] else None)


USE = """const choice = page.state.current.plan.choices.find(c => c.point === "{}");
const method = choice.methods.find(m => m.name === "{}");"""


def test_a_method_changes_the_picture_as_its_albedo_says(shown):
    """In even light of 1, the mean over the disk of a sphere is its albedo. The measurement leaves out pixels at the edge:
    with a disk of 40 pixels' radius at most 2 / 40 of the area, which may change by all else than the rest; so a tenth of the
    change is the margin, and a hundredth for the noise of 4000 pixels of 16 samples."""
    shown.evaluate(f"""const {{ state, data }} = page, away = {FAR} * data.camera.radius;
        state.samples = 16; state.environment = data.environments.findIndex(e => e.name === "even");
        state.shape = data.shapes.findIndex(s => s.name === "sphere");
        state.eye = [0, 1, 2].map(i => data.camera.target[i] + (i === 2 ? away : 0));
        window.fov = data.camera.fov; data.camera.fov = 2.4 * 180 / Math.PI / {FAR};
        viewer.camera.far = 2 * away; page.placeCamera();""")
    measured = """const m = await page.plan.use(choice, method);
        return [m.before, m.after, page.state.current.plan.albedo, method.albedo, m.flip];"""
    before, after, albedo, other, flip = shown.evaluate(USE.format("energyCompensation", "none") + measured)
    assert np.allclose(before, albedo, rtol=0.1) and flip > 0.05
    change, predicted = np.divide(after, before) - 1.0, np.divide(other, albedo) - 1.0
    assert (predicted < -0.1).all(), "the material is too smooth to show the method"
    assert np.all(np.abs(change - predicted) <= 0.1 * np.abs(predicted) + 0.01), (change, predicted)
    said = shown._page.locator("#planState").inner_text()
    assert "energyCompensation none instead of turquin" in said and "\u2212" in said and "predicted error" in said
    assert shown._page.locator("#planPicture canvas").count() == 1
    # Without layers the albedo's method decides nothing that is seen, and the number says so.
    before, after, albedo, other, flip = shown.evaluate(
        USE.format("directionalAlbedo", "karis") + measured)
    assert albedo == other and before == after and flip == 0.0
    mixed = shown.evaluate("""const effect = page.state.current.plan.effects.find(e =>
        page.state.current.inputs[e.input].input.endsWith("body.mix")); const m = await page.plan.move(effect.input, effect.to);
        page.data.camera.fov = window.fov; return [m.after, effect.albedo];""")
    assert np.allclose(*mixed, rtol=0.05)


def test_a_method_is_drawn_until_it_is_taken_back(shown, page, chromium):
    before = shown.picture()
    shown.evaluate(USE.format("energyCompensation", "kullaConty") + "await page.plan.use(choice, method)")
    other = shown.picture()
    assert np.abs(other - before).max() > 0.01
    pressed = shown.evaluate("return [...document.querySelectorAll('.plan [aria-pressed=true]')].map(b => b.ariaLabel)")
    assert "draw: energyCompensation kullaConty" in pressed
    link = shown.evaluate("return page.state.toText()")
    shown._page.click("[aria-label='as planned: energyCompensation turquin']")
    assert np.array_equal(shown.picture(), before)
    chromium.open(page, "?width=48#" + link)
    linked = shown.picture()  # the eye of a link is rounded
    assert np.abs(linked - other).mean() < 0.1 * np.abs(linked - before).mean()


def test_what_has_no_weight_changes_nothing(shown):
    """The text with every input live draws what simplification cut. Both pictures have the same random numbers but in
    lobes that are chosen otherwise, so the bound is that of rounding where no lobe more has a chance."""
    shown._page.click("#planCuts")
    flip, whole = shown.evaluate("""while (page.plan.busy) await new Promise(done => setTimeout(done, 20));
        return [document.getElementById("planState").textContent, page.state.needsAll()];""")
    assert whole and re.search(r"mean FLIP 0\.000\d", flip), flip


def test_methods_without_a_program_say_why(shown):
    for choice in shown.evaluate("return page.state.current.plan.choices"):
        for method in choice["methods"]:
            assert (method["program"] is not None) + bool(method["why"]) + (method["name"] == choice["method"]) == 1, method
    assert shown._page.locator("[aria-label='draw: energyCompensation randomWalk']").count() == 0


def test_names_stay_text(make, chromium, tmp_path):
    (tmp_path / "evil.mtlx").write_text(green(EVIL))
    chromium.open(make("evilPlan.html", tmp_path / "evil.mtlx"), "?width=32")
    for panel in ("code", "plan"):
        chromium.evaluate(f"page.drawer.toggle(page.{panel})")
        assert chromium.evaluate("return document.getElementById('drawerTitle').textContent.endsWith(page.state.current.name)")
        assert chromium.evaluate("return [document.images.length, document.scripts.length]") == [0, 2]
    assert "PATINA_SCRIPT" in chromium._page.locator("#planKept").inner_text()
    assert chromium.messages() == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_keyboard_and_screen_readers(shown, scheme):
    shown._page.emulate_media(color_scheme=scheme)
    assert not violations(shown, axe_script())
    shown.evaluate("document.getElementById('drawerTitle').focus()")
    named = set()
    for _ in range(60):
        shown.press("Tab")
        named.add(shown.evaluate("return document.activeElement.ariaLabel"))
    assert {"draw: directionalAlbedo fit", "draw: sampling boundedVndf"} <= named
