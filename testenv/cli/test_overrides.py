# SPDX-License-Identifier: Apache-2.0
"""--set changes inputs in the session layer, with the type that they have."""
import pytest
from pxr import Usd

from patina.cli import overrides
from patina.cli.errors import CommandError, UsageError
import usda


@pytest.fixture
def stage():
    stage = Usd.Stage.CreateInMemory()
    stage.GetRootLayer().ImportFromString(usda.stage(
        usda.material("m", {
            "s": ("UsdPreviewSurface", {"roughness": 0.1, "useSpecularWorkflow": 0, "color3f diffuseColor": "<image>"}),
            "image": ("UsdUVTexture", {"file": "", "token wrapS": ""})}, surface="s"),
        usda.prim("SphereLight", "light"),
        up=""))
    return stage


def value(stage, path):
    return stage.GetAttributeAtPath(path).Get()


def test_types(stage):
    overrides.apply(stage, ["/m/s.roughness=0.75", "/m/s.inputs:useSpecularWorkflow=1", "/m/s.diffuseColor=1,0.5,0",
                            "/m/image.file=@a=b.png@", "/m/image.wrapS=mirror", "/light.radius=2",
                            "/light.inputs:normalize=true"])
    assert value(stage, "/m/s.inputs:roughness") == 0.75
    assert value(stage, "/m/s.inputs:useSpecularWorkflow") == 1
    assert value(stage, "/m/s.inputs:diffuseColor") == (1, 0.5, 0)
    assert value(stage, "/m/image.inputs:file").path == "a=b.png"
    assert value(stage, "/m/image.inputs:wrapS") == "mirror"
    assert value(stage, "/light.inputs:radius") == 2.0
    assert value(stage, "/light.inputs:normalize") is True


def test_connection_is_cut_and_the_root_layer_untouched(stage):
    before = stage.GetRootLayer().ExportToString()
    overrides.apply(stage, ["/m/s.diffuseColor=0.25"])
    assert not stage.GetAttributeAtPath("/m/s.inputs:diffuseColor").GetConnections()
    assert value(stage, "/m/s.inputs:diffuseColor") == (0.25, 0.25, 0.25)
    assert stage.GetRootLayer().ExportToString() == before


def test_inputs_of_a_material_are_those_of_its_surface(stage):
    overrides.apply(stage, ["/m.roughness=0.5"])
    assert value(stage, "/m/s.inputs:roughness") == 0.5


def test_input_that_is_not_authored_has_the_type_of_its_definition(stage):
    overrides.apply(stage, ["/m/s.clearcoat=1", "/m.emissiveColor=1,2,3"])
    assert value(stage, "/m/s.inputs:clearcoat") == 1.0
    assert value(stage, "/m/s.inputs:emissiveColor") == (1, 2, 3)


@pytest.mark.parametrize("text", ["/nowhere.roughness=1", "/m/s.roughness=a", "/m/s.roughness=1,2",
                                  "/m/s.diffuseColor=1,2", "/light.nothing=1", "/light.inputs:normalize=maybe"])
def test_what_cannot_be_set_is_named(stage, text):
    with pytest.raises(CommandError, match=text.partition(".")[0]):
        overrides.apply(stage, [text])


@pytest.mark.parametrize("text", ["roughness=1", "/m/s.roughness", "/m/s=1", ""])
def test_what_cannot_be_read_is_a_usage_error(stage, text):
    with pytest.raises(UsageError):
        overrides.apply(stage, [text])
