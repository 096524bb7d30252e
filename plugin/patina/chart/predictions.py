"""Whether the planner keeps its word: the error that a tolerance makes on a stage, against what was predicted.

The truth is the stage with tolerance 0, which takes the truth method at every choice point. Two errors are measured, both
the mean over the pixels of |luminance - truth| over (truth + 0.01):

- of methods: planned and truth methods with the same samples and seeds, so that most noise is the same in both. What
  remains of it is taken off by a second pair of other seeds: per pixel, the product of both differences has the square
  of the error for its mean.
- of the whole: sampling stops as the tolerance says. The reference's own noise, which its two halves show, is taken off.
"""
import os
import time
from dataclasses import asdict, dataclass

import numpy as np

from patina.chart.sceneMeasures import LUMINANCE
from patina.chart.sceneRenders import StageRenders

COLUMNS = ("stage", "backend", "tolerance", "predicted", "methodError", "methodWithin", "methodSigma", "speedup", "error",
           "within", "noise", "samples", "seconds", "truthSeconds", "bounded", "problem")


@dataclass
class Row:
    stage: str
    backend: str
    tolerance: float
    predicted: float = 0.0      # by the planner, of methods
    methodError: float = 0.0
    methodWithin: bool = False  # at most the tolerance
    methodSigma: float = 0.0    # standard error of methodError
    speedup: float = 0.0        # truth methods over planned ones, same samples
    error: float = 0.0          # with the adaptive stop
    within: bool = False
    noise: float = 0.0          # of the reference, taken off
    samples: float = 0.0        # per pixel, until it stopped
    seconds: float = 0.0
    truthSeconds: float = 0.0   # of as many samples with the truth methods
    bounded: bool = False       # time or samples ended before the tolerance was met, or the reference is too noisy
    problem: str = ""

    def as_dict(self):
        return asdict(self)


def check(path, arguments, backend, tolerances, samples, most, seconds):
    """:param samples: per pixel, of the renders that methods are compared by
    :param most: samples per pixel that the adaptive render takes
    :param seconds: for each render
    :returns: list of Row
    """
    renders = StageRenders(path, arguments)
    name = os.path.splitext(os.path.basename(path))[0]

    def render(seed, tolerance, count, whole, limit=seconds):
        settings = renders.settings(count, seed, tolerance)
        settings["minSamples"] = 16 if whole else count
        settings["seconds"] = limit
        settings["maxDepth"] = -1
        begin = time.perf_counter()
        result = renders.render(backend, settings)
        statistics = renders.renderers[backend].progress()["statistics"]
        return (result.image.astype(np.float64) @ LUMINANCE, statistics.get("predictedError", 0.0), result.samples,
                result.seconds, time.perf_counter() - begin)

    render(0, 0.0, 1, False)  # builds the scene: what follows is timed without that
    seeds = (arguments.seed + 1, arguments.seed + 2)
    truths = [render(seed, 0.0, samples, False) for seed in seeds]
    taken = min(t[2] for t in truths)
    halves = [render(seed + 100, 0.0, most, False, 2.0 * seconds)[0] for seed in seeds]
    reference = (halves[0] + halves[1]) / 2.0
    scale = np.maximum(reference, 0.0) + 0.01
    noise = _mean(np.abs(halves[0] - halves[1]) / 2.0 / scale)
    rows = []
    for tolerance in tolerances:
        row = Row(name, backend, tolerance)
        render(0, tolerance, 1, False)
        planned = [render(seed, tolerance, max(1, int(taken)), False) for seed in seeds]
        row.predicted = planned[0][1]
        row.methodError, row.methodSigma = _common(*[(p[0] - t[0]) / scale for p, t in zip(planned, truths)])
        per_sample = [r[3] / r[2] for r in planned + truths]
        row.speedup = sum(per_sample[2:]) / max(sum(per_sample[:2]), 1e-12)
        whole = render(arguments.seed + 7, tolerance, most, True)
        row.noise, row.samples, row.seconds = noise, whole[2], whole[3]
        row.truthSeconds = whole[2] * sum(per_sample[2:]) / 2.0
        row.error = max(_mean(np.abs(whole[0] - reference) / scale) ** 2 - noise ** 2, 0.0) ** 0.5
        row.bounded = whole[2] >= most or whole[4] >= seconds > 0.0 or noise > tolerance / 2.0
        row.methodWithin = row.methodError - 2.0 * row.methodSigma <= tolerance
        row.within = row.error <= tolerance
        rows.append(row)
    return rows


def _mean(values):
    found = values[np.isfinite(values)]
    return float(found.mean()) if found.size else 0.0


def _common(first, second):
    """Of two differences with noise of their own: the mean size of what they have in common, and its standard error."""
    product = first * second
    product = product[np.isfinite(product)]
    if not product.size:
        return 0.0, 0.0
    common = np.sign(product) * np.sqrt(np.abs(product))
    return max(float(common.mean()), 0.0), float(common.std() / np.sqrt(common.size))


def listing(rows):
    """The rows as text, with the shares within tolerance."""
    lines = [f"{'stage':<18}{'back end':<9}{'tolerance':>9}{'predicted':>10}{'methods':>9}{'':>4}{'whole':>9}{'':>4}"
             f"{'samples':>9}{'seconds':>9}{'of truth':>9}"]
    for row in rows:
        if row.problem:
            lines.append(f"{row.stage:<18}{row.backend:<9}{row.problem}")
            continue
        lines.append(
            f"{row.stage:<18}{row.backend:<9}{row.tolerance:>9g}{row.predicted:>10.2g}{row.methodError:>9.2g}"
            f"{'' if row.methodWithin else '  !':<4}{row.error:>9.2g}"
            f"{'  b' if row.bounded else '' if row.within else '  !':<4}{row.samples:>9.0f}{row.seconds:>9.2f}"
            f"{row.seconds / max(row.truthSeconds, 1e-12):>8.2f}x")
    good = [row for row in rows if not row.problem]
    for tolerance in sorted({row.tolerance for row in good}):
        of = [row for row in good if row.tolerance == tolerance]
        whole = [row for row in of if not row.bounded]
        lines.append(f"tolerance {tolerance:g}: methods within it on {sum(r.methodWithin for r in of)} of {len(of)}; whole error "
                     f"on {sum(r.within for r in whole)} of {len(whole)} that were not bounded by time or samples; truth "
                     f"methods take {np.median([r.speedup for r in of]):.2f} times as long (median)")
    if any(row.bounded for row in rows):
        lines.append("b: bounded: time or samples ended before the tolerance was met, or the reference has more noise than half "
                     "of it")
    return "\n".join(lines)
