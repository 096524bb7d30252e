# SPDX-License-Identifier: Apache-2.0
"""A sequential test of a material's samples: a first look at each graph, that costs little, and more samples only where
a look finds something.

Each look draws samples of three outgoing directions and as many directions of the sphere. At all of them values are finite
and not negative, the density of a sample is that of eval() for its direction, and its weight is f cos / pdf. Two means are
compared:

- of the samples' weights, with albedo(), and with the largest albedo that the graph may have;
- of c / (c + pdf) over samples, with pdf / (c + pdf) over the sphere, where c is the sphere's even density. Both have the
  integral of c pdf / (c + pdf) as mean if samples are drawn with the density that they claim. Both stay below 1, so that no
  narrow lobe spoils them.

The points of a look are REPLICATES copies of one lattice, each shifted at random, so that the error of a mean is known:
Student's t with REPLICATES - 1 degrees of freedom. Looks use other random numbers, so their significances multiply.
"""
import math
from collections import namedtuple

import graphChecks
import numpy as np

REPLICATES = 16
VIEWS = 3
# points: of a replicate. quantile: of Student's t with 15 degrees of freedom, exceeded on either side in `significance` of all
# cases. test_graphLooks.py computes them.
Look = namedtuple("Look", "points quantile significance")
LOOKS = (Look(32, 4.073, 1e-3), Look(128, 4.073, 1e-3), Look(1024, 5.239, 1e-4))
COMPARED = VIEWS * (3 + 3 + 1)  # weights with albedo() and with the bound, by channel, and densities
EVEN = 1.0 / (4.0 * math.pi)
# The largest error of albedo(), as a share of a white lobe's (testLobeAlbedo): no sample is needed to explain it.
# The model's own (Oren and Nayar 1994, eq. 30): A + B / 2 at grazing angles, at most 1.0152 of a white surface, at a roughness
# of 0.2.
OREN_NAYAR = 0.0153
BUDGETS = {"dielectric_bsdf": 0.035, "dielectric_btdf": 0.035, "conductor_bsdf": 0.004,
           "generalized_schlick_bsdf": graphChecks.BUDGET, "sheen_bsdf": 0.005, "chiang_hair_bsdf": 0.005,
           "patina_phong_bsdf": 0.005, "patina_blinn_phong_bsdf": 0.005, "patina_ward_bsdf": 0.02,
           "patina_cook_torrance_bsdf": 3.0 / 64.0, "thin_film_bsdf": 0.05,
           "oren_nayar_diffuse_bsdf": OREN_NAYAR}
FACETS = {"dielectric_bsdf", "dielectric_btdf", "conductor_bsdf"}
BECKMANN, FILM = 0.02, 0.04
# Of the tables of anisotropy (anisotropicAlbedo.glsl): from inside, at grazing angles, an interface is further off.
ANISOTROPIC = {"dielectric_bsdf": 0.08, "dielectric_btdf": 0.08, "generalized_schlick_bsdf": graphChecks.BUDGET,
               "conductor_bsdf": 0.03}
COLOR_MAX = 65504.0  # of a factor (shaders/lib/degenerate.glsl)
JUMPING = {"dielectric_bsdf", "dielectric_btdf"}
TABLED = (0.1, 10.0)  # iors of dielectrics that the tables hold well
ROUNDED = 1e-3
# Beneath a reflecting lobe a transmission is scaled by up to 1 / ALBEDO_MIN = 1000. Where hardly any of it is left, as within
# almost total reflection, that makes all of an albedo of the error of the tables, 1e-4 to 1e-3.
UNKNOWN = 1.0
# How far methods that estimate an albedo are off: the largest errors of Schlick lobes on the grid of guessedAlbedos.py, rounded
# up; a finer grid may find larger ones. Karis's curve knows one roughness alone, and GGX. Samples send back too much where they
# miss brighter facets.
GUESSES = {"karis": 0.55, "monteCarlo16": 0.5}
# Lobes whose values are the same when both directions are exchanged, whatever their inputs.
RECIPROCAL = {"oren_nayar_diffuse_bsdf", "burley_diffuse_bsdf", "translucent_bsdf", "subsurface_bsdf", "patina_lambert_bsdf",
              "patina_phong_bsdf", "patina_blinn_phong_bsdf", "patina_ward_bsdf", "patina_cook_torrance_bsdf"}
