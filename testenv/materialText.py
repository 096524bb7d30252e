# SPDX-License-Identifier: Apache-2.0
"""Materials of UsdShade as text of .usda."""


def material(name, terminals, nodes):
    """
    :param terminals: dict of `mtlx:surface`, `mtlx:volume` and the like to the node that gives it
    :param nodes: dict of a node's name to its definition and inputs: a dict of `type name` to the value as .usda writes
        it, or to `<node>`, whose output `out` is connected
    """
    def linked(node):
        return f"</{name}/{node}.outputs:out>"

    lines = [f'def Material "{name}"', "{"]
    lines += [f"    token outputs:{terminal}.connect = {linked(node)}" for terminal, node in terminals.items()]
    for node, (definition, inputs) in nodes.items():
        lines += [f'    def Shader "{node}"', "    {", f'        uniform token info:id = "{definition}"']
        for typed, value in inputs.items():
            kind, _, key = typed.rpartition(" ")
            given = f".connect = {linked(value[1:-1])}" if value.startswith("<") else f" = {value}"
            lines.append(f"        {kind} inputs:{key}{given}")
        lines += ["        token outputs:out", "    }"]
    return "\n".join([*lines, "}", ""])
