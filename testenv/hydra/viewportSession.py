#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Memory of viewport sessions: edits a stage in Hydra for a time, and tells whether memory stays flat.

Usage: viewportSession.py [--seconds 3600] [--backend embree|raster|interactive] [--seed 1] [--sceneIndex] [--log FILE]
[--samples FILE] [--judge FILE] [--results]

The program viewportSession makes every kind of edit once, in random order, and takes all of them back: a cycle. Then the scene
is what it was, and memory is counted: bytes on the heap that malloc has handed out, and resident bytes of no file, after
malloc_trim(). The first third of the time is left out, in which caches fill. Programs that the rasterizer keeps for networks to
come back to are others after each cycle, up to 40 MB each, so it keeps none there.

Growth is the slope of memory over edits after Theil (1950) and Sen (1968), with limits of 99 % on either side. At most 20 equal
spans are compared, each by the smallest of its counts, which are six or more: what an edit leaves behind for good is in all
later counts, while what a driver has compiled for a program's last uses comes and goes with the order of edits. Memory is flat
where the upper limit is below a bound, and grows where the lower one is above: 32 bytes of the heap for each edit, malloc's
smallest chunk, so that below it not every edit can leave something behind; for resident memory one page of 4096 bytes for each
cycle.

Prints JSON. Exit status 1: memory grows; 2: neither is shown, and a longer run may tell. --results adds a row to
testenv/fuzz/results.json, of which docs/trust.md is made."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
if __name__ == "__main__":
    sys.path[:0] = [HERE, os.path.join(HERE, "..")]
    import checkout

    checkout.enter()

import numpy as np  # noqa: E402
from scipy import stats  # noqa: E402

sys.path[1:1] = [HERE, os.path.join(HERE, "..", "fuzz")]

import hydraBuild  # noqa: E402
import results  # noqa: E402

CHUNK = 32  # bytes: the smallest that malloc hands out on 64-bit machines, with its header
PAGE = 4096
SPANS = 20
COUNTS = 6  # of a span at least: half of a rasterizer's counts are near the smallest, and six miss it once in 64 spans
CONFIDENCE = 0.99  # of each limit
BACKENDS = ("embree", "raster", "interactive")


def run(*arguments, seconds, log=None, kept=None):
    """:param arguments: of the program viewportSession
    :param log: file for what renderer and OpenUSD say; None: it is dropped
    :param kept: file that the samples are written to as they come, a line of JSON each
    :returns: samples, dicts of seconds, edits, lost (hosts that OpenUSD's own errors ended), heap and resident bytes
    :raises AssertionError: when the program fails"""
    with tempfile.TemporaryDirectory() as folder, open(log or os.devnull, "w", encoding="utf-8") as told:
        kept = kept or os.path.join(folder, "samples")
        command = [hydraBuild.folder("viewportSession"), folder, "--seconds", str(seconds), *map(str, arguments)]
        with open(kept, "w", encoding="utf-8") as samples:
            process = subprocess.run(command, env=hydraBuild.environment(), stdout=samples, stderr=told, check=False,
                                     timeout=3 * seconds + 900)
        if process.returncode != 0:
            raise AssertionError(f"{' '.join(command)} ends with {process.returncode}")
        return read(kept)


def read(kept):
    """:returns: the samples of a file; the last line may be cut off, where a run was ended"""
    with open(kept, encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.endswith("}\n")]


def settled(samples):
    """:returns: the samples after the first third of the time"""
    return [sample for sample in samples if sample["seconds"] > samples[-1]["seconds"] / 3]


def growth(samples, key, counts=COUNTS):
    """:param key: heap or resident
    :param counts: of a span at least
    :returns: bytes per edit, and the lower and upper limit of that; nothing is known with fewer than four spans"""
    edits, memory = (np.array([sample[name] for sample in samples], float) for name in ("edits", key))
    count = min(SPANS, len(samples) // counts)
    if count < 4:
        return 0.0, -np.inf, np.inf
    spans = np.array_split(np.arange(len(samples)), count)
    least = [span[np.argmin(memory[span])] for span in spans]
    x, y = edits[least], memory[least]
    slope, _, low, high = stats.theilslopes(y, x, 2 * CONFIDENCE - 1)
    return slope, low, high


def verdict(low, high, bound):
    return "flat" if high < bound else "grows" if low > bound else "undecided"


def report(samples):
    """:returns: dict of the run, with one of each kind of memory: megabytes at the end, bytes per edit with limits, verdict"""
    late = settled(samples)
    each = samples[0]["edits"]
    found = {"edits": samples[-1]["edits"], "cycles": len(samples), "seconds": samples[-1]["seconds"],
             "lost": samples[-1]["lost"]}
    for key, bound in (("heap", CHUNK), ("resident", PAGE / each)):
        slope, low, high = growth(late, key)
        found[key] = {"megabytes": round(samples[-1][key] / 2 ** 20, 1), "perEdit": round(slope, 1),
                      "limits": [round(low, 1), round(high, 1)] if np.isfinite(high) else None, "bound": round(bound, 1),
                      "verdict": verdict(low, high, bound)}
    return found


def row(backend, seed, found):
    """:returns: a row of results.json"""
    grows = [key for key in ("heap", "resident") if found[key]["verdict"] == "grows"]
    counts = {"growth": len(grows)} if grows else {}
    return results.row("viewport" + backend.capitalize(), seed,
                       {"inputs": found["edits"], "seconds": found["seconds"],
                        "counts": {**counts, "fine": found["edits"] - len(grows)},
                        "memory": {key: found[key] for key in ("cycles", "heap", "resident")},
                        "findings": [("growth", f"{key}: {found[key]['perEdit']} bytes per edit") for key in grows]})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--backend", choices=BACKENDS, default="embree")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sceneIndex", action="store_true", help="UsdImaging's scene indices as input")
    parser.add_argument("--log", help="file for what renderer and OpenUSD say")
    parser.add_argument("--samples", help="file for the samples, as they come")
    parser.add_argument("--judge", metavar="FILE", help="file that --samples of an earlier run wrote: nothing is run")
    parser.add_argument("--results", action="store_true")
    line = parser.parse_args()
    flags = ["--set", "unusedPrograms=0", *(["--sceneIndex"] if line.sceneIndex else [])]
    samples = read(line.judge) if line.judge else run(
        "--set", "backend=" + line.backend, "--seed", line.seed, *flags, seconds=line.seconds, log=line.log, kept=line.samples)
    found = report(samples)
    print(json.dumps({"backend": line.backend, "seed": line.seed, **found, "samples": samples}))
    if line.results:
        results.append([row(line.backend, line.seed, found)])
    verdicts = {found[key]["verdict"] for key in ("heap", "resident")}
    sys.exit(1 if "grows" in verdicts else 2 if "undecided" in verdicts else 0)


if __name__ == "__main__":
    main()
