# SPDX-License-Identifier: Apache-2.0
"""Every input has a control: numbers slide, what decides the program is chosen from a list, the rest says why it is fixed."""
import os

import numpy as np
import pytest

from usda import material

MATERIAL = "#usda 1.0\n" + material("plastic", {
    "base": ("ND_oren_nayar_diffuse_bsdf", {"color3f color": "<noise>"}),
    "noise": ("ND_fractal3d_color3", {"int octaves": "2"}),
    "coat": ("ND_dielectric_bsdf", {"distribution": "ggx", "roughness": (0.2, 0.2)}),
    "layer": ("ND_layer_bsdf", {"top": "<coat>", "base": "<base>"}),
    "surface": ("ND_surface", {"bsdf": "<layer>"}),
})
CONTROL = "page.panel.gui.controllersRecursive().find(c => c._name === '{}')"


@pytest.fixture(scope="module")
def page(make, tmp_path_factory):
    file = tmp_path_factory.mktemp("inputs") / "plastic.usda"
    file.write_text(MATERIAL)
    return make("plastic.html", file)


def test_a_page_of_many_programs_is_small(page):
    assert os.path.getsize(page) < 3e6


def test_whole_numbers_and_choices_change_the_picture(page, chromium):
    chromium.open(page, "?width=48")
    start = chromium.picture("page.panel.gui.foldersRecursive().forEach(f => f.fill?.()); page.state.samples = 4")
    kinds = {c["label"]: c["kind"] for c in chromium.evaluate("return page.state.current.controls")}
    assert kinds["octaves"] == "number" and kinds["distribution"] == kinds["energy compensation"] == "choice"
    assert kinds["scatter mode"] == "choice"
    octaves = chromium.picture(CONTROL.format("octaves") + ".setValue(6)")
    assert np.abs(octaves - start).max() > 0.01
    chromium.evaluate("page.reset()")
    beckmann = chromium.picture("page.state.samples = 4;" + CONTROL.format("distribution") + ".setValue(1)")
    assert np.abs(beckmann - start).max() > 0.01
    same = chromium.picture("page.reset(); page.state.samples = 4")
    assert np.abs(same - start).max() < 1e-6
    assert chromium.messages() == []


def test_choices_are_saved_and_linked(page, chromium, tmp_path, capsys):
    from patina.cli import main

    chromium.open(page, "?width=48")
    link = chromium.evaluate(CONTROL.format("distribution") + ".setValue(1); return page.state.toText()")
    path = os.path.join(os.path.dirname(page), "chosen.usda")
    chromium.download("[data-action=layer] button", path)
    assert 'string inputs:distribution = "beckmann"' in open(path, encoding="utf-8").read()
    assert main.main(["explain", path + ":/plastic"]) == 0
    assert "beckmann" in capsys.readouterr().out
    chromium.open(page, "?width=48#" + link)
    assert chromium.evaluate("return page.state.choices[0].includes(1)")
    assert chromium.messages() == []


def test_a_saved_layer_has_numbers_of_its_types(page, chromium, tmp_path, capsys):
    """OpenUSD refuses a layer that gives a boolean or an integer a fraction, which a link may hold."""
    from patina.cli import main

    chromium.open(page, "?width=48")
    chromium.evaluate("""page.paused = true; const at = end => page.state.current.inputs.findIndex(i => i.input.endsWith(end));
        const values = page.state.values[0]; values[at(".octaves")] = [1e12]; values[at(".thin_walled")] = [0.37];""")
    path = os.path.join(os.path.dirname(page), "typed.usda")
    chromium.download("[data-action=layer] button", path)
    text = open(path, encoding="utf-8").read()
    assert "int inputs:octaves = 2147483647\n" in text and "bool inputs:thin_walled = 1\n" in text
    assert main.main(["explain", path + ":/plastic"]) == 0
    assert capsys.readouterr().err == "" and chromium.messages() == []


def test_more_choices_than_programs_are_fixed_with_the_reason():
    from patina.view import choices

    made = [choices.Choice("/m/n", "", f"c{i}", "boolean", choices.OFF_ON, 0, i == 29) for i in range(30)]
    found, left = choices.combinations(made)
    assert len(found) == choices.MAX_PROGRAMS and len(set(found)) == len(found) and 29 not in left
    assert len(left) == 30 - (choices.MAX_PROGRAMS - 1)
    few, none = choices.combinations(made[:3])
    assert len(few) == 8 and not none


SURFACES = {"open": ("ND_open_pbr_surface_surfaceshader", "transmission_dispersion_scale"),
            "standard": ("ND_standard_surface_surfaceshader", "transmission_dispersion"),
            "gltf": ("ND_gltf_pbr_surfaceshader", "dispersion")}


def dispersive(module, name, given=None, behind=False):
    """A network of a surface model; `behind` a node that hands the number on."""
    node, input_ = SURFACES[name]
    network = module.Network("/m")
    network.add_node("/m/s", node)
    network.set_terminal("surface", "/m/s", "")
    if name == "gltf":
        network.set_input("/m/s", "metallic", "float", 0.0)  # metal has nothing to disperse
    if behind:
        network.add_node("/m/p", "ND_multiply_float")
        network.set_input("/m/p", "in1", "float", given or 0.0)
        network.connect("/m/s", input_, "/m/p", "")
    elif given is not None:
        network.set_input("/m/s", input_, "float", given)
    return network


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("behind", [False, True])
def test_what_is_not_modelled_is_told_where_an_author_asks_for_it(name, behind):
    """The page opens inputs to move them, which asks for nothing."""
    from patina.cli import compiled
    from patina.view import materials

    module = compiled.load()
    for given in (None, 0.0, 0.5):
        page, _, warnings = materials.build("m", dispersive(module, name, given, behind), {}, materials.Textures(16))
        reported = [w for w in warnings if w["id"] == "dispersionLeftOut"]
        assert len(reported) == len(warnings) == (1 if given else 0), (given, warnings)
        keys = {i["input"] for i in page["inputs"]}
        assert "/m/s.base_color" in keys  # all others keep their sliders
        assert given or f"/m/s.{SURFACES[name][1]}" not in keys and "/m/p.in1" not in keys
