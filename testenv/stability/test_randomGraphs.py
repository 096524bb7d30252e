# SPDX-License-Identifier: Apache-2.0
"""Random legal graphs, and those that failed once: no crash, finite, not negative, no energy gained, both back ends equal.

More of them: ./patina python testenv/stability/randomGraphs.py --seed N --count M --keep FOLDER
"""
import os
import types

import numpy as np
import pytest

import _patina
import graphChecks
import graphText
import kept
import randomGraphs
import keptFindings

COUNT = 100
WALKED = 60
WALKS = {"energyCompensation": "randomWalk", "layering": "positionFree"}
ON_THE_DRIVER = (4, 16, 33)  # seeds; a driver in software takes seconds to compile each
# Random walks have a test of their own.
POINTS = [(point, [m for m in names if m[0] not in randomGraphs.WALKS]) for point, names in _patina.choice_points()]


def without_opengl():
    try:
        _patina.RasterProbe(randomGraphs.load(_patina, graphText.Graph(ON_THE_DRIVER[0]).text()))
    except (AttributeError, RuntimeError) as error:
        return str(error)
    return ""


@pytest.mark.parametrize("first", range(1, COUNT + 1, 20))
def test_random_graphs(first):
    found = {}
    for seed in range(first, first + 20):
        graph = graphText.Graph(seed)
        network = randomGraphs.load(_patina, graph.text())
        methods = graphText.methods(seed, POINTS)
        graph.expect(methods)
        failed = randomGraphs.failures(_patina, network, graph, methods)
        if failed:
            found[seed] = failed
    assert found == {}


@pytest.mark.parametrize("first", range(1, WALKED + 1, 30))
def test_random_graphs_by_random_walks(first):
    found, walking = {}, 0
    for seed in range(first, first + 30):
        graph = graphText.Graph(seed)
        network = randomGraphs.load(_patina, graph.text())
        failed = randomGraphs.failures(_patina, network, graph, WALKS)
        if failed:
            found[seed] = failed
        wo, wi = graphChecks.pairs()
        by_formula, by_walk = (_patina.MaterialProbe(network, methods).eval(wo, wi)[0] for methods in ({}, WALKS))
        walking += not np.array_equal(by_formula, by_walk)
    assert found == {}
    assert walking >= 5


@pytest.mark.parametrize("seed", ON_THE_DRIVER)
def test_both_back_ends(seed):
    reason = without_opengl()
    if reason:
        pytest.skip(reason)
    graph = graphText.Graph(seed)
    assert randomGraphs.failures(_patina, randomGraphs.load(_patina, graph.text()), graph, {}, raster=True) == []


@pytest.mark.parametrize("path", keptFindings.corpus("randomGraphs"), ids=os.path.basename)
def test_corpus(path):
    text, expected, methods = kept.read(path)
    raster = getattr(expected, "raster", False) and not without_opengl()
    assert randomGraphs.failures(_patina, randomGraphs.load(_patina, text), expected, methods, raster) == []


@pytest.mark.parametrize("path", keptFindings.corpus("randomGraphs"), ids=os.path.basename)
def test_corpus_by_looks(path):
    text, expected, methods = kept.read(path)
    assert randomGraphs.look(_patina, randomGraphs.load(_patina, text), expected, methods)[0] == []


def test_a_seed_is_a_text_for_ever():
    assert graphText.Graph(7).text() == graphText.Graph(7).text()
    assert len({graphText.Graph(seed).text() for seed in range(40)}) == 40
    kinds = {kind for seed in range(400) for kind in graphText.Graph(seed).kinds}
    assert kinds == {*graphText.BSDFS, *graphText.EDFS, *graphText.VDFS, *graphText.MORE}


def test_every_closure_is_tried():
    """A leaf of the table that random graphs do not know would never be tried; a measured one needs a file."""
    found = [_patina.node_definition(identity) for identity in _patina.node_ids()]
    leaves = {node["category"] for node in found if node["outputs"] and node["outputs"][0][1] in ("BSDF", "EDF", "VDF")
              and not any(kind in ("BSDF", "EDF", "VDF") for _, kind in node["inputs"]) and node["id"].startswith("ND_")}
    known = {*graphText.BSDFS, *graphText.EDFS, *graphText.VDFS, *graphText.MORE, "measured_edf"}
    assert {name for name in leaves if not name.startswith("Lama")} <= known

def test_kept_graphs_come_back(tmp_path):
    graph = graphText.Graph(5)
    (tmp_path / "a.mtlx").write_text(kept.noted(graph.text(), graph, {"thinFilm": "table"}, ["f: nan -- at x"]))
    text, expected, methods = kept.read(tmp_path / "a.mtlx")
    assert (expected.bound, expected.loses, expected.thin, methods) == (graph.bound, graph.loses, graph.thin,
                                                                        {"thinFilm": "table"})
    assert randomGraphs.load(_patina, text).path.endswith("graph5")


