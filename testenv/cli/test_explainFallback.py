# SPDX-License-Identifier: Apache-2.0
"""`explain` of what cannot be shown, and names of materials with namespaces."""
import json

import mtlx
from patina.cli import main, materials
import usda

STAGE = usda.stage(usda.material("lamp", {"light": ("ND_point_light", {})}, surface="light"), usda.preview("red"), up="")


def test_a_fallback_is_told_as_one(tmp_path, capsys):
    stage = tmp_path / "lamp.usda"
    stage.write_text(STAGE)
    assert main.main(["explain", f"{stage}:/lamp"]) == 0
    reported = capsys.readouterr()
    assert "This material has no usable surface and is not shown." in reported.out
    assert "material /lamp" not in reported.out and "material /displayColor" in reported.out
    assert "\nplan of the fallback: " in reported.out
    assert "node /lamp/light (ND_point_light) is not drawn" in reported.err
    assert main.main(["explain", f"{stage}:/red"]) == 0
    reported = capsys.readouterr()
    assert "no usable surface" not in reported.out and "\nplan: " in reported.out
    assert main.main(["explain", str(stage), "--json"]) == 0
    found = {m["name"]: m["plan"]["fallback"] for m in json.loads(capsys.readouterr().out)["materials"]}
    assert found == {"/lamp": True, "/red": False}


def test_names_may_hold_namespaces(tmp_path):
    (tmp_path / "library.mtlx").write_text(mtlx.document(mtlx.shader("gold"), attributes='namespace="lib"'))
    document = tmp_path / "main.mtlx"
    document.write_text(mtlx.document('<xi:include href="library.mtlx"/>', mtlx.shader("gold")))
    found, warnings = materials.load(str(document), every=True)
    assert sorted(name for name, _ in found) == ["gold", "lib:gold"] and not warnings
    (name, network), = materials.load(f"{document}:lib:gold")[0]
    assert name == "lib:gold" and network.nodes()[0]["path"] == "/lib:s"
    (name, network), = materials.load(f"{document}:gold")[0]
    assert name == "gold" and network.nodes()[0]["path"] == "/s"
