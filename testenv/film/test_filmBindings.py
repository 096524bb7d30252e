# SPDX-License-Identifier: Apache-2.0
"""The film and image files as Python sees them: arrays, options, errors."""
import numpy as np
import pytest

import _patina



@pytest.fixture
def film():
    film = _patina.Film()
    film.reset(4, 3, ["depth", "primId", "primvars:st", "sampleCount"])
    film.add_color(1, 2, (1, 2, 3), 0.5)
    return film


def test_resolve_gives_arrays_with_the_top_row_first(film):
    color = film.resolve("color")
    assert color.shape == (3, 4, 3) and color.dtype == np.float32
    assert np.allclose(color[2, 1], (1, 2, 3)) and color.sum() == 6
    assert film.resolve("alpha").shape == (3, 4)
    assert film.resolve("primvars:st").shape == (3, 4, 2)
    ids = film.resolve("primId")
    assert ids.dtype == np.int32 and (ids == -1).all()
    assert film.resolve("depth")[0, 0] == np.float32(1e10)


def test_samples_that_are_no_numbers_are_counted(film):
    assert not film.add_color(0, 0, (float("nan"), 0, 0), 1)
    assert film.dropped_samples == 1
    with pytest.raises(IndexError):
        film.add_color(4, 0, (0, 0, 0), 1)


def test_exr_holds_aovs_and_metadata(film, tmp_path):
    path = str(tmp_path / "a.exr")
    _patina.write_images(film, path, {"half": True}, {"patina:stage": "x.usda", "patina:samples": 3, "patina:seconds": 1.5})
    image = _patina.read_image(path)
    assert {"R", "G", "B", "A", "depth.Z", "primId", "primvars:st.X", "sampleCount"} <= set(image.channels)
    assert image.pixels.shape == (3, 4, len(image.channels))
    assert image.metadata["patina:stage"] == "x.usda"
    assert image.metadata["patina:samples"] == 3
    assert image.metadata["patina:seconds"] == 1.5
    pixels, blue = image.pixels, image.channels.index("B")
    del image
    assert pixels[2, 1, blue] == 3  # the array keeps its memory


def test_arrays_are_written_through_the_display(tmp_path):
    path = str(tmp_path / "grey.png")
    _patina.write_image(path, np.full((5, 7, 3), 0.18))
    image = _patina.read_image(path)
    assert (image.width, image.height, len(image.channels)) == (7, 5, 3)
    assert np.allclose(image.pixels, 118 / 255, atol=1e-6)  # 1.055 * 0.18^(1/2.4) - 0.055 = 0.4614
    _patina.write_image(path, np.full((5, 7), 0.5), options={"raw": True, "bits": 16})
    assert np.allclose(_patina.read_image(path).pixels, 0.5, atol=1e-5)


def test_outliers_are_spread_in_what_a_display_shows_alone(tmp_path):
    film = _patina.Film()
    film.reset(24, 24, [])
    for y in range(24):
        for x in range(24):
            for i in range(16):  # one sample of one pixel is a thousand times too bright
                film.add_color(x, y, [200.0 if (x, y, i) == (9, 12, 3) else 0.19 + 0.02 * ((x + 3 * y + 7 * i) % 5) / 4] * 3)

    def written(name, **options):
        path = str(tmp_path / name)
        _patina.write_images(film, path, options)
        return np.array(_patina.read_image(path).pixels)[..., 0]

    kept, spread = written("kept.png", outliers="keep"), written("spread.png", outliers="spread")
    assert kept.argmax() == 12 * 24 + 9 and kept.max() == 1.0 and spread.max() < 0.6
    assert np.array_equal(written("plain.png"), kept)  # who says nothing measures
    for name, options in (("a.exr", {}), ("a.hdr", {}), ("a.tif", {"bits": 32}), ("b.png", {"raw": True})):
        assert np.array_equal(written("spread" + name, outliers="spread", **options), written("kept" + name, **options)), name
    with pytest.raises(ValueError, match="keep"):
        written("a.png", outliers="median")


def test_checkpoints_continue_a_film(film, tmp_path):
    path = str(tmp_path / "a.checkpoint")
    film.resume_token = "scene"
    film.save_checkpoint(path)
    other = _patina.Film()
    other.load_checkpoint(path)
    assert other.resume_token == "scene"
    assert np.array_equal(other.resolve("color"), film.resolve("color"))


@pytest.mark.parametrize("options, word", [({"bit": 8}, "bit"), ({"bits": "many"}, "bits"), ({"aovs": 3}, "aovs")])
def test_wrong_options_are_named(film, tmp_path, options, word):
    with pytest.raises(ValueError, match=word):
        _patina.write_images(film, str(tmp_path / "a.exr"), options)
    assert not list(tmp_path.iterdir())


def test_failures_are_one_line(film, tmp_path):
    for call in (lambda: _patina.write_images(film, str(tmp_path / "a.xyz")),
                 lambda: _patina.write_images(film, str(tmp_path / "no" / "a.exr")),
                 lambda: _patina.write_images(film, str(tmp_path / "a.png"), {"aovs": ["depth"]}),
                 lambda: _patina.write_images(_patina.Film(), str(tmp_path / "a.exr")),
                 lambda: _patina.read_image(str(tmp_path / "absent.exr")),
                 lambda: _patina.check_image_path(str(tmp_path / "a.exr"), ["glitter"]),
                 lambda: _patina.write_image(str(tmp_path / "a.png"), np.zeros((0, 3, 3)))):
        with pytest.raises(RuntimeError) as error:
            call()
        assert "\n" not in str(error.value)
    with pytest.raises(KeyError):
        film.resolve("glitter")
    assert not list(tmp_path.iterdir())


def test_a_film_that_is_rendered_into_is_left_alone(film, tmp_path):
    scene = _patina.Scene()
    with scene.edit() as edit:
        edit.set_camera("/c")
    path = str(tmp_path / "a.checkpoint")
    film.save_checkpoint(path)
    first, second = _patina.make_renderer("embree"), _patina.make_renderer("embree")
    settings = {"width": 64, "height": 64, "samples": 1 << 30}
    first.start(scene, "/c", settings, film)
    calls = [lambda: film.reset(9, 9), lambda: film.load_checkpoint(path), lambda: film.add_color(0, 0, (1, 1, 1), 1),
             lambda: _patina.denoise(film), lambda: _patina.merge_partial(film, path),
             lambda: second.start(scene, "/c", settings, film)]
    for call in calls:
        with pytest.raises(RuntimeError, match="stop"):
            call()
    first.start(scene, "/c", settings, film)  # by the same one again
    first.stop()
    film.reset(9, 9)
    film.load_checkpoint(path)
    assert film.resolve("color").shape == (3, 4, 3)


def test_none_is_no_scene():
    with pytest.raises(TypeError):
        _patina.Scene.edit(None)


def test_networks_of_very_many_nodes(tmp_path):
    """A look at all nodes before each would take 10^11 steps."""
    network = _patina.Network("/m")
    for i in range(300000):
        network.add_node(f"/m/n{i}", "ND_constant_float")
        network.set_input(f"/m/n{i}", "value", "float", float(i))
    with pytest.raises(ValueError, match="already has"):
        network.add_node("/m/n7", "ND_constant_float")
