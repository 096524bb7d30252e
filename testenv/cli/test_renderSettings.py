# SPDX-License-Identifier: Apache-2.0
"""--settings: what a UsdRenderSettings prim says of camera, resolution, products, AOVs, purposes and settings is done, and
flags are stronger; --layer: opinions over the stage."""
import json
import os

import numpy as np
import pytest

import _patina
from patina.cli import denoiser, main, products
import usda

STAGE = usda.stage(
    usda.camera(horizontalAperture=20, verticalAperture=10, at=(0, 0, 10)),
    usda.camera("double3 xformOp:translate = (1, 0, 10)", name="side", meta=("inherits = </camera>",)),
    usda.prim("Sphere", "ball", at={1: (0, 0, 0), 3: (100, 0, 0)}),
    usda.prim("Cube", "stand", purpose="proxy", size=40),
    usda.prim("DomeLight", "dome"),
    usda.prim("Scope", "Render",
        usda.prim("RenderSettings", "main", "uniform int2 resolution = (32, 16)", "rel camera = </camera>",
                  "rel products = [</Render/beauty>, </Render/depth>, </Render/other>]", "int patina:samples = 3",
                  'token patina:method:domeLight = "sampled"'),
        usda.prim("RenderSettings", "alone", "uniform int2 resolution = (24, 6)", "uniform float pixelAspectRatio = 2",
                  "rel camera = </side>", "uniform float4 dataWindowNDC = (0.5, 0, 1, 0.5)",
                  'uniform token[] includedPurposes = ["default", "proxy"]', "int patina:seed = 9",
                  "float patina:tolerance = 0.5", "int patina:minSamples = 2"),
        usda.prim("RenderSettings", "odd", "rel products = [</Render/deep>, </ball>, </Render/beauty>]",
                  "float patina:nonsense = 3", 'token patina:cullStyle = "sideways"', "int patina:samples = 1"),
        usda.prim("RenderPass", "empty", "rel renderSource = </Render/main>",
                  "rel collection:prune:includes = [</ball>, </dome>]", apis=("CollectionAPI:prune",)),
        usda.prim("RenderPass", "twice", "rel renderSource = [</Render/main>, </Render/alone>]"),
        usda.prim("RenderProduct", "beauty", "rel orderedVars = [</Render/color>, </Render/alpha>]",
                  productName="beauty.<F4>.exr"),
        usda.prim("RenderProduct", "depth", "rel orderedVars = [</Render/z>, </Render/n>, </Render/nothing>]",
                  productName="depth.%03d.exr"),
        usda.prim("RenderProduct", "other", "rel camera = </side>", "uniform int2 resolution = (20, 10)",
                  productName="other.##.exr"),
        usda.prim("RenderProduct", "deep", 'token productType = "hologram"', productName="deep.exr"),
        usda.prim("RenderVar", "color", 'uniform token dataType = "color3h"', sourceName="Ci"),
        usda.prim("RenderVar", "alpha", sourceName="a"),
        usda.prim("RenderVar", "z", sourceName="cameraDepth"),
        usda.prim("RenderVar", "n", sourceName="normal"),
        usda.prim("RenderVar", "nothing", sourceName="nothing")),
    up="", startTimeCode=1, endTimeCode=3, renderSettingsPrimPath="/Render/main")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "stage.usda").write_text(STAGE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def record(*arguments):
    return main.main(["record", "stage.usda", *map(str, arguments), "--quiet", "--json=s.json"])


def reported():
    with open("s.json") as file:
        return json.load(file)


def image(path):
    return _patina.read_image(str(path))


def pixels(path):
    return np.array(image(path).pixels)


def test_all_products_are_written_and_those_that_are_alike_share_a_render(folder):
    assert record("--settings", "/Render/main", "--frames", "1:3x2") == 0
    made = {"beauty.0001.exr", "beauty.0003.exr", "depth.001.exr", "depth.003.exr", "other.01.exr", "other.03.exr"}
    assert set(os.listdir()) == made | {"stage.usda", "s.json"}
    assert [(f["frame"], f["images"], f["width"], f["height"], f["samplesPerPixel"]) for f in reported()["frames"]] == [
        (1.0, ["beauty.0001.exr", "depth.001.exr"], 32, 16, 3.0), (1.0, ["other.01.exr"], 20, 10, 3.0),
        (3.0, ["beauty.0003.exr", "depth.003.exr"], 32, 16, 3.0), (3.0, ["other.03.exr"], 20, 10, 3.0)]
    assert image("beauty.0001.exr").channels == ["R", "G", "B", "A"]
    assert image("depth.001.exr").channels == ["depth.Z", "normal.X", "normal.Y", "normal.Z"]
    assert image("other.01.exr").metadata["patina:camera"] == "/side"
    assert [(w["prim"], w["input"]) for w in reported()["warnings"]] == [("/Render/nothing", "sourceName")]
    assert not np.array_equal(pixels("beauty.0001.exr"), pixels("beauty.0003.exr"))  # the ball has left


@pytest.mark.parametrize("name", ("../victim.exr", "{folder}/../victim.exr", "link/victim.exr"))
def test_a_stage_names_no_file_outside_of_the_folder_of_products(name, folder, capsys):
    """An image of the user's, which somebody else's stage would replace."""
    work, victim = folder / "work", folder / "victim.exr"
    work.mkdir()
    victim.write_text("precious")
    os.symlink(folder, work / "link")
    os.chdir(work)
    one = name.format(folder=work)
    flags = ["record", "../stage.usda", "--settings", "/Render/main", "--set", f"/Render/beauty.productName={one}",
             "--frames", "1", "-w", "4", "--samples", "1", "--quiet"]
    assert main.main(flags) == 1
    assert capsys.readouterr().err == (f"patina: /Render/beauty names the file '{one}', which is outside of the folder {work}: "
                                       "--outputFolder FOLDER names another folder for products, --allowOutside lets the stage "
                                       "name any\n")
    assert victim.read_text() == "precious" and os.listdir() == ["link"]
    if name.startswith("../"):
        assert main.main([*flags, "--allowOutside"]) == 0
        assert victim.read_bytes() != b"precious" and "victim.exr" not in os.listdir()
        flags[6 - 1] = "/Render/beauty.productName=here.exr"
        assert main.main([*flags, "--outputFolder", "made/deep"]) == 0
        assert set(os.listdir("made/deep")) == {"here.exr", "depth.001.exr", "other.01.exr"}
        assert main.main([*flags, "a.exr", "--outputFolder", "made"]) == 2


def test_a_product_has_the_pixels_of_the_flags_that_mean_the_same(folder):
    assert record("--settings", "/Render/main") == 0  # of the stage's start, whose place the names have
    assert os.path.exists("other.01.exr")
    assert record("--settings", "/Render/main", "--frames", "1") == 0
    assert record("flags.exr", "-w", 20, "--imageHeight", 10, "--camera", "/side", "--samples", 3, "--method",
                  "domeLight=sampled", "--frames", "1") == 0
    assert np.array_equal(pixels("flags.exr"), pixels("other.01.exr"))


def test_settings_without_products_need_an_image(folder, capsys):
    assert record("--settings", "/Render/alone") == 1
    assert "/Render/alone has no products: name an IMAGE" in capsys.readouterr().err
    assert record("a.exr", "--settings", "/Render/alone") == 0
    made = image("a.exr")
    assert (made.display_width, made.display_height, made.x, made.y, made.width, made.height) == (24, 6, 12, 3, 12, 3)
    assert made.pixel_aspect_ratio == 2.0 and made.metadata["patina:seed"] == 9 and made.metadata["patina:camera"] == "/side"
    assert made.metadata["patina:tolerance"] == 0.5 and made.metadata["patina:settings"] == "/Render/alone"
    depth = ("--aov", "depth", "--samples", 2)
    assert record("proxy.exr", "--settings", "/Render/alone", *depth) == 0
    assert record("none.exr", "--settings", "/Render/alone", *depth, "--purposes", "none") == 0
    near, far = (np.array(image(name).pixels)[..., image(name).channels.index("depth.Z")] for name in ("proxy.exr", "none.exr"))
    assert near.max() < 1e9 < far.max()  # the stand fills the picture, and is a proxy


def test_flags_are_stronger(folder):
    flags = ("--samples", 1, "--camera", "/side", "-w", 8, "--frames", "1", "--aov", "albedo")
    assert record("a.exr", "--settings", "stage", *flags) == 0
    frame, made = reported()["frames"][0], image("a.exr")
    assert (frame["width"], frame["height"], frame["samplesPerPixel"]) == (8, 4, 1.0)
    assert made.metadata["patina:camera"] == "/side" and "albedo.R" in made.channels
    # As what was typed counts, not what differs from the default.
    assert record("b.exr", "--settings", "/Render/alone", "--seed", 0) == 0
    assert image("b.exr").metadata["patina:seed"] == 0


def test_what_cannot_be_done_is_told_by_prim_and_input(folder):
    assert record("--settings", "/Render/odd", "--frames", "1", "-w", 8) == 0
    assert sorted((w["prim"], w["input"]) for w in reported()["warnings"]) == [
        ("/Render/deep", "productType"), ("/Render/odd", "patina:cullStyle"), ("/Render/odd", "patina:nonsense"),
        ("/Render/odd", "products")]
    assert image("beauty.0001.exr").width == 8


@pytest.mark.parametrize("path, said", [
    ("/Render", "/Render is no UsdRenderSettings prim (there are: /Render/main, /Render/alone, /Render/odd)"),
    ("/nowhere", "/nowhere is not there"), ("no path", "no path is no prim path")])
def test_a_prim_that_is_no_settings_is_named(folder, capsys, path, said):
    assert record("a.exr", "--settings", path) == 1
    assert said in capsys.readouterr().err and os.listdir() == ["stage.usda"]


def test_two_frames_of_a_product_need_a_place_in_its_name(folder, capsys):
    assert record("--settings", "/Render/main", "--frames", "1:2", "--set", "/Render/beauty.productName=beauty.exr") == 1
    assert "beauty.exr would be written twice: for frames 1 and 2" in capsys.readouterr().err


def test_two_products_of_one_file_are_refused(folder, capsys):
    named = [flag for name, file in (("beauty", "a.exr"), ("depth", "./a.exr"))
             for flag in ("--set", f"/Render/{name}.productName={file}")]
    assert record("--settings", "/Render/main", "--frames", "1", *named) == 1
    assert "would be written twice: two products have this name" in capsys.readouterr().err


def test_an_image_or_settings_are_wanted(folder, capsys):
    assert main.main(["record", "stage.usda"]) == 2
    assert "name an IMAGE" in capsys.readouterr().err
    assert main.main(["record", "stage.usda", "--samples", "1", "-w", "4", "a.png", "--quiet"]) == 0  # wherever it stands


@pytest.mark.parametrize("source, kind, aov", [
    ("Ci", "raw", "color"), ("a", None, "alpha"), ("z", None, "depth"), ("cameraDepth", None, "depth"),
    ("depth", None, "deviceDepth"), ("Neye", None, "Neye"), ("albedo", None, "albedo"), ("st", "primvar", "primvars:st"),
    ("primvars:st", None, "primvars:st"), ("nothing", None, ""), ("", None, ""), ("", "primvar", "")])
def test_sources_of_vars_mean_what_they_do_in_hydra(source, kind, aov):
    assert products.film_aov(source, kind) == aov


def test_layers_lie_over_the_stage_and_later_ones_are_stronger(folder):
    (folder / "textures").mkdir()
    for name, intensity in (("dim", 3), ("textures/dimmer", 0.5), ("session", 7)):
        (folder / f"{name}.usda").write_text(f'#usda 1.0\nover "dome"\n{{\n    float inputs:intensity = {intensity}\n}}\n')
    small = ("-w", 8, "--samples", 1)
    dim, dimmer = "dim.usda", "textures/dimmer.usda"
    for layers, seen in (([dim], 3.0), ([dim, dimmer], 0.5), ([dimmer, dim], 3.0)):
        flags = [word for layer in layers for word in ("--layer", layer)]
        assert record("a.exr", *small, *flags, "--sessionLayer", "session.usda") == 0
        assert pixels("a.exr")[0, 0, :3] == pytest.approx([seen] * 3)
    assert image("a.exr").metadata["patina:layers"] == "textures/dimmer.usda dim.usda"
    assert record("a.exr", *small, "--layer", "dim.usda", "--set", "/dome.inputs:intensity=2") == 0
    assert pixels("a.exr")[0, 0, 0] == pytest.approx(2.0)
    assert "intensity" not in (folder / "stage.usda").read_text()


@pytest.mark.parametrize("layer, said", [("none.usda", "there is no such file"), ("broken.usda", "cannot be opened")])
def test_a_layer_that_is_none_is_named(folder, capsys, layer, said):
    (folder / "broken.usda").write_text("no layer")
    assert record("a.exr", "--layer", layer) == 1
    assert said in capsys.readouterr().err and not os.path.exists("a.exr")


def test_denoise_on_a_prim_finds_its_library_before_the_render(folder, monkeypatch, capsys):
    def missing(_):
        raise denoiser.CommandError("no library")

    monkeypatch.setattr(denoiser, "prepare", missing)
    text = (folder / "stage.usda").read_text()
    (folder / "stage.usda").write_text(text.replace("int patina:seed = 9", "bool patina:denoise = 1"))
    assert record("a.exr", "--settings", "/Render/alone") == 1
    assert "no library" in capsys.readouterr().err and not os.path.exists("a.exr")


def test_each_render_has_a_report_of_its_own(folder, capsys):
    small = ("--settings", "/Render/main", "--samples", 1, "-w", 8)
    assert record(*small, "--frames", "1", "--report", "p.html") == 0
    assert "/camera" in (folder / "p.html").read_text() and "/side" in (folder / "p.2.html").read_text()
    assert record("a.##.#.exr", "--frames", "1:2x0.5", "--samples", 1, "-w", 8, "--report", "q.##.html") == 2
    assert "q.##.html has room for 0" in capsys.readouterr().err


def test_a_report_that_fails_is_a_warning(folder, monkeypatch):
    def fail(*_):
        raise ValueError("odd numbers")

    monkeypatch.setattr("patina.report.page.document", fail)
    assert record("a.exr", "--frames", "1", "--samples", 1, "-w", 8, "--report", "p.html") == 0
    assert "no report p.html: odd numbers" in [w["message"] for w in reported()["warnings"]] and os.path.exists("a.exr")


def _odd(folder, prim, line):
    """Writes the stage with one more attribute on a prim."""
    text = (folder / "stage.usda").read_text()
    name = line.split(" = ")[0].split()[-1]
    head, opening, rest = text.partition(f'"{prim}"\n    {{\n')
    body, end, tail = rest.partition("\n    }\n")
    kept = "\n".join(one for one in body.split("\n") if f" {name} = " not in one)
    (folder / "stage.usda").write_text(f"{head}{opening}        {line}\n{kept}{end}{tail}")


_BASE = [
    ("float4 dataWindowNDC = (nan, 0, 1, 1)", "is not 4 finite numbers; it is left out"),
    ("float4 dataWindowNDC = (0, 0, inf, 1)", "is not 4 finite numbers; it is left out"),
    ("float dataWindowNDC = 1", "is not 4 finite numbers; it is left out"),
    ('string dataWindowNDC = "0011"', "is not 4 finite numbers; it is left out"),
    ('string[] resolution = ["32", "16"]', "is not 2 finite numbers; it is left out"),
    ("int resolution = 5", "is not 2 finite numbers; it is left out"),
    ("int3 resolution = (5, 5, 5)", "is not 2 finite numbers; it is left out"),
    ("int2 resolution = (-5, 0)", "-5 x 0 is no size; 2048 x 1080 is used"),
    ('string pixelAspectRatio = "x"', "is no finite number; it is left out"),
    ("float pixelAspectRatio = nan", "is no finite number; it is left out"),
    ("float pixelAspectRatio = inf", "is no finite number; it is left out"),
    ("float pixelAspectRatio = 1e7", "1e+07 is not allowed, it is not from 0.001 to 1000; square pixels are used"),
    ("float pixelAspectRatio = 0", "0 is not allowed, it is not from 0.001 to 1000; square pixels are used")]
_PURPOSES = [
    ("int includedPurposes = 3", "is no list of purposes; it is left out"),
    ("int[] includedPurposes = [3]", "is no list of purposes; it is left out"),
    ('token materialBindingPurposes = "full"', "is no list of purposes; it is left out")]


@pytest.mark.parametrize("prim, line, said", [
    *(("alone", *row) for row in _BASE + _PURPOSES), *(("beauty", *row) for row in _BASE)])
def test_values_of_another_type_or_range_are_told(folder, prim, line, said):
    name = line.split(" = ")[0].split()[-1]
    _odd(folder, prim, line)
    path = "/Render/alone" if prim == "alone" else "/Render/main"
    assert record("a.exr", "--settings", path, "--samples", 1, "--frames", "1", "-w", 8) == 0
    told = [(w["prim"], w["input"], w["message"]) for w in reported()["warnings"]]
    assert (f"/Render/{prim}", name, said) in told
    if name == "pixelAspectRatio":
        assert image("a.exr").pixel_aspect_ratio == 1.0


def test_the_schemas_own_purposes_are_no_news(folder):
    """As Houdini writes them into every settings prim."""
    _odd(folder, "alone", 'uniform token[] materialBindingPurposes = ["full", "allPurpose"]')
    assert record("a.exr", "--settings", "/Render/alone", "--samples", 1, "--frames", "1", "-w", 8) == 0
    assert not [w for w in reported()["warnings"] if w["input"] == "materialBindingPurposes"]


@pytest.mark.parametrize("line, said", [
    ("int patina:seed = -1", "-1 is not allowed; the setting keeps its value"),
    ("double patina:filterRadius = 1e30", "1e+30 is not allowed; the setting keeps its value"),
    ('token patina:method:zz = "q"', "there is no choice point 'zz'"),
    ('token patina:method:subdivision = "zz"', "the choice point 'subdivision' has no method 'zz'")])
def test_settings_that_are_not_allowed_are_told(folder, line, said):
    _odd(folder, "alone", line)
    assert record("a.exr", "--settings", "/Render/alone", "--samples", 1, "-w", 8) == 0
    told = {(w["prim"], w["input"]): w["message"] for w in reported()["warnings"]}
    assert told["/Render/alone", line.split(" = ")[0].split()[-1]].startswith(said)


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_overscan_shows_what_lies_beside_the_frame(folder, backend):
    """The file's frame is the image without overscan, of the same camera."""
    _odd(folder, "alone", "float4 dataWindowNDC = (-0.25, -0.5, 1.25, 1.5)")
    common = ("--samples", 64, "--backend", backend)
    assert record("over.exr", "--settings", "/Render/alone", *common) == 0
    _odd(folder, "alone", "float4 dataWindowNDC = (0, 0, 1, 1)")
    assert record("plain.exr", "--settings", "/Render/alone", *common) == 0
    over, plain = image("over.exr"), image("plain.exr")
    width, height = plain.width, plain.height
    assert (over.x, over.y, over.width, over.height) == (-width // 4, -height // 2, width * 3 // 2, height * 2)
    assert (over.display_width, over.display_height) == (width, height)
    own = np.array(over.pixels)[-over.y:-over.y + height, -over.x:-over.x + width]
    assert np.abs(own - np.array(plain.pixels)).mean() < 0.1 * np.abs(np.array(plain.pixels)).mean()


def test_overscan_by_the_flag(folder):
    assert record("flag.exr", "-w", 24, "--imageHeight", 12, "--samples", 1, "--dataWindow=-4,-2,9,5") == 0
    made = image("flag.exr")
    assert (made.x, made.y, made.width, made.height) == (-4, -2, 14, 8)
    assert (made.display_width, made.display_height) == (24, 12)


def test_a_data_window_of_huge_numbers_is_cut(folder):
    _odd(folder, "alone", "double4 dataWindowNDC = (-1e308, 0.5, 1e308, 1e308)")
    assert record("a.exr", "--settings", "/Render/alone", "--samples", 1) == 0
    made = image("a.exr")
    assert (made.x, made.y, made.width, made.height) == (0, 0, 24, 3)
    told = [(w["prim"], w["input"]) for w in reported()["warnings"] if "reaches beyond the image" in w["message"]]
    assert told == [("/Render/alone", "dataWindowNDC")]


@pytest.mark.parametrize("ratio", ["1e7", "1e308", "1e-30", "0", "inf", "nan"])
def test_pixel_aspect_ratios_that_no_image_holds_are_refused_as_flags(folder, capsys, ratio):
    assert record("a.exr", "-w", 8, "--samples", 1, "--pixelAspectRatio", ratio) == 2
    assert "--pixelAspectRatio" in capsys.readouterr().err and not os.path.exists("a.exr")


@pytest.mark.parametrize("ratio", ["0.001", "1000"])
def test_pixel_aspect_ratios_at_the_ends_of_the_range_are_written(folder, ratio):
    assert record("a.exr", "-w", 8, "--samples", 1, "--pixelAspectRatio", ratio) == 0
    assert image("a.exr").pixel_aspect_ratio == pytest.approx(float(ratio))


def test_a_render_pass_brings_its_settings_and_draws_its_collections(folder):
    assert record("all.exr", "--settings", "/Render/main") == 0 and record("pass.exr", "-rp", "/Render/empty") == 0
    whole, left = (_patina.read_image(name) for name in ("all.exr", "pass.exr"))
    assert (left.width, left.height) == (32, 16)
    alpha = whole.channels.index("A")
    assert whole.pixels[..., alpha].max() == 1.0 and left.pixels[..., alpha].max() == 0.0


@pytest.mark.parametrize("path, problem", [("/Render/none", "is not there"), ("/ball", "is no UsdRenderPass prim"),
                                           ("/Render/twice", "has 2 prims as its renderSource")])
def test_passes_that_cannot_be_used_are_named(folder, capfd, path, problem):
    assert record("x.exr", "--renderPassPrimPath", path) == 1
    assert problem in capfd.readouterr().err and not os.path.exists("x.exr")


def test_a_pass_and_settings_are_not_given_together(folder, capfd):
    assert record("x.exr", "-rp", "/Render/empty", "--settings", "stage") == 2
    assert "--settings cannot be beside it" in capfd.readouterr().err


@pytest.mark.parametrize("policy, given, aspect", [
    ("adjustPixelAspectRatio", 1, 20 / 10 * 6 / 24), ("adjustPixelAspectRatio", 2, 20 / 10 * 6 / 24), ("expandAperture", 2, 2)])
def test_pixels_have_the_aspect_that_the_policy_gives_them(folder, policy, given, aspect):
    """As UsdRenderSpec computes it: the aperture's aspect over that of 24 x 6 pixels."""
    _odd(folder, "alone", f'token aspectRatioConformPolicy = "{policy}"')
    _odd(folder, "alone", f"float pixelAspectRatio = {given}")
    assert record("a.exr", "--settings", "/Render/alone", "--samples", 1) == 0
    assert image("a.exr").pixel_aspect_ratio == pytest.approx(aspect)


@pytest.mark.parametrize("purposes, drawn", [
    ('["default", "proxy"]', "ball stand"), ('["proxy"]', "stand"), ('["render"]', ""), ('["default"]', "ball"),
    ('["render", "default"]', "ball"), ("[]", "ball"), ('["sets"]', "ball")])
def test_prims_of_purpose_default_are_drawn_where_that_is_included(folder, purposes, drawn):
    """The ball is of purpose default, 9 before the camera; the stand is a proxy, and around both."""
    _odd(folder, "alone", f"token[] includedPurposes = {purposes}")
    assert record("a.exr", "--settings", "/Render/alone", "--samples", 1, "--frames", "1", "--camera", "/camera", "--aov",
                  "depth", "--dataWindow=0,0,23,5") == 0
    depth = np.array(image("a.exr").pixels)[..., image("a.exr").channels.index("depth.Z")]
    assert (depth.min() < 10, depth.max() < 100) == ("ball" in drawn, "stand" in drawn)
    told = {w["id"] for w in reported()["warnings"] if w["input"] == "includedPurposes"}
    assert ("noPurposeIncluded" in told) == (purposes in ("[]", '["sets"]'))


@pytest.mark.parametrize("window, size, held", [
    ((0.25, 0.25, 0.75, 0.75), 6, (1, 2, 3, 3)), ((0.25, 0.25, 0.75, 0.75), 10, (2, 3, 5, 5)),
    ((0.05, 0.05, 0.95, 0.95), 10, (0, 1, 9, 9)), ((-0.25, 0, 1, 1.25), 6, (-2, -1, 8, 7)),
    ((0.3, 0.1, 0.5, 0.9), 10, (3, 1, 2, 8))])
def test_a_pixel_belongs_to_the_window_that_holds_its_centre(folder, window, size, held):
    """A centre on the window's left or lower edge is in it, one on its right or upper edge is not (UsdRender's rasterization
    rule), so windows side by side share no pixel and miss none. Rows count from the top."""
    _odd(folder, "alone", f"float4 dataWindowNDC = {window}")
    assert record("a.exr", "--settings", "/Render/alone", "--samples", 1, "-w", size, "--imageHeight", size) == 0
    made = image("a.exr")
    assert (made.x, made.y, made.width, made.height) == held
