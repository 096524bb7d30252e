# SPDX-License-Identifier: Apache-2.0
"""UsdRenderSettings' renderingColorSpace: light is added and multiplied there, whatever the colours were given in.

The matrices are those of SMPTE ST 2065-1 and ACES S-2014-004, with Bradford's adaptation of D60 to D65."""
import json

import numpy as np
import pytest

import _patina
from rendering import color, patina, record
import usda

# Rec.709 to AP1; its rows sum to 1.
AP1 = np.array([[0.613097402, 0.339523146, 0.047379451],
                [0.070193722, 0.916353879, 0.013452398],
                [0.020615593, 0.109569773, 0.869814634]])
WHITE = usda.prim("DistantLight", "sun", "%s", intensity=1, angle=0)
CAMERA = usda.stage("( %s )", usda.camera(flat=(10, 10), clippingRange=(1, 100), at=(0, 0, 20)), up="")
FLOOR = (
    usda.card("floor", 5, "@PRIMVAR@", scheme="", bind="paint", st=usda.ST)
    + usda.prim("Material", "paint", "token outputs:surface.connect = </paint/surface.outputs:out>",
        usda.prim("Shader", "surface", 'uniform token info:id = "ND_surface"',
                  "token inputs:bsdf.connect = </paint/bsdf.outputs:out>", "token outputs:out"),
        usda.prim("Shader", "bsdf", 'uniform token info:id = "ND_oren_nayar_diffuse_bsdf"', "token outputs:out", "@COLOR@"),
        "@NODES@"))
ORANGE, MINT = np.array([0.8, 0.3, 0.05]), np.array([0.2, 0.9, 0.5])
SRGB = np.where(ORANGE > 0.0031308, 1.055 * ORANGE ** (1 / 2.4) - 0.055, 12.92 * ORANGE)


def values(color3):
    return "(" + ", ".join(f"{x:.9g}" for x in color3) + ")"


def connected(node):
    return "color3f inputs:color.connect = </paint/source.outputs:out>", "def Shader \"source\" {" + node + """
        color3f outputs:out
    }"""


def floors(folder):
    """:returns: dict of (COLOR, NODES, PRIMVAR) of a floor whose albedo is ORANGE in linear Rec.709"""
    _patina.write_image(str(folder / "orange.exr"), np.full((2, 2, 3), ORANGE, np.float32), ["R", "G", "B"], {})
    image = connected(f"""uniform token info:id = "ND_image_color3"
        asset inputs:file = @{folder}/orange.exr@ ( colorSpace = "lin_rec709" )""")
    primvar = connected("""uniform token info:id = "ND_geompropvalue_color3"
        string inputs:geomprop = "paintColor" """)
    return {
        "value": (f"color3f inputs:color = {values(ORANGE)}", "", ""),
        "signal": (f'color3f inputs:color = {values(SRGB)} ( colorSpace = "srgb_texture" )', "", ""),
        "AP1": (f'color3f inputs:color = {values(AP1 @ ORANGE)} ( colorSpace = "lin_ap1_scene" )', "", ""),
        "texture": (*image, ""),
        "primvar": (*primvar, f"color3f[] primvars:paintColor = [{values(ORANGE)}]"),
    }


def stage_of(folder, kind, light=WHITE % f"color3f inputs:color = {values(MINT)}", head=""):
    parts = floors(folder)[kind]
    text = CAMERA % head + light + FLOOR
    for name, part in zip(("@COLOR@", "@NODES@", "@PRIMVAR@"), parts):
        text = text.replace(name, part)
    path = folder / "stage.usda"
    path.write_text(text)
    return path


def rendered(folder, stage, *flags, backend="embree", name="image.exr"):
    record(stage, folder / name, "--camera", "/camera", "--imageWidth", 8, "--imageHeight", 8, "--samples", 4,
           "--backend", backend, *flags)
    return color(folder / name).reshape(-1, 3).mean(axis=0)


@pytest.mark.parametrize("backend", ["embree", "raster"])
@pytest.mark.parametrize("kind", ["value", "signal", "AP1", "texture", "primvar"])
def test_albedo_times_light_is_a_product_of_the_space(tmp_path, kind, backend):
    """A floor under a sun: albedo times irradiance over pi, channel by channel of the space."""
    stage = stage_of(tmp_path, kind)
    found = rendered(tmp_path, stage, "--renderingColorSpace", "acescg", backend=backend)
    expected = (AP1 @ ORANGE) * (AP1 @ MINT) / np.pi
    # Halfs of the texture, float matrices of both sides. In Rec.709 the product differs by 2 % and more.
    assert found == pytest.approx(expected, rel=1e-3)
    elsewhere = AP1 @ (ORANGE * MINT / np.pi)
    assert np.abs(elsewhere / expected - 1).max() > 0.02
    assert rendered(tmp_path, stage, backend=backend) == pytest.approx(ORANGE * MINT / np.pi, rel=1e-3)


def test_colours_of_lights_beyond_rec709_are_kept(tmp_path):
    light = WHITE % 'color3f inputs:color = (0, 1, 0) ( colorSpace = "lin_ap1_scene" )'
    stage = stage_of(tmp_path, "value", light)
    found = rendered(tmp_path, stage, "--renderingColorSpace", "ACEScg")
    assert found == pytest.approx((AP1 @ ORANGE) * (0, 1, 0) / np.pi, rel=1e-3, abs=1e-6)


