# SPDX-License-Identifier: Apache-2.0
"""The page of `patina record --report`, in a browser: it tells the render's own numbers, needs nothing else, and works."""
import base64
import hashlib
import json
import os
import re

import numpy as np
import pytest

from patina.cli import main
from usda import camera, material, prim, stage

STAGE = stage(
    camera(horizontalAperture=20, verticalAperture=10, at=(0, 0, 10)),
    prim("Sphere", "other"),
    prim("DomeLight", "dome"),
    prim("Scope", "looks",
        material("red", {
            "s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>"}),
            "t": ("UsdUVTexture", {"file": "none<i>.png"})}, inside="/looks", surface="s")),
    prim("Sphere", "ball", "rel material:binding = </looks/red>", at=(0.5, 0, 0)),
    prim("SphereLight", "lamp", at=(5, 5, 5)),
    up="")
SMALL = ("-w", "64", "--samples", "32", "--aov", "depth", "--quiet")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """:returns: folder with an image, its page and its statistics"""
    folder = tmp_path_factory.mktemp("report")
    (folder / "stage.usda").write_text(STAGE)
    os.environ.pop("PATINA_COMMAND", None)
    assert main.main(["record", str(folder / "stage.usda"), str(folder / "a.exr"), *SMALL, "--report", str(folder / "a.html"),
                      f"--json={folder / 's.json'}"]) == 0
    return folder


@pytest.fixture
def shown(made, chromium):
    chromium.open(str(made / "a.html"), width=900, height=800)
    yield chromium
    assert chromium.messages() == []


def statistics(made):
    with open(made / "s.json") as file:
        return json.load(file)


def test_the_image_is_the_one_without_a_report(made):
    import _patina

    assert main.main(["record", str(made / "stage.usda"), str(made / "plain.exr"), *SMALL]) == 0
    a, b = _patina.read_image(str(made / "a.exr")), _patina.read_image(str(made / "plain.exr"))
    assert a.channels == b.channels and np.array_equal(np.array(a.pixels), np.array(b.pixels))


def test_the_page_runs_its_own_script_alone(made):
    with open(made / "a.html", encoding="utf-8") as file:
        text = file.read()
    script = re.search(r"<script>(.*?)</script>", text, re.DOTALL).group(1)
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"default-src 'none'; script-src 'sha256-{digest}';" in text.partition("<title>")[0]


def test_the_page_tells_the_numbers_of_the_render(made, shown):
    text = shown.evaluate("return document.body.innerText")
    frame = statistics(made)["frames"][0]
    assert "64 × 32" in text and "32" in text and f"{100 * frame['estimatedError']:.2g} %" in text
    for phase in ("read", "translate", "build", "sample", "write"):
        assert phase in text
    assert "/looks/red" in text and "displayColor" in text  # where time went
    assert "UsdPreviewSurface" in shown.evaluate("return document.body.textContent")  # what is modelled of it
    assert statistics(made)["causes"] and all(c["message"][:30] in text for c in statistics(made)["causes"])


def test_time_by_material_adds_up(made):
    frame = statistics(made)["frames"][0]
    spent = frame["materialSeconds"]
    assert {"/looks/red", "", "camera"} <= set(spent) and all(s >= 0.0 for s in spent.values())
    # Threads' seconds: no more than all cores had while it sampled, and a part of it at least.
    assert 0.0 < sum(spent.values()) <= os.cpu_count() * (frame["seconds"]["render"] + frame["seconds"]["build"])


def test_the_pixel_under_the_pointer_is_that_of_the_file(made, shown):
    import _patina

    image = _patina.read_image(str(made / "a.exr"))
    pixels = np.array(image.pixels)
    for x, y in ((36, 16), (1, 2), (63, 31)):
        reported = dict(shown.evaluate(f"return page.describe({x}, {y})"))
        color = [float(n) for n in reported["linear RGB"].split()]
        # Half floats have 2^-11 of error, four digits 5e-4 more.
        assert color == pytest.approx([pixels[y, x, image.channels.index(c)] for c in "RGB"], rel=1.0e-3)
        assert reported["samples"] == "32" and reported["pixel"] == f"{x}, {y}"
        depth = pixels[y, x, image.channels.index("depth.Z")]
        assert reported["depth"] == "nothing is seen" if depth > 1e9 else float(reported["depth"]) == pytest.approx(depth,
                                                                                                                    rel=1e-3)
    assert dict(shown.evaluate("return page.describe(38, 16)"))["prim"] == "/ball"


