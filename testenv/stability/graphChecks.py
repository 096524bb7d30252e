# SPDX-License-Identifier: Apache-2.0
"""Checks that hold for every material, whatever is in it: numbers at its worst places, from either back end."""
import functools

import numpy as np

COSINES = (1.0, 0.7, 0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0, -1e-7, -1e-3, -0.4, -1.0)
INCOMING = (1.0, 0.6, 1e-1, 1e-3, 1e-6, 1e-8, 0.0, -1e-7, -1e-2, -0.5, -1.0)
LAST = 1.0 - 2.0 ** -24
# The excess over an albedo of 1 that approximations of a lobe may have (testLobeAlbedo): anisotropic tables 0.05; the
# transmission of Schlick curves that no dielectric has, 0.09, from 16 facets; the rest far less.
BUDGET = 0.09
DELTA = 4
SAMPLES = 1024
# The error of a reflectance, which is a float of at most 1. The steepest curve has a slope of 100, so that a cosine that is
# off by its last digit, 2^-24, changes it by 100 of these; what is added up in it is off by a few more.
REFLECTANCE = 2.0 ** -17
NARROW = 3e3  # density above which float directions do not hold a lobe's value to a percent
# What a direction is off by, in each component, once it was turned from a lobe's frame into the world's and back: three
# products and two sums of floats below 1 each way. What is drawn with one density may therefore be evaluated where it is
# another: beyond the horizon, beside the axis of a fibre, on the other side of a critical angle, down a narrow lobe's slope.
TURNED = 2.0 ** -22
NEIGHBOURS = 64


def direction(z, phi):
    s = np.sqrt(max(1.0 - z * z, 0.0))
    return (s * np.cos(phi), s * np.sin(phi), z)


@functools.lru_cache(maxsize=None)
def directions(cosines=COSINES, turns=(0.0, 2.1)):
    return np.array([direction(z, phi) for z in cosines for phi in turns], dtype=np.float32)


@functools.lru_cache(maxsize=None)
def pairs():
    """:returns: outgoing and incoming directions: a grid, and exact opposites"""
    wo = directions()
    wi = directions(INCOMING, (0.0, 3.9))
    a, b = np.repeat(wo, len(wi), axis=0), np.tile(wi, (len(wo), 1))
    return np.concatenate([a, wo, wo]), np.concatenate([b, wo, -wo])


@functools.lru_cache(maxsize=None)
def randoms():
    ends = (0.0, 0.37, LAST)
    return np.array([(x, y, z, w) for x in ends for y in (0.0, 0.61, LAST) for z in (0.0, LAST) for w in (0.0, 0.5, LAST)],
                    dtype=np.float32)


def bad(values):
    return ~(np.isfinite(values) & (values >= 0.0))


class Failures(list):
    """Failures in words; one line per kind of failure, with its first place."""

    def check(self, wrong, what, places, values):
        """:param wrong: a flag per row"""
        wrong = np.asarray(wrong)
        if not wrong.any():
            return
        i = int(np.argmax(wrong))
        place = " ".join(f"{name} ({', '.join(f'{v:.9g}' for v in row[i])})" for name, row in places.items())
        self.append(f"{what}: {np.array2string(np.asarray(values)[i], precision=6)} at {place} ({int(wrong.sum())} of "
                    f"{len(wrong)})")


def rows(flags):
    """One flag per row."""
    return flags if flags.ndim == 1 else flags.any(axis=1)


def check(probe, graph, budget=BUDGET):
    """:param probe: MaterialProbe or RasterProbe
    :param graph: with `bound` of the albedo, as graphText.Graph has it
    :returns: list of what failed, empty when all is well
    """
    bound = graph.bound
    failures = Failures()
    wo, wi = pairs()
    f, pdf = probe.eval(wo, wi)
    failures.check(rows(bad(f)), "f", {"wo": wo, "wi": wi}, f)
    failures.check(bad(pdf), "pdf", {"wo": wo, "wi": wi}, pdf)
    all_wo = directions()
    albedo, emission = probe.albedo(all_wo), probe.emission(all_wo)
    failures.check(rows(bad(albedo)), "albedo", {"wo": all_wo}, albedo)
    failures.check(rows(albedo > bound * (1.0 + budget)), f"albedo above {bound:g}", {"wo": all_wo}, albedo)
    failures.check(rows(bad(emission)), "emission", {"wo": all_wo}, emission)
    _check_samples(probe, failures)
    return failures


