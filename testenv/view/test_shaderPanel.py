# SPDX-License-Identifier: Apache-2.0
"""The shader in the page: its text is what the page draws with, and changes to it are compiled and drawn."""
import numpy as np
import pytest

from accessibility import axe_script, violations
from usda import material

MATERIAL = "#usda 1.0\n" + material("red", {
    "base": ("ND_oren_nayar_diffuse_bsdf", {"color": (0.1, 0.3, 0.7)}),
    "coat": ("ND_dielectric_bsdf", {"weight": 0}),
    "layer": ("ND_layer_bsdf", {"top": "<coat>", "base": "<base>"}),
    "surface": ("ND_surface", {"bsdf": "<layer>"}),
})
# Tells every text that a driver is given from here on.
SPY = """const gl = viewer.renderer.getContext(), own = gl.shaderSource.bind(gl);
window.sent = []; gl.shaderSource = (shader, text) => { window.sent.push(text); own(shader, text); };"""


@pytest.fixture(scope="module")
def page(make, tmp_path_factory):
    file = tmp_path_factory.mktemp("shader") / "red.usda"
    file.write_text(MATERIAL)
    return make("shader.html", file)


@pytest.fixture
def shown(page, chromium):
    if not chromium.shows(page):
        chromium.open(page, "?width=48", width=1000, height=800)
    chromium.picture("""page.code.edits.drafts.clear(); page.reset(); page.state.samples = 4; page.code.key = "";
        page.code.part = "material"; page.drawer.close(); page.drawer.toggle(page.code);""")
    yield chromium
    assert chromium.messages() == []


def text_of(browser):
    return browser._page.locator("#codeText").input_value()


def write(browser, text):
    browser._page.evaluate("""text => { const area = document.getElementById("codeText");
        area.value = text; area.dispatchEvent(new Event("input")); }""", text)


def compile_it(browser):
    browser.evaluate("await page.code.compile();")


def state_of(browser):
    return browser._page.locator("#codeState").inner_text()


def middle(picture):
    return picture[18:30, 18:30].mean(axis=(0, 1))


def red(text):
    """The text of a material that shines red, whatever light there is."""
    body = text.index("{", text.index("vec3 materialEmission("))
    return text[:body + 1] + "\n    return vec3(3.0, 0.0, 0.0);" + text[body + 1:]


def test_the_panel_shows_the_text_that_is_drawn(shown):
    shown.evaluate(SPY + """for (const { made } of viewer.content.programs.values()) made.dispose();
                             viewer.content.programs.clear(); viewer.invalidate(); viewer.settle();""")
    parts = {}
    for part in ("head", "material", "page"):
        shown._page.locator(".code select").select_option(part)
        parts[part] = text_of(shown)
    whole = parts["head"] + parts["material"] + parts["page"]
    sent = shown.evaluate("return window.sent")
    assert any(text.startswith("#version 300 es\n") and text.endswith(whole) for text in sent)
    assert "orenNayar" in parts["material"] and len(whole.split("\n")) > 1000 > len(parts["material"].split("\n"))


def test_an_edit_is_drawn_and_taken_back(shown):
    before = shown.picture()
    assert middle(before)[2] > middle(before)[0]
    generated = text_of(shown)
    write(shown, red(generated))
    assert "not compiled" in state_of(shown)
    assert np.array_equal(shown.picture(), before)
    compile_it(shown)
    assert "as the page draws" in state_of(shown)
    after = middle(shown.picture())
    assert after[0] > 2.9 and after[0] > 3.0 * after[1:].max()
    shown._page.click("#codeRevert")
    assert text_of(shown) == generated
    assert np.array_equal(shown.picture(), before)


