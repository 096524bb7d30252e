# SPDX-License-Identifier: Apache-2.0
"""The extension that Blender installs; testenv/hydra renders with it."""
import ast
import json
import zipfile

import pytest

from patina.cli import blenderAddOn, hostSettings, settingFlags
from patina.cli.errors import CommandError


def test_the_extension_is_whole(tmp_path):
    (tmp_path / "blender/5.0").mkdir(parents=True)
    (tmp_path / "plugin/hdPatina/resources").mkdir(parents=True)
    for name in ("plugInfo.json", "hdPatina.so", "hdPatina/resources/plugInfo.json"):
        (tmp_path / "plugin" / name).write_text(name)
    for i in range(2):
        blenderAddOn.pack(str(tmp_path / "blender"), str(tmp_path / "plugin"), (25, 8), str(tmp_path / f"{i}.zip"))
    assert (tmp_path / "0.zip").read_bytes() == (tmp_path / "1.zip").read_bytes()
    archive = zipfile.ZipFile(tmp_path / "0.zip")
    assert {"__init__.py", "usdPlugin/plugInfo.json", "usdPlugin/hdPatina.so",
            "usdPlugin/hdPatina/resources/plugInfo.json"} < set(archive.namelist())
    ast.parse(archive.read("__init__.py"))
    assert 'blender_version_min = "5.0.0"' in archive.read("blender_manifest.toml").decode()
    assert json.loads(archive.read("host.json")) == {"version": [25, 8]}
    with pytest.raises(CommandError, match="is no Blender"):
        blenderAddOn.blender_version(str(tmp_path))


def test_settings_have_a_default_that_they_take():
    found = hostSettings.shown()
    assert len({s["key"] for s in found}) == len(found)
    for setting in found:
        assert not setting["choices"] or setting["default"] in setting["choices"], setting
        for bound, sign in (("min", 1), ("max", -1)):
            assert setting[bound] is None or sign * (setting["default"] - setting[bound]) >= 0, setting
    shown = {name for name, row in settingFlags.table().items() if "label" in row.words}
    assert shown - {s["key"] for s in found} == {"interactive"}
