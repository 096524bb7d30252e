# SPDX-License-Identifier: Apache-2.0
"""`patina denoise`: less error and flicker with the frames around, the same bits for any subset, a word on each bad input."""
import os

import numpy as np
import pytest

import _patina
import inProcess
import sequences
from inProcess import channels, patina

SIZE = ["-w", "64", "--imageHeight", "36", "--camera", "camera"]


@pytest.fixture(scope="module")
def noisy(tmp_path_factory):
    """:returns: pattern of the frames of a room that a camera passes through, with four samples"""
    pytest.importorskip("pyoidn", reason="pyoidn is not installed")
    folder = tmp_path_factory.mktemp("frames")
    (folder / "camera.usda").write_text(sequences.stages()["camera"])
    return sequences.recorded(folder / "camera.usda", str(folder), "noisy", "--samples", "4", "--denoiseLater", *SIZE)


def file_of(pattern, frame):
    return str(pattern).replace("###", f"{frame:03d}")


def changed(path, made, change=None, **attributes):
    """Writes a frame with other pixels. :param change: function of a dict of channels, which may take some away"""
    image = _patina.read_image(str(path))
    found = dict(zip(image.channels, np.moveaxis(np.array(image.pixels), -1, 0)))
    (change or (lambda found: None))(found)
    _patina.write_image(str(made), np.stack(list(found.values()), axis=-1), list(found), {},
                        {"patina:samples": 4.0, **attributes})


@pytest.fixture
def copies(noisy, tmp_path):
    """:returns: function(change=None, **frames): pattern of three frames, of which some are changed, or left out as None"""
    def made(**frames):
        for frame in (1, 2, 3):
            change = frames.get(f"f{frame}", lambda found: None)
            if change:
                changed(file_of(noisy, frame), tmp_path / f"f.{frame:03d}.exr", change, **{"patina:seed": frame})
        return tmp_path / "f.###.exr"
    return made


def failed(*arguments):
    result = patina("denoise", *arguments, check=False)
    assert result.returncode == 1 and not result.stdout, result
    return result.stderr


def test_error_and_flicker_fall_beside_frames_alone(noisy, tmp_path):
    """A camera moves. Two references leave no noise of their own in the mean. It is tested one-sided, 1 %, over 32 blocks of
    8 x 8 pixels and all frames, since frames share their noise, and the denoiser spreads a bright pixel over some pixels."""
    stage = os.path.join(os.path.dirname(noisy), "camera.usda")
    truths = np.array([sequences.pictures(sequences.recorded(stage, str(tmp_path), f"t{seed}", "--samples", "64", "--seed",
                                                             seed, *SIZE)) for seed in (77, 78)])
    found = [sequences.squares(sequences.pictures(sequences.denoised(noisy, around)), truths) for around in (0, 2)]
    for alone, together in zip(*found):
        blocks = (alone - together).mean(axis=(0, 3))[2:34].reshape(4, 8, 8, 8).mean(axis=(1, 3)).ravel()
        assert blocks.mean() > 2.453 * blocks.std(ddof=1) / np.sqrt(len(blocks)), blocks  # t31


def test_it_is_what_record_makes_of_a_frame_alone(noisy, tmp_path):
    """Without frames around: the bits of `record --denoise`, and every other channel as it was."""
    stage = os.path.join(os.path.dirname(noisy), "camera.usda")
    inProcess.record(stage, tmp_path / "once.exr", "--frames", "3", "--samples", "4", "--denoiseLater", "--denoise", *SIZE)
    patina("denoise", file_of(noisy, 3), tmp_path / "later.exr", "-q")
    once, later, before = (channels(path) for path in (tmp_path / "once.exr", tmp_path / "later.exr", file_of(noisy, 3)))
    assert once.keys() == later.keys()
    for name, values in later.items():
        np.testing.assert_array_equal(values, once[name], name)
        if name in before and name not in "RGB":
            np.testing.assert_array_equal(values, before[name], name)


def test_each_frame_has_its_seed(noisy):
    seeds = [_patina.read_image(file_of(noisy, frame)).metadata["patina:seed"] for frame in (1, 2, 7)]
    assert seeds == [1000, 2000, 7000]


