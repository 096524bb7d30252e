# SPDX-License-Identifier: Apache-2.0
"""Makes random legal material graphs and looks for what breaks.

    ./patina python testenv/stability/randomGraphs.py --seed 1 --count 1000 --keep FOLDER [--raster 20]

Every graph is compiled, evaluated and sampled at its worst places (graphChecks.py); each that fails is kept in FOLDER
as a document with a comment that says what failed.
"""
import argparse
import os
import sys
import tempfile
import time

if __name__ == "__main__":
    folder = os.path.dirname(os.path.abspath(__file__))
    sys.path[:0] = [folder, os.path.join(folder, "..")]
    import checkout

    checkout.enter()

import graphChecks  # noqa: E402
import graphText  # noqa: E402
import kept  # noqa: E402

# Of the path tracer alone, and with values that are estimates.
WALKS = ("randomWalk", "positionFree")
# Ways to find an albedo that are not meant to be exact: sampling finds another.
ROUGH_GUESSES = ("karis", "mirror", "monteCarlo16")
# Albedos with steps, which the path tracer reads from a curve between measured angles: up to 1.4 % apart at grazing ones.
STEPPED = ("monteCarlo16", "monteCarlo64")


def load(patina, text):
    """:returns: the network of a document with one material"""
    with tempfile.NamedTemporaryFile("w", suffix=".mtlx", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        networks = patina.read_mtlx(file.name)
    if len(networks) != 1:
        raise ValueError(f"the document holds {len(networks)} materials")
    return networks[0]


def failures(patina, network, graph, methods, raster=False):
    """:returns: list of what failed on the processor, and where asked for on the driver"""
    probe = patina.MaterialProbe(network, methods)
    walks = any(name in WALKS for name in methods.values())
    found = graphChecks.check(probe, graph)
    if not walks:
        found += graphChecks.check_density(probe)
    if methods.get("directionalAlbedo") not in ROUGH_GUESSES:
        found += graphChecks.check_furnace(probe, graph)
    if raster and not walks:
        other = patina.RasterProbe(network, methods)
        found += ["raster: " + line for line in [*graphChecks.check(other, graph), *graphChecks.check_density(other)]]
        found += graphChecks.compare(probe, other, 5e-2 if methods.get("directionalAlbedo") in STEPPED else 5e-3)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1, help="of the first graph; the others count up")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--raster", type=int, default=0, metavar="N", help="also on OpenGL, every Nth graph (0: none)")
    parser.add_argument("--keep", metavar="FOLDER", help="where graphs that fail are written")
    parser.add_argument("--results", nargs="?", const="", metavar="FILE",
                        help="add the figures to this table (default: testenv/fuzz/results.json)")
    arguments = parser.parse_args()
    import _patina

    points, start, broken, findings = _patina.choice_points(), time.time(), 0, []
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        graph = graphText.Graph(seed)
        methods = graphText.methods(seed, points)
        raster = arguments.raster > 0 and seed % arguments.raster == 0
        found = failures(_patina, load(_patina, graph.text()), graph, methods, raster)
        if not found:
            continue
        broken += 1
        findings.append(("promise", f"seed {seed}: {found[0]}"))
        print("\n  ".join([f"seed {seed}: {', '.join(graph.kinds)}; methods: {methods}; bound: {graph.bound:g}", *found]),
              flush=True)
        if arguments.keep:
            os.makedirs(arguments.keep, exist_ok=True)
            kept.write(os.path.join(arguments.keep, f"graph{seed}.mtlx"), graph.text(), graph, methods, found)
    if arguments.results is not None:
        sys.path.append(os.path.join(folder, "..", "fuzz"))
        import results

        counts = {"fine": arguments.count - broken} | ({"promise": broken} if broken else {})
        results.append([results.row("randomGraphsRaster" if arguments.raster == 1 else "randomGraphs", arguments.seed, {
            "inputs": arguments.count, "seconds": time.time() - start, "counts": counts, "findings": findings})],
            arguments.results or results.FILE)
    print(f"{broken} of {arguments.count} graphs failed; {time.time() - start:.1f} s")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
