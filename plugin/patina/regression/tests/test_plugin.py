# SPDX-License-Identifier: Apache-2.0
"""`pytest --patina-scenes`: golden images are made, hold for another noise, and fail for another picture. Each test runs a
pytest of its own in a folder of its own."""
import json
import os
import subprocess
import sys

import numpy as np
import pytest

from patina.regression import golden, plugin, welch
from patina.regression.scenes import Folder, Scene, SceneError

STAGE = """#usda 1.0
def Camera "camera"
{
    double3 xformOp:translate = (0, 0, 6)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "sky"
{
}
def SphereLight "lamp"
{
    float inputs:radius = 0.3
    float inputs:intensity = 20
    double3 xformOp:translate = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Sphere "ball"
{
    color3f[] primvars:displayColor = [(0.5, COLOUR, 0.1)]
}
"""
SETTINGS = {"*": {"arguments": ["-w", "32", "--samples", "16"], "renders": 4}}


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "one.usda").write_text(STAGE.replace("COLOUR", "0.2"))
    (tmp_path / "scenes.json").write_text(json.dumps(SETTINGS))
    return tmp_path


def run(folder, *arguments):
    """:returns: exit status and output of a pytest that knows the plugin alone"""
    done = subprocess.run([sys.executable, "-m", "pytest", "-p", "patina.regression.plugin", "-p", "no:cacheprovider", "-q",
                           "-rA",
                           "--patina-scenes", str(folder), *arguments], cwd=folder.parent, capture_output=True, text=True,
                          env=dict(os.environ, PYTEST_DISABLE_PLUGIN_AUTOLOAD="1"))
    return done.returncode, done.stdout + done.stderr


def edit(folder, before, after):
    text = (folder / "one.usda").read_text()
    assert before in text
    (folder / "one.usda").write_text(text.replace(before, after))


def test_the_way_of_a_scene(folder):
    status, text = run(folder)
    assert status == 1 and "there is no golden image" in text and "--patina-update" in text
    assert run(folder, "--patina-update")[0] == 0
    assert (folder / "golden" / "one.usda.npz").exists() and (folder / "golden" / "one.usda.exr").exists()
    status, text = run(folder)
    assert status == 0 and "1 passed" in text
    edit(folder, "(0.5, 0.2, 0.1)", "(0.5, 0.24, 0.1)")  # a fifth more green
    status, text = run(folder)
    assert status == 1 and "tiles differ" in text and " G +" in text, text
    assert (folder / "failed" / "one.usda.exr").exists() and (folder / "failed" / "one.usda.difference.png").exists()
    assert run(folder, "--patina-update")[0] == 0 and run(folder)[0] == 0


def test_a_page_tells_of_the_run(folder):
    (folder / "two.usda").write_text((folder / "one.usda").read_text())
    page = folder / "report.html"
    assert run(folder, "--patina-update", "--patina-report", str(page))[0] == 0
    text = page.read_text()
    assert "2 stages passed" in text and text.count("<img ") == 2 and "golden images made" in text
    edit(folder, "(0.5, 0.2, 0.1)", "(0.5, 0.3, 0.1)")
    (folder / "<three>.usda").write_text("#usda 1.0\n")
    status, said = run(folder, "--patina-report", str(page))
    assert status == 1 and "has 3 stages with their pictures" in said
    text = page.read_text()
    assert "2 of 3 stages failed" in text and "<script" not in text and "Content-Security-Policy" in text
    # What failed stands first, with golden and new picture and their difference; names of files are no markup.
    order = [text.index(part) for part in ("one.usda <span", "tiles differ", "&lt;three&gt;.usda", "two.usda <span")]
    assert order == sorted(order) and text.count("<img ") == 4 and "<three>" not in text
    status, said = run(folder, "--patina-report", str(folder / "nowhere" / "report.html"))
    assert status == 4 and "--patina-report" in said  # before anything is rendered


def test_another_noise_is_the_same_picture(folder):
    """The golden renders' own seeds would have their bits; others are judged by the statistics (at most 1 % are rejected)."""
    stage, scene = str(folder / "one.usda"), Folder(folder).scene("one.usda")
    made, _, _ = golden.Golden.made(stage, scene)
    assert golden.compare(stage, scene, made).image is None
    made.first = "another build's bits"
    result = golden.compare(stage, scene, made)
    assert result.image is not None and "tiles differ" not in result.problem and result.sees > scene.margin


def test_a_test_that_cannot_see_a_difference_says_so():
    """Half of the tiles are a background without noise: those show any difference, and say nothing of the others. Noise of 10 %
    in four renders hides far more than 5 %; seed 5."""
    generator = np.random.default_rng(5)
    means = np.ones((4, 6, 8, 3))
    means[:, :, :4] += generator.normal(0.0, 0.1, (4, 6, 4, 3))
    scene = Scene(arguments=("-w", "64", "--samples=16"))
    seen = golden.seen(welch.compare(means, means), scene)
    assert seen > 0.3
    problem = golden.blind(seen, scene)
    wanted = int(problem.partition("--samples ")[2].split()[0])
    assert "has to see 5 %" in problem and wanted == pytest.approx(16 * ((seen - 0.01) / 0.04) ** 2, abs=16)
    assert not golden.blind(0.05, scene)
    assert golden.seen(welch.compare(np.ones_like(means), np.ones_like(means)), scene) == scene.margin  # there is no noise


def test_the_way_to_accept_is_that_of_the_installation(monkeypatch):
    item = type("Item", (), {"config": type("Config", (), {"getoption": lambda self, name: "my scenes"})(), "name": "a.usda"})()
    monkeypatch.delenv("PATINA_COMMAND", raising=False)
    assert plugin._Stage._how(item) == "pytest --patina-scenes 'my scenes' -k a.usda --patina-update"
    monkeypatch.setenv("PATINA_COMMAND", "./patina")
    assert plugin._Stage._how(item).startswith("./patina python -m pytest -p patina.regression.plugin --patina-scenes ")


