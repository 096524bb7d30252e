# SPDX-License-Identifier: Apache-2.0
"""Files of packages that others made."""
import zipfile

import pytest

from patina.stage import assets, compat


@pytest.fixture(params=["its own", "an older one"])
def reader(request, monkeypatch):
    """OpenUSD's Python as it is, and one that opens no assets."""
    if request.param != "its own":
        monkeypatch.setattr(compat.Ar, "GetResolver", object)


def test_empty_packages_and_files(reader, tmp_path):
    package = tmp_path / "a.usdz"
    package.write_bytes(b"")
    assert compat.read_asset(str(package)) in (None, b"")
    assert assets.extract(f"{package}[a.png]") is None


def test_packed_files_are_refused(reader, tmp_path):
    package = tmp_path / "b.usdz"
    with zipfile.ZipFile(package, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("a.png", bytes(1 << 20))
    assert assets.extract(f"{package}[a.png]") is None


def test_long_names_are_other_files_still(reader, tmp_path):
    package = tmp_path / "c.usdz"
    names = [letter + 300 * "x" + ".png" for letter in "ab"]
    with zipfile.ZipFile(package, "w", zipfile.ZIP_STORED) as file:
        for name in names:
            file.writestr(name, name[:1])
    copies = [assets.extract(f"{package}[{name}]") for name in names]
    assert [open(copy).read() for copy in copies] == ["a", "b"] and all(copy.endswith("x.png") for copy in copies)
