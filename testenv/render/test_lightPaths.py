# SPDX-License-Identifier: Apache-2.0
"""AOVs of light paths: partitions of the colour on every test scene, closed forms of each order of scattering and of each
lobe, light groups, shadows, and that they change no bit of the colour and survive cutting and resuming."""
import glob
import math
import os

import numpy as np
import pytest

from rendering import SCENES, color, patina, record
from test_features import CAMERA, HEAD, distant, glow, lambert, quad
import usda
from usda import material, prim

FIRST = ("emission", "diffuse", "specular", "transmission", "subsurface", "volume")  # by what happens first
ORDER = ("emission", "direct", "indirect")  # by how often
ALL_SCENES = sorted(os.path.relpath(path, SCENES)[:-5] for path in glob.glob(os.path.join(SCENES, "**", "*.usda"),
                                                                             recursive=True))


def aovs(names):
    return [word for name in names for word in ("--aov", name)]


def layer(image, name):
    return color(image, [f"{name}.{c}" for c in "RGB"])


def film_of(stage, names, **settings):
    """:returns: what a render of some aovs leaves, and the colour of one without them"""
    return stage.film(**settings, aovs=list(names)), stage.film(**settings, aovs=[]).resolve("color")


def assert_is_sum(film, names, total):
    """Values are rounded to 24 bits a few times on each of a path's events; what is summed has no sign."""
    parts = sum(np.asarray(film.resolve(name), np.float64) for name in names)
    assert np.abs(parts - total).max() <= 2**-24 * 64 * max(total.max(), 1e-30)


@pytest.mark.parametrize("name", ALL_SCENES)
def test_partitions_sum_to_the_colour(name):
    from inProcess import Stage

    stage = Stage(os.path.join(SCENES, *name.split("/")) + ".usda", "--imageWidth", 16, "--samples", 2)
    film, plain = film_of(stage, [*FIRST, "direct", "indirect", "shadow"])
    total = np.asarray(film.resolve("color"), np.float64)
    assert (film.resolve("color") == plain).all()  # to the bit
    assert total.max() > 0.0
    assert_is_sum(film, FIRST, total)
    assert_is_sum(film, ORDER, total)


def test_partitions_hold_where_indirect_light_is_clamped():
    from inProcess import Stage

    stage = Stage(os.path.join(SCENES, "media.usda"), "--imageWidth", 16, "--samples", 4)
    film, plain = film_of(stage, [*FIRST, "direct", "indirect"], indirectClamp=0.05)
    total = np.asarray(film.resolve("color"), np.float64)
    assert (film.resolve("color") == plain).all()
    assert_is_sum(film, FIRST, total)
    assert_is_sum(film, ORDER, total)


def write(tmp_path, *parts):
    stage = tmp_path / "stage.usda"
    stage.write_text(HEAD + CAMERA + "".join(parts))
    return stage


def render(tmp_path, names, *parts, samples=16, size=32, arguments=()):
    image = tmp_path / "image.exr"
    record(write(tmp_path, *parts), image, "--camera", "/camera", "--imageWidth", size, "--imageHeight", size, "--samples",
           samples, "--filterRadius", 0.5, "--disableCameraLight", *aovs(names), *arguments)
    return image


def assert_mean(values, expected):
    """Pixels share no numbers; 5 standard errors, two-sided significance 6e-7, and rounding."""
    values = np.asarray(values, np.float64).mean(axis=-1).ravel()
    error = values.std(ddof=1) / math.sqrt(values.size)
    assert abs(values.mean() - expected) <= 5.0 * error + 1e-5 * expected, (values.mean(), expected, error)


def closed_room(albedo, glowing=1.0):
    """A cube seen from inside, whose walls glow and are Lambertian: light of k bounces is glowing * albedo^k everywhere."""
    both = material("walls", {
        "diffuse": ("ND_oren_nayar_diffuse_bsdf", {"color": (albedo, albedo, albedo)}),
        "edf": ("ND_uniform_edf", {"color": (glowing, glowing, glowing)}),
        "surface": ("ND_surface", {"bsdf": "<diffuse>", "edf": "<edf>"})})
    return both + prim("Cube", "room", bind="walls", size=60, doubleSided=1)


@pytest.mark.parametrize("branches", [1, 3])
def test_each_order_of_a_furnace_has_its_power_of_the_albedo(branches, tmp_path):
    """Each branch goes on from the same event."""
    albedo, orders = 0.5, range(5)
    names = [f"order{k}=lpe:C<RD>{{{k}}}O" for k in orders]
    image = render(tmp_path, names, closed_room(albedo), samples=64, arguments=("--branches", branches))
    for k in orders:
        assert_mean(layer(image, f"order{k}"), albedo**k)