def test_a_temperature_is_a_colour_of_rec709(tmp_path):
    light = WHITE % "bool inputs:enableColorTemperature = 1\n    float inputs:colorTemperature = 3000"
    stage = stage_of(tmp_path, "value", light)
    warm = rendered(tmp_path, stage) * np.pi / ORANGE
    found = rendered(tmp_path, stage, "--renderingColorSpace", "lin_ap1_scene")
    assert found == pytest.approx((AP1 @ ORANGE) * (AP1 @ warm) / np.pi, rel=1e-3)


def test_glow_of_a_temperature(tmp_path):
    """ND_blackbody gives linear Rec.709, and what is emitted is not multiplied with anything."""
    text = (CAMERA % "") + FLOOR.replace("@PRIMVAR@", "").replace("ND_oren_nayar_diffuse_bsdf", "ND_uniform_edf")
    text = text.replace("inputs:bsdf.connect", "inputs:edf.connect")
    for name, part in zip(("@COLOR@", "@NODES@"), connected("""uniform token info:id = "ND_blackbody"
        float inputs:temperature = 2500""")):
        text = text.replace(name, part)
    stage = tmp_path / "stage.usda"
    stage.write_text(text)
    plain = rendered(tmp_path, stage)
    assert plain[0] > 2 * plain[2]
    assert rendered(tmp_path, stage, "--renderingColorSpace", "acescg") == pytest.approx(AP1 @ plain, rel=1e-4)


def test_grey_stays_grey_to_the_bit(tmp_path):
    stage = stage_of(tmp_path, "value", WHITE % "")
    stage.write_text(stage.read_text().replace(values(ORANGE), "(0.18, 0.18, 0.18)"))
    plain, aces = (rendered(tmp_path, stage, *flags) for flags in ((), ("--renderingColorSpace", "acescg")))
    assert (plain == aces).all() and plain[0] == pytest.approx(0.18 / np.pi, rel=1e-6)


def test_files_say_the_space_and_pictures_look_the_same(tmp_path):
    stage = stage_of(tmp_path, "value", WHITE % "")  # white light: the product is the same colour in every space
    rendered(tmp_path, stage)
    rendered(tmp_path, stage, "--renderingColorSpace", "acescg", name="aces.exr")
    exact = {"image.exr": (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290),
             "aces.exr": (0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767)}
    for name, expected in exact.items():
        assert _chromaticities(tmp_path / name) == pytest.approx(expected, abs=1e-6), name
    pictures = []
    for name, flags in (("plain.png", ()), ("aces.png", ("--renderingColorSpace", "acescg"))):
        record(stage, tmp_path / name, "--camera", "/camera", "--imageWidth", 8, "--imageHeight", 8, "--samples", 4, *flags)
        pictures.append(np.array(_patina.read_image(str(tmp_path / name)).pixels)[..., :3])
    assert np.abs(pictures[0] - pictures[1]).max() <= 1.01 / 255  # one step of rounding
    assert pictures[0].std() > 0.1


def _chromaticities(path):
    """From the file's bytes: name, type, size, eight floats."""
    data = path.read_bytes()
    start = data.index(b"chromaticities\0chromaticities\0") + 30
    assert int.from_bytes(data[start:start + 4], "little") == 32
    return np.frombuffer(data[start + 4:start + 36], "<f4")


SETTINGS = usda.prim("RenderSettings", "settings", 'uniform token renderingColorSpace = "%s"', "rel camera = </camera>",
                     "uniform int2 resolution = (8, 8)", "int patina:samples = 4")


@pytest.mark.parametrize("space", ["lin_ap1_scene", "srgb_texture", "nobody knows", "lin_rec709_scene", "raw"])
def test_settings_of_a_stage(tmp_path, space):
    stage = stage_of(tmp_path, "value")
    stage.write_text(stage.read_text() + SETTINGS % space)
    image = tmp_path / "image.exr"
    process = patina("record", stage, image, "--settings", "/settings", "--json")
    found = color(image).reshape(-1, 3).mean(axis=0)
    messages = [w["message"] for w in json.loads(process.stdout)["warnings"]]
    aces = (AP1 @ ORANGE) * (AP1 @ MINT) / np.pi
    assert found == pytest.approx(aces if space == "lin_ap1_scene" else ORANGE * MINT / np.pi, rel=1e-3)
    told = space in ("srgb_texture", "nobody knows", "raw")
    assert messages == ([f"'{space}' is no linear colour space that is known; linear Rec.709 is used"] if told else [])
    # A flag is stronger.
    patina("record", stage, image, "--settings", "/settings", "--renderingColorSpace", "acescg")
    assert color(image).reshape(-1, 3).mean(axis=0) == pytest.approx(aces, rel=1e-3)


def test_an_unknown_space_is_told_before_anything_is_rendered(tmp_path):
    process = patina("record", stage_of(tmp_path, "value"), tmp_path / "x.exr", "--renderingColorSpace", "sRGB", check=False)
    assert process.returncode == 1 and "'sRGB' is no linear colour space" in process.stderr
    assert not (tmp_path / "x.exr").exists()
