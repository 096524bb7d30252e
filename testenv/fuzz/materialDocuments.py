# SPDX-License-Identifier: Apache-2.0
"""Random materials: `.mtlx` documents of every node that is known, and UsdShade networks of them."""
import random as randoms

import outcomes
import values

EXTENSION = ".mtlx"
LINES = True
MARK = "PWND"
CLOSURES = ("BSDF", "EDF", "VDF", "surfaceshader", "volumeshader", "displacementshader")
_nodes = []


def _known():
    """:returns: list of (id, category, list of (type, name) of its inputs, type of its first output): all definitions of nodes
        and shading models"""
    if not _nodes:
        import _patina

        for identity in _patina.node_ids():
            found = _patina.node_definition(identity)
            inputs = [(kind, name) for name, kind in _patina.node_inputs(identity).items()]
            _nodes.append((identity, found["category"], inputs, found["outputs"][0][1] if found["outputs"] else "material"))
    return _nodes


def _chosen(random):
    """:returns: a definition; half of them closures and shaders, which are few among so many patterns"""
    closures = [node for node in _known() if node[3] in CLOSURES]
    return random.choice(closures if random.random() < 0.5 else _known())


COUNTS = {"float": 1, "integer": 1, "vector2": 2, "vector3": 3, "vector4": 4, "color3": 3, "color4": 4, "matrix33": 9,
          "matrix44": 16}
WORDS = ("mirror", "periodic", "ggx", "RT", "", f"{MARK};}}//", "&lt;/script&gt;", "%n", "x" * 2000, "../..")


def _plain(random, kind):
    if kind in COUNTS:
        choose = values.INTEGERS if kind == "integer" else values.NUMBERS
        return ", ".join(repr(random.choice(choose) if random.random() < 0.4 else random.randint(0, 3) if kind == "integer"
                              else round(random.uniform(0, 1), 3)) for _ in range(COUNTS[kind]))
    if kind == "boolean":
        return random.choice(("true", "false", "1", ""))
    if kind == "filename":
        return random.choice(values.ASSETS).replace("<", "&lt;").replace(">", "&gt;")
    return random.choice(WORDS)


def make(seed):
    """:returns: the bytes of an input"""
    r = randoms.Random(seed)
    nodes = [_chosen(r) for _ in range(r.randint(1, 14))]
    version = r.choice(("1.39", "1.39", "1.38", "1.37", "9", "", "nan"))
    extra = r.choice(("", "", ' colorspace="lin_rec709"', ' colorspace="g22_ap1"', ' colorspace="none such"', ' namespace="n"',
                      ' fileprefix="/dev/"'))
    lines = ['<?xml version="1.0"?>', f'<materialx version="{version}"{extra}>']
    if r.random() < 0.1:
        lines.append(f'<xi:include href="{r.choice(values.ASSETS[1:]).replace("<", "")}"/>')
    for i, (_, category, inputs, output) in enumerate(nodes):
        lines.append(f'<{category} name="n{i}" type="{output}">')
        for kind, name in inputs:
            choice = r.random()
            if choice < 0.35:
                lines.append(f'<input name="{name}" type="{kind}" value="{_plain(r, kind)}"/>')
            elif choice < 0.6:
                fitting = [k for k, other in enumerate(nodes) if other[3] == kind]
                other = r.choice(fitting) if fitting and r.random() < 0.9 else r.randint(0, len(nodes))
                lines.append(f'<input name="{name}" type="{kind}" nodename="n{other}"/>')
        lines.append(f"</{category}>")
    last = {kind: i for i, (_, _, _, kind) in enumerate(nodes)}
    if "surfaceshader" not in last:
        lines.append('<surface name="s" type="surfaceshader">')
        lines += [f'<input name="{name}" type="{kind}" nodename="n{last[kind]}"/>'
                  for name, kind in (("bsdf", "BSDF"), ("edf", "EDF"))
                  if kind in last]
        lines.append("</surface>")
    shader = f"n{last['surfaceshader']}" if "surfaceshader" in last else "s"
    lines += ['<surfacematerial name="material" type="material">',
              f'<input name="surfaceshader" type="surfaceshader" nodename="{shader}"/>', "</surfacematerial>", "</materialx>",
              ""]
    return "\n".join(lines).encode(errors="replace")


SDF = {"float": "float", "integer": "int", "boolean": "bool", "vector2": "float2", "vector3": "float3", "vector4": "float4",
       "color3": "color3f", "color4": "color4f", "matrix33": "matrix3d", "matrix44": "matrix4d", "string": "string",
       "filename": "asset"}


def usd_material(random):
    """:returns: lines of a UsdShade material called material"""
    shaders = [_chosen(random) for _ in range(random.randint(1, 6))]
    first = "UsdPreviewSurface" if random.random() < 0.5 else "ND_standard_surface_surfaceshader"
    known = {node[0]: node for node in _known()}
    shaders = [known.get(first, shaders[0]), *shaders]
    lines = ['def Material "material"', "{", "    token outputs:surface.connect = </material/n0.outputs:out>"]
    for i, (identity, _, inputs, _) in enumerate(shaders):
        lines += [f'    def Shader "n{i}"', "    {", f'        uniform token info:id = "{identity}"',
                  "        token outputs:out"]
        for kind, name in inputs:
            usd, choice = SDF.get(kind), random.random()
            if choice < 0.25 and usd:
                lines.append(f"        {usd} inputs:{name} = {values.value(random, usd)}")
            elif choice < 0.4:
                lines.append(f"        {usd or 'token'} inputs:{name}.connect = "
                             f"</material/n{random.randint(1, len(shaders))}.outputs:out>")
        lines.append("    }")
    return [*lines, "}"]


def execute(path, folder):
    """Plans a material and takes values of it, in a process that may die. :returns: the exit status"""
    status = outcomes.command(["explain", path], folder)
    if status:
        return status
    import numpy as np

    import _patina

    directions = np.array([[0, 0, 1], [0.6, 0, 0.8], [0, 0.8, -0.6], [0.999999, 0, 0.0014142]])
    for network in _patina.read_mtlx(path)[:2]:
        probe = _patina.MaterialProbe(network, {})
        wo, wi = (a.reshape(-1, 3) for a in np.broadcast_arrays(directions[:, None], directions[None]))
        f, pdf = probe.eval(wo, wi)
        if not (np.isfinite(f).all() and np.isfinite(pdf).all() and (f >= 0).all() and (pdf >= 0).all()):
            return outcomes.broken("a value of a material is no number, or negative")
        if not np.isfinite(probe.albedo(directions)).all():
            return outcomes.broken("an albedo is no number")
    return 0