@functools.lru_cache(maxsize=None)
def draws():
    """:returns: outgoing directions and random numbers at their ends"""
    u = randoms()
    wo = directions((1.0, 0.5, 1e-2, 1e-4, 1e-8, -1e-7, -0.6))
    return np.repeat(wo, len(u), axis=0), np.tile(u, (len(wo), 1))


def _check_samples(probe, failures):
    wo, u = draws()
    s = probe.sample(wo, u)
    places = {"wo": wo, "u": u}
    failures.check(rows(bad(s["weight"])), "weight of a sample", places, s["weight"])
    failures.check(bad(s["pdf"]), "pdf of a sample", places, s["pdf"])
    drawn = s["event"] != 0
    failures.check(drawn & ~(s["pdf"] > 0.0), "sample of pdf 0", places, s["pdf"])
    length = np.linalg.norm(s["wi"], axis=1)
    failures.check(drawn & ~(np.abs(length - 1.0) < 1e-3), "length of a sample's direction", places, length)


def check_density(probe):
    """The value of sample() is that of eval() for its direction: weight = f cos / pdf.

    :returns: list of what failed
    """
    generator = np.random.default_rng(5)
    wo = np.repeat(directions((0.9, 0.4, 0.1, -0.5), (0.7,)), 64, axis=0)
    u = generator.random((len(wo), 4), dtype=np.float32)
    s = probe.sample(wo, u)
    return same_density(probe, wo, u, s, *probe.eval(wo, s["wi"]))


def _spans(probe, wo, wi, asked):
    """What eval() says of all directions that are `wi` but for their rounding.

    :param asked: a flag per row: the others are left out
    :returns: the lowest and highest f cos, and the lowest and highest pdf, of the rows that are asked for
    """
    count = int(asked.sum())
    steps = np.random.default_rng(6).uniform(-TURNED, TURNED, (count, NEIGHBOURS, 3))
    near = (wi[asked][:, None, :] + steps).astype(np.float32).reshape(-1, 3)
    f, pdf = probe.eval(np.repeat(wo[asked], NEIGHBOURS, axis=0), near)
    value = (f * np.abs(near[:, 2:])).reshape(count, NEIGHBOURS, 3)
    pdf = pdf.reshape(count, NEIGHBOURS)
    return value.min(axis=1), value.max(axis=1), pdf.min(axis=1), pdf.max(axis=1)


def same_density(probe, wo, u, s, f, pdf, reflectance=REFLECTANCE):
    """:param s: samples that were drawn of wo with u
    :param f: value of eval() for their directions
    :param pdf: density of eval() for their directions
    :param reflectance: the error that a reflectance may have
    :returns: list of what failed
    """
    failures = Failures()
    drawn = (s["event"] != 0) & (s["event"] & DELTA == 0) & (np.maximum(s["pdf"], pdf) < NARROW)
    places = {"wo": wo, "wi": s["wi"], "u": u}
    value = f * np.abs(s["wi"][:, 2:])
    expected = s["weight"] * s["pdf"][:, None]
    slack = 1e-5 * (1.0 + value.max(axis=1, keepdims=True)) + reflectance * pdf[:, None]

    def apart(low, high, pdf_low, pdf_high, rows_of=slice(None)):
        e, p = expected[rows_of], s["pdf"][rows_of]
        return (rows((e < 0.98 * low - slack[rows_of]) | (e > 1.02 * high + slack[rows_of])),
                (p < 0.98 * pdf_low - 1e-5) | (p > 1.02 * pdf_high + 1e-5))

    weight_far, pdf_far = apart(value, value, pdf, pdf)
    asked = drawn & (weight_far | pdf_far)
    if asked.any():
        weight_far[asked], pdf_far[asked] = apart(*_spans(probe, wo, s["wi"], asked), asked)
    failures.check(drawn & pdf_far, "pdf of a sample is not that of eval", places, np.column_stack([s["pdf"], pdf]))
    failures.check(drawn & weight_far, "weight of a sample is not f cos / pdf", places, np.column_stack([expected, value]))
    return failures


def furnace(probe, cosine, seed, count=SAMPLES):
    """:returns: mean of the weights of samples, and its standard error (the largest channel's)"""
    generator = np.random.default_rng(seed)
    weight = probe.sample(np.repeat(directions((cosine,), (0.3,)), count, axis=0),
                          generator.random((count, 4), dtype=np.float32))["weight"].astype(np.float64)
    return weight.mean(axis=0), float(weight.std(axis=0).max() / np.sqrt(count))


