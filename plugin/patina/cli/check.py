# SPDX-License-Identifier: Apache-2.0
"""Checks the mathematical properties of materials that a renderer relies on, over directions and places.

  finite       values, densities, samples, albedo and emission are finite and not negative
  energy       no more light comes back than arrives, by the material's own albedo and by its samples
  pdf          densities integrate to 1 at most, and to the share of samples that are not mirrors
  weight       a sample's weight is f cos / pdf
  chi2         samples fall where the density says (chi-squared test; significance 1 % for the whole
               material, by Šidák)
  reciprocity  f(a, b) = f(b, a) for directions above the surface. If not, it prints "note"; that is a
               failure only with --reciprocal, since energy compensation, layers by albedo and
               media inside are not reciprocal by design

Materials that vary are checked at points of uv 0 to 1. Each material is shown when it is done; warnings come last, grouped by
cause as in `patina record`. The exit status is 1 if a check fails.

--layers takes no material. It prints how far the albedo of layers as they are meant (`--method layering=...`) is from that of
a varnish: a random walk between the interfaces.
"""
import math

import numpy as np

from patina import significance
from patina.cli import binnedDensity, causes, layers, materials, methods, outputs, statistics
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError
from patina.cli.progress import Progress

CHECKS = ("finite", "energy", "pdf", "weight", "chi2", "reciprocity")
MIRROR = 4  # event of samples that have a probability instead of a density
SIGNIFICANCE = 0.01
ANGLES = (0.0, 30.0, 60.0, 80.0, 89.0)


def add_arguments(parser):
    parser.add_argument("material", metavar="STAGE|MATERIAL", nargs="?", help=materials.EVERY_HELP)
    parser.add_argument("--layers", action="store_true", help="layers beside a random walk, as a table")
    parser.add_argument("--samples", type=int, default=65536, metavar="N", help="samples per direction (default: 65536)")
    parser.add_argument("--places", type=int, default=3, metavar="N",
                        help="points of uv per material that varies (default: 3; finite: its square times 16)")
    parser.add_argument("--tolerance", type=float, default=0.01, metavar="E",
                        help="allowed error of energy, densities and weights (default: 0.01)")
    parser.add_argument("--reciprocal", action="store_true", help="fail where f(a, b) is not f(b, a)")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="seed of the random numbers (default: 0)")
    materials.add_flags(parser)
    parser.add_argument("--json", metavar="FILE", help="write the results as JSON: --json to standard output, "
                                                       "--json=FILE to a file")


def run(arguments):
    if arguments.samples < 1024 or arguments.places < 1 or arguments.seed < 0 or not arguments.tolerance >= 0.0:
        raise UsageError("patina check: --samples is 1024 or more, --places 1 or more, --seed and --tolerance 0 or "
                         "more")
    if arguments.layers == bool(arguments.material):
        raise UsageError("patina check: name a material, or --layers without one")
    chosen = methods.parse(arguments.method)
    outputs.check_all([arguments.json])
    if arguments.layers:
        _report_layers(chosen, arguments)
        return
    found, warnings = materials.load(arguments.material, arguments.set, every=True)
    outputs.check_all([arguments.json])  # now that it is known what is read
    results, work = [], _Work(len(found))
    width = max(len(name) for name, _ in found)
    try:
        for name, network in found:
            work.compiling(name)
            probe = _patina.MaterialProbe(network, chosen)
            warnings += probe.warnings
            work.begin(_steps(probe, arguments))
            results.append((name, check(probe, arguments, work.step)))
            if arguments.json != "-":
                work.progress.clear()
                _print(*results[-1], width)
    finally:  # also of what was not checked any more
        work.progress.clear()
        statistics.report(warnings)
    outputs.write_json(arguments.json, {"materials": [{"name": name, "checks": outcomes} for name, outcomes in results],
                 "causes": statistics.Causes(warnings).groups, "warnings": warnings})
    failures = [(name, kind, outcome) for name, outcomes in results for kind, outcome in outcomes.items()
                if outcome["failed"]]
    if failures:
        name, kind, outcome = failures[0]
        raise CommandError(f"{len(failures)} of {len(CHECKS) * len(results)} checks fail; first {name}: {kind}, "
                           f"{outcome['text']}")


class _Work:
    """How far the command is: one step is a direction, or a material's check of numbers."""

    def __init__(self, materials_in_all):
        self.progress = Progress("check")
        self.materials = materials_in_all
        self.number = self.started = self.done = self.known = 0

    def compiling(self, name):
        self.number += 1
        self.name = name
        self._show()

    def begin(self, steps):
        self.started += 1
        self.known += steps
        self._show()

    def step(self):
        self.done += 1
        self._show()

    def _show(self):
        # Those that are not compiled yet are taken for the mean of those that are.
        total = self.known * self.materials / max(self.started, 1)
        self.progress.step(self.done, total, f"material {self.number} of {self.materials}, {self.name}")


