# SPDX-License-Identifier: Apache-2.0
"""The texts of the page's shaders."""
import re

from patina.cli.compiled import _patina
from patina.shader import own
from patina.view import live

MAX_UNIFORMS = 128  # WebGL2 promises 224 vectors; more values come by a texture


def lean(text):
    """Without comments, blank lines and #line, which everybody would load; indented, for who reads it in the page."""
    text = re.sub(r"//[^\n]*", "", text)
    lines = (line.rstrip() for line in text.split("\n"))
    return "\n".join(line for line in lines if line and not line.startswith("#line")) + "\n"


def library():
    """The GLSL that all pages share."""
    load = _patina.shader_text
    return {name: lean(load(f"shaders/web/{file}.glsl")) for name, file in (
        ("head", "head"), ("page", "page.frag"), ("surface", "surface.vert"),
        ("backdrop", "backdrop.frag"), ("backdropVertex", "backdrop.vert"))}


def primvar_functions(primvars, count):
    """One function for each primvar of a material: a live input, or what a shape has.

    :param count: live inputs of the material
    """
    if count > MAX_UNIFORMS:
        text = ("uniform sampler2D liveTable;\n"
                "vec4 liveAt(int i) { return texelFetch(liveTable, ivec2(i & 255, i >> 8), 0); }\n")
    else:
        text = f"uniform vec4 live[{max(count, 1)}];\n"
    for slot, (name, kind) in enumerate(primvars):
        if re.fullmatch(live.PREFIX + r"\d+", name) and int(name[len(live.PREFIX):]) < count:
            i = int(name[len(live.PREFIX):])
            value = f"liveAt({i})" if count > MAX_UNIFORMS else f"live[{i}]"
        else:
            value = own.primvar(name, kind)
        text += f"vec4 primvar{slot}(vec4 fallback) {{ return {value}; }}\n"
    return text


def material_text(material, count):
    """Between the head and the end of the page's fragment shader."""
    return primvar_functions(material["primvars"], count) + lean(material["text"])
