# SPDX-License-Identifier: Apache-2.0
"""Draws every stage of folders by four ways, and tells which fail and whether hosts agree.

    ./patina python testenv/conformance/run.py FOLDER... [--output FOLDER] [--only PATTERN]

The ways are the command line with the path tracer and with the rasterizer, and Hydra in both modes: the delegate's way and
scene indices. Each draws with the same camera and the same light; a stage that has none gets them. Hydra's pictures are
compared with the path tracer's, tile by tile (agreement.py). The rasterizer takes one sample: only faults are looked for.

FOLDER may be NAME=FOLDER, so that results call it NAME, or a single stage. Each finished stage is a line of
OUTPUT/results.jsonl; a later run goes on after it. OUTPUT/index.html shows all, with pictures of other renderers where they lie
beside a stage (peers.py). Stages that are not meant alone are listed. --results takes the counts over into
testenv/conformance/results.json, from which docs/generated/conformance.md is made.

A way ends as one of: ok; message (exit status not 0, with a line that says why); crash; timeout; memory; NaN. Exit status: 1
where a way crashed, took too long or too much, or drew values that are no numbers.
"""
import argparse
import concurrent.futures
import fnmatch
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
if __name__ == "__main__":
    sys.path[:0] = [HERE, os.path.join(HERE, "..")]
    import checkout

    checkout.enter()
sys.path[1:1] = [HERE, os.path.join(HERE, ".."), os.path.join(HERE, "..", "hydra")]

import conformanceResults  # noqa: E402
import found  # noqa: E402
import hydraBuild  # noqa: E402
import page  # noqa: E402
import stageRun  # noqa: E402
import ways  # noqa: E402
from patina import experiment  # noqa: E402

BAD = ("crash", "timeout", "memory", "NaN")


def read(path):
    """:returns: dict of a stage's name to its row; the last row of a name counts, a line that was cut off is none"""
    rows = {}
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            for line in file:
                if line.endswith("\n"):
                    row = json.loads(line)
                    rows[row["name"]] = row
    return rows


def line_of(row):
    """:returns: a row in one line"""
    told = [f"{name} {way['status']}" + (f" {way['seconds']:.1f} s {way['memory']} MB" if "seconds" in way else "")
            + (f" {len(way['warnings'])} warnings" if way["warnings"] else "") for name, way in row["ways"].items()]
    pairs = [f"{name} {pair['word']}" for name, pair in row["pairs"].items()]
    return f"{row['name']}: {'listed: ' + row['listed'] if row['listed'] else '; '.join(told + pairs)}"


def work(sets, options, arguments):
    """Draws what is not drawn yet. :returns: rows of all stages of the sets"""
    file = os.path.join(arguments.output, "results.jsonl")
    rows, asked, parts = read(file), [], {}
    for each in sets:
        parts.update(found.parts(each.stages))
        asked += [(each.label(stage), stage) for stage in each.stages]
    asked = [(label, stage) for label, stage in asked if not arguments.only or fnmatch.fnmatch(label, f"*{arguments.only}*")]
    if arguments.again:
        rows = {label: row for label, row in rows.items() if label not in dict(asked)}
    left = [(label, stage, [*stageRun.missing(rows.get(label), options["ways"])]) for label, stage in asked]
    left = [each for each in left if each[2]]
    print(f"{len(asked)} stages, of which {len(asked) - len(left)} are finished", flush=True)
    tasks = [(label, stage, dict(options, ways=names), parts.get(stage), rows.get(label)) for label, stage, names in left]
    pool = concurrent.futures.ThreadPoolExecutor(arguments.jobs)
    with open(file, "a", encoding="utf-8") as out:
        for number, (_, done) in enumerate(experiment.as_done(pool, stageRun.run, tasks), 1):
            row = done.result()
            rows[row["name"]] = row
            out.write(json.dumps(row) + "\n")
            out.flush()
            print(f"{number}/{len(left)} {line_of(row)}", flush=True)
    return [rows[label] for label, _ in asked]


def parsed(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", metavar="FOLDER", nargs="+")
    parser.add_argument("--output", default=os.path.join(os.environ.get("PATINA_BUILD_DIR", "."), "conformance"),
                        metavar="FOLDER", help="default: %(default)s")
    parser.add_argument("--samples", type=int, default=16, help="per pixel (default: %(default)s)")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), default=(160, 120), metavar="WxH",
                        help="pixels that a picture fits into (default: 160x120)")
    parser.add_argument("--timeout", type=float, default=60.0, help="seconds of one way (default: %(default)s)")
    parser.add_argument("--memory", type=float, default=12.0, help="GB of addresses of one way (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=1, help="stages at once (default: %(default)s)")
    parser.add_argument("--only", default="", metavar="PATTERN", help="stages whose names hold this; * is any text")
    parser.add_argument("--ways", default=",".join(ways.WAYS), help="default: %(default)s")
    parser.add_argument("--again", action="store_true", help="draw stages anew that are finished")
    parser.add_argument("--results", action="store_true", help="take the counts over into testenv/conformance/results.json")
    return parser, parser.parse_args(words)


def main(words=None):
    parser, arguments = parsed(words)
    sets = [found.Set(text) for text in arguments.folders]
    chosen = arguments.ways.split(",")
    if set(chosen) - set(ways.WAYS) or len(arguments.size) != 2:
        parser.error(f"the ways are {', '.join(ways.WAYS)}, and a size is WIDTHxHEIGHT")
    for each in sets:
        if not each.stages:
            parser.error(f"{each.folder}: there are no stages")
    host = ""
    if hydraBuild.missing():
        print(f"without Hydra: {hydraBuild.missing()}")
        chosen = [name for name in chosen if ways.WAYS[name].backend]
    else:
        version = hydraBuild.folder("version")
        host = f"{version[:2]}.{version[2:]}"
    pictures = os.path.join(arguments.output, "pictures")
    os.makedirs(pictures, exist_ok=True)
    options = {"samples": arguments.samples, "size": arguments.size, "ways": chosen, "pictures": pictures, "openUSD": host,
               "limits": {"seconds": arguments.timeout, "gigabytes": arguments.memory}}
    rows = work(sets, options, arguments)
    for line in conformanceResults.table(rows):
        print(line)
    print(page.write(rows, arguments.output))
    if arguments.results:
        conformanceResults.update(rows, [each.name for each in sets], options)
    return int(any(way["status"] in BAD for row in rows for way in row["ways"].values()))


if __name__ == "__main__":
    sys.exit(main())
