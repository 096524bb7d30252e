# SPDX-License-Identifier: Apache-2.0
"""Writes the pages of docs/generated from the code, or with --check tells which of them are stale.

    ./patina python testenv/generateDocs.py [--check] [PAGE ...]

Pages: nodes, flags, limits, methods, aovs, marks, cameras, lights, library, byDesign, messages, benchmarks, conformance,
openUSD, trust (docs/trust.md).
testenv/lint/test_generatedDocs.py fails where one is stale.
"""
import argparse
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

import benchmarks
from documents import read
from patina import experiment

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
FOLDER = os.path.join(ROOT, "docs", "generated")
NODES = "materialNetwork/nodes"
FUNCTIONS = "shaders/patterns/nodes"
MODELS = "materialNetwork/models"
LOBES = "materialNetwork/lobeTable.inc"
STRING = r'"((?:[^"\\]|\\.)*)"'


def names_in(path, ending):
    return sorted(name for name in os.listdir(os.path.join(ROOT, path)) if name.endswith(ending))


def cell(text):
    """:returns: text that breaks no row of a table, and names no element of HTML outside of code"""
    parts = " ".join(text.split()).replace("|", "\\|").split("`")
    return "`".join(part if i % 2 else re.sub(r"<(?=[A-Za-z/!])", r"\\<", part) for i, part in enumerate(parts))


def table(head, rows):
    return experiment.table(head, [list(map(cell, row)) for row in rows])


def entries(text):
    """:returns: texts of the entries of an array's initializer, without the commas between them"""
    found, depth, start, quoted = [], 0, 0, False
    for i, c in enumerate(text):
        if c == '"' and text[i - 1] != "\\":
            quoted = not quoted
        elif not quoted and c in "{(":
            depth += 1
        elif not quoted and c in "})":
            depth -= 1
        elif not quoted and c == "," and depth == 0:
            found.append(text[start:i].strip())
            start = i + 1
    return [e for e in [*found, text[start:].strip()] if e]


def families():
    """:returns: for each family of nodes, the text of the file that has its rows: that of its functions, if it has one"""
    functions = {name.removesuffix(".glsl"): f"{FUNCTIONS}/{name}" for name in names_in(FUNCTIONS, ".glsl")}
    files = {name.removesuffix("Nodes.cpp"): f"{NODES}/{name}" for name in names_in(NODES, "Nodes.cpp")}
    return [read(path) for _, path in sorted({**files, **functions}.items())]


def categories(source):
    """:param source: one of families()
    :returns: the rows' categories in their order, each once"""
    body = source.split("const NodeRow rows[] = {", 1)[1].split("\n};", 1)[0]
    lobes = "".join(f"closure({row})," for row in re.findall(r'PATINA_LOBE_NODE\(\w+, ("[^"]*", "[^"]*")', read(LOBES)))
    body = re.sub(r'#define PATINA_LOBE_NODE.*?#include "materialNetwork/lobeTable.inc"\n', lobes, body, flags=re.DOTALL)
    found = []
    for entry in entries(re.sub(r"//[^\n]*", "", body)):
        strings = re.findall(STRING, entry)
        # A macro of the matrices has the category first; a row has its id before it.
        is_macro = re.match(r"PATINA_(MATRIX|MATRICES|SUMS|CHOICE)", entry)
        if not strings or (not is_macro and len(strings) < 2):
            raise ValueError(f"a row of {NODES} that is not understood: {entry[:80]}")
        found.append(strings[0 if is_macro else 1])
    return list(dict.fromkeys(found))


def head_comment(source):
    """:returns: the first sentence of the comment that a file begins with"""
    lines = []
    for line in source.splitlines():
        if not line.startswith("//"):
            break
        if "SPDX-License-Identifier" in line:
            continue
        lines.append(line[2:].strip())
    return re.split(r"[.:](?:\s|$)", " ".join(lines))[0]