def test_any_subset_order_and_threads_give_the_same_bits(noisy, tmp_path):
    patina("denoise", noisy, tmp_path / "a.###.exr", "--frames", "1:7", "--around", 2, "-q")
    for name, more in (("b", ["--frames", "5,3", "--threads", 1]), ("c", ["--frames", "7:1x2", "--threads", 2])):
        patina("denoise", noisy, tmp_path / f"{name}.###.exr", "--around", 2, "-q", *more)
    for name, frames in (("b", (3, 5)), ("c", (1, 3, 5, 7))):
        for frame in frames:
            a, b = (inProcess.pixels(tmp_path / f"{which}.{frame:03d}.exr") for which in ("a", name))
            np.testing.assert_array_equal(a, b)
    assert _patina.read_image(str(tmp_path / "a.002.exr")).metadata["patina:around"] == "1 3 4"


def test_denoised_frames_are_denoised_from_their_noise(noisy, tmp_path):
    patina("denoise", noisy, tmp_path / "a.###.exr", "--frames", "1:3", "-q")
    for name, source in (("b", tmp_path / "a.###.exr"), ("c", noisy)):
        patina("denoise", source, tmp_path / f"{name}.###.exr", "--frames", "2", "--around", 1, "-q")
    b, c = (channels(tmp_path / f"{name}.002.exr") for name in "bc")
    assert b.keys() == c.keys()
    for name in b:
        np.testing.assert_array_equal(b[name], c[name], name)


def test_window_space_and_compression_stay(noisy, tmp_path):
    image = _patina.read_image(file_of(noisy, 1))
    window = [-2, 3, 61, 38]
    _patina.write_image(str(tmp_path / "a.exr"), image.pixels, image.channels,
                        {"data_window": window, "display_width": 70, "display_height": 50, "compression": "piz",
                         "pixel_aspect_ratio": 2.0, "rendering_color_space": "acescg"}, {"patina:stage": "x"})
    patina("denoise", tmp_path / "a.exr", tmp_path / "b.exr", "-q")
    a, b = (_patina.read_image(str(tmp_path / f"{name}.exr")) for name in "ab")
    assert (b.x, b.y, b.width, b.height, b.display_width, b.display_height) == (-2, 3, 64, 36, 70, 50)
    assert b.pixel_aspect_ratio == 2.0
    for name in ("chromaticities", "compression", "patina:stage"):
        assert b.metadata[name] == a.metadata[name]


def test_neighbours_that_are_missing_are_named(copies, tmp_path):
    source = copies(f1=None)
    said = patina("denoise", source, tmp_path / "o.###.exr", "--frames", "2", "--around", 3).stderr
    assert f"not there, so left out: {tmp_path}/f.001.exr, {tmp_path}/f.004.exr\n" in said
    assert "of 2 frames" in said


def test_frames_that_are_missing_are_an_error_and_nothing_is_written(copies, tmp_path):
    source = copies(f2=None)
    said = failed(source, tmp_path / "o.###.exr", "--frames", "1:4")
    assert f"there is no file {tmp_path}/f.002.exr, nor 1 more of --frames 1:4" in said
    assert not (tmp_path / "o.001.exr").exists()


@pytest.mark.parametrize("aov,around", [("denoisingAlbedo", 0), ("denoisingNormal", 0), ("motionForward", 1), ("depth", 1)])
def test_an_aov_that_is_missing_is_named(aov, around, copies, tmp_path):
    def without(found):
        for name in [name for name in found if name.startswith(aov)]:
            del found[name]

    source = copies(f2=without)
    said = failed(source, tmp_path / "o.###.exr", "--frames", "2", "--around", around)
    assert f"{tmp_path}/f.002.exr has no {aov}: record it with --denoiseLater, or with --aov {aov}\n" in said


def test_a_frame_alone_needs_no_motion(copies, tmp_path):
    def without(found):
        for name in [name for name in found if name.startswith(("motion", "depth", "sampleCount"))]:
            del found[name]

    patina("denoise", copies(f2=without), tmp_path / "o.###.exr", "--frames", "2", "-q")
    assert np.isfinite(inProcess.pixels(tmp_path / "o.002.exr")).all()