def test_an_error_stands_at_its_line_and_the_picture_stays(shown):
    generated = text_of(shown)
    write(shown, red(generated))
    compile_it(shown)
    before = shown.picture()
    lines = red(generated).split("\n")
    lines[19] += " int wrong = 1.5;"
    write(shown, "\n".join(lines))
    compile_it(shown)
    assert "1 error" in state_of(shown)
    assert shown._page.locator("#codeErrors li").all_inner_texts()[0].startswith("line 20")
    assert shown._page.locator(".numbers .error").all_inner_texts() == ["\u25cf 20"]
    assert shown._page.locator("#codeText").get_attribute("aria-invalid") == "true"
    assert np.array_equal(shown.picture(), before)
    shown._page.click("#codeErrors button")
    picked = shown.evaluate("const a = document.activeElement; return a.value.slice(a.selectionStart, a.selectionEnd)")
    assert picked == lines[19]
    write(shown, "\n".join(["", "", *lines]))  # the caret stands at the end: two lines more are told below it alone
    compile_it(shown)
    assert shown._page.locator("#codeErrors li").all_inner_texts()[0].startswith("line 22")


def test_errors_of_the_library_name_their_part(shown):
    shown._page.locator(".code select").select_option("page")
    lines = text_of(shown).split("\n")
    lines[2] = "nonsense " + lines[2]
    write(shown, "\n".join(lines))
    shown._page.locator(".code select").select_option("material")
    compile_it(shown)
    assert shown._page.locator("#codeErrors li").all_inner_texts()[0].startswith("page line 3")
    assert shown._page.locator(".code select").input_value() == "page"
    shown._page.click("#codeRevert")


def test_edits_stay_with_their_text(shown):
    """A slider that the text reads moves it; one that needs another text shows that, and the edit comes back."""
    generated = text_of(shown)
    edited = red(generated)
    write(shown, edited)
    compile_it(shown)
    start = middle(shown.picture())
    value = "page.state.values[0][page.state.current.inputs.findIndex(i => i.input.endsWith('{}'))]"
    dark = middle(shown.picture(value.format("base.color") + ".fill(0)"))
    assert dark[0] > 2.9 and dark[2] < start[2]
    other = shown.picture(value.format("coat.weight") + "[0] = 0.5")
    assert middle(other)[0] < 2.0
    shown.evaluate("page.beforeStep()")
    assert text_of(shown) not in (generated, edited) and "come back" in state_of(shown)
    again = middle(shown.picture(value.format("coat.weight") + "[0] = 0"))
    shown.evaluate("page.beforeStep()")
    assert np.array_equal(again, dark) and text_of(shown) == edited
    shown.evaluate("page.reset(); page.state.samples = 4; page.beforeStep()")
    assert text_of(shown) == edited and "not compiled" in state_of(shown)
    assert middle(shown.picture())[0] < 2.0


def test_a_long_text_stays_quick_and_no_markup(shown):
    generated = text_of(shown)
    evil = "// <img src=x onerror=alert(1)></textarea><script>alert(2)</script>\n"
    write(shown, evil + generated + "\n" * 10000 + "int last() { return 1; }\n")
    rows = shown.evaluate("page.code.editor.goTo(10170); return document.querySelectorAll('.back > div').length")
    assert rows < 60  # those in view
    compile_it(shown)
    assert "as the page draws" in state_of(shown) and shown.evaluate("return document.images.length") == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_keyboard_and_screen_readers(shown, scheme):
    shown._page.emulate_media(color_scheme=scheme)
    lines = text_of(shown).split("\n")
    shown._page.locator("#codeText").fill("\n".join(["wrong", *lines]))
    shown.press("Control+Enter")
    shown.evaluate("while (page.code.busy) await new Promise(done => setTimeout(done, 20));")
    assert "1 error" in state_of(shown)
    assert not violations(shown, axe_script())
    shown._page.keyboard.press("Escape")
    assert shown.evaluate("return [document.activeElement.id, document.getElementById('drawer').hidden]") == ["view", True]
    shown.press("c")
    reached = []
    for _ in range(12):
        shown.press("Tab")
        reached.append(shown.evaluate("return document.activeElement.id || document.activeElement.tagName"))
        if reached[-1] == "codeText":
            break
    assert {"SELECT", "codeCompile", "codeRevert", "codeText"} <= set(reached)
