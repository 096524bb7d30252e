# SPDX-License-Identifier: Apache-2.0
"""GLSL of small networks, from the numbers that albedoFit.py finds."""

HEAD = """\
// Three facets that stand in for all that a view sees of isotropic GGX: the directional albedo of a
// reflection under any Fresnel curve F is about w.x F(c.x) + w.y F(c.y) + w.z F(c.z). For light from
// the thinner side; total reflection has a kink that three places miss.
// Written by shaders/bake/albedoFit.py. Over 32 x 32 cell centres of (cosine, root of alpha), ior
// 1.03 to 3, metals and Schlick's curve: RMSE {rms:.1e}, largest error {largest:.1e}.

struct MicrofacetRule {{
    vec3 c; // cosines between view and facet, in [0, 1]
    vec3 w; // weights; their sum is the albedo of a white mirror
}};

PATINA_FN vec4 fitBend(vec4 z) {{
    return z / sqrt(vec4(1.0f) + z * z);
}}

// mu: cosine of the view, in [0, 1]. alpha: in [ALPHA_MIRROR, 1].
PATINA_FN MicrofacetRule fitRule(float mu, float alpha) {{
    float x0 = sqrt(mu);
    float x1 = sqrt(alpha);
    float x2 = mu / sqrt(mu * mu + alpha * alpha);
"""

TAIL = """\
    // A facet that leans by `lean` towards the view and `side` across it, in slopes over alpha.
    float s = alpha * safeSqrt(1.0f - mu * mu);
    vec3 slope2 = (lean * lean + side * side) * (alpha * alpha);
    MicrofacetRule r;
    r.c = min(max((vec3(mu) + lean * s) / sqrt(vec3(1.0f) + slope2), vec3(0.0f)), vec3(1.0f));
    r.w = w;
    return r;
}
"""


def number(value):
    return f"{value:.7g}"


def scalar(value):
    text = number(value)
    return (text if "." in text or "e" in text else text + ".0") + "f"


def vector(values):
    return f"vec{len(values)}(" + ", ".join(scalar(v) for v in values) + ")"


def _sum(name, kind, matrix, offsets, columns, inputs):
    lines = [f"    {kind} {name} = {vector(offsets[columns])}"]
    lines += [f"             + {vector(matrix[i, columns])} * {of}" for i, of in enumerate(inputs)]
    return "\n".join(lines) + ";\n"


def hidden(layer, matrix, offsets, inputs):
    """:returns: the text of one layer of units, and the names of its outputs"""
    text, names = "", []
    for i in range(0, len(offsets), 4):
        name = f"h{layer}{i // 4}"
        text += _sum(name, "vec4", matrix, offsets, slice(i, i + 4), inputs)
        text += f"    {name} = fitBend({name});\n"
        names += [f"{name}.{c}" for c in "xyzw"]
    return text, names


def rule(layers, rms, largest):
    text, inputs = HEAD.format(rms=rms / 65535.0, largest=largest), ["x0", "x1", "x2"]
    for i, (matrix, offsets) in enumerate(layers[:-1]):
        part, inputs = hidden(i, matrix, offsets, inputs)
        text += part
    matrix, offsets = layers[-1]
    for i, name in enumerate(("lean", "side", "w")):
        text += _sum(name, "vec3", matrix, offsets, slice(3 * i, 3 * i + 3), inputs)
    return text + TAIL
