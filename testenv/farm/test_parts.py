# SPDX-License-Identifier: Apache-2.0
"""A frame that was cut has the bits of the frame rendered at once; parts that do not belong together are refused."""
import json
import os
import re
import shutil

import pytest

from inProcess import patina, scene
from partImages import contents, parts, whole

SIZE = ("--imageWidth", "70", "--imageHeight", "37")  # 15 tiles, some of them cut off


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("parts")


@pytest.mark.parametrize("cut, flags", [
    ("4", ("--samples", "5", "--aov", "all")),
    ("1x3", ("--samples", "50", "--aov", "all", "--aov", "denoisingAlbedo")),
    ("2x2", ("--samples", "20", "--dataWindow", "9,5,50,30", "--seed", "3", "--aov", "cryptoMaterial", "--aov", "direct",
             "--aov", "red=lpe:C.*L")),
    ("3x2", ("--samples", "21", "--method", "pixelFilter=splatted", "--dataWindow", "9,5,50,30", "--aov", "normal")),
])
def test_all_that_the_file_holds_is_the_same(folder, cut, flags):
    stage, image = scene("texturedDiffuse"), folder / f"cut{cut}.exr"
    expected = whole(stage, folder / "whole.exr", *SIZE, *flags)
    files = parts(folder, stage, image, cut, *SIZE, *flags)
    assert not image.exists(), "a part writes no image"
    patina("merge", *files, image)
    assert contents(image) == expected


@pytest.mark.parametrize("cut, tolerance, method", [("3", "0.04", "sampled"), ("2x2", "0.04", "sampled"),
                                                    ("2x2", "0.02", "splatted")])
def test_tiles_stop_where_they_stop_at_once(folder, cut, tolerance, method):
    flags = (*SIZE, "--method", f"pixelFilter={method}", "--samples", "96", "--tolerance", tolerance, "--aov",
             "sampleCount", "--aov", "variance")
    stage, image = scene("diffuseBox"), folder / "adaptive.exr"
    expected = whole(stage, folder / "adaptiveWhole.exr", *flags)
    patina("merge", *parts(folder, stage, image, cut, *flags), image)
    assert contents(image) == expected
    import _patina

    counts = _patina.read_image(str(image))
    channel = next(i for i, name in enumerate(counts.channels) if name.startswith("sampleCount"))
    samples = counts.pixels[..., channel]
    assert samples.min() < samples.max(), "no tile stopped before another: the test shows nothing"


FEW = ("--imageWidth", "32", "--samples", "1")


@pytest.fixture(scope="module")
def stage(folder):
    shutil.copytree(os.path.dirname(scene("texturedDiffuse")), folder / "scenes",
                    ignore=lambda _, names: [n for n in names if n not in ("texturedDiffuse.usda", "textures") and "." in n
                                             and n.endswith(".usda")])
    return str(folder / "scenes" / "texturedDiffuse.usda")


@pytest.fixture(scope="module")
def files(folder, stage):
    return parts(folder, stage, folder / "a.exr", "2", *FEW)


def other(folder, stage, *flags, part="1/2"):
    file = folder / "other.part"
    patina("record", stage, folder / "a.exr", *FEW, *flags, f"--part={part}", f"--partial={file}", "--quiet")
    return str(file)


def refusal(*arguments):
    result = patina("merge", *arguments, check=False)
    assert result.returncode == 1 and result.stderr.count("\n") == 1
    return result.stderr


@pytest.mark.parametrize("flags, differs", [
    (("--seed", "9"), "settings seed is 9, not 0"),
    (("--samples", "2"), "settings samples is 2, not 1"),
    (("--imageWidth", "33"), "settings width is 33, not 32"),
    (("--complexity", "medium"), "complexity is 1.1, not 1.0"),
])
def test_other_settings(folder, stage, files, flags, differs):
    file = other(folder, stage, *flags)
    text = refusal(files[0], file, folder / "x.exr")
    assert file in text and differs in text
    assert not (folder / "x.exr").exists()


def test_another_cut(folder, stage, files):
    assert "cut is 3, not 2" in refusal(files[0], other(folder, stage, part="1/3"), folder / "x.exr")


def test_a_changed_layer_and_a_changed_texture(folder, stage, files):
    textures = folder / "scenes" / "textures"
    texture = next(t for t in sorted(textures.rglob("*")) if t.is_file() and t.name in open(stage, encoding="utf-8").read())
    before = texture.read_bytes()
    texture.write_bytes(before + b" ")
    changed = other(folder, stage)
    texture.write_bytes(before)
    assert re.search(rf"{texture.name} is another", refusal(files[0], changed, folder / "x.exr"))
    text = open(stage, encoding="utf-8").read()
    with open(stage, "a", encoding="utf-8") as file:
        file.write("\n# changed\n")
    changed = other(folder, stage)
    with open(stage, "w", encoding="utf-8") as file:
        file.write(text)
    assert "texturedDiffuse.usda is another" in refusal(files[0], changed, folder / "x.exr")