def test_the_divider_and_the_choices_work(shown):
    names = shown.evaluate("return page.data.layers.map(l => l.label)")
    assert names[:3] == ["image", "error", "samples"] and {"albedo", "normal", "depth", "prims"} <= set(names)
    clip = "return document.getElementById('right').style.clipPath"
    assert shown.evaluate(clip) == "inset(0px 0px 0px 50%)"
    shown.evaluate("document.getElementById('divider').focus()")
    shown.press("ArrowRight")
    assert shown.evaluate(clip) == "inset(0px 0px 0px 52%)"
    shown.press("End")
    assert shown.evaluate("return page.state.share") == 1
    shown.press("3")
    assert shown.evaluate("return [page.state.right, document.getElementById('rightTag').textContent]") == [2, "samples"]
    shown.press("s")
    assert shown.evaluate("return [page.state.left, page.state.right]") == [2, 0]
    assert shown.evaluate("return document.getElementById('sheet').getBoundingClientRect().width") > 500
    shown.evaluate("document.querySelector('[data-zoom=\"2\"]').click()")
    assert shown.evaluate("return document.getElementById('sheet').getBoundingClientRect().width") == 128


def test_all_pictures_are_whole(shown):
    sizes = shown.evaluate("""const all = page.data.layers.map(async l => { const i = new Image(); i.src = l.uri;
        await i.decode(); return [i.naturalWidth, i.naturalHeight]; }); return Promise.all(all);""")
    assert sizes and all(size == [64, 32] for size in sizes)


def test_the_command_renders_the_same(made, shown):
    import shlex

    words = shlex.split(shown.evaluate("return document.getElementById('command').textContent"))
    assert words[0] == "cd" and words[2:5] == ["&&", "patina", "record"] and str(made / "a.exr") in words


def test_names_of_a_stage_are_text(made, shown):
    """A texture is named as an element."""
    assert "none<i>.png" in shown.evaluate("return document.body.innerText")
    assert shown.evaluate("return document.querySelectorAll('i:not(.legend i)').length") == 0


@pytest.mark.parametrize("report, status", [("a.txt", 2), ("none/a.html", 1), ("stage.usda", 2)])
def test_a_page_has_a_place(made, report, status, capsys):
    assert main.main(["record", str(made / "stage.usda"), str(made / "b.png"), "-w", "8", "--samples", "1", "--quiet",
                      "--report", str(made / report)]) == status
    assert not os.path.exists(made / "b.png") and len(capsys.readouterr().err.splitlines()) == 1


def test_each_frame_has_a_page_where_its_name_has_a_place(made):
    for name, pages in (("f.#.html", ["f.1.html", "f.2.html"]), ("last.html", ["last.html"])):
        assert main.main(["record", str(made / "stage.usda"), str(made / "f.#.png"), "-w", "16", "--samples", "2", "--quiet",
                          "--frames", "1:2", "--report", str(made / name)]) == 0
        assert sorted(p.name for p in made.glob(name.replace("#", "*"))) == pages
    text = (made / "last.html").read_text()
    assert "<h2>Frames</h2>" in text and "f.1.png" in text and "f.2.png" in text


def test_errors_that_are_not_finite_are_counted_and_left_out():
    from patina.report import pictures, sections

    error = np.array([[0.01, np.inf], [np.nan, 0.02]])
    facts = sections.Facts(**dict.fromkeys(sections.Facts.__dataclass_fields__))
    facts.error, facts.samples, facts.window = error, np.ones((2, 2)), (0, 0, 1, 1)
    text = sections._pixels(facts)
    assert "the worst, pixel 1, 1" in text and "left out" in text and '<td class="n">2</td>' in text
    assert pictures.heat("error", error, log=True)["legend"]["high"] == 0.02
    facts.error = np.full((2, 2), np.nan)
    assert "No pixel has a finite number" in sections._pixels(facts)
