# SPDX-License-Identifier: Apache-2.0
"""Whether the planner keeps its word: the error that a tolerance makes on a stage, against what was predicted.

The truth is the stage with tolerance 0, which takes the truth method at every choice point. Two errors are measured, both
the mean over the pixels of |luminance - truth| over (truth + 0.01):

- of methods: planned and truth methods with the same samples and seeds, so that most noise is the same in both. The
  rest of it is taken off by a second pair of other seeds: per pixel, the product of both differences has the square
  of the error for its mean.
- of the whole, in the mean over several seeds where there are few pixels: sampling stops as the tolerance says. The
  reference's own noise, which its two halves show, is taken off.

Times are of processors, so that what else the machine does has no part in them.
"""
import time
from dataclasses import dataclass, fields

import numpy as np

from patina.experiment import LUMINANCE, read_csv
from patina.chart.sceneRenders import StageRenders

COLUMNS = ("stage", "backend", "tolerance", "predicted", "methodError", "methodWithin", "methodSigma", "speedup",
           "defaultSpeedup", "defaultError", "error", "state", "noise", "samples", "width", "height", "seconds",
           "truthSeconds", "problem")

# The ways a tolerance may end. Only the first is a promise kept; of the last two nothing can be said.
WITHIN, OUTSIDE, SAMPLES, SECONDS, REFERENCE = "within", "outside", "samples ended", "seconds ended", "reference noisy"

# The error of a few pixels is a matter of chance: several such pictures, with seeds of their own, stand for a larger one.
MIN_PIXELS, MAX_REPEATS = 64, 4


@dataclass
class Row:
    stage: str
    backend: str
    tolerance: float
    predicted: float = 0.0       # by the planner, of methods
    methodError: float = 0.0
    methodWithin: bool = False   # at most the tolerance
    methodSigma: float = 0.0     # standard error of methodError
    speedup: float = 0.0         # truth methods over planned ones, same samples
    defaultSpeedup: float = 0.0  # default methods over planned ones, same samples
    defaultError: float = 0.0    # of the default methods, as methodError
    error: float = 0.0           # with the adaptive stop
    state: str = ""
    noise: float = 0.0           # of the reference, taken off
    samples: float = 0.0         # per pixel, until it stopped
    width: int = 0
    height: int = 0
    seconds: float = 0.0
    truthSeconds: float = 0.0    # of as many samples with the truth methods
    problem: str = ""