UNCOMPENSATED = {"conductor_bsdf"}  # with the method energyCompensation=none


def false_alarms(graphs):
    """:returns: the largest expected number of sound graphs, of so many, that all looks call broken"""
    return graphs * COMPARED * math.prod(look.significance for look in LOOKS)


def _numbers(inputs, name, default):
    """:returns: what is written for an input, None where it is connected"""
    _, source, value = inputs.get(name, ("", "", default))
    return None if source else [float(number) for number in value.split(",")]


def _steep(category, inputs):
    """:returns: whether a reflectance may jump, at a critical angle or beside grazing, where no table follows"""
    if category in ("conductor_bsdf", "patina_cook_torrance_bsdf"):
        n = _numbers(inputs, "ior", "0.183, 0.421, 1.373")
        k = _numbers(inputs, "extinction", "3.424, 2.346, 1.77")
        return n is None or k is None or any(a > 10.0 or b > 10.0 or (a < 1.0 and b < 0.5) for a, b in zip(n, k, strict=True))
    ior = _numbers(inputs, "ior", "1.5")
    return ior is None or not TABLED[0] <= ior[0] <= TABLED[1]


def _hardly_transmits(category, inputs):
    """:returns: whether a lobe that transmits alone may do so but little: steep glass, Schlick's curve from 0.25 on (ior 3)"""
    given = inputs.get("scatter_mode", ("", "", "R"))[2]
    if category == "generalized_schlick_bsdf":
        color = _numbers(inputs, "color0", "1, 1, 1")
        return given == "T" and (color is None or max(color) > 0.25)
    transmits = category == "dielectric_btdf" or (category == "dielectric_bsdf" and given == "T")
    return transmits and _steep(category, inputs)


def flat_curve(nodes):
    """:returns: whether light passes by Schlick's curve of a small exponent p. The share 1 - x^p, about -p ln x, then hangs on
    the last digits of x = 1 - cos: where cos rounds to the float below 1, ln x is off by ln 2 of 16.6"""
    for category, _, _, inputs in nodes:
        exponent = _numbers(inputs, "exponent", "5") if category == "generalized_schlick_bsdf" else [5.0]
        if exponent is None or exponent[0] < 0.1:
            return True
    return False


def budget(nodes):
    """:param nodes: of a graph
    :returns: the error that albedo() may have
    """
    largest = ROUNDED
    layered = any(category == "layer" for category, *_ in nodes)
    for category, _, _, inputs in nodes:
        largest = max(largest, BUDGETS.get(category, 0.0))
        if category in ANISOTROPIC:
            _, source, value = inputs.get("roughness", ("", "", ""))
            along, _, across = value.partition(", ")
            largest = max(largest, ANISOTROPIC[category] if source or along != across else 0.0)
        if category in FACETS or category == "patina_cook_torrance_bsdf":
            largest = max(largest, graphChecks.BUDGET if _steep(category, inputs) else 0.0,
                          BECKMANN if inputs.get("distribution", ("", "", ""))[2] == "beckmann" else 0.0,
                          FILM if "thinfilm_thickness" in inputs else 0.0)
        if layered and _hardly_transmits(category, inputs):
            largest = UNKNOWN
    return largest


def lattice(count, columns):
    """:returns: an additive recurrence of the generalised golden ratio (Roberts 2018)"""
    ratio = 2.0
    for _ in range(40):
        ratio = (1.0 + ratio) ** (1.0 / (columns + 1))
    return np.arange(count)[:, None] * ratio ** -np.arange(1.0, columns + 1.0) % 1.0