def check_furnace(probe, graph, budget=BUDGET):
    """The albedo that sampling finds: that of albedo(), and no more than the bound.

    :returns: list of what failed; five standard errors: p < 1e-6 for each comparison
    """
    failures = Failures()
    for cosine in (0.9, 0.3, -0.6):
        wo = directions((cosine,), (0.3,))
        mean, error = furnace(probe, cosine, 11)
        albedo = probe.albedo(wo)[0]
        place = {"wo": wo}
        highest = max(1.0, float(albedo.max()), graph.bound if np.isfinite(graph.bound) else 1.0)
        slack = 5.0 * error + budget * highest
        failures.check([(mean > graph.bound + slack).any()], f"sampled albedo above {graph.bound:g}", place, [mean])
        if graph.ward or not np.isfinite(graph.bound):  # a tint of 65504 makes much of the last digit
            continue
        apart = mean - albedo
        far = apart > slack if graph.loses else np.abs(apart) > slack
        failures.check([far.any()], "sampled albedo is not albedo()", place, [np.append(mean, albedo)])
    return failures


# Of a jump in a direction; and of one in the cosine of a facet that glass of ior 6 was passed by, which floats tell apart
# from 1 where the facet is 2.4e-4 from its normal: a direction moves five times as far. This is more than twice that.
BESIDE = (1e-6, 3e-3)


def _beside(directions, step):
    """:returns: directions a step away: a value that jumps at one, as a curve of exponent 1e-8 does where a facet is
    met along its normal, may be taken from either side of it by two orders of rounding, and not beside it"""
    turned = directions.astype(np.float64) + step * (np.roll(directions, 1, axis=1) + 0.3)
    return (turned / np.linalg.norm(turned, axis=1, keepdims=True)).astype(np.float32)


def compare(probe, other, relative=5e-3):
    """Both back ends compute the same.

    :param other: a RasterProbe of the material of `probe`
    :param relative: difference that is accepted
    :returns: list of what differs
    """
    def _apart(a, b):  # beyond what two orders of rounding explain
        return ~(np.abs(a - b) <= relative * np.maximum(np.abs(a), np.abs(b)) + 2e-4)

    failures = Failures()
    wo, wi = pairs()

    def differences(wo, wi):
        (f, pdf), (g, qdf) = probe.eval(wo, wi), other.eval(wo, wi)
        both, cosine = np.maximum(pdf, qdf) < NARROW, np.abs(wi[:, 2:])
        return (both & rows(_apart(f * cosine, g * cosine)), both & _apart(pdf, qdf), np.column_stack([f, g]),
                np.column_stack([pdf, qdf]))

    f_apart, pdf_apart, f, pdf = differences(wo, wi)
    for step in BESIDE:
        if (f_apart | pdf_apart).any():
            f_beside, pdf_beside, *_ = differences(wo, _beside(wi, step))
            f_apart, pdf_apart = f_apart & f_beside, pdf_apart & pdf_beside
    places = {"wo": wo, "wi": wi}
    failures.check(f_apart, "f cos differs", places, f)
    failures.check(pdf_apart, "pdf differs", places, pdf)
    all_wo = directions()
    for name in ("albedo", "emission"):
        a, b = getattr(probe, name)(all_wo), getattr(other, name)(all_wo)
        failures.check(rows(_apart(a, b)), f"{name} differs", {"wo": all_wo}, np.column_stack([a, b]))
    generator = np.random.default_rng(9)
    wo = np.repeat(directions((0.9, 0.4, 0.1, -0.5), (0.7,)), 64, axis=0)
    u = generator.random((len(wo), 4), dtype=np.float32)
    s, t = probe.sample(wo, u), other.sample(wo, u)
    apart = rows(_apart(s["weight"], t["weight"])) | (s["event"] != t["event"]) | rows(np.abs(s["wi"] - t["wi"]) > 3e-3)
    # A choice may fall the other way where the random number is on the border, one sample in a hundred at most.
    if apart.mean() > 0.01:
        failures.check(apart, "sample differs", {"wo": wo, "u": u},
                       np.column_stack([s["weight"], t["weight"], s["wi"], t["wi"]]))
    return failures