def test_lobes_get_their_own_light(tmp_path):
    """A mix of a diffuse and a rough metal lobe in a white sky: the diffuse AOV is half of the diffuse lobe's albedo, however
    the lobes are drawn. By which lobe was drawn alone it would be another."""
    mixed = material("white", {
        "diffuse": ("ND_oren_nayar_diffuse_bsdf", {"color": (0.8, 0.8, 0.8)}),
        "metal": ("ND_conductor_bsdf", {"roughness": (0.6, 0.6), "ior": (0.2, 0.9, 1.1), "extinction": (3.9, 2.4, 2.2)}),
        "mix": ("ND_mix_bsdf", {"fg": "<diffuse>", "bg": "<metal>", "mix": 0.5}),
        "surface": ("ND_surface", {"bsdf": "<mix>"})})
    image = render(tmp_path, ["diffuse", "specular"], mixed, quad("wall", 0, 4.0), 'def DomeLight "sky"\n{\n}\n', samples=64)
    assert_mean(layer(image, "diffuse"), 0.4)
    assert layer(image, "specular").mean() > 0.1


LABEL = 'custom string inputs:ri:light:lightGroup = "%s"'


def test_light_groups_are_their_lights(tmp_path):
    """Two suns and a sky, all straight onto a wall of albedo 0.5: each group has its own closed form, and what has no label is
    the rest. Labels of RenderMan stand above the primvar."""
    wall = quad("wall", 0, 4.0) + lambert("white", 0.5)
    names = ["key=lpe:C.*<L.'key'>", "fill=lpe:C.*<L.'fill'>", "sky=lpe:C.*<B.'sky'>", "rest=lpe:C.*<[LO].[^'key''fill''sky']>"]
    image = render(tmp_path, names, wall,
                   distant("a", LABEL % "key", 'custom string primvars:lightGroup = "fill"', intensity=math.pi),
                   distant("b", 'custom string primvars:lightGroup = "fill"', intensity=2 * math.pi),
                   distant("c", intensity=3 * math.pi),
                   'def DomeLight "sky"\n{\n    custom string primvars:lightGroup = "sky"\n}\n', samples=64)
    groups = [layer(image, name) for name in ("key", "fill", "rest", "sky")]
    for group, expected in zip(groups, (0.5, 1.0, 1.5, 0.5)):
        assert_mean(group, expected)
    assert np.abs(sum(groups) - color(image)).max() <= 1e-5 * color(image).max()


def test_emissive_geometry_has_a_light_group(tmp_path):
    """The label is inherited, and an edit of it changes the AOV."""
    lamp = (prim("Xform", "lamps", 'custom string primvars:lightGroup = "%s" (interpolation = "constant")',
                 quad("lamp", 0, 4.0, material="glow"))
            + glow("glow", (2.0, 2.0, 2.0)))
    for label, expected in (("lamp", 2.0), ("other", 0.0)):
        image = render(tmp_path, ["lamp=lpe:C<O.'lamp'>", "glow=lpe:CO"], lamp % label, samples=2)
        assert layer(image, "lamp") == pytest.approx(expected, abs=1e-6)
        assert layer(image, "glow") == pytest.approx(2.0, abs=1e-6)


def test_a_label_may_change_while_the_renderer_stays(tmp_path):
    """Of a light, and of a mesh that glows, neither of which changes in any other way."""
    from inProcess import Stage
    from patina import stage as reader

    text = (quad("lamp", 0, 4.0, 0.0, "glow", 'custom string primvars:lightGroup = "key" (interpolation = "constant")')
            + glow("glow", (2.0, 2.0, 2.0)) + quad("wall", -1, 8.0) + lambert("white", 0.5)
            + distant("sun", 'custom string primvars:lightGroup = "key"'))
    path = write(tmp_path, text)
    stage = Stage(path, "--imageWidth", 16, "--samples", 2, "--disableCameraLight")
    names = ["key=lpe:C.*<[LO].'key'>", "fill=lpe:C.*<[LO].'fill'>"]
    for label, other in (("key", "fill"), ("fill", "key")):
        path.write_text(path.read_text().replace('"key"', f'"{label}"'))
        opened = reader.open_stage(str(path))
        opened.Reload()
        with stage.scene.edit() as edit:
            edit.clear()
            reader.read_stage(opened, edit, reader.StageOptions(headlight=False))
        film, _ = film_of(stage, names)
        assert film.resolve(other).max() == 0.0
        assert_is_sum(film, [label], np.asarray(film.resolve("color"), np.float64))


def test_a_shadow_is_the_light_that_is_missing(tmp_path):
    """A sun straight from the camera's side, half of it behind a black card that the camera does not see."""
    card = quad("card", 20, 4.0, x=-4.0, material="black") + lambert("black", 0.0)
    image = render(tmp_path, ["shadow", "direct"], quad("wall", 0, 8.0), lambert("white", 0.5), card,
                   distant("sun", intensity=math.pi))
    shadow, direct = layer(image, "shadow"), layer(image, "direct")
    assert shadow[:, :14] == pytest.approx(0.5, rel=1e-4) and direct[:, :14] == pytest.approx(0.0, abs=1e-7)
    assert shadow[:, 18:] == pytest.approx(0.0, abs=1e-7) and direct[:, 18:] == pytest.approx(0.5, rel=1e-4)


