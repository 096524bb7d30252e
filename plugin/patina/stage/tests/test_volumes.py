# SPDX-License-Identifier: Apache-2.0
"""UsdVolVolume: fields, their files, and what can be wrong with them."""

VOLUME = """
def Volume "v" {
    %s
    def OpenVDBAsset "a" {
        asset filePath = @./a.vdb@
        token fieldName = "smoke"
    }
    def OpenVDBAsset "b" {
        asset filePath = @/elsewhere/b.vdb@
        %s
    }
    def Field3DAsset "c" { }
}
"""


def test_fields_are_named_by_the_relationship(read):
    v = read(VOLUME % ("rel field:density = </v/a>\nrel field:heat = </v/b>", "")).prim("/v")
    file, grid = v["field density"].split(" ")
    assert file.endswith('a.vdb"') and grid == '"smoke"'
    # Without a fieldName the grid has the name of the field.
    assert v["field heat"] == '"/elsewhere/b.vdb" "heat"'


def test_fields_that_cannot_be_read_are_named(read):
    stage = read(VOLUME % ("rel field:density = </v/none>\nrel field:heat = </v/c>", ""))
    assert not any(key.startswith("field") for key in stage.prim("/v"))
    text = "\n".join(stage.warnings)
    assert "/v/none" in text and "Field3DAsset" in text


def test_moved_fields_are_reported(read):
    moved = """double3 xformOp:translate = (1, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]"""
    stage = read(VOLUME % ("rel field:heat = </v/b>", moved))
    assert any("transform is not used" in w for w in stage.warnings)


def test_volumes_that_are_lights(read):
    """Pictures are in testenv/render/test_volumeLights.py."""
    volume = 'def Volume "v" (prepend apiSchemas = ["VolumeLightAPI"]) { %s }'
    plain = read(volume % "")
    assert "light" not in plain.prim("/v") and not any("VolumeLightAPI" in w for w in plain.warnings)
    tinted = read(volume % "float inputs:intensity = 3  float inputs:exposure = 1  color3f inputs:color = (1, 0.5, 0.25)")
    assert tinted.prim("/v")["light"] == "6 3 1.5"
    for given in ('uniform token light:materialSyncMode = "independent"', "float inputs:intensity = -1"):
        told = read(volume % given)
        assert "light" not in told.prim("/v")
        assert any(w.startswith("/v light:materialSyncMode: VolumeLightAPI is evaluated as") for w in told.warnings)
