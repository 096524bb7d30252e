# SPDX-License-Identifier: Apache-2.0
"""What OpenPBR 1.2 adds to the base: haze, light that goes back to where it came from, and a weight of the emission."""
import numpy as np
import pytest

import _patina


METAL = {"base_metalness": 1.0, "base_color": (0.9, 0.5, 0.2), "specular_roughness": 0.3}
# Rows of directions about the normal z, none at grazing angles.
RANDOM = np.random.default_rng(6).normal(size=(64, 6)).astype(np.float32)
OUT, IN = (RANDOM[:, a:a + 3] for a in (0, 3))
OUT, IN = (np.column_stack([d[:, :2], np.abs(d[:, 2:]) + 0.3]) for d in (OUT, IN))
OUT, IN = (d / np.linalg.norm(d, axis=1, keepdims=True) for d in (OUT, IN))


def probe(**inputs):
    network = _patina.Network("/m")
    network.add_node("/m/s", "ND_open_pbr_surface_surfaceshader")
    for name, value in inputs.items():
        network.set_input("/m/s", name, "color3" if isinstance(value, tuple) else "float", value)
    network.set_terminal("surface", "/m/s")
    return _patina.MaterialProbe(network)


def values(material, out=OUT):
    return material.eval(out, IN)[0]


@pytest.mark.parametrize("base", [METAL, dict(METAL, base_metalness=0.0), dict(METAL, thin_film_weight=1.0)])
def test_haze_is_a_share_of_the_same_lobe_with_more_roughness(base):
    wide = 0.3 + 0.4 * (1.0 - 0.3)
    mixed = values(probe(**base, specular_haze=0.25, specular_haze_spread=0.4))
    expected = 0.75 * values(probe(**base)) + 0.25 * values(probe(**dict(base, specular_roughness=wide)))
    assert np.allclose(mixed, expected, rtol=1e-4)
    assert not np.allclose(mixed, values(probe(**base)), rtol=1e-2)


def test_light_goes_back_as_if_the_view_were_mirrored():
    mirrored = OUT * (-1, -1, 1)
    back = values(probe(**METAL, specular_retroreflectivity=1.0))
    assert np.allclose(back, values(probe(**METAL), mirrored), rtol=1e-4)
    half = values(probe(**METAL, specular_retroreflectivity=0.5))
    assert np.allclose(half, 0.5 * (back + values(probe(**METAL))), rtol=1e-4)


WHITE = {"base_color": (1.0, 1.0, 1.0)}
BACK, FILM = {"specular_retroreflectivity": 0.5}, {"thin_film_weight": 0.5}


@pytest.mark.parametrize("base, more", [
    *((base, more) for base in ({"transmission_weight": 1.0}, WHITE) for more in ({}, BACK, FILM)),
    *((dict(WHITE, base_metalness=1.0), more) for more in ({}, BACK))])  # a film over white metal is not white
def test_white_with_haze_loses_nothing(base, more):
    # Twice the largest error of an albedo from the tables, which is 0.0022, for two of them are mixed.
    material = probe(**base, **more, specular_haze=0.5)
    for cosine in (0.2, 0.6, 1.0):
        assert np.allclose(material.albedo([(np.sqrt(1 - cosine * cosine), 0.0, cosine)]), 1.0, atol=0.0044)


def test_the_emission_has_a_weight_that_is_one_where_it_is_left_out():
    bright = {"emission_luminance": 3.0, "emission_color": (1.0, 0.5, 0.0)}
    for weight, factor in ((None, 1.0), (0.25, 0.25), (0.0, 0.0)):
        emission = probe(**bright, **({} if weight is None else {"emission_weight": weight})).emission([(0.0, 0.0, 1.0)])
        assert np.allclose(emission, factor * np.array((3.0, 1.5, 0.0)), rtol=1e-5)