def _steps(probe, arguments):
    """:returns: how often check() calls its step"""
    return 1 + 2 * len(ANGLES) * (1 if probe.constant else arguments.places)


def check(probe, arguments, step=lambda: None):
    """:param step: called after each direction, and after the numbers
    :returns: check -> dict of failed, state ("ok", "FAIL", or "note": it does not hold and need not), worst (a number), text"""
    generator = np.random.default_rng(arguments.seed)
    varies = not probe.constant
    outcomes = {"finite": _finite(probe, arguments, generator, varies)}
    step()
    places = [(0.5, 0.5)]
    if varies:
        places = [tuple(generator.random(2)) for _ in range(arguments.places)]
    found = {kind: [] for kind in CHECKS[1:]}
    tests = len(places) * len(ANGLES) * 2
    for place in places:
        if varies:
            probe.move_to(*place)
        for angle in ANGLES:
            for below in (False, True):
                where = f"at {180 - angle if below else angle:g} degrees" + (
                    f", uv {place[0]:.3f} {place[1]:.3f}" if varies else "")
                wo = _at(180.0 - angle if below else angle)
                _direction(probe, wo, where, arguments, generator, tests, found)
                step()
        number, where = _reciprocity(probe, generator, place if varies else None)
        limit = arguments.tolerance if arguments.reciprocal else None
        found["reciprocity"].append((number, limit, where))
    for kind in CHECKS[1:]:
        outcomes[kind] = _worst(kind, found[kind], arguments)
    return outcomes


def _at(degrees):
    t = math.radians(degrees)
    return np.array([math.sin(t), 0.0, math.cos(t)]) if degrees % 180.0 else np.array([0.0, 0.0, math.cos(t)])


def _outcome(failed, worst, text, holds=True):
    return {"failed": bool(failed), "state": "FAIL" if failed else "ok" if holds else "note", "worst": worst, "text": text}


def _worst(kind, entries, arguments):
    """:param entries: (number, limit or None, where)"""
    entries = [e for e in entries if e is not None]
    if not entries:
        return _outcome(False, 0.0, "nothing to check")
    number, limit, where = max(entries, key=lambda e: e[0] - (e[1] or 0.0))
    failed = limit is not None and not number <= limit
    if kind == "chi2":
        text = f"{len(entries)} tests, most unlikely p = {math.exp(-number):.3g} {where}"
    elif kind == "energy":
        text = f"largest albedo {number:.4g} {where}"
    else:
        text = f"largest error {number:.3g} {where}"
    # Without a limit it is no failure, and still not so.
    holds = limit is not None or number <= arguments.tolerance
    if not holds:
        text = f"not reciprocal by design (energy compensation, layers by albedo and media are not): {text}"
    return _outcome(failed, float(number), text, holds)


def _finite(probe, arguments, generator, varies):
    """Everything over a grid with the extremes in it: grazing, in the plane, from below."""
    degrees = [0, 1e-3, 20, 45, 70, 85, 89, 89.9, 89.999, 90, 90.001, 91, 120, 160, 180]
    directions = np.array([_turned(_at(d), p) for d in degrees for p in (0.0, 1.0, 3.5)], np.float32)
    a = np.repeat(directions, len(directions), axis=0)
    b = np.tile(directions, (len(directions), 1))
    places = [None] if not varies else [None] + [tuple(p) for p in generator.random((16 * arguments.places ** 2, 2))]
    bad = ""
    for place in places:
        if place is not None:
            probe.move_to(*place)
        f, pdf = probe.eval(a, b)
        u = generator.random((len(a), 4), dtype=np.float32)
        s = probe.sample(a, u)
        values = {"f": f, "pdf": pdf, "weight": s["weight"], "sample pdf": s["pdf"],
                  "albedo": probe.albedo(directions), "emission": probe.emission(directions)}
        for what, array in values.items():
            if not (np.isfinite(array).all() and (array >= 0.0).all()):
                row = np.argwhere(~(np.isfinite(array) & (array >= 0.0)))[0]
                direction = (a if len(array) == len(a) else directions)[row[0]]
                bad = bad or f"{what} is {array[tuple(row)]:g} for wo = {np.round(direction, 5).tolist()}" + (
                    f", uv {place[0]:.3f} {place[1]:.3f}" if place is not None else "")
        if not np.isfinite(s["wi"]).all():
            bad = bad or "a sampled direction is not finite"
    return _outcome(bool(bad), float(bool(bad)), bad or f"{len(a) * len(places)} pairs of directions")


def _turned(direction, phi):
    c, s = math.cos(phi), math.sin(phi)
    return [direction[0] * c - direction[1] * s, direction[0] * s + direction[1] * c, direction[2]]


