# SPDX-License-Identifier: Apache-2.0
"""Writes the table of MaterialX's node definitions that Patina's are compared with (Completeness in testMaterialNetwork).

    ./patina python testenv/materialxDefinitions.py LIBRARIES_139 LIBRARIES_138

Both are folders `MaterialX/libraries` of a wheel of `materialx`: 1.39.5, and 1.38.10 from `pip download`. Of the older release
only what differs is written. A row is

    id|category|type input=default|...|>type output|...

where `@` begins a geometric property, one number stands for equal components, and an input without `=` has no default.
"""
import argparse
import os
import xml.etree.ElementTree as ElementTree

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "materialNetwork", "tests", "expected",
                     "materialxDefinitions.txt")


def definitions(folder):
    """:returns: nodedef elements by name, of all documents below a folder"""
    found = {}
    for place, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            if name.endswith(".mtlx"):
                for element in ElementTree.parse(os.path.join(place, name)).getroot().iter("nodedef"):
                    found[element.get("name")] = element
    return found


def ports(element, tag, known):
    """:returns: elements by name, of a definition and those that it inherits from"""
    parent = known.get(element.get("inherit"))
    return {**(ports(parent, tag, known) if parent is not None else {}),
            **{child.get("name"): child for child in element if child.tag == tag}}


def numbers(text):
    """:returns: the numbers in short, one for equal components; the text itself where it is none"""
    try:
        values = [float(part) for part in text.replace(",", " ").split()]
    except ValueError:
        return text
    shortest = [f"{value:.7g}" for value in values]
    return shortest[0] if len(set(shortest)) == 1 else " ".join(shortest)


def row(element, known):
    parts = [element.get("name"), element.get("node")]
    for name, port in ports(element, "input", known).items():
        default = ""
        if port.get("defaultgeomprop"):
            default = "=@" + port.get("defaultgeomprop")
        elif port.get("value") is not None:
            text = port.get("value")
            default = "=" + (text if port.get("type") in ("string", "filename") else
                             {"true": "1", "false": "0"}.get(text, numbers(text)))
        parts.append(f"{port.get('type')} {name}{default}")
    parts += [f">{port.get('type')} {name}" for name, port in ports(element, "output", known).items()]
    return "|".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("libraries139", metavar="LIBRARIES_139")
    parser.add_argument("libraries138", metavar="LIBRARIES_138")
    arguments = parser.parse_args()
    new, old = definitions(arguments.libraries139), definitions(arguments.libraries138)
    rows = {name: row(element, new) for name, element in new.items()}
    older = {name: row(element, old) for name, element in old.items()}
    with open(TABLE, "w", encoding="utf-8") as file:
        file.write("# Node definitions of MaterialX, made by testenv/materialxDefinitions.py.\n# 1.39.5\n")
        file.writelines(rows[name] + "\n" for name in sorted(rows))
        file.write("# 1.38.10, where it differs\n")
        file.writelines(older[name] + "\n" for name in sorted(older) if older[name] != rows.get(name))


if __name__ == "__main__":
    main()