# Of seven columns, of which six are used. A ratio near a fraction leaves gaps, where a lobe that is drawn seldom is never
# found: of six columns one is 0.6522, nearly 15 / 23, and leaves a gap 35 times as long as the mean one. Here it is 3.5.
COLUMNS = 6
LATTICES = {look: lattice(look.points, COLUMNS + 1)[:, :COLUMNS] for look in LOOKS}


def views(seed):
    """:returns: outgoing directions of a graph: two above the surface, one below"""
    generator = np.random.default_rng([seed, 77])
    z = generator.uniform(0.05, 1.0, VIEWS) * (1.0, 1.0, -1.0)
    phi = generator.uniform(0.0, 2.0 * math.pi, VIEWS)
    r = np.sqrt(1.0 - z * z)
    return np.column_stack([r * np.cos(phi), r * np.sin(phi), z]).astype(np.float32)


class Drawn:
    """The samples of one look, and values over the sphere."""

    def __init__(self, probe, seed, number):
        look = LOOKS[number]
        generator = np.random.default_rng([seed, number])
        shifts = generator.random((VIEWS, REPLICATES, 1, COLUMNS))
        points = np.minimum((LATTICES[look] + shifts) % 1.0, graphChecks.LAST).astype(np.float32).reshape(-1, COLUMNS)
        self.views, self.u = views(seed), points[:, :4]
        self.wo = np.repeat(self.views, len(points) // VIEWS, axis=0)
        z, phi = 1.0 - 2.0 * points[:, 4], 2.0 * math.pi * points[:, 5]
        r = np.sqrt(1.0 - z * z)
        self.wi = np.column_stack([r * np.cos(phi), r * np.sin(phi), z])
        self.samples = probe.sample(self.wo, self.u)
        self.f, self.pdf = probe.eval(self.wo, self.samples["wi"])
        self.f_around, self.pdf_around = probe.eval(self.wo, self.wi)
        event = self.samples["event"]
        self.spread = (event != 0) & (event & graphChecks.DELTA == 0)

    def means(self, values):
        """:returns: mean over all replicates and its standard error, by outgoing direction"""
        of = np.asarray(values, dtype=np.float64)
        of = of.reshape(VIEWS, REPLICATES, len(of) // (VIEWS * REPLICATES), -1).mean(axis=2)
        return of.mean(axis=1), of.std(axis=1, ddof=1) / math.sqrt(REPLICATES)


def check_exactly(drawn):
    """:returns: what no random number explains"""
    failures = graphChecks.Failures()
    places = {"wo": drawn.wo, "wi": drawn.wi}
    failures.check(graphChecks.rows(graphChecks.bad(drawn.f_around)), "f", places, drawn.f_around)
    failures.check(graphChecks.bad(drawn.pdf_around), "pdf", places, drawn.pdf_around)
    s = drawn.samples
    places = {"wo": drawn.wo, "u": drawn.u}
    failures.check(graphChecks.rows(graphChecks.bad(s["weight"])), "weight of a sample", places, s["weight"])
    failures.check(graphChecks.bad(s["pdf"]), "pdf of a sample", places, s["pdf"])
    failures.check((s["event"] != 0) & ~(s["pdf"] > 0.0), "sample of pdf 0", places, s["pdf"])
    return failures


def check_density(probe, drawn, nodes, bound):
    """A colour is a factor on a reflectance and on its error. Brewster's angle and the critical one lie 5e-5 apart in the
    cosine at an ior of 10, and nearer at higher ones: no float tells between them how much is reflected."""
    jumps = any(category in JUMPING and _steep(category, inputs) for category, _, _, inputs in nodes)
    reflectance = (1.0 if jumps else graphChecks.REFLECTANCE) * min(max(bound, 1.0), COLOR_MAX)
    return graphChecks.same_density(probe, drawn.wo, drawn.u, drawn.samples, drawn.f, drawn.pdf, reflectance)


def check_means(probe, graph, drawn, number, allowed, furnace=True, densities=True):
    """:param allowed: error of albedo(), as budget() has it
    :param furnace: compare weights with albedo()
    :param densities: compare densities with what samples show
    :returns: list of what is further off than the look's significance
    """
    failures = graphChecks.Failures()
    quantile = LOOKS[number].quantile
    albedo = probe.albedo(drawn.views).astype(np.float64)
    mean, error = drawn.means(drawn.samples["weight"])
    bound = graph.bound if np.isfinite(graph.bound) else 1.0
    places = {"wo": drawn.views}
    slack = quantile * error + allowed * np.maximum(np.maximum(1.0, bound), albedo)
    failures.check(graphChecks.rows(mean > graph.bound + slack), f"sampled albedo above {graph.bound:g}", places, mean)
    if furnace and np.isfinite(graph.bound):
        far = mean - albedo if graph.loses else np.abs(mean - albedo)
        failures.check(graphChecks.rows(far > slack), "sampled albedo is not albedo()", places, np.column_stack([mean, albedo]))
    if densities:
        # What reflects nothing may claim a density and draw nothing: no light counts by it.
        dark = np.repeat(drawn.f_around.reshape(VIEWS, -1).max(axis=1) == 0.0, len(drawn.wo) // VIEWS)
        shown = np.where(drawn.spread, EVEN / (EVEN + drawn.pdf), 0.0) - drawn.pdf_around / (EVEN + drawn.pdf_around)
        mean, error = drawn.means(np.where(dark, 0.0, shown))
        failures.check(graphChecks.rows(np.abs(mean) > quantile * error + ROUNDED), "density is not that of samples", places,
                       np.column_stack([mean, error]))
    return failures


def reciprocal(graph, methods):
    """:returns: whether all lobes are reciprocal, and so is what they are put together by"""
    known = RECIPROCAL | (UNCOMPENSATED if methods.get("energyCompensation") == "none" else set())
    return not graph.layered and not graph.loses and not graph.thin and known.issuperset(graph.kinds)


def check_reciprocity(probe, seed, count=48):
    """:returns: list of directions that give other values when exchanged"""
    generator = np.random.default_rng([seed, 78])
    z = generator.uniform(0.02, 1.0, (2, count))
    z[1, ::4] *= -1.0
    phi = generator.uniform(0.0, 2.0 * math.pi, (2, count))
    r = np.sqrt(1.0 - z * z)
    a, b = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1).astype(np.float32)
    (there, pdf), (back, qdf) = probe.eval(a, b), probe.eval(b, a)
    far = np.abs(there - back) > 1e-3 * np.maximum(there, back) + 1e-5
    failures = graphChecks.Failures()
    narrow = np.maximum(pdf, qdf) > graphChecks.NARROW
    failures.check(graphChecks.rows(far) & ~narrow, "not reciprocal", {"wo": a, "wi": b}, np.column_stack([there, back]))
    return failures


def look(probe, graph, seed, number, methods, furnace=True, densities=True):
    """:param number: of the look
    :param methods: that were forced
    :returns: list of what no random number explains, and of what few would
    """
    drawn = Drawn(probe, seed, number)
    found = check_exactly(drawn)
    if densities:
        found += check_density(probe, drawn, graph.nodes, graph.bound)
    if number == 0 and densities and reciprocal(graph, methods):
        found += check_reciprocity(probe, seed)
    if found:
        return found, []
    allowed = max(budget(graph.nodes) if densities else graphChecks.BUDGET,
                  GUESSES.get(methods.get("directionalAlbedo"), 0.0))
    return [], check_means(probe, graph, drawn, number, allowed, furnace, densities)


def check(probe, graph, seed, methods, furnace=True, densities=True):
    """Look after look, until one finds nothing.

    :returns: list of what failed, and how many looks it took
    """
    for number in range(len(LOOKS)):
        exact, doubtful = look(probe, graph, seed, number, methods, furnace, densities)
        if exact or not doubtful:
            return exact, number + 1
    return doubtful, len(LOOKS)
