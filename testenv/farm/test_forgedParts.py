# SPDX-License-Identifier: Apache-2.0
"""Parts from somebody else, with right checksums: they are refused in one line, or harmless."""
import argparse
import copy
import json
import os
import re

import pytest

import _patina
from inProcess import patina, scene
from patina import limits, messages
from patina.cli import record
from patina.farm import cut, missing, partial


FLAGS = ("--imageWidth=8", "--imageHeight=8", "--samples=1", "--quiet")
OTHERS = (None, 5, "x", [], {})  # one of each kind that JSON has
NAME_OF_ERROR = re.compile(r"[A-Za-z]Error\b|Traceback|Exception")


class Real:
    """A part as `patina record` writes it, and copies of it with other words and right checksums."""

    def __init__(self, folder):
        self.folder, file = folder, str(folder / "real.part")
        patina("record", scene("diffuseBox"), folder / "a.exr", *FLAGS, "--part=1/1", f"--partial={file}")
        self.film = _patina.Film()
        self.report = json.loads(_patina.merge_partial(self.film, file))
        self.header = json.loads(_patina.partial_description(file))

    def forged(self, header=None, report=None):
        file = str(self.folder / "forged.part")
        tiles = _patina.tiles_of_part(self.film.width, self.film.height, (0, 0, -1, -1), 0, 1)
        writer = _patina.PartialWriter(file, json.dumps(self.header if header is None else header), tiles)
        writer.add(self.film)
        writer.commit(json.dumps(self.report if report is None else report))
        return file


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    return Real(tmp_path_factory.mktemp("forged"))


def places(values, **deep):
    """:returns: keys of a dict, and some of dicts in it, as tuples"""
    return [(name,) for name in values] + [(name, inner) for name, inside in deep.items() for inner in inside]


def replaced(values, place, value):
    values = copy.deepcopy(values)
    inside = values
    for name in place[:-1]:
        inside = inside[name]
    inside[place[-1]] = value
    return values


def merged(file, image, *flags):
    """:returns: the finished command, which told nothing of Python"""
    result = patina("merge", file, image, "--quiet", *flags, check=False)
    assert result.returncode in (0, 1), result.stderr
    assert not NAME_OF_ERROR.search(result.stderr) and result.stderr.count("\n") == result.returncode, result.stderr
    return result


def test_the_forger_changes_nothing_by_itself(real, tmp_path):
    assert merged(real.forged(), tmp_path / "a.exr").returncode == 0


def test_each_field_of_a_header(real, tmp_path):
    refused = set()
    for place in places(real.header, settings=("minSamples", "seed", "tolerance"), options=real.header["options"]):
        for value in OTHERS:
            image = tmp_path / "a.exr"
            result = merged(real.forged(header=replaced(real.header, place, value)), image, f"--json={tmp_path / 'a.json'}")
            assert image.exists() == (result.returncode == 0), (place, value)
            image.unlink(missing_ok=True)
            if result.returncode:
                refused.add(place)
    assert refused >= {(name,) for name in ("identity", "part", "range", "arguments", "options", "frame", "camera", "settings",
                                            "noiseTolerance", "folder", "home", "denoise", "decimals")}


def test_each_field_of_a_report(real, tmp_path):
    refused = set()
    report = dict(real.report, warnings=[messages.warning("/a", "b", "settingNotNumbers", 3)],
                  plans={"/m": {"error": 0.1, "albedo": 0.5, "choices": [{"point": "lobe", "method": "exact"}]}})
    one = [("warnings", 0), *(("warnings", 0, name) for name in report["warnings"][0])]
    deep = places(report, statistics=("rays", "maxDepth"), seconds=("render", "build"), plans=("/m",))
    for place in [*deep, *one]:
        for value in OTHERS:
            image = tmp_path / "a.exr"
            result = merged(real.forged(report=replaced(report, place, value)), image, f"--json={tmp_path / 'a.json'}")
            assert image.exists() == (result.returncode == 0), (place, value)
            image.unlink(missing_ok=True)
            if result.returncode:
                refused.add(place)
    assert refused >= {("statistics",), ("seconds",), ("warnings",), ("backend",), ("plans",), ("seconds", "render"),
                       ("plans", "/m"), *one}