def test_another_size_is_refused(copies, tmp_path):
    def cut(found):
        for name in found:
            found[name] = found[name][1:]

    source = copies(f3=cut)
    said = failed(source, tmp_path / "o.###.exr", "--frames", "2", "--around", 1)
    assert f"{tmp_path}/f.003.exr has 64 x 35 pixels at 0, 0 of 64 x 35, but {tmp_path}/f.00" in said
    patina("denoise", source, tmp_path / "o.###.exr", "--frames", "2:3", "-q")  # each alone


def test_pixels_that_are_no_numbers(copies, tmp_path):
    def spoil(found):
        found["R"][5, 7] = np.nan
        found["denoisingNormal.X"][6, 8] = np.inf
        found["G"][9, 9] = -np.inf

    for around, says in ((0, "2 pixels are not finite; they count as black"), (1, "2 pixels are not finite; frames around")):
        said = patina("denoise", copies(f2=spoil), tmp_path / "o.###.exr", "--frames", "2", "--around", around).stderr
        assert f"{tmp_path}/f.002.exr: {says}" in said
        assert np.isfinite(inProcess.pixels(tmp_path / "o.002.exr")).all()


def test_frames_of_one_seed_are_told(copies, tmp_path):
    source = copies()
    for frame in (1, 3):
        changed(file_of(source, frame), file_of(source, frame), **{"patina:seed": 2})
    said = patina("denoise", source, tmp_path / "o.###.exr", "--frames", "1:3", "--around", 1).stderr
    assert said.count("have the same seed") == 1 and "--denoiseLater" in said


def test_nothing_is_written_over_what_is_read(copies, tmp_path):
    source = copies()
    for image, frames in ((source, "2"), (tmp_path / "f.<F3>.exr", "1:3")):
        assert "this command reads" in failed(source, image, "--frames", frames)
    os.link(file_of(source, 3), tmp_path / "o.002.exr")
    assert "this command reads" in failed(source, tmp_path / "o.###.exr", "--frames", "2", "--around", 1)


def test_other_files_are_refused(copies, tmp_path):
    source = copies()
    (tmp_path / "p.002.part").write_bytes(b"part")
    assert "`patina merge` makes such an image of parts" in failed(tmp_path / "p.###.part", tmp_path / "o.###.exr",
                                                                   "--frames", "2")
    assert "reads and writes OpenEXR" in failed(source, tmp_path / "o.###.png", "--frames", "2")
    (tmp_path / "p.002.exr").write_bytes(b"part")
    assert f"cannot read '{tmp_path}/p.002.exr'" in failed(tmp_path / "p.###.exr", tmp_path / "o.###.exr", "--frames", "2")
    assert "the folder" in failed(source, tmp_path / "no" / "o.###.exr", "--frames", "2")


@pytest.mark.parametrize("arguments,says", [
    (["f.###.exr", "o.exr", "--frames", "1:2"], "o.exr needs one place for the frame"),
    (["f.exr", "o.###.exr", "--frames", "1:2"], "f.exr needs one place for the frame"),
    (["f.###.exr", "o.###.exr"], "has a place for frames, but there is no --frames"),
    (["f.exr", "o.exr", "--around", "1"], "--around needs --frames"),
    (["f.###.exr", "o.###.exr", "--frames", "1:2", "--around", "-1"], "--around"),
    (["f.###.exr", "o.###.exr", "--frames", "1:2", "--around", "17"], "number of frames (0 to 16)"),
    (["f.###.exr", "o.###.exr", "--frames", "1:2", "--threads", "-1"], "--threads"),
    (["f.###.exr", "o.###.exr", "--frames", "STARTTIME"], "'STARTTIME' is no frame"),
    (["f.###.exr", "o.###.exr", "--frames", "1.5"], "have 1 decimals")])
def test_wrong_usage(arguments, says):
    result = patina("denoise", *arguments, check=False)
    assert result.returncode == 2 and says in result.stderr, result.stderr


def test_denoise_later_is_of_an_image(tmp_path):
    result = patina("record", inProcess.scene("lightDome"), "--settings", "/x", "--denoiseLater", check=False)
    assert result.returncode == 2 and "--denoiseLater is of IMAGE alone" in result.stderr
