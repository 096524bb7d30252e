# SPDX-License-Identifier: Apache-2.0
"""Prints the light that a material reflects and transmits, for given directions, in numbers.

  eval     f (without the cosine) and the density with which wi would be sampled
  sample   directions wi, their weight f cos / pdf, and their density (for a mirror, clear glass, or
           light that passes straight on, the probability)
  albedo   directional albedo: the share of the light that comes back towards wo, from both sides

Numbers are those of the whole material. Light that passes straight on, through a thin wall, a film or
an opacity below 1, counts in sample and albedo. f has no part of it.

Directions are unit vectors in the shading frame (z normal, x tangent) and point away from the
surface; others are made unit vectors. With - for a direction, sets are read from standard input,
one per line: wo and wi as six numbers for eval, wo for sample and albedo. If a flag gives one of the
two, the line holds only the other.

Methods that walk (randomWalk, positionFree) have no formula: f is then the mean of 256 walks, an
albedo that of 2048, and densities are estimates that weigh strategies against each other.
"""
import contextlib
import json
import sys

import numpy as np

from patina.cli import materials, methods, outputs, statistics
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError

BATCH = 65536  # lines that are worked on at once


def add_arguments(parser):
    parser.add_argument("action", metavar="eval|sample|albedo", choices=["eval", "sample", "albedo"],
                        help="what to print")
    parser.add_argument("material", metavar="MATERIAL", help=materials.MATERIAL_HELP)
    parser.add_argument("--wo", default="0,0,1", metavar="X,Y,Z", help="outgoing direction (default: 0,0,1)")
    parser.add_argument("--wi", metavar="X,Y,Z", help="incoming direction, for eval")
    parser.add_argument("--count", type=int, default=1, metavar="N", help="samples for each wo (default: 1)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="seed of sample (default: 0)")
    parser.add_argument("--backend", default="embree", choices=["embree", "raster"],
                        help="code to run: raster is the GLSL on the driver (default: embree)")
    materials.add_flags(parser)
    parser.add_argument("--json", metavar="FILE",
                        help="one JSON object per line: --json to standard output, --json=FILE to a file")


def run(arguments):
    if arguments.action == "eval" and arguments.wi is None:
        raise UsageError("patina bsdf eval: --wi is missing")
    if arguments.count < 1 or arguments.seed < 0:
        raise UsageError("patina bsdf: --count is 1 or more, --seed 0 or more")
    wo = _direction(arguments.wo, "--wo")
    wi = _direction(arguments.wi, "--wi") if arguments.action == "eval" else None
    chosen = methods.parse(arguments.method)
    found, warnings = materials.load(arguments.material, arguments.set)
    probe = _probe(arguments.backend, found[0][1], chosen)
    statistics.report(warnings + probe.warnings, json=False)
    if getattr(probe, "stochastic", False):
        print("note: a method walks at random; values are means over walks, densities are estimates", file=sys.stderr)
    to_file = arguments.json not in (None, "-")
    generator = np.random.default_rng(arguments.seed)
    with outputs.writing(arguments.json) if to_file else contextlib.nullcontext(sys.stdout) as out:
        for outgoing, incoming in _batches(arguments.action, wo, wi):
            _print(_results(arguments, probe, outgoing, incoming, generator), arguments.json, out)


def _probe(backend, network, chosen):
    if backend == "embree":
        return _patina.MaterialProbe(network, chosen)
    if not hasattr(_patina, "RasterProbe"):
        raise CommandError("this build has no rasterizer")
    try:
        return _patina.RasterProbe(network, chosen)
    except RuntimeError as error:
        raise CommandError(f"--backend raster: {error}") from error


def _direction(text, flag):
    """:returns: a unit vector, or None for standard input"""
    if text == "-":
        return None
    try:
        return _unit([float(word) for word in text.replace(",", " ").split()], 3)
    except ValueError:
        raise UsageError(f"patina bsdf: {flag} {text}: write it as x,y,z, such as {flag} 0,0,1, and not all 0") from None


def _unit(numbers, count):
    if len(numbers) != count:
        raise ValueError
    vectors = np.array(numbers, dtype=np.float64).reshape(-1, 3)
    lengths = np.linalg.norm(vectors, axis=1)
    if not (np.isfinite(lengths).all() and (lengths > 0.0).all()):
        raise ValueError
    return (vectors / lengths[:, None]).ravel()


def _batches(action, wo, wi):
    """Yields arrays of outgoing and incoming directions."""
    if wo is not None and (action != "eval" or wi is not None):
        yield wo[None], wi[None] if wi is not None else None
        return
    wanted = 6 if action == "eval" and wo is None and wi is None else 3
    rows = []
    for number, line in enumerate(sys.stdin, 1):
        if not line.strip():
            continue
        try:
            rows.append(_unit([float(word) for word in line.replace(",", " ").split()], wanted))
        except ValueError:
            raise CommandError(f"line {number} of standard input is no set of {wanted} numbers "
                               "with directions that are not 0") from None
        if len(rows) == BATCH:
            yield _columns(np.array(rows), wo, wi, action)
            rows = []
    if rows:
        yield _columns(np.array(rows), wo, wi, action)


def _columns(rows, wo, wi, action):
    n = len(rows)
    outgoing = rows[:, :3] if wo is None else np.tile(wo, (n, 1))
    if action != "eval":
        return outgoing, None
    return outgoing, rows[:, -3:] if wi is None else np.tile(wi, (n, 1))


def _results(arguments, probe, wo, wi, generator):
    """Yields one dict of the numbers for each line of output."""
    if arguments.action == "eval":
        f, pdf = probe.eval(wo, wi)
        for i in range(len(wo)):
            yield {"f": f[i].tolist(), "pdf": float(pdf[i])}
    elif arguments.action == "albedo":
        for row in probe.albedo(wo):
            yield {"albedo": row.tolist()}
    else:
        wo = np.repeat(wo, arguments.count, axis=0)
        for begin in range(0, len(wo), BATCH):
            part = wo[begin:begin + BATCH]
            found = probe.sample(part, generator.random((len(part), 4), dtype=np.float32))
            for i in range(len(part)):
                yield {"wi": found["wi"][i].tolist(), "weight": found["weight"][i].tolist(),
                       "pdf": float(found["pdf"][i])}


def _print(results, as_json, out):
    for result in results:
        if as_json:
            print(json.dumps(result), file=out)
        else:
            print("  ".join(f"{name} " + (" ".join(f"{v:.7g}" for v in value) if isinstance(value, list)
                                          else f"{value:.7g}") for name, value in result.items()), file=out)
