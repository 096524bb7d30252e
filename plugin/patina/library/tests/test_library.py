# SPDX-License-Identifier: Apache-2.0
"""The library's documents: read without a word, as bright as their indices say, and the same in both back ends."""
import os
import xml.etree.ElementTree

import numpy as np
import pytest

import _patina
from patina.cli import main, materials
from patina.cli.errors import CommandError
from patina.library import catalog, page, pictures

ENTRIES = catalog.entries()
NAMES = [entry.name for entry in ENTRIES]
WO = np.array([[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, -0.95, 0.3122499]], np.float32)
WI = np.array([[0.3, 0.1, 0.9486833], [-0.5, 0.2, 0.842615], [0.1, 0.7, 0.7071068]], np.float32)


def _network(name):
    return materials.load(catalog.PREFIX + name)[0][0][1]


def _input(name, category, port):
    node = xml.etree.ElementTree.parse(catalog.path_of(name)).getroot().find(category)
    return np.array([float(x) for x in node.find(f"input[@name='{port}']").get("value").split(",")])


def test_forty_materials_tell_of_themselves():
    assert len(ENTRIES) == 40 and len(set(NAMES)) == 40
    for entry in ENTRIES:
        assert os.path.basename(entry.path) == entry.name + ".mtlx"
        assert entry.title and entry.group in catalog.GROUPS
        # A number is somebody's measurement, a curve that is named, or designed.
        assert any(word in entry.source for word in ("designed", "ior", "19", "20")), entry


@pytest.mark.parametrize("name", NAMES)
def test_it_is_read_without_a_warning_and_gains_no_light(name):
    found, warnings = materials.load(catalog.PREFIX + name)
    assert warnings == [] and len(found) == 1
    probe = _patina.MaterialProbe(found[0][1])
    assert list(probe.warnings) == []
    albedo = probe.albedo(WO)
    assert np.isfinite(albedo).all() and (albedo >= 0.0).all()
    assert (albedo <= 1.0 + 1e-3).all()  # tables and fits of albedos meet within 1e-3


@pytest.mark.parametrize("name", [entry.name for entry in ENTRIES if entry.group == "Metals" and entry.name != "hematite"])
def test_a_metal_reflects_what_its_index_says(name):
    """Along the normal, where facets of a small roughness are met head on (Fresnel 1823)."""
    n, k = _input(name, "conductor_bsdf", "ior"), _input(name, "conductor_bsdf", "extinction")
    wanted = ((n - 1.0) ** 2 + k ** 2) / ((n + 1.0) ** 2 + k ** 2)
    albedo = _patina.MaterialProbe(_network(name)).albedo(WO[:1])[0]
    # Albedo tables and fits of metals' curves meet within 3e-3 each.
    np.testing.assert_allclose(albedo, wanted, atol=6e-3)


@pytest.mark.parametrize("name", NAMES)
def test_check_passes(name):
    assert main.main(["check", catalog.PREFIX + name, "--places", "1", "--samples", "16384"]) == 0


@pytest.mark.parametrize("name", ["brass", "velvet", "carPaint"])
def test_both_back_ends_see_the_same(name):
    network = _network(name)
    try:
        drawn = _patina.RasterProbe(network)
    except RuntimeError as error:
        pytest.skip(f"no OpenGL: {error}")
    np.testing.assert_allclose(drawn.eval(WO, WI)[0], _patina.MaterialProbe(network).eval(WO, WI)[0], rtol=1e-3, atol=1e-5)


def test_names_that_are_none_are_told():
    with pytest.raises(CommandError, match="no material golf .did you mean gold"):
        materials.load("library:golf")
    assert main.main(["view", "--library", "library:gold", "-o", "x.html"]) == 2


def test_the_page_holds_both_pictures_of_each_and_no_markup_of_names():
    hostile = catalog.Entry("x", "<script>alert(1)</script>", "Metals", "\"><b>", catalog.path_of("chalk"))
    text, warnings = page.document(16, 1, [catalog.entries()[0], hostile])
    assert warnings == []
    assert text.count("<article") == 2 and text.count('src="data:image/png') == 4
    assert text.count("<script") == 1 and "<b>" not in text
    assert "Content-Security-Policy" in text and "PATINA_" not in text


def test_hair_is_shown_as_hair():
    drawn = []

    class Edit:
        def set_curves(self, path, **fields):
            drawn.append((path, fields))

    pictures.lock()(Edit())
    fields = drawn[0][1]
    assert len(fields["points"]) == fields["curve_vertex_counts"].sum() and np.isfinite(fields["points"]).all()
