# SPDX-License-Identifier: Apache-2.0
"""UsdVolParticleField3DGaussianSplat: its arrays of floats and halves, and their fallbacks."""
import pytest
from pxr import UsdVol

if not hasattr(UsdVol, "ParticleField3DGaussianSplat"):
    pytest.skip("before OpenUSD 26.03", allow_module_level=True)

SPLATS = """
def ParticleField3DGaussianSplat "s" {
    point3f[] positions = [(0, 1, 2), (3, 4, 5)]
    %s
}
"""


def test_arrays_and_degree(read, numbers):
    s = read(SPLATS % """quatf[] orientations = [(1, 0, 0, 0), (0, 0, 0, 2)]
    float3[] scales = [(1, 2, 3), (4, 5, 6)]
    float[] opacities = [0.25, 0.5]
    uniform int radiance:sphericalHarmonicsDegree = 1
    float3[] radiance:sphericalHarmonicsCoefficients = [(1, 2, 3), (4, 5, 6), (7, 8, 9), (10, 11, 12),
        (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]""").prim("/s")
    assert s["kind"] == "Splats" and s["degree"] == "1"
    assert numbers(s["positions"]) == [0, 1, 2, 3, 4, 5]
    assert numbers(s["orientations"]) == [1, 0, 0, 0, 0, 0, 0, 1]  # the real part first, of length 1
    assert numbers(s["scales"]) == [1, 2, 3, 4, 5, 6]
    assert numbers(s["opacities"]) == [0.25, 0.5]
    assert numbers(s["harmonics"])[:6] == [1, 2, 3, 4, 5, 6] and len(numbers(s["harmonics"])) == 24


def test_halves_count_where_there_are_no_numbers(read, numbers):
    s = read("""def ParticleField3DGaussianSplat "s" {
    point3h[] positionsh = [(0, 1, 2)]
    quath[] orientationsh = [(0, 1, 0, 0)]
    half3[] scalesh = [(0.5, 0.25, 2)]
    float3[] scales = [(1, 1, 1)]
    half[] opacitiesh = [0.5]
    uniform int radiance:sphericalHarmonicsDegree = 0
    half3[] radiance:sphericalHarmonicsCoefficientsh = [(1, 2, 3)]
}""").prim("/s")
    assert [numbers(s[key]) for key in ("positions", "orientations", "scales", "opacities", "harmonics")] == [
        [0, 1, 2], [0, 1, 0, 0], [1, 1, 1], [0.5], [1, 2, 3]]


def test_fallbacks(read):
    stage = read(SPLATS % "")
    s = stage.prim("/s")
    assert set(s) == {"kind", "positions", "doubleSided"}  # no turn, scale 1, opacity 1, grey of degree 0
    assert not any(w.startswith("/s") for w in stage.warnings)


@pytest.mark.parametrize("attribute, message", [
    ("float[] opacities = [1]", "1 values where 2 are needed; all of them are left out"),
    ("float[] opacities = [1, 1, 1]", "3 values where 2 are needed; the last ones"),
    ("float3[] scales = [(1, 1, 0), (1, 1, 1)]", "1 particles have sizes that are zero or negative"),
    ("quatf[] orientations = [(0, 0, 0, 0), (1, 0, 0, 0)]", "1 have no length"),
    ("float[] opacities = [1.5, 1]", "1 are outside of 0..1"),
    ("float[] scales = [1, 1]", "scales: "),
    ("uniform int radiance:sphericalHarmonicsDegree = -1", "-1 is no degree"),
    ("uniform int radiance:sphericalHarmonicsDegree = 4", "up to degree 3 are shown"),
    ("float3[] radiance:sphericalHarmonicsCoefficients = [(1, 1, 1)]", "1 values where 32 are needed"),
    ("rel material:binding = </m>", ""),
])
def test_messages_name_prim_and_input(read, attribute, message):
    stage = read(SPLATS % attribute)
    assert stage.has("/s")
    name = attribute.split(" = ")[0].split(" ")[-1]
    assert any(w.startswith(f"/s {name}: ") and message in w or not message for w in stage.warnings), stage.warnings


def test_colour_spaces(read):
    space = 'uniform token colorSpace:name = "srgb_rec709_scene"'
    text = SPLATS % space
    text = text.replace('"s" {', '"s" (prepend apiSchemas = ["ColorSpaceAPI"]) {')
    assert read(text).prim("/s")["colorSpace"] == '"srgb_rec709_scene"'
    own = "float3[] radiance:sphericalHarmonicsCoefficients = [] (colorSpace = \"lin_ap1_scene\")"
    assert read(SPLATS % own).prim("/s")["colorSpace"] == '"lin_ap1_scene"'



@pytest.mark.parametrize("api, shape", [("GaussianEllipsoid", None), ("GaussianSurflet", "gaussianSurflet"),
                                        ("ConstantSurflet", "constantSurflet")])
def test_kernels_of_a_field(read, numbers, api, shape):
    """Scales of flat kernels have no meaning across their plane."""
    s = read("""def ParticleField "s" (prepend apiSchemas = ["ParticleFieldKernel%sAPI", "ParticleFieldScaleAttributeAPI",
        "ParticleFieldPositionAttributeAPI"]) {
    point3f[] positions = [(0, 1, 2)]
    float3[] scales = [(1, 2, 0)]
}""" % api)
    assert s.prim("/s").get("shape") == shape
    assert numbers(s.prim("/s")["scales"])[:2] == [1, 2]
    assert any("sizes that are zero" in w for w in s.warnings) == (shape is None)


def test_a_field_without_a_kernel_is_told(read):
    stage = read("""def ParticleField "s" (prepend apiSchemas = ["ParticleFieldPositionAttributeAPI"]) {
    point3f[] positions = [(0, 1, 2)]
}""")
    assert not stage.has("/s")
    assert any(w.startswith("/s") and "without a kernel" in w for w in stage.warnings), stage.warnings