def nodes():
    rows = [(head_comment(source), ", ".join(f"`{c}`" for c in categories(source))) for source in families()]
    models = []
    for name in names_in(MODELS, ".mtlx"):
        defined = ElementTree.fromstring(read(f"{MODELS}/{name}")).iter("nodedef")
        models.append((f"`{MODELS}/{name}`", ", ".join(dict.fromkeys(f"`{d.get('node')}`" for d in defined))))
    missing = [(f"`{ids}`", reason[0].upper() + reason[1:] + ".") for ids, reason in
               re.findall(rf"PATINA_NOT_DRAWN\({STRING},\s*{STRING}\)", read(f"{NODES}/notDrawn.inc"))]
    return ["# Nodes", "",
            f"Categories that the table of node definitions (`{NODES}`) has, by file, and those that are graphs in data files.",
            "Most have one definition for each type. A closure that is known but not modelled gets a warning.", "",
            *table(("family", "categories"), rows), "", *table(("data file", "categories"), models), "",
            "Each definition of MaterialX 1.39.5 and 1.38.10 is compared with these: inputs, types, defaults and outputs.",
            "Those that are not drawn, where `*` stands for any text:", "", *table(("definitions", "why"), missing)]


def flags():
    from patina.cli import recordFlags

    parser = argparse.ArgumentParser(prog="patina record", add_help=False)
    recordFlags.add_arguments(parser)
    lines = ["# Flags of `patina record`", "", "`patina record STAGE IMAGE [flags]`"]
    for group in parser._action_groups:
        actions = [action for action in group._group_actions if action.option_strings]
        if not actions:
            continue
        rows = []
        for action in actions:
            value = "" if action.nargs == 0 else " " + (action.metavar or "{" + ",".join(map(str, action.choices)) + "}")
            rows.append((f"`{', '.join(action.option_strings)}{value}`", action.help % {"default": action.default}))
        lines += ["", f"## {group.title[0].upper()}{group.title[1:]}", "", *table(("flag", "meaning"), rows)]
    return lines


def limits():
    from patina import limits as known

    rows = [(f"`{name}`", f"{default:,}", f"{least:,} to {most:,}", text)
            for name, (default, least, most, text) in known.table().items()]
    return ["# Limits", "",
            "Limits keep a hostile or broken file from taking memory without end. Input beyond a limit is left out,",
            "with a message that names the prim and the limit, and the rest is shown. The defaults are above the",
            "needs of real scenes.",
            "", "- `--limit NAME=VALUE` sets one (`record`, `merge`, `explain`, `bsdf`, `check`, `bake`, `shader`, `view`).",
            '- `PATINA_LIMITS="NAME=VALUE ..."` in the environment sets them in every host.', "",
            "The table is `base/limits.def`.", "", *table(("limit", "default", "may be", "counts"), rows)]


def methods():
    from patina.cli import compiled

    module = compiled.load()
    lines = ["# Methods at choice points", "",
             "`--method POINT=NAME` forces a method. The first method of each table is the default.",
             "`patina chart --lobes` measures the figures.", "",
             "- *Error*: the mean and the largest error, each of the subject where it is worst.",
             "- *Of*: the quantity that the error is in. *noise* is the standard deviation of one sample's weight, *effort* is",
             "  time x variance over the default's.",
             "- *Cost*: time over the default's."]
    for point, known in module.choice_points():
        rows = []
        for name, description in known:
            figures = module.method_figures(point, name)
            measured = ("",) * 3 if figures is None else (
                f"{figures['mean']:.2g}, {figures['largest']:.2g}", figures["errorOf"], f"{figures['cost']:.2g}")
            rows.append((f"`{name}`", description, *measured))
        if not any(row[2] for row in rows):
            rows, head = [row[:2] for row in rows], ("method", "does")
        else:
            head = ("method", "does", "error: mean, largest", "of", "cost")
        lines += ["", f"## {point}", "", *table(head, rows)]
    return lines


