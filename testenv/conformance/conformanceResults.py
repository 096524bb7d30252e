# SPDX-License-Identifier: Apache-2.0
"""Counts of conformance runs, and the page docs/generated/conformance.md that is made of them.

testenv/conformance/results.json holds for each set of stages the counts, and one line for each stage that fails or whose hosts
disagree. causes.py says why, as far as it is known."""
import collections
import datetime
import json
import os

import agreement
import causes

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "results.json")
STATUSES = ("ok", "message", "crash", "timeout", "memory", "NaN", "listed")
WORDS = ("same", "agrees", "coarse", "differs", "undecided", "failed")
TITLES = {"read": "reading", "embree": "command line, path tracer", "raster": "command line, rasterizer",
          "delegate": "Hydra, delegate's way", "sceneIndex": "Hydra, scene indices"}


def counted(rows):
    """:returns: dict of `stages`, `listed`, `ways` (way -> status -> number), `pairs` (way -> word -> number), `seconds` and
        `memory` (way -> sum, largest) of rows"""
    ways, pairs = collections.defaultdict(collections.Counter), collections.defaultdict(collections.Counter)
    seconds, memory = collections.Counter(), collections.Counter()
    for row in rows:
        for name, way in row["ways"].items():
            ways[name][way["status"]] += 1
            seconds[name] += way.get("seconds", 0.0)
            memory[name] = max(memory[name], way.get("memory", 0))
        for name, pair in row["pairs"].items():
            pairs[name][pair["word"]] += 1
    return {"stages": len(rows), "listed": sum(bool(row["listed"]) for row in rows),
            "ways": {name: dict(found) for name, found in ways.items()},
            "pairs": {name: dict(found) for name, found in pairs.items()},
            "seconds": {name: round(sum_) for name, sum_ in seconds.items()}, "memory": dict(memory)}


def lines(rows):
    """:returns: list of (stage, way, what) of all that fails or differs"""
    found = []
    for row in rows:
        name = row["name"].partition("/")[2]
        for way, told in row["ways"].items():
            if told["status"] not in ("ok", "listed"):
                found.append([name, way, told["status"]])
        for way, pair in row["pairs"].items():
            if pair["word"] in ("differs", "undecided", "failed"):
                found.append([name, way, pair["word"] + (f", {percent(pair['worst'])}" if pair["worst"] >= 0 else "")])
    return found


def percent(part):
    return f"{100 * part:.0f} %" if part > 0.1 else f"{100 * part:.2g} %"


def table(rows):
    """:returns: lines of text: counts of ways and of pairs"""
    counts = counted(rows)
    told = [f"{counts['stages']} stages, {counts['listed']} listed"]
    for name, found in counts["ways"].items():
        told.append(f"{TITLES[name]}: " + ", ".join(f"{found[s]} {s}" for s in STATUSES if s in found)
                    + f"; {counts['seconds'][name]} s, up to {counts['memory'][name]} MB")
    for name, found in counts["pairs"].items():
        told.append(f"{TITLES[name]} beside the path tracer: " + ", ".join(f"{found[w]} {w}" for w in WORDS if w in found))
    return told


def read(path=FILE):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def update(rows, names, options, path=FILE):
    """Replaces the counts of sets, and keeps those of others."""
    kept = read(path) if os.path.exists(path) else {}
    for name in names:
        own = [row for row in rows if row["name"].startswith(name + "/")]
        kept[name] = {"date": datetime.date.today().isoformat(), "samples": options["samples"], "size": list(options["size"]),
                      "openUSD": options.get("openUSD", ""), "counts": counted(own), "lines": lines(own)}
    with open(path, "w", encoding="utf-8") as file:
        file.write("{\n" + ",\n".join(f" {json.dumps(name)}: {_text(of)}" for name, of in sorted(kept.items())) + "\n}\n")


def _text(of):
    """:returns: a set's results, with a line for each that fails"""
    head = json.dumps({key: value for key, value in of.items() if key != "lines"})
    told = ",\n".join("   " + json.dumps(line) for line in of["lines"])
    return f'{head[:-1]}, "lines": [\n{told}\n  ]}}' if told else f'{head[:-1]}, "lines": []}}'


def page():
    """:returns: lines of docs/generated/conformance.md"""
    import generateDocs

    told = ["# Conformance", "",
            "Stages that others made, drawn by up to four ways: the command line with the path tracer and with the",
            "rasterizer, and Hydra in the delegate's way and by scene indices. Counts are those of a run of",
            "`./patina python testenv/conformance/run.py FOLDER... --results`; the stages are not part of Patina.", "",
            "- *message*: the command ended with a line that says why.",
            "- *listed*: the stage is not drawn. It shows nothing by itself, or Hydra's OpenUSD has no plugin for a file that",
            "  it composes.", "",
            "The rasterizer takes one sample per pixel, and its picture is compared with no other. Hydra's pictures are",
            "compared with those of the path tracer, tile by tile, by Welch's test with a margin of 1 %.",
            "The percentage is the largest difference of a tile.", "",
            "- *same*: all bits are equal. *agrees*: no tile differs by more than the margin.",
            "- *coarse*: tiles differ, and the stage has spheres or other shapes of which UsdImagingDelegate makes coarse",
            f"  meshes. The picture's mean differs by at most {percent(agreement.COARSE)}, by which such a ball is too small.",
            "- *undecided*: noise hides what the test is asked to see."]
    for name, of in sorted(read().items()):
        counts = of["counts"]
        told += ["", f"## {name}", "",
                 *([causes.SETS[name], ""] if name in causes.SETS else []),
                 f"{counts['stages']} stages, of which {counts['listed']} show nothing by themselves;",
                 f"{of['size'][0]} x {of['size'][1]} pixels, {of['samples']} samples, {of['date']}"
                 + (f"; Hydra is that of OpenUSD {of['openUSD']}." if of.get("openUSD") else "."), "",
                 *generateDocs.table(("way", *STATUSES, "seconds in all", "largest MB"),
                                     [(TITLES[way], *(str(found.get(status, 0)) for status in STATUSES),
                                       str(counts["seconds"][way]), str(counts["memory"][way]))
                                      for way, found in counts["ways"].items()]), "",
                 *generateDocs.table(("beside the path tracer", *WORDS),
                                     [(TITLES[way], *(str(found.get(word, 0)) for word in WORDS))
                                      for way, found in counts["pairs"].items()])]
        if of["lines"]:
            told += ["", *generateDocs.table(("stage", "way", "what", "cause"),
                                             [(f"`{stage}`", TITLES[way], what, causes.of(name, stage, way))
                                              for stage, way, what in of["lines"]])]
    return told