def _direction(probe, wo, where, arguments, generator, tests, found):
    n = arguments.samples
    outgoing = np.tile(wo.astype(np.float32), (n, 1))
    s = probe.sample(outgoing, generator.random((n, 4), dtype=np.float32))
    event, weight = s["event"], s["weight"].astype(np.float64)
    alive = event != 0
    # Energy. Samples estimate it with an error of their own, of which four are allowed.
    estimate = weight.mean(axis=0)
    noise = 4.0 * weight.std(axis=0) / math.sqrt(n)
    own = probe.albedo(outgoing[:1])[0].astype(np.float64)
    found["energy"].append((float(max((estimate - noise).max(), own.max())), 1.0 + arguments.tolerance, where))
    smooth = alive & ((event & MIRROR) == 0)
    if not smooth.any():
        return
    f, pdf = probe.eval(outgoing[smooth], s["wi"][smooth])
    cosine = np.abs(s["wi"][smooth][:, 2:3]).astype(np.float64)
    expected = f.astype(np.float64) * cosine / np.maximum(pdf, 1e-30)[:, None]
    # Directions as floats are too coarse for the sharpest lobes: the median is what is wrong or not.
    scale = np.maximum(expected.max(axis=1), 1e-3)
    error = np.median(np.abs(weight[smooth] - expected).max(axis=1) / scale)
    found["weight"].append((float(error), arguments.tolerance, where))

    y, x = binnedDensity.coordinates(s["wi"][smooth])
    observed = binnedDensity.counts(y, x)
    expected, sure = binnedDensity.integrate(probe, wo, y, x, n)
    total = expected.sum()
    if not sure:
        return  # narrower than the quadrature can see
    share = smooth.mean()
    error = max(total - 1.0, abs(total - share) - 4.0 * math.sqrt(share * (1.0 - share) / n))
    found["pdf"].append((float(error), arguments.tolerance, where))
    p = chi_squared(observed, expected * n, n)
    if p is not None:
        limit = -math.log(significance.sidak(SIGNIFICANCE, tests))
        found["chi2"].append((-math.log(max(p, 1e-300)), limit, where))


def chi_squared(observed, expected, n):
    """Probability of a deviation this large; cells of few expected samples are pooled.

    :returns: None with fewer than two cells
    """
    # Errors of all bins add up in what they leave: "pdf" tests that, and here it counts beyond them.
    left, expected_left = n - observed.sum(), max(0.0, n - expected.sum())
    observed = np.append(observed.astype(np.float64), left)
    expected = np.append(expected, left if abs(left - expected_left) <= binnedDensity.PRECISE * n else expected_left)
    order = np.argsort(expected)
    cells, o, e = [], 0.0, 0.0
    for i in order:
        o, e = o + observed[i], e + expected[i]
        if e >= 8.0:
            cells.append((o, e))
            o = e = 0.0
    if cells and (o or e):
        cells[-1] = (cells[-1][0] + o, cells[-1][1] + e)
    if len(cells) < 2:
        return None
    # The quadrature's own error, a thousandth of each cell, is no fault of the samples.
    statistic = sum(max(0.0, abs(o - e) - 1e-3 * e) ** 2 / e for o, e in cells)
    return significance.chi_squared_tail(statistic, len(cells) - 1)


def _reciprocity(probe, generator, place):
    z = generator.uniform(0.02, 1.0, (2, 4096))
    phi = generator.uniform(0.0, 2.0 * math.pi, (2, 4096))
    r = np.sqrt(1.0 - z * z)
    a, b = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1).astype(np.float32)
    there, back = probe.eval(a, b)[0].astype(np.float64), probe.eval(b, a)[0].astype(np.float64)
    scale = np.maximum(np.maximum(there, back), 1e-3)
    error = (np.abs(there - back) / scale).max(axis=1)
    worst = int(error.argmax())
    return float(error[worst]), "between {:.0f} and {:.0f} degrees".format(
        *np.degrees(np.arccos([a[worst, 2], b[worst, 2]]))) + (
            f", uv {place[0]:.3f} {place[1]:.3f}" if place else "")


def _report_layers(chosen, arguments):
    progress, rows = Progress("check"), []
    for row in layers.rows(chosen, arguments.samples, arguments.seed):
        if arguments.json != "-":
            progress.clear()
            print(layers.line(row) if rows else layers.HEAD + "\n" + layers.line(row), flush=True)
        rows.append(row)
        progress.step(len(rows), len(layers.STACKS) * len(layers.ANGLES), row["stack"])
    progress.clear()
    outputs.write_json(arguments.json, {"layers": rows})


def _print(name, outcomes, width):
    """Shows a material as soon as it is checked."""
    for kind in CHECKS:
        outcome = outcomes[kind]
        print(f"{causes.printable(name):<{width}}  {kind:<12} {outcome['state']:<5} {outcome['text']}", flush=True)
