# SPDX-License-Identifier: Apache-2.0
"""Makes random legal material graphs and looks for what breaks.

    ./patina python testenv/stability/randomGraphs.py --seed 1 --count 100000 --jobs 2 --keep FOLDER
    ./patina python testenv/stability/randomGraphs.py --seed 1 --count 3200 --raster

Every graph is compiled, evaluated and sampled at its worst places (graphChecks.py) and at random ones (graphLooks.py). With
--raster the driver computes it too, and both are compared; one shader serves graphs that differ in numbers alone. What fails
is made smaller, and kept in FOLDER as a document with a comment that says what failed.
"""
import argparse
import concurrent.futures
import multiprocessing
import os
import sys
import tempfile
import time
from collections import Counter

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(FOLDER, "..", "fuzz"))
if __name__ == "__main__":
    sys.path[:0] = [FOLDER, os.path.join(FOLDER, "..")]
    import checkout

    checkout.enter()

import graphChecks  # noqa: E402
import graphLooks  # noqa: E402
import graphShrink  # noqa: E402
import graphText  # noqa: E402
import kept  # noqa: E402
import keptFindings  # noqa: E402
from patina import experiment  # noqa: E402

# Of the path tracer alone, and with values that are estimates.
WALKS = {("energyCompensation", "randomWalk"), ("layering", "positionFree")}
# Ways to find an albedo that are not meant to be exact: sampling finds another.
ROUGH_GUESSES = ("karis", "monteCarlo16")
# Albedos with steps, which the path tracer reads from a curve between measured angles: up to 1.4 % apart at grazing ones.
STEPPED = "monteCarlo16"
TOGETHER = 100  # graphs in one document
SLOW = 1.0 / 64.0  # share of slow methods that a long run keeps
VARIANTS = 32  # graphs that differ in numbers alone, for one shader


def networks(patina, nodes):
    """:returns: of all materials of a document"""
    with tempfile.NamedTemporaryFile("w", suffix=".mtlx", encoding="utf-8") as file:
        file.write(nodes if isinstance(nodes, str) else graphText.document(nodes))
        file.flush()
        return patina.read_mtlx(file.name)


def load(patina, text):
    """:returns: the network of a document with one material"""
    found = networks(patina, text)
    if len(found) != 1:
        raise ValueError(f"the document holds {len(found)} materials")
    return found[0]


def walks(methods):
    return not WALKS.isdisjoint(methods.items())


def failures(patina, network, graph, methods, raster=False):
    """:returns: list of what failed on the processor, and where asked for on the driver"""
    probe = patina.MaterialProbe(network, methods)
    found = graphChecks.check(probe, graph)
    if not walks(methods):
        found += graphChecks.check_density(probe)
    if methods.get("directionalAlbedo") not in ROUGH_GUESSES:
        found += graphChecks.check_furnace(probe, graph)
    if raster and not walks(methods):
        found += compared(probe, patina.RasterProbe(network, methods), graph, methods)
    return found


class Remembering:
    """A probe that is asked each thing once."""

    def __init__(self, probe):
        self.probe, self.answers = probe, {}

    def __getattr__(self, name):
        def ask(*arrays):
            key = (name, *(array.tobytes() for array in arrays))
            if key not in self.answers:
                self.answers[key] = getattr(self.probe, name)(*arrays)
            return self.answers[key]
        return ask


def compared(probe, other, graph, methods):
    """:returns: list of what failed on the driver, or differs from the processor"""
    other = Remembering(other)
    found = ["raster: " + line for line in [*graphChecks.check(other, graph), *graphChecks.check_density(other)]]
    rough = methods.get("directionalAlbedo") == STEPPED or graphLooks.flat_curve(graph.nodes)
    found += graphChecks.compare(probe, other, 5e-2 if rough else 5e-3)
    return found


def look(patina, network, graph, methods):
    """As failures() on the processor, with as many samples as it takes.

    :returns: list of what failed, and the number of looks
    """
    probe = patina.MaterialProbe(network, methods)
    found = graphChecks.check(probe, graph)
    if found:
        return found, 0
    return graphLooks.check(probe, graph, graph.seed, methods,
                            furnace=methods.get("directionalAlbedo") not in ROUGH_GUESSES, densities=not walks(methods))


class Finding:
    """A graph that failed, in words and as small as it gets."""

    def __init__(self, graph, methods, failed, fails):
        """:param fails: callable of nodes and methods -> list of what fails"""
        self.graph, self.failed = graph, failed
        self.words = f"seed {graph.seed}" + (f" variant {graph.variant}" if graph.variant else "")
        kind = failed[0].partition(":")[0]

        def still(nodes, chosen):
            return any(line.partition(":")[0] == kind for line in fails(nodes, chosen))

        self.methods = graphShrink.fewest(methods, lambda chosen: still(graph.nodes, chosen))
        self.nodes = graphShrink.smallest(graph.nodes, lambda nodes: still(nodes, self.methods))

    def __str__(self):
        head = f"{self.words}: {', '.join(self.graph.kinds)}; methods: {self.methods}; bound: {self.graph.bound:g}"
        return "\n  ".join([head, *self.failed]) + "\n" + graphText.document(self.nodes)

    def keep(self, folder):
        text = kept.noted(graphText.document(self.nodes), self.graph, self.methods, self.failed)
        keptFindings.save(folder, "randomGraphs", ".mtlx", ("promise", self.words, text.encode(), "\n".join(self.failed)))