@pytest.mark.parametrize("values", [None, 5, "x", [], {}, {"part": "1/1"}])
def test_no_header_and_no_report(real, tmp_path, values):
    assert merged(real.forged(header=values if values is not None else []), tmp_path / "a.exr").returncode == 1
    assert merged(real.forged(report=values if values is not None else []), tmp_path / "a.exr").returncode == 1


def test_reports_lack_fields(real, tmp_path):
    for name in real.report:
        report = {key: value for key, value in real.report.items() if key != name}
        assert merged(real.forged(report=report), tmp_path / "a.exr").returncode == 1, name


@pytest.mark.parametrize("place, value", [
    (("arguments",), {}), (("settings",), {"minSamples": 1}), (("frame",), "x"), (("frame",), [1]), (("frame",), float("inf")),
    (("frame",), float("nan")), (("home",), "a\0b"), (("folder",), "a\0b"), (("arguments", "stage"), "a\0b"),
    (("identity", "files"), {"a\0b/<UDIM>.png": "x"}), (("decimals",), -1), (("decimals",), 10 ** 30), (("denoise",), "no"),
    (("camera",), "\ud800")])
def test_what_is_refused(real, tmp_path, place, value):
    file = real.forged(header=replaced(real.header, place, value))
    for flags in ((), ("--renderMissing",)):
        result = merged(file, tmp_path / "a.###.exr", *flags)
        assert result.returncode == 1 and result.stderr == f"patina: {file} is of another version of Patina\n"
    assert not list(tmp_path.glob("a*"))


def test_headers_that_are_nested_too_deeply(real, tmp_path):
    text = json.dumps(real.header)
    deep = '{"x": ' + "[" * 100000 + "]" * 100000 + ", " + text[1:]
    file = str(tmp_path / "deep.part")
    writer = _patina.PartialWriter(file, deep, _patina.tiles_of_part(8, 8))
    writer.add(real.film)
    writer.commit("{}")
    assert merged(file, tmp_path / "a.exr").returncode == 1


def test_arguments_with_which_missing_parts_are_rendered(real, tmp_path):
    """Of 1x1 the other part of 1x2 is missing; its render begins with each of these, and ends before it is a part."""
    header = replaced(replaced(real.header, ("part",), "1/1x2"), ("identity", "cut"), "1x2")
    for name in ("stage", "camera", "samples", "imageWidth", "dataWindow", "layer", "set", "method", "purposes", "given"):
        for value in OTHERS[1:]:
            forged = replaced(header, ("arguments", name), value)
            result = merged(real.forged(header=forged), tmp_path / "a.exr", "--renderMissing")
            assert result.returncode == 1 and os.listdir(tmp_path) == [], (name, value)


@pytest.fixture
def asked(tmp_path, monkeypatch):
    """:returns: a function that asks for a missing part with a header, and returns what the render is given"""
    def ask(header):
        seen = []
        monkeypatch.setattr(record, "run", seen.append)
        merge = argparse.Namespace(image=str(tmp_path / "a.exr"), threads=1, quiet=True)
        missing.render(partial.Description("a.part", header), cut.part("1/1"), str(tmp_path / "b.part"), merge)
        return seen[0]

    return ask


def test_arguments_that_no_command_line_has_are_left_out(real, asked):
    flags = asked(replaced(real.header, ("arguments", "run"), "other"))
    assert not hasattr(flags, "run") and flags.samples == 1 and flags.given == real.header["arguments"]["given"]
    assert flags.part == cut.part("1/1") and flags.json is None


def test_limits_are_those_of_the_command_that_renders(real, monkeypatch, tmp_path):
    seen = []
    monkeypatch.setattr(record, "run", lambda _: seen.append(limits.value("instances")))
    header = replaced(replaced(real.header, ("part",), "1/1x2"), ("identity", "cut"), "1x2")
    file = real.forged(header=replaced(header, ("arguments", "limit"), ["instances=3"]))
    for flags in ((), ("--limit=instances=2",)):
        merged(file, tmp_path / "a.exr", "--renderMissing", *flags)
    assert seen == [limits.table()["instances"][0], 2]


def test_arguments_that_a_part_lacks_are_those_of_a_blank_command_line(real, asked):
    flags = asked(replaced(real.header, ("arguments",), {"stage": "a.usda"}))
    assert flags.stage == "a.usda" and flags.backend == "embree" and flags.layer == []
