# SPDX-License-Identifier: Apache-2.0
"""The budget of a change: one row of each kind of thing is named in the files of its page in docs/howto and in no others.

Whoever adds a switch over kinds somewhere else needs a file more for each row from then on; this test says so."""
import os
import re

import pytest

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
ROOMS = ("base", "hdDelegate", "materialNetwork", "plugin/hydra", "plugin/python", "plugin/patina", "shaders", "cmake")
SUFFIXES = (".cpp", ".h", ".inc", ".def", ".glsl", ".py", ".ts", ".js", ".cmake", ".txt", ".in")

# Page, what stands in the code for one row, and the files. Rows without anything that only they have.
ROWS = [
    ("lobe", r"[cC]hiangHair(Lobe|Setup|Eval|Sample|Albedo)|Kind::ChiangHair\b|\bChiangHair, chiangHair\b|\"chiang_hair_bsdf\"",
     {"materialNetwork/lobeTable.inc", "shaders/lobes/chiangHair.glsl"}),
    # A baked albedo and a sweep, too.
    ("lobe", r"[wW]ard(Lobe|Setup|Eval|Sample)\b|\bWard, ward\b|::Ward\b|ward_bsdf",
     {"materialNetwork/lobeTable.inc", "shaders/lobes/ward.glsl", "shaders/bake/bakeAlbedo.cpp",
      "plugin/patina/chart/sweepsClassic.py"}),
    # The outline that stands for it in the rasterizer, too: rasterLightPlan.cpp and areaLights.glsl.
    ("light", r"\bSHAPE_DISK\b|Type::Disk\b|\bdisk(Hit|Place|PlaceDensity|Normal|Extent)\b|\bDiskLight\b|\bdiskLight\b",
     {"hdDelegate/scene/lightTypes.inc", "shaders/lights/shapes/disk.glsl", "hdDelegate/raster/scene/rasterLightPlan.cpp",
      "shaders/raster/areaLights.glsl"}),
    ("aov", r"AovId::Neye\b|AOV\(Neye\b", {"hdDelegate/film/aovs.def", "hdDelegate/film/aovValues.h"}),
    # A file of methods and one of measurements, too.
    ("choicePoint", r"\bSHEEN_(TABLED|FITTED|QUADRATURE)\b|(Choice|method)::Sheen\b|\bsheenMethods\b|PATINA_CHOICE\(Sheen\b",
     {"materialNetwork/plan/choicePoints.inc", "shaders/lobes/sheen.glsl", "shaders/lib/methods/sheenReflects.glsl",
      "shaders/measure/measureSheen.cpp"}),
    ("node", r"ND_unpremult|\bunpremult\b|\bnodeUnpremultiply\b", {"shaders/patterns/nodes/color.glsl"}),
]


def sources():
    """:returns: dict of path in the checkout to text, of what is written by hand and is no test"""
    texts = {}
    for room in ROOMS:
        for folder, folders, files in os.walk(os.path.join(ROOT, room)):
            folders[:] = [name for name in folders if name not in ("tests", "node_modules", "__pycache__")]
            for file in files:
                if file.endswith(SUFFIXES):
                    path = os.path.join(folder, file)
                    with open(path, encoding="utf-8") as stream:
                        texts[os.path.relpath(path, ROOT).replace(os.sep, "/")] = stream.read()
    return texts


@pytest.fixture(scope="module")
def texts():
    return sources()


@pytest.mark.parametrize("page, pattern, files", ROWS, ids=[f"{row[0]}{i}" for i, row in enumerate(ROWS)])
def test_a_row_is_named_where_its_page_says(texts, page, pattern, files):
    found = {path for path, text in texts.items() if re.search(pattern, text)}
    assert found == files, f"docs/howto/{page}.md and this test should know {sorted(found ^ files)}"


@pytest.mark.parametrize("name", ["ambientOcclusionSamples", "maxScatterings"])
def test_a_setting_is_named_in_its_row_and_where_it_is_read(texts, name):
    """One reader, in whatever file that is."""
    found = {path for path, text in texts.items() if re.search(rf"\b{name}\b", text)}
    assert len(found - {"hdDelegate/scene/settings.def"}) == 1 and "hdDelegate/scene/settings.def" in found, sorted(found)


def test_pages_name_the_files_of_their_rows():
    """The files of a table, and those that a row may need besides."""
    for page, _, files in ROWS:
        with open(os.path.join(ROOT, "docs", "howto", page + ".md"), encoding="utf-8") as stream:
            text = stream.read()
        for path in files:
            folder = os.path.dirname(path)
            assert path in text or f"`{folder}`" in text or f"{folder}/" in text, (page, path)