def test_parts_and_threads_give_the_bits_of_the_whole(tmp_path):
    stage = os.path.join(SCENES, "media.usda")
    flags = ["--imageWidth", 24, "--samples", 8, *aovs(["diffuse", "indirect", "key=lpe:C<T.>.*L"])]
    images = [tmp_path / name for name in ("whole.exr", "one.exr", "merged.exr")]
    record(stage, images[0], *flags)
    record(stage, images[1], *flags, "--threads", 1)
    parts = [tmp_path / f"{k}.part" for k in (1, 2)]
    for k, part in enumerate(parts, 1):
        record(stage, images[2], *flags, "--part", f"{k}/2", "--partial", part)
    patina("merge", *parts, images[2])
    for name in ("diffuse", "indirect", "key"):
        whole = layer(images[0], name)
        assert whole.max() > 0.0
        assert (layer(images[1], name) == whole).all() and (layer(images[2], name) == whole).all()


def test_more_samples_are_added_to_a_checkpoint(tmp_path):
    stage = os.path.join(SCENES, "plastic.usda")
    flags = ["--imageWidth", 16, "--keepCheckpoint", *aovs(["specular", "d=lpe:CDL"])]
    whole, resumed = tmp_path / "whole.exr", tmp_path / "resumed.exr"
    record(stage, whole, *flags, "--samples", 4)
    record(stage, resumed, *flags, "--samples", 2)
    record(stage, resumed, *flags, "--samples", 4, "--resume")
    for name in ("specular", "d"):
        assert (layer(resumed, name) == layer(whole, name)).all()


@pytest.mark.parametrize("aov, words", [
    ("key=lpe:C<RD.*L", ["'C<RD.*L'", "column 6"]), ("lpe:", ["unknown AOV 'lpe:'"]),
    ("=lpe:C.*L", ["there is no name before ="]),
    ("color=lpe:CL", ["'color'", "another AOV"]), ("a b=lpe:CL", ["'a b'"]), ("key=lpe:LC", ["no path fits it"]),
    ("x=lpe:C" + "." * 2000 + "L", ["at most 1024"])])
def test_what_is_wrong_is_said_before_anything_is_rendered(tmp_path, aov, words):
    result = record(os.path.join(SCENES, "furnace.usda"), tmp_path / "a.exr", "--aov", aov, check=False)
    assert result.returncode == 1 and len(result.stderr.strip().splitlines()) == 1
    assert all(word in result.stderr for word in words), result.stderr
    assert not (tmp_path / "a.exr").exists()


def test_two_aovs_cannot_have_one_name(tmp_path):
    result = record(os.path.join(SCENES, "furnace.usda"), tmp_path / "a.exr", *aovs(["k=lpe:CDL", "k=lpe:CL"]), check=False)
    assert result.returncode == 1 and "would both be written as 'k'" in result.stderr


def test_an_expression_without_a_name_is_one(tmp_path):
    image = tmp_path / "a.exr"
    record(os.path.join(SCENES, "furnace.usda"), image, "--imageWidth", 8, "--samples", 1, "--aov", "lpe:C<RD>L")
    assert layer(image, "lpe_C_RD_L").max() > 0.0


def lpe(name, expression):
    return prim("RenderVar", name, f'uniform string sourceName = "{expression}"', 'uniform token sourceType = "lpe"')


def test_products_have_light_paths(tmp_path):
    stage, image = tmp_path / "stage.usda", tmp_path / "product.exr"
    stage.write_text(usda.stage(
        prim("Scope", "Render",
             prim("RenderSettings", "settings", "rel camera = </World/camera>", "rel products = </Render/product>",
                  "uniform int2 resolution = (16, 12)", "int patina:samples = 2"),
             prim("RenderProduct", "product",
                  "rel orderedVars = [</Render/beauty>, </Render/bounce>, </Render/lit>, </Render/wrong>]",
                  productName=str(image)),
             lpe("beauty", "C.*"), lpe("bounce", "C<RD>.*L"),
             prim("RenderVar", "lit", 'uniform string sourceName = "lpe:C<RD><L.>"',
                  'custom string driver:parameters:aov:name = "straight"'),
             lpe("wrong", "C<RD")),
        up="", subLayers=f"[@{os.path.join(SCENES, 'lightRect.usda')}@]"))
    told = patina("record", stage, "--settings", "/Render/settings", "--outputFolder", tmp_path)
    assert "/Render/wrong.sourceName" in told.stderr.replace(": ", ".") and "column 5" in told.stderr
    assert layer(image, "bounce").max() > layer(image, "straight").max() * 0.99 > 0.0
    assert color(image).max() > 0.0


def test_the_rasterizer_says_that_it_has_none(tmp_path):
    from inProcess import needs_opengl

    needs_opengl()
    image = tmp_path / "a.exr"
    told = patina("record", os.path.join(SCENES, "furnace.usda"), image, "--backend", "raster", "--imageWidth", 8, "--samples",
                  1, *aovs(["diffuse", "key=lpe:CDL"]))
    assert "the AOV diffuse is left empty" in told.stderr and "the AOV key is left empty" in told.stderr
    assert (layer(image, "diffuse") == 0.0).all() and (layer(image, "key") == 0.0).all()