def check(path, name, arguments, backend, tolerances, samples, maximum, seconds):
    """:param name: of the stage, for its rows
    :param samples: per pixel, of the renders that methods are compared by
    :param maximum: samples per pixel that the adaptive render takes
    :param seconds: for each render; twice that for the reference
    :returns: iterator of Row, one for each tolerance
    """
    renders = StageRenders(path, arguments)

    def render(seed, tolerance, count, whole=False, limit=seconds):
        settings = renders.settings(count, seed, tolerance)
        settings["minSamples"] = 16 if whole else count
        settings["seconds"] = limit
        settings["maxDepth"] = -1
        begin = time.perf_counter()
        result = renders.render(backend, settings)
        return _Image(result, renders.renderers[backend].progress()["statistics"], time.perf_counter() - begin)

    render(0, 0.0, 1)  # builds the scene: what follows is timed without that
    seeds = (arguments.seed + 1, arguments.seed + 2)
    truths = [render(seed, 0.0, samples) for seed in seeds]
    taken = max(1, int(min(t.samples for t in truths)))
    render(0, None, 1)
    defaults = [render(seed, None, taken) for seed in seeds]
    repeats = min(-(-MIN_PIXELS // (renders.width * renders.height)), MAX_REPEATS)
    every = {t: [render(arguments.seed + 7 + k, t, maximum, True) for k in range(repeats)] for t in tolerances}
    minimum = 2.0 * max(w.maximum for wholes in every.values() for w in wholes)
    reference, noise = _reference(render, arguments.seed + 100, samples, min(tolerances), seconds, minimum)
    scale = np.maximum(reference, 0.0) + 0.01
    for tolerance in tolerances:
        row = Row(name, backend, tolerance, width=renders.width, height=renders.height)
        render(0, tolerance, 1)
        planned = [render(seed, tolerance, taken) for seed in seeds]
        row.predicted = planned[0].predicted
        row.methodError, row.methodSigma = _common(*[(p.image - t.image) / scale for p, t in zip(planned, truths)])
        row.methodWithin = row.methodError - 2.0 * row.methodSigma <= tolerance
        row.defaultError = _common(*[(d.image - t.image) / scale for d, t in zip(defaults, truths)])[0]
        own, truth, default = (sum(r.perSample for r in of) / len(of) for of in (planned, truths, defaults))
        row.speedup, row.defaultSpeedup = truth / max(own, 1e-12), default / max(own, 1e-12)
        wholes = every[tolerance]
        row.noise, row.samples = noise, sum(w.samples for w in wholes) / repeats
        row.seconds, row.truthSeconds = sum(w.samples * w.perSample for w in wholes) / repeats, row.samples * truth
        row.error = max(_mean([np.abs(w.image - reference) / scale for w in wholes]) ** 2 - noise**2, 0.0) ** 0.5
        if any(w.wall >= seconds > 0.0 for w in wholes):
            row.state = SECONDS
        elif any(w.maximum >= maximum for w in wholes):
            row.state = SAMPLES
        elif noise > tolerance / 2.0:
            row.state = REFERENCE
        else:
            row.state = WITHIN if row.error <= tolerance else OUTSIDE
        yield row


class _Image:
    def __init__(self, result, statistics, wall):
        self.image = result.image.astype(np.float64) @ LUMINANCE
        self.predicted = statistics.get("predictedError", 0.0)
        self.samples, self.maximum, self.wall = result.samples, result.maximum, wall
        self.perSample = result.seconds * result.busy / max(result.samples, 1e-9)


def _reference(render, seed, samples, tolerance, seconds, minimum):
    """The mean of truths, more and more samples of them, until noise takes less than half of the tolerance or time is over.

    :param minimum: samples per pixel that it has in any case, for of light that neither half has found none is missed
    :returns: it and its noise, the mean over the pixels relative to it
    """
    sums, counts, spent, noise, image = [0.0, 0.0], [0.0, 0.0], 0.0, 1.0, None
    while True:
        for k in range(2):
            found = render(seed + k, 0.0, samples, limit=max(seconds, 0.01) if seconds else 0.0)
            sums[k] = sums[k] + found.image * found.samples
            counts[k] += found.samples
            spent += found.wall
        halves = [s / c for s, c in zip(sums, counts)]
        image = (halves[0] + halves[1]) / 2.0
        noise = _mean(np.abs(halves[0] - halves[1]) / 2.0 / (np.maximum(image, 0.0) + 0.01))
        enough = noise <= tolerance / 2.2 and sum(counts) >= minimum
        if enough or (seconds and spent >= 2.0 * seconds) or counts[0] >= 1e8:
            return image, noise
        # Doubled at least; at most what noise and time ask for.
        factor = min(max((2.2 * noise / tolerance) ** 2 - 1.0, minimum / sum(counts) - 1.0, 0.1), 3.0)
        if seconds:
            factor = min(factor, max(2.0 * seconds / spent - 1.0, 0.1) * 1.1)
        seed, samples = seed + 2, max(1, int(counts[0] * factor))


def _mean(values):
    values = np.asarray(values)
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
    lines = [f"{'stage':<20}{'back end':<9}{'tolerance':>9}{'predicted':>10}{'methods':>9}{'':>4}{'whole':>9}  {'':<16}"
             f"{'samples':>9}{'seconds':>9}{'of truth':>9}{'of default':>11}"]
    for row in rows:
        if row.problem:
            lines.append(f"{row.stage:<20}{row.backend:<9}{row.problem}")
            continue
        lines.append(
            f"{row.stage:<20}{row.backend:<9}{row.tolerance:>9g}{row.predicted:>10.2g}{row.methodError:>9.2g}"
            f"{'' if row.methodWithin else '  !':<4}{row.error:>9.2g}  {row.state:<16}{row.samples:>9.0f}{row.seconds:>9.2f}"
            f"{1.0 / max(row.speedup, 1e-12):>8.2f}x{1.0 / max(row.defaultSpeedup, 1e-12):>10.2f}x")
    return "\n".join(lines + [summary(rows)])


def read(path):
    """:returns: the rows of a predictions.csv"""
    kinds = {"float": float, "int": int, "bool": lambda text: text == "True", "str": str}
    return [Row(**{f.name: kinds[getattr(f.type, "__name__", f.type)](row[f.name]) for f in fields(Row)})
            for row in read_csv(path)]


def summary(rows):
    """In words, for each tolerance: on how many stages it held, and what time was saved."""
    good, lines = [row for row in rows if not row.problem], []
    for tolerance in sorted({row.tolerance for row in good}):
        of = [row for row in good if row.tolerance == tolerance]
        said = [row for row in of if row.state in (WITHIN, OUTSIDE, SAMPLES)]
        lines.append(f"tolerance {tolerance:g}: methods within it on {sum(r.methodWithin for r in of)} of {len(of)}; whole "
                     f"error within it on {sum(r.state == WITHIN for r in said)} of {len(said)}"
                     + (f" ({len(of) - len(said)} more ended by time)" if len(of) > len(said) else "")
                     + f"; median time of a sample {np.median([1.0 / max(r.speedup, 1e-12) for r in of]):.2f}x of the truth's, "
                     f"{np.median([1.0 / max(r.defaultSpeedup, 1e-12) for r in of]):.2f}x of the default's")
    return "\n".join(lines)
