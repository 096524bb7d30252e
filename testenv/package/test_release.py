# SPDX-License-Identifier: Apache-2.0
"""`patina release`: what it refuses, and its bill of materials. everyPackage.sh makes and tries the files themselves."""
import contextlib
import json
import os
import shutil
import subprocess
import types
import zipfile

import pytest

from patina.cli import billOfMaterials, release
from patina.cli.errors import CommandError
from patina.farm import digests

WHEEL = "hdpatina-9.8.7-cp311-cp311-manylinux_2_36_x86_64.whl"


@pytest.fixture
def wheel(tmp_path):
    """:returns: path of a wheel that has a library's licence and the page's script, and asks for two packages"""
    path = tmp_path / WHEEL
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("hdPatina-9.8.7.dist-info/METADATA", "Metadata-Version: 2.1\nName: hdPatina\nRequires-Dist: numpy\n"
                         'Requires-Dist: usd-core>=23.11\nRequires-Dist: pytest>=8; extra == "regression"\n')
        archive.writestr("hdPatina.libs/licences/libstdc++6", "terms")
        archive.writestr("patina/view/web/page.js", "// three.js")
    return path


def bill(tmp_path, *files):
    path = tmp_path / "bill.spdx.json"
    billOfMaterials.write(str(path), [str(file) for file in files], "c0ffee", 1700000000)
    return json.loads(path.read_text())


def related(document, kind):
    locators = {p["SPDXID"]: p.get("externalRefs", [{}])[0].get("referenceLocator") for p in document["packages"]}
    return {locators[r["relatedSpdxElement"]] for r in document["relationships"] if r["relationshipType"] == kind}


def test_the_bill_names_what_a_wheel_contains_and_asks_for(wheel, tmp_path):
    document = bill(tmp_path, wheel)
    with open(os.path.join(release.ROOT, "plugin", "patina", "view", "web", "package.json"), encoding="utf-8") as file:
        page = {f"pkg:npm/{name}@{version}" for name, version in json.load(file)["dependencies"].items()}
    contained = related(document, "CONTAINS")
    assert page <= contained
    (library,) = contained - page
    assert library.startswith("pkg:deb/debian/libstdc%2B%2B6")
    assert related(document, "DEPENDS_ON") == {"pkg:pypi/numpy", "pkg:pypi/usd-core"}, "extras are not asked for"
    (own,) = [p for p in document["packages"] if p.get("packageFileName") == WHEEL]
    assert own["checksums"][0]["checksumValue"] == digests.content(wheel)
    assert "c0ffee" in own["sourceInfo"]
    assert document["creationInfo"]["created"] == "2023-11-14T22:13:20Z"


def test_the_bill_keeps_to_its_format(wheel, tmp_path):
    document = bill(tmp_path, wheel, shutil.copy(wheel, tmp_path / WHEEL.replace("9.8.7", "9.8.8")))
    names = [p["SPDXID"] for p in document["packages"]]
    assert len(set(names)) == len(names), "what two files have is told once"
    known = {*names, document["SPDXID"]}
    for r in document["relationships"]:
        assert {r["spdxElementId"], r["relatedSpdxElement"]} <= known
    parse = pytest.importorskip("spdx_tools.spdx.parser.parse_anything", reason="spdx-tools is not installed: tier long")
    validate = pytest.importorskip("spdx_tools.spdx.validation.document_validator")
    assert not validate.validate_full_spdx_document(parse.parse_file(str(tmp_path / "bill.spdx.json")))


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """:returns: a repository that release takes for the checkout"""
    root = tmp_path / "checkout"
    root.mkdir()
    (root / "CMakePresets.json").write_text("{}")
    for words in (["init", "-q"], ["add", "."], ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "one"]):
        subprocess.run(["git", "-C", root, *words], check=True)
    monkeypatch.setattr(release, "ROOT", str(root))
    monkeypatch.setenv("PATINA_BUILD_DIR", str(tmp_path / "build"))
    return root


def run(folder, **given):
    return release.run(types.SimpleNamespace(folder=str(folder), **{"uncommitted": False, **given}))


def test_a_changed_checkout_is_refused(checkout, tmp_path):
    (checkout / "new").write_text("")
    with pytest.raises(CommandError, match=r"not clean \(\?\? new, 1 in all\)"):
        run(tmp_path / "dist")
    assert not (tmp_path / "dist").exists()


def test_a_folder_with_files_is_refused(checkout, tmp_path):
    with pytest.raises(CommandError, match="not an empty folder"):
        run(checkout)


def test_missing_tools_are_named(checkout, tmp_path, monkeypatch):
    programs = tmp_path / "programs"
    programs.mkdir()
    os.symlink(shutil.which("git"), programs / "git")
    monkeypatch.setenv("PATH", str(programs))
    monkeypatch.setattr(release.sys, "executable", str(programs / "python"))
    with pytest.raises(CommandError, match="missing: cmake, ninja-build, npm, dpkg, dpkg-dev, file, patchelf"):
        run(tmp_path / "dist")


def test_plugins_are_named_for_their_hosts(tmp_path, monkeypatch):
    """What builds and packs them is tested with hosts (testenv/hydra)."""
    asked = {}

    def build_all(hosts, headers, build, command, portable):
        asked.update(hosts=hosts, headers=headers, portable=portable)
        return [release.hydraHosts.Built("plugin", "programs", "libraries", (26, 8), name) for name in ("usd", "blender")]

    monkeypatch.setenv("PATINA_BUILD_DIR", "build")
    monkeypatch.setenv("PATINA_COMMAND", "./patina")
    monkeypatch.setattr(release.hydraHosts, "build_all", build_all)
    monkeypatch.setattr(release.pluginPackage, "pack", lambda built, file: open(file, "w").close())
    monkeypatch.setattr(release.pluginPackage, "whole", lambda built: contextlib.nullcontext("folder"))
    monkeypatch.setattr(release.blenderAddOn, "blender_version", lambda host: "5.0")
    monkeypatch.setattr(release.blenderAddOn, "pack", lambda host, plugin, version, file: open(file, "w").close())
    release._plugins(types.SimpleNamespace(usd=["/opt/usd"], blender=["/opt/blender"], headers=["/opt/src"]), str(tmp_path))
    assert asked == {"hosts": ["/opt/usd", "/opt/blender"], "headers": ["/opt/src"], "portable": True}
    version = release.__version__
    assert sorted(os.listdir(tmp_path)) == [f"hdPatina-{version}-blender-5.0.zip", f"hdPatina-{version}-usd.tar.gz"]