def aovs():
    from patina.cli import recordFlags, rows as tables

    kinds = {"Mean": "mean of the samples", "First": "the sample nearest the pixel's centre",
             "Coverage": "ids by their share of the samples"}
    counted = {"sampleCount": "count", "variance": "estimate"}
    table_rows = [row for row in tables.read("hdDelegate/film/aovs.def", "AOV") if row.values[0] not in ("primvars", "lpe")]
    # AOVs that the film makes, then means.
    table_rows.sort(key=lambda row: ("film" not in row.words, row.values[2] != "Mean"))
    rows = []
    for row in table_rows:
        name, components, kind, clear, _ = row.values
        holds = row.text(4) + "".join(f": `{expression}`" for expression in row.words.get("paths", ()))
        rows.append((f"`{name}`", components, holds, counted.get(name, kinds[kind]), clear.rstrip("f"),
                     "yes" if name in recordFlags.ALL_AOVS else ""))
    rows.append(("`NAME=lpe:EXPRESSION`", "3", "light of the paths that fit [an expression](../design/lightPaths.md)",
                 kinds["Mean"], "0.0", ""))
    rows.append(("`primvars:NAME`", "1 to 3", "a primvar; texture coordinates have two components", kinds["First"], "0.0",
                 "`primvars:st`"))
    return ["# AOVs", "", "The table is `hdDelegate/film/aovs.def`. `color` and `alpha` are always written.", "",
            *table(("name", "components", "holds", "value of a pixel", "value of an empty pixel", "in `--aov all`"), rows)]


def marks():
    from patina.cli import rows as tables

    rows = [(f"`primvars:{row.text(0)}`", row.text(2)) for row in tables.read("hdDelegate/scene/primMarks.def", "MARK")]
    return ["# Marks of prims", "", "Primvars that decide which rays see a prim, and whether it is a matte or a",
            "catcher. They are constant and inherited. If a prim has several, the ones further down",
            "are stronger. The table is `hdDelegate/scene/primMarks.def`.",
            "[Visibility and catchers](../design/pathTracer.md#visibility-mattes-and-catchers) has the meanings.", "",
            *table(("primvar", "meaning"), rows)]


def cameras():
    from patina.cli import rows as tables

    rows = [(f"`{row.text(0)}`", row.text(2)) for row in tables.read("hdDelegate/scene/cameraInputs.def", "CAMERA_INPUT")]
    return ["# Attributes of cameras", "", "Attributes that a camera may have beyond UsdGeomCamera's. The table is",
            "`hdDelegate/scene/cameraInputs.def`. If a camera has several, the ones further down are stronger. Each",
            "may also be a primvar of the camera, with `primvars:` before its name, which is weaker. Defaults are in brackets.",
            "[Cameras](../design/cameras.md) has the meanings.", "", *table(("attribute", "meaning"), rows)]


def lights():
    from patina.cli import rows as tables

    path = "hdDelegate/scene/lightTypes.inc"
    types = [(f"`{schema}`", row.text(1)) for macro in ("PATINA_LIGHT", "PATINA_AREA_LIGHT")
             for row in tables.read(path, macro) for schema in row.text(2).split()]
    rows = []
    for group, type_, _, _, name, fallback, meaning in (row.values for row in tables.read(path, "PATINA_LIGHT_INPUT")):
        kind = {"vec3": "colour", "float": "number", "bool": "true, false"}.get(type_, "file" if "file" in name else "token")
        value = re.sub(r"vec3\((.*)\)", r"\1", fallback).strip('"')
        value = re.sub(r"(\.0)?f$", "", value) if value[-1:] == "f" else value
        name = ("" if "treatAs" in name else "inputs:") + tables.argument(name)
        rows.append((f"`{name}`", group.lower(), kind, value, tables.argument(meaning)))
    return ["# Lights", "", f"The table is `{path}`. Fallbacks are those of UsdLux;",
            "there a DistantLight has an intensity of 50000.",
            "[Lights](../design/lights.md) has the meanings, and filters.", "", *table(("type", "is drawn as"), types), "",
            "*light*: all lights have it; *shape*: some have it; *shaping*: it counts where the ShapingAPI is applied;",
            "*image*: of domes and rects.", "", *table(("input", "of", "value", "fallback", "meaning"), rows)]


def library():
    from patina.library import catalog

    rows = [(e.group, f"`library:{e.name}`", e.title, e.source) for e in catalog.entries()]
    return ["# Material library", "",
            "Materials that come with Patina, as MaterialX documents in `materialNetwork/library`. Every command that takes a",
            "material takes a name of this list: `patina explain library:gold`,",
            "`patina view library:gold -o gold.html`, `patina shader library:gold --target mtlx --output gold.mtlx`.",
            "`patina view --library -o library.html` makes a page of all, with pictures of both back ends.",
            "Numbers marked *designed* were chosen by eye; all others have a source.", "",
            "![All materials, as the path tracer shows them](../pictures/library.png)", "",
            *table(("group", "name", "title", "sources"), rows)]


