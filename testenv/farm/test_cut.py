# SPDX-License-Identifier: Apache-2.0
"""Cuts: what they are written as, and where samples may be cut."""
import os
import types

import pytest

import _patina
from patina.cli.errors import CommandError
from patina.farm import cut, digests, folders, identity, partial


def test_parts_are_written_as_numbers_of_a_cut():
    assert cut.cut("4x2") == cut.Cut(4, 2) and cut.cut("3") == cut.Cut(3, 1)
    part = cut.part("6/4x2")
    assert (part.tile_group, part.range_index, str(part)) == (1, 1, "6/4x2")
    for text in ("0/2", "3/2", "9/4x2", "1", "1/0", "1/2x0", "a/2", "1/999999x9999"):
        with pytest.raises(ValueError):
            cut.part(text)


@pytest.mark.parametrize("samples, count, begins", [(64, 4, [0, 16, 32, 48]), (256, 8, [0, 32, 64, 96, 128, 160, 192, 224]),
                                                    (100, 2, [0, 48]), (8, 4, [0, 1, 2, 4]), (1000, 1, [0])])
def test_ranges_are_as_equal_as_spans_allow(samples, count, begins):
    ranges = cut.ranges(_patina.span_ends(samples), count)
    assert [begin for begin, _ in ranges] == begins
    assert [end for _, end in ranges] == begins[1:] + [samples]


@pytest.mark.parametrize("samples", [1, 7, 16, 77, 300, 4096])
def test_every_count_up_to_the_most_is_possible(samples):
    ends = _patina.span_ends(samples)
    for count in range(1, len(ends) + 1):
        ranges = cut.ranges(ends, count)
        assert len(ranges) == count and all(begin < end for begin, end in ranges)
    with pytest.raises(CommandError):
        cut.ranges(ends, len(ends) + 1)


def test_digests_are_of_regular_files_alone(tmp_path):
    """Parts of others name the files that they were made of."""
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", "/dev/zero", tmp_path):
        with pytest.raises(OSError):
            digests.of_file(str(path))
    what = {**identity.of_machine(_patina), "environment": identity.of_environment()}
    for name in ("pipe", "/dev/zero", "no\0name"):
        assert not identity.still_true(_patina, {**what, "files": {name: "x"}}, str(tmp_path / "shot.usda"))


def test_nobody_else_writes_the_digests_of_the_users_own_cache(tmp_path, monkeypatch):
    monkeypatch.delenv("PATINA_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(digests, "KEPT_FROM", 0)
    (tmp_path / "patina").mkdir()
    os.chmod(tmp_path / "patina", 0o777)
    before = os.umask(0)
    try:
        digests.of_file(__file__)
    finally:
        os.umask(before)
    modes = [os.stat(tmp_path / folder).st_mode & 0o777 for folder in ("patina", "patina/digests")]
    assert modes == [0o755, 0o700] and len(os.listdir(tmp_path / "patina" / "digests")) == 1
    # What another user has made there is not read.
    kept = tmp_path / "patina" / "digests" / os.listdir(tmp_path / "patina" / "digests")[0]
    kept.write_text(kept.read_text().replace(digests.content(__file__), "forged"))
    assert digests.of_file(__file__) == "forged"
    uid = os.geteuid()
    with monkeypatch.context() as patch:
        patch.setattr(digests.os, "fstat", lambda _: types.SimpleNamespace(st_uid=uid + 1))
        assert digests.of_file(__file__) == digests.content(__file__)
    kept.write_text(kept.read_text().replace(digests.content(__file__), "forged"))
    monkeypatch.setattr(folders.os, "geteuid", lambda: uid + 1)
    assert digests.of_file(__file__) == digests.content(__file__)


def test_a_description_holds_tables(tmp_path):
    values = {"identity": {"files": []}, "part": "1/2", "range": [0, 1], "arguments": {"stage": "a.usda"}, "options": {},
              "frame": 1, "camera": "/c", "settings": {}, "noiseTolerance": 0, "folder": "", "home": "", "denoise": False,
              "decimals": 0}
    with pytest.raises(CommandError):
        partial.Description("a.part", values)
    values["identity"] = {"files": {}}
    for name, value in (("decimals", float("inf")), ("noiseTolerance", 10 ** 400), ("folder", 3), ("arguments", {})):
        with pytest.raises(CommandError):
            partial.Description("a.part", {**values, name: value})
    assert partial.Description("a.part", values).part.number == 1
