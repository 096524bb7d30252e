# SPDX-License-Identifier: Apache-2.0
"""The sequential test of random graphs: its significance, and which defects it finds with which probability."""
import math

import numpy as np
import pytest

import _patina
import graphChecks
import graphLooks
import graphShrink
import graphText
import guessedAlbedos
import plantedDefects
import randomGraphs


def tail(t, degrees):
    """:returns: how often Student's t is further from 0 than `t`, on either side; by the midpoint rule"""
    s = (np.arange(20000) + 0.5) / 20000
    x = t + s / (1.0 - s)
    scale = math.gamma(0.5 * (degrees + 1)) / (math.sqrt(degrees * math.pi) * math.gamma(0.5 * degrees))
    return 2.0 * scale * float(((1.0 + x * x / degrees) ** (-0.5 * (degrees + 1)) / (1.0 - s) ** 2).mean())


def test_quantiles_have_their_significance():
    for look in graphLooks.LOOKS:
        assert tail(look.quantile, graphLooks.REPLICATES - 1) == pytest.approx(look.significance, rel=2e-3)


def test_a_million_sound_graphs_are_hardly_ever_called_broken():
    assert graphLooks.false_alarms(1000000) <= 0.0021


@pytest.mark.parametrize("method", graphLooks.GUESSES)
def test_estimated_albedos_are_as_far_off_as_the_looks_allow(method):
    error, *place = guessedAlbedos.largest(_patina, method)
    assert graphLooks.GUESSES[method] - 0.01 < error <= graphLooks.GUESSES[method], place


@pytest.fixture(scope="module")
def graphs():
    """Graphs whose albedo is known well, with normals as they are: what is planted in them is all that is wrong."""
    return [(graph, probe) for graph, probe in plantedDefects.sound(_patina, range(400000, 400160))
            if graphLooks.budget(graph.nodes) <= 0.005 and not graph.loses and graph.bound <= 1.0]


@pytest.mark.parametrize("name", ["albedo() 5 % too high", "density of eval() 5 % too high", "both densities 5 % too high",
                                  "both densities 20 % too high", "values below 0 in 1 % of the sphere",
                                  "values below 0 in 0.2 % of the sphere"])
def test_planted_defects_are_found(graphs, name):
    """With the power that studies are customarily planned for; docs/design/charts.md has what is measured."""
    assert plantedDefects.power(graphs, **plantedDefects.DEFECTS[name]) >= 0.8


def test_nothing_is_found_in_sound_graphs(graphs):
    assert plantedDefects.power(graphs) == 0.0


@pytest.mark.parametrize("first", range(500000, 500100, 50))
def test_random_graphs_by_looks(first):
    found, looks = randomGraphs.of_processor(first, 50)
    assert [str(finding) for finding in found] == []
    assert looks[1] >= 45  # most graphs need a first look only


def white(category, **inputs):
    nodes = [(category, "BSDF", "a", {"color": ("color3", "", "1, 1, 1"), **inputs}),
             ("surface", "surfaceshader", "b", {"bsdf": ("BSDF", "a", "")}),
             ("surfacematerial", "material", "c", {"surfaceshader": ("surfaceshader", "b", "")})]
    return nodes, _patina.MaterialProbe(randomGraphs.networks(_patina, nodes)[0])


def test_only_reciprocal_lobes_pass_for_reciprocal():
    assert graphLooks.check_reciprocity(white("burley_diffuse_bsdf")[1], 3) == []
    assert "not reciprocal" in graphLooks.check_reciprocity(white("sheen_bsdf", mode=("string", "", "zeltner"))[1], 3)[0]


def test_a_graph_shrinks_to_what_fails():
    graph = next(graph for graph in map(graphText.Graph, range(500)) if "patina_ward_bsdf" in graph.kinds and
                 len(graph.nodes) > 8)
    smallest = graphShrink.smallest(graph.nodes, lambda nodes: any(node[0] == "patina_ward_bsdf" for node in nodes))
    assert [node[0] for node in smallest] == ["patina_ward_bsdf", "surface", "surfacematerial"]
    assert smallest[0][3] == {}
    assert graphShrink.fewest({"thinFilm": "table", "sheen": "table"}, lambda methods: "sheen" in methods) == {"sheen": "table"}


def test_variants_differ_in_numbers_alone():
    first, second = graphText.Graph(11), graphText.Graph(11, variant=1)
    assert first.text() != second.text()

    def shape(graph):
        return [(node[0], sorted((key, kind, source) for key, (kind, source, _) in node[3].items())) for node in graph.nodes]

    assert shape(first) == shape(second)
    assert graphText.Graph(11, variant=1).text() == second.text()


def test_one_document_holds_many_graphs():
    graphs = [graphText.Graph(seed, prefix=f"g{seed}") for seed in range(20)]
    together = randomGraphs.networks(_patina, [node for graph in graphs for node in graph.nodes])
    wo, wi = graphChecks.pairs()
    for graph, network in zip(graphs, together, strict=True):
        assert network.path.endswith(f"graph{graph.seed}")
        alone = randomGraphs.load(_patina, graphText.Graph(graph.seed).text())
        assert np.array_equal(_patina.MaterialProbe(network).eval(wo, wi)[0], _patina.MaterialProbe(alone).eval(wo, wi)[0])


def test_graphs_that_differ_in_numbers_share_a_shader():
    graphs = [graphText.Graph(*seed, prefix=f"v{i}") for i, seed in enumerate([(16,), (16, 1), (4,)])]
    networks = randomGraphs.networks(_patina, [node for graph in graphs for node in graph.nodes])
    try:
        first = _patina.RasterProbe(networks[0])
    except (AttributeError, RuntimeError) as error:
        pytest.skip(str(error))
    second, third = (_patina.RasterProbe(network, {}, [first]) for network in networks[1:])
    assert (first.shares_shader, second.shares_shader, third.shares_shader) == (False, True, False)
    del first
    wo, wi = graphChecks.pairs()
    for probe, network in ((second, networks[1]), (third, networks[2])):
        assert np.array_equal(probe.eval(wo, wi)[0], _patina.RasterProbe(network).eval(wo, wi)[0], equal_nan=True)