def test_what_cannot_be_compared_is_told(folder):
    stage, scene = str(folder / "one.usda"), Folder(folder).scene("one.usda")
    made, _, _ = golden.Golden.made(stage, scene)
    made.size = (31, 18)
    assert "the golden one 31 x 18" in golden.compare(stage, scene, made).problem
    other = Scene(arguments=("-w", "16"), renders=2)
    assert "the golden image was made with -w 32" in golden.compare(stage, other, made).problem
    (folder / "two.usda").write_text("no stage")
    status, text = run(folder, "--patina-update", "-k", "two")
    assert status == 1 and "two.usda" in text and "cannot be opened" in text
    (folder / "golden").mkdir(exist_ok=True)
    (folder / "golden" / "one.usda.npz").write_text("no numbers")
    assert "cannot be read" in run(folder, "-k", "one")[1]


@pytest.mark.parametrize("text, words", [
    ("{", "scenes.json"), ("[]", "an object is expected"), ('{"*": {"sampels": 1}}', "there is no 'sampels'"),
    ('{"*": {"renders": 1}}', "from 2 to 1000"), ('{"*": {"margin": -1}}', "0 or more"),
    ('{"*": {"margin": 0.1}}', "sees is a number above the margin"),
    ('{"*": {"arguments": "-w 3"}}', "list of texts"), ('{"*": {"arguments": ["--seed", "3"]}}', "--seed is chosen"),
    ('{"stages": "*"}', "list of patterns"), ('{"a": 1}', "is an object")])
def test_settings_that_cannot_be_used(folder, text, words):
    (folder / "scenes.json").write_text(text)
    with pytest.raises(SceneError, match=words.replace("(", "[(]")):
        Folder(folder)


def test_a_folder_that_is_not_there_ends_the_run(folder):
    status, text = run(folder / "none")
    assert status == 4 and "there is no folder" in text


def test_stages_are_chosen_by_patterns(folder):
    (folder / "shots" / "a").mkdir(parents=True)
    (folder / "shots" / "a" / "b.usda").write_text("")
    (folder / "golden").mkdir()
    (folder / "golden" / "one.usda").write_text("")
    assert Folder(folder).names() == ["one.usda"]
    (folder / "scenes.json").write_text(json.dumps({"stages": ["**/*.usd*"], "*": {"renders": 3}, "shots/*": {"renders": 5}}))
    chosen = Folder(folder)
    assert chosen.names() == ["one.usda", "shots/a/b.usda"]
    assert [chosen.scene(name).renders for name in chosen.names()] == [3, 5]


def test_equal_pictures_are_rejected_no_more_often_than_stated():
    """400 pairs of noise alone, without margin: at 1 % each, more than 12 rejections have a probability below 0.001
    (binomial); seed 3."""
    generator = np.random.default_rng(3)
    rejected = sum(welch.compare(*generator.normal(1.0, 0.1, (2, 4, 3, 5, 3))).outside(0.0).any() for _ in range(400))
    assert rejected <= 12


def test_the_help_names_what_there_is():
    for flag in ("--patina-scenes", "--patina-update"):
        assert flag in plugin.__doc__


FAKE = """import os, shutil, sys
import numpy as np
if sys.argv[1:] == ["--help"]:
    sys.exit(print("usage: usdrecord [--renderer {Truth,Storm}] [--disableCameraLight] ..."))
words = [word for word in sys.argv[1:] if word != "--disableCameraLight"]
assert len(words) == len(sys.argv) - 2
values = dict(zip(words[:-2:2], words[1:-2:2]))
assert values == {"--renderer": values["--renderer"], "--colorCorrectionMode": "disabled", "--imageWidth": "32",
                  "--camera": "/camera"}, words
stage, image = words[-2:]
shutil.copy(os.path.join(os.path.dirname(stage), "golden", "one.usda.exr"), image)
if values["--renderer"] == "Storm":
    import _patina
    found = np.array(_patina.read_image(image).pixels)[..., :3]
    found[: len(found) // 2] *= 1.2
    _patina.write_image(image, found)
"""


def test_other_delegates_are_held_to_the_same_golden_images(folder):
    (folder / "fake.py").write_text(FAKE)
    record = ["--usdrecord", f"{sys.executable} {folder / 'fake.py'}", "--renderer"]
    (folder / "scenes.json").write_text(json.dumps({"*": dict(SETTINGS["*"], sees=0.2)}))
    assert run(folder, "--patina-update")[0] == 0
    status, text = run(folder, *record, "HdTruthRendererPlugin")
    assert status == 0, text
    status, text = run(folder, *record, "Storm")
    assert status == 1 and "tiles differ" in text and "tile row 0" in text, text
    assert run(folder, *record, "Storm", "--patina-update")[0] == 0
    status, text = run(folder)
    assert status == 1 and "tiles differ" in text, "the golden images are the delegate's own"


def test_delegates_that_are_not_there_end_the_run(folder):
    (folder / "fake.py").write_text(FAKE)
    status, text = run(folder, "--usdrecord", f"{sys.executable} {folder / 'fake.py'}", "--renderer", "HdArnoldRendererPlugin")
    assert status == 4 and "has no renderer HdArnoldRendererPlugin (there are: Truth, Storm)" in text
    status, text = run(folder, "--usdrecord", str(folder / "none"), "--renderer", "Storm")
    assert status == 4 and "none cannot be run: No such file or directory; --usdrecord names another" in text
