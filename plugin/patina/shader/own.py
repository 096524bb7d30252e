# SPDX-License-Identifier: Apache-2.0
"""Patina's own shaders: the text that its pages run, with the functions of one material and a host that one may replace."""
import re
from patina.cli.compiled import _patina


VERSIONS = {"glsl": "#version 450 core", "essl": "#version 300 es"}
HEAD = """\
{version}
// A material as a fragment shader.
//
// A vertex shader gives vPosition, vObjectPosition, vNormal, vTangent (w: side of the bitangent), vUv and vColor in world
// space.
// Uniforms: eye, pixelAngle (radians across a pixel), lightDirection (unit vector to the light), lightIrradiance,
// surroundings (radiance from all around), pass (a number that counts up), normalToWorld, albedoTable (R32F, 1024 wide:
// what lobes reflect in all, as `patina shader --albedoTable` writes it), sampler0 and on (linear RGBA, the first level alone)
// and parameterTable where the material has them.
//
// Call setPoint(), then materialPresence(), materialEmission() and materialSetup(); after it materialEval(wi), which has the
// cosine in it, and materialSample(u, uLobe). Directions are unit vectors in world space, away from the surface.
"""


def shader(network, target, methods, largest):
    """
    :param target: a key of VERSIONS
    :param largest: width and height that textures are brought down to
    :returns: the text, and the dict of `_patina.web_material`
    """
    material = _patina.web_material(network, methods, largest)
    text = "#include \"shaders/web/inputs.glsl\"\n"
    text += "".join(f"vec4 primvar{slot}(vec4 fallback) {{ return {primvar(name, kind)}; }}\n"
                    for slot, (name, kind) in enumerate(material["primvars"]))
    text += material["text"] + "#include \"shaders/web/standalone.frag.glsl\"\n"
    return HEAD.format(version=VERSIONS[target]) + _lean(_patina.whole_shader(text)), material


def primvar(name, kind):
    """:returns: what a shader reads a primvar from"""
    if kind == "vector2":
        return "vec4(vUv, 0.0, 1.0)"
    return "vec4(vColor, 1.0)" if name == "displayColor" else "fallback"


def _lean(text):
    lines = (line.rstrip() for line in text.split("\n"))
    return "\n".join(line for line in lines if line and not re.match(r"\s*#line\b", line)) + "\n"