def of_processor(seed, count):
    """:returns: findings of so many graphs, and a Counter of looks"""
    import _patina

    points = _patina.choice_points()
    graphs = [graphText.Graph(number, prefix=f"g{number}") for number in range(seed, seed + count)]
    found, looks = [], Counter()
    for graph, network in zip(graphs, networks(_patina, [node for graph in graphs for node in graph.nodes]), strict=True):
        methods = graphText.methods(graph.seed, points, SLOW)
        graph.expect(methods)
        failed, number = look(_patina, network, graph, methods)
        looks[number] += 1
        if failed:
            found.append(Finding(graph, methods, failed, lambda nodes, chosen, graph=graph: look(
                _patina, networks(_patina, nodes)[0], graph, chosen)[0]))
    return found, looks


def of_both(seed, count):
    """As of_processor(), of `count` graphs of one seed, which differ in numbers alone.

    :returns: findings, and a Counter of graphs by whether their shader was compiled or shared
    """
    import _patina

    os.environ["PATINA_CACHE"] = ""  # shaders of random graphs are not met again
    os.environ.setdefault("GALLIVM_PERF", "nopt")  # Mesa's driver in software compiles in less time than it saves
    points = _patina.choice_points()
    found, shaders = [], Counter()
    graphs = [graphText.Graph(seed, variant, prefix=f"v{variant}") for variant in range(count)]
    methods = graphText.methods(seed, points, SLOW)
    methods = {point: name for point, name in methods.items() if (point, name) not in WALKS}
    like = []
    for graph, network in zip(graphs, networks(_patina, [node for graph in graphs for node in graph.nodes]), strict=True):
        graph.expect(methods)
        probe = _patina.MaterialProbe(network, methods)
        other = _patina.RasterProbe(network, methods, like)
        shaders["shared" if other.shares_shader else "compiled"] += 1
        if not other.shares_shader:
            like.append(other)
        failed = compared(probe, other, graph, methods)
        if failed:
            found.append(Finding(graph, methods, failed, lambda nodes, chosen, graph=graph: compared(
                *(kind(networks(_patina, nodes)[0], chosen) for kind in (_patina.MaterialProbe, _patina.RasterProbe)),
                graph, chosen)))
    return found, shaders


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1, help="of the first graph; the others count up")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--raster", action="store_true", help="also on OpenGL, some graphs for each seed")
    parser.add_argument("--variants", type=int, default=VARIANTS,
                        help=f"graphs for each seed of --raster, which differ in numbers alone (default: {VARIANTS})")
    parser.add_argument("--keep", metavar="FOLDER", help="where graphs that fail are written")
    parser.add_argument("--results", nargs="?", const="", metavar="FILE",
                        help="add the figures to this table (default: testenv/fuzz/results.json)")
    arguments = parser.parse_args()
    start, broken, findings, counted = time.time(), 0, [], Counter()
    work, size = (of_both, max(1, arguments.variants)) if arguments.raster else (of_processor, TOGETHER)
    count = arguments.count // size * size if arguments.raster else arguments.count
    spans = [(arguments.seed + (at // size if arguments.raster else at), min(size, count - at)) for at in range(0, count, size)]
    # A process that dies ends the run, with the seeds that it had.
    context = multiprocessing.get_context("fork")
    pool = concurrent.futures.ProcessPoolExecutor(arguments.jobs, mp_context=context)
    for (seed, _), future in experiment.as_done(pool, work, spans):
        try:
            found, numbers = future.result()
        except Exception as error:
            raise SystemExit(f"graphs from seed {seed} on: {type(error).__name__}: {error}") from error
        counted.update(numbers)
        broken += len(found)
        for finding in found:
            findings.append(("promise", f"{finding.words}: {finding.failed[0]}"))
            print(finding, flush=True)
            if arguments.keep:
                finding.keep(arguments.keep)
    seconds = (time.time() - start) * arguments.jobs
    if arguments.results is not None:
        import results

        counts = {"fine": count - broken} | ({"promise": broken} if broken else {})
        results.append([results.row("randomGraphsRaster" if arguments.raster else "randomGraphs", arguments.seed, {
            "inputs": count, "seconds": seconds, "counts": counts, "findings": findings})],
            arguments.results or results.FILE)
    said = ", ".join(f"{name}: {number}" for name, number in sorted(counted.items(), key=str))
    print(f"{broken} of {count} graphs failed; {'shaders' if arguments.raster else 'graphs by looks'}: {said}; "
          f"{count / max(seconds, 1e-9):.1f} graphs per second and process")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