def by_design():
    sys.path.append(os.path.join(ROOT, "testenv", "raster"))
    import byDesign

    rows = [(f"`{name}`", f.instead, ", ".join(f"`{s}`" for s in f.scenes), f"`testenv/raster/{f.test}`")
            for name, f in byDesign.FEATURES.items()]
    return ["# Differences of the rasterizer by design", "",
            "The list is `testenv/raster/byDesign.py`. Each difference has a test of its own. Test scenes with such a",
            "feature are left out of the test that holds whole pictures of both back ends together.", "",
            *table(("feature", "the rasterizer instead", "test scenes", "test of the difference"), rows)]


def messages():
    from patina import messages as texts

    lines = ["# Messages", "",
             "A message names a prim and an input, says what is wrong, and what is shown instead. Words in braces stand for",
             "names and numbers of the scene. `/World/ball.normals: are not vectors; faces are drawn flat` is the message",
             "`normalsNoVectors`, at the input `normals` of the prim `/World/ball`. In `--json` a warning has that name",
             "as `id`, and what the braces stand for as `fields`.", "",
             "- *missing*: something that was authored is missing from the picture, and a fallback stands in its place.",
             "- *changed*: a default or an approximation is used.",
             "- Both are warnings, and the command goes on. `patina record --strict` fails at either.", "",
             "If a command can show nothing at all, it ends with one line that says why, and with status 1 (2 for",
             "wrong usage, 75 if the same may work later)."]
    for area in dict.fromkeys(row.area for row in texts.table().values()):
        rows = [(f"`{id_}`", row.severity, row.text, row.advice)
                for id_, row in texts.table().items() if row.area == area]
        lines += ["", f"## {area}", "", *table(("id", "", "message", "what to do"), rows)]
    return lines


def trust():
    sys.path.append(os.path.join(ROOT, "testenv", "fuzz"))
    import results

    return results.page()


def conformance():
    sys.path.append(os.path.join(ROOT, "testenv", "conformance"))
    import conformanceResults

    return conformanceResults.page()


def open_usd():
    sys.path.append(os.path.join(ROOT, "testenv", "hydra"))
    import versions

    return versions.page()


PAGES = {"nodes": nodes, "flags": flags, "limits": limits, "methods": methods, "aovs": aovs, "marks": marks, "cameras": cameras,
         "lights": lights, "library": library, "byDesign": by_design, "messages": messages,
         "benchmarks": benchmarks.page, "conformance": conformance, "openUSD": open_usd, "trust": trust}
PLACES = {"trust": os.path.join(ROOT, "docs", "trust.md")}  # of pages that are not in docs/generated
NOTE = "<!-- Made by `./patina python testenv/generateDocs.py`; edits are lost. -->"


def path_of(page):
    return PLACES.get(page, os.path.join(FOLDER, page + ".md"))


def text_of(page):
    """:returns: what the page's file has to hold"""
    lines = PAGES[page]()
    return "\n".join([lines[0], NOTE, *lines[1:]]) + "\n"


def is_stale(page):
    path = path_of(page)
    return not os.path.isfile(path) or read(path) != text_of(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", metavar="PAGE", nargs="*", help=f"of {', '.join(PAGES)} (default: all)")
    parser.add_argument("--check", action="store_true", help="write nothing, fail where a page is stale")
    a = parser.parse_args()
    unknown = [page for page in a.pages if page not in PAGES]
    if unknown:
        parser.error(f"there is no page {unknown[0]}")
    stale = [page for page in a.pages or PAGES if is_stale(page)]
    if a.check:
        sys.exit(f"stale: {', '.join(stale)}" if stale else 0)
    os.makedirs(FOLDER, exist_ok=True)
    for page in stale:
        with open(path_of(page), "w", encoding="utf-8") as file:
            file.write(text_of(page))
        print(f"wrote {os.path.relpath(path_of(page), ROOT)}")


if __name__ == "__main__":
    main()