class Broken:
    """Lambert's lobe with one thing wrong."""

    def __init__(self, wrong):
        self.wrong = wrong

    def eval(self, wo, wi):
        f = np.where((wo[:, 2:] >= 0) & (wi[:, 2:] > 0), 0.5 / np.pi, 0.0) * np.ones((1, 3))
        if self.wrong == "nan":
            f[17, 1] = np.nan
        return f, np.maximum(wi[:, 2], 0.0) / np.pi * (0.5 if self.wrong == "density" else 1.0)

    def sample(self, wo, u):
        z, phi = np.sqrt(1.0 - u[:, 0]), 2.0 * np.pi * u[:, 1]
        s = np.sqrt(1.0 - z * z)
        weight = np.full((len(wo), 3), 1.4 if self.wrong == "gain" else -0.5 if self.wrong == "negative" else 0.5)
        weight[wo[:, 2] < 0] = 0.0
        return {"wi": np.column_stack([s * np.cos(phi), s * np.sin(phi), z]), "weight": weight, "pdf": z / np.pi + 1e-9,
                "event": np.full(len(wo), 1)}

    def albedo(self, wo):
        return np.where(wo[:, 2:] >= 0, 2.0 if self.wrong == "albedo" else 0.5, 0.0) * np.ones((1, 3))

    def emission(self, wo):
        return np.zeros((len(wo), 3))


@pytest.mark.parametrize("wrong, words", [("", ""), ("nan", "f:"), ("gain", "sampled albedo above 1"),
                                          ("albedo", "albedo above 1"),
                                          ("negative", "weight of a sample"), ("density", "pdf of a sample is not")])
def test_what_is_wrong_is_found(wrong, words):
    graph = types.SimpleNamespace(bound=1.0, loses=False, thin=False, ward=False)
    probe = Broken(wrong)
    found = [*graphChecks.check(probe, graph), *graphChecks.check_density(probe), *graphChecks.check_furnace(probe, graph)]
    assert any(words in line for line in found) if words else not found


class Jumps(Broken):
    """A lobe with another value where light comes along one of the directions that are looked at."""

    def __init__(self, on):
        super().__init__("")
        self.on = np.array(on, np.float32)

    def eval(self, wo, wi):
        f, pdf = super().eval(wo, wi)
        return np.where((wi == self.on).all(axis=1)[:, None] & (wo[:, 2:] >= 0), 7.0, f), pdf


class Rounds(Broken):
    """Samples of a lobe that is dark from some z on."""

    def __init__(self, border):
        super().__init__("")
        self.border = border

    def eval(self, wo, wi):
        f, pdf = super().eval(wo, wi)
        return np.where(wi[:, 2:] > self.border, f, 0.0), pdf

    def sample(self, wo, u):
        s = super().sample(wo, u)
        s["wi"][:, 2] = self.border + 3e-8
        s["pdf"] = np.full(len(wo), self.border / np.pi)
        s["weight"] = np.where(wo[:, 2:] >= 0, 0.5, 0.0) * np.ones((1, 3))
        return {**s, "wi": s["wi"].astype(np.float32)}


def test_values_may_jump_where_directions_round():
    assert graphChecks.check_density(Rounds(0.5)) == []
    wo, u = np.repeat(graphChecks.directions((0.9,), (0.7,)), 8, axis=0), np.full((8, 4), 0.4, np.float32)
    s = Rounds(0.5).sample(wo, u)
    s["wi"][:, 2] += 1e-5
    found = graphChecks.same_density(Rounds(0.6), wo, u, s, *Rounds(0.6).eval(wo, s["wi"]))
    assert "weight of a sample is not f cos / pdf" in found[0]


def test_a_constant_that_is_no_number_passes_for_no_other():
    """A tangent of NaN is that of the point, as none is, and not the normal."""
    text = kept.read(os.path.join(keptFindings.folder("randomGraphs"), "constantNotANumber.mtlx"))[0]
    bare = text.replace('<input name="tangent" type="vector3" nodename="n1"/>', "")
    assert bare != text
    wo, u = graphChecks.draws()
    samples = [_patina.MaterialProbe(randomGraphs.load(_patina, document)).sample(wo, u) for document in (text, bare)]
    assert np.array_equal(samples[0]["wi"], samples[1]["wi"])


def test_back_ends_that_differ_are_found_but_at_a_jump():
    assert graphChecks.compare(Broken(""), Broken("")) == []
    assert any("pdf differs" in line for line in graphChecks.compare(Broken(""), Broken("density")))
    assert any("albedo differs" in line for line in graphChecks.compare(Broken(""), Broken("albedo")))
    assert graphChecks.compare(Broken(""), Jumps(graphChecks.directions(graphChecks.INCOMING, (0.0, 3.9))[2])) == []
