# SPDX-License-Identifier: Apache-2.0
"""Frame specs expand as usdrecord's do, and frames get their place in the image's name."""
import pytest
from pxr import UsdUtils

from patina.cli import frames
from patina.cli.errors import CommandError, UsageError


class Stage:
    def GetStartTimeCode(self):
        return 3.0

    def GetEndTimeCode(self):
        return 5.0


class Arguments:
    def __init__(self, image, spec=None, default=False):
        self.image, self.frames, self.defaultTime = image, spec, default


@pytest.mark.parametrize("spec, expected", [
    ("7", [7]),
    ("-2", [-2]),
    ("101:103", [101, 102, 103]),
    ("103:101", [103, 102, 101]),
    ("1:10x4", [1, 5, 9]),
    ("1:2x0.5", [1, 1.5, 2]),
    ("1,5:6,10:14x2", [1, 5, 6, 10, 12, 14]),
    ("STARTTIME:ENDTIME", [3, 4, 5]),
    ("@START:END", [3, 4, 5]),
    ("STARTTIME:ENDTIMEx2", [3, 5]),
    ("ENDTIME", [5]),
])
def test_spec(spec, expected):
    assert frames.expand(spec, 3.0, 5.0)[0] == pytest.approx(expected)


@pytest.mark.parametrize("spec", ["101:109x2", "101:104x0.5", "105:101", "1:10x3", "2:2"])
def test_spec_means_what_usd_says(spec):
    theirs = [code.GetValue() for code in UsdUtils.TimeCodeRange.CreateFromFrameSpec(spec)]
    assert frames.expand(spec, 0, 0)[0] == pytest.approx(theirs)


def test_stride_does_not_lose_the_last_frame_to_rounding():
    assert len(frames.expand("0:1x0.1", 0, 0)[0]) == 11


@pytest.mark.parametrize("spec", ["", "a", "1:", ":2", "1:2x0", "1:2x", "1:2:3", "nan", "1:inf", "0:9999999999", "1,,2"])
def test_broken_spec_is_a_usage_error(spec):
    with pytest.raises(UsageError):
        frames.expand(spec, 0.0, 1.0)


@pytest.mark.parametrize("pattern, frame, expected", [
    ("a.####.png", 7, "a.0007.png"),
    ("a.#.png", 123, "a.123.png"),
    ("f/###.##.exr", 1.5, "f/001.50.exr"),
    ("a.###.png", -1, "a.-01.png"),
    ("a.<F4>.png", 7, "a.0007.png"),
    ("a.<F>.png", 123, "a.123.png"),
    ("a.%04d.png", 7, "a.0007.png"),
    ("%d/a.png", 12, "12/a.png"),
    ("/proj#1/a.####.exr", 7, "/proj#1/a.0007.exr"),
    ("my%20dir/%4d.png", 7, "my%20dir/   7.png"),
    ("my%20dir/%d/a.png", 7, "my%20dir/7/a.png"),
])
def test_name(pattern, frame, expected):
    assert frames.image_name(pattern, frame, 0) == expected


def test_names_need_room_for_decimals():
    with pytest.raises(UsageError, match="room"):
        frames.image_name("a.###.png", 1.5, 1)


def test_plan():
    assert frames.plan(Arguments("a.png"), Stage()) == [(3.0, "a.png")]
    assert frames.plan(Arguments("a.png", default=True), Stage()) == [(None, "a.png")]
    assert frames.plan(Arguments("a.png", "9"), Stage()) == [(9.0, "a.png")]
    assert frames.plan(Arguments("a.#.png", "1:2"), Stage()) == [(1.0, "a.1.png"), (2.0, "a.2.png")]


def test_what_only_looks_like_a_place_is_none(tmp_path):
    assert not frames.has_place("my%20dir/a.png") and not frames.has_place("a%20d.png")
    (tmp_path / "proj#1").mkdir()
    assert not frames.has_place(f"{tmp_path}/proj#1/a.png") and frames.has_place(f"{tmp_path}/proj#2/a.png")


@pytest.mark.parametrize("image, spec", [("a.png", "1:2"), ("a.#.b.#.png", "1:2"), ("a.#.b.<F>.png", "1:2"), ("a.#.png", None),
                                         ("a.%d.png", None), ("a.<F2>.png", "1:2x0.5")])
def test_plan_refuses_names_that_do_not_fit(image, spec):
    with pytest.raises(UsageError):
        frames.plan(Arguments(image, spec), Stage())


def test_a_frame_is_not_written_twice():
    with pytest.raises(CommandError):
        frames.plan(Arguments("a.#.png", "1,2,1"), Stage())