def test_what_is_no_part(folder, stage, files):
    assert "is not a part" in refusal(stage, files[0], folder / "x.exr")
    damaged = folder / "damaged.part"
    data = bytearray(open(files[0], "rb").read())
    data[len(data) // 2] ^= 1
    damaged.write_bytes(data)
    assert "damaged" in refusal(damaged, files[1], folder / "x.exr")


def test_missing_parts_are_named_and_rendered(folder, stage, files):
    made = parts(folder, stage, folder / "a.exr", "2x1", *FEW)
    assert "part 1 of 2 is missing" in refusal(files[0], folder / "x.exr")
    patina("merge", made[0], folder / "rendered.exr", "--renderMissing", "--quiet")
    assert contents(folder / "rendered.exr") == whole(stage, folder / "whole2.exr", *FEW)
    assert not list(folder.glob("rendered.exr.*"))


def test_missing_parts_are_rendered_from_any_folder(folder, stage, monkeypatch):
    inner, elsewhere = folder / "inner", folder / "else" / "where"
    for one in (inner, elsewhere):
        one.mkdir(parents=True)
    (folder / "bright.usda").write_text('#usda 1.0\nover "looks"\n{\n}\n')
    flags = (*FEW, "--layer=../bright.usda")
    monkeypatch.chdir(inner)
    named = os.path.relpath(stage, inner)
    expected = whole(named, folder / "whole3.exr", *flags)
    made = parts(folder, named, "a.exr", "2", *flags)
    monkeypatch.chdir(elsewhere)
    patina("merge", made[1], "b.exr", "--renderMissing", "--json=told.json", "--quiet")
    assert contents(elsewhere / "b.exr") == expected
    assert os.getcwd() == str(elsewhere) and sorted(os.listdir(elsewhere)) == ["b.exr", "told.json"]
    assert os.listdir(inner) == []


def test_merging_writes_over_nothing_that_was_read(folder, stage, files):
    textures = sorted(t for t in (folder / "scenes" / "textures").iterdir() if t.suffix == ".png")
    before = textures[0].read_bytes()
    assert "this command reads" in refusal(*files, textures[0])
    assert textures[0].read_bytes() == before
    result = patina("record", stage, textures[0], *FEW, "--part=1/2", f"--partial={folder / 'p.part'}", check=False)
    assert result.returncode == 1 and "this command reads" in result.stderr
    result = patina("record", stage, folder / "p.exr", *FEW, "--part=1/2", f"--partial={folder / 'p.exr'}", check=False)
    assert result.returncode == 1 and "is the same file" in result.stderr


def test_rendering_what_is_missing_leaves_the_users_files(folder, stage, files):
    image = folder / "kept.exr"
    kept = folder / "kept.exr.1.part"
    kept.write_text("mine")
    patina("merge", files[0], image, "--renderMissing", "--quiet")
    assert image.exists() and kept.read_text() == "mine"
    assert sorted(folder.glob("kept.exr*")) == [image, kept]


def test_frames_keep_their_decimals(folder, stage):
    file = folder / "half.part"
    patina("record", stage, folder / "f.##.#.exr", *FEW, "--frames=1.5", "--part=1/1", f"--partial={file}", "--quiet")
    result = patina("merge", file, folder / "f.####.exr", check=False)
    assert result.returncode == 2 and "1 decimals" in result.stderr and not list(folder.glob("f.0*"))
    patina("merge", file, folder / "f.##.#.exr")
    assert len(list(folder.glob("f.*1.5.exr"))) == 1


def test_settings_prims_may_ask_for_denoising(folder):
    import _patina

    from patina.cli import denoiser
    from patina.cli.errors import CommandError

    try:
        denoiser.prepare(_patina)
    except CommandError as error:
        pytest.skip(str(error))
    text = open(scene("diffuseBox"), encoding="utf-8").read()
    stage = folder / "denoised.usda"
    stage.write_text(text + '\ndef RenderSettings "clean"\n{\n    bool patina:denoise = 1\n}\n')
    flags = ("--settings=/clean", *SIZE, "--samples=2")
    expected = whole(stage, folder / "clean.exr", *flags)
    assert "color.noisy.R" in expected[0] or any("noisy" in name for name in expected[0])
    patina("merge", *parts(folder, stage, folder / "clean.exr", "2", *flags), folder / "merged.exr")
    assert contents(folder / "merged.exr") == expected


def test_counts_are_those_of_the_frame(folder):
    stage, flags = scene("diffuseBox"), ("--imageWidth", "32", "--samples", "50")
    patina("record", stage, folder / "n.exr", *flags, "--quiet", f"--json={folder / 'whole.json'}")
    files = parts(folder, stage, folder / "n.exr", "1x2", *flags)
    patina("merge", *files, folder / "n.exr", f"--json={folder / 'merged.json'}")
    told = [json.loads((folder / f"{name}.json").read_text()) for name in ("whole", "merged")]
    for name in ("rays", "paths"):
        assert told[0][name] == told[1][name] > 0


@pytest.mark.parametrize("flags, status, words", [
    (("--part", "1/2"), 2, "--partial go together"),
    (("--part", "3/2", "--partial", "p"), 2, "invalid part"),
    (("--part", "1/2", "--partial", "p", "--seconds", "3"), 2, "--seconds"),
    (("--part", "1/2", "--partial", "p", "--backend", "raster"), 2, "path tracer"),
    (("--part", "1/2x2", "--partial", "p", "--tolerance", "0.1"), 2, "need --samples"),
    (("--part", "1/9", "--partial", "p", "--imageWidth", "16", "--imageHeight", "16"), 1, "1 tiles cannot be cut into 9"),
    (("--part", "1/1x9", "--partial", "p", "--samples", "8"), 1, "into 4 ranges at most"),
])
def test_usage(tmp_path, monkeypatch, flags, status, words):
    monkeypatch.chdir(tmp_path)
    result = patina("record", scene("diffuseBox"), tmp_path / "a.exr", *flags, check=False)
    assert result.returncode == status and words in result.stderr and result.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())
