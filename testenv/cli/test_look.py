# SPDX-License-Identifier: Apache-2.0
"""The colours of charts can be told apart by people of any colour vision, and read, on white and on black."""
import itertools
import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from patina.chart import labels, lobes, look

SCHEMES = {"light": {c: c for c in look.DARK}, "dark": look.DARK}
# Viénot, Brettel and Mollon 1999: what linear RGB looks like without long-wave and without middle-wave cones.
VISIONS = {
    "all cones": np.eye(3),
    "protanopia": [[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]],
    "deuteranopia": [[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]],
}
SEEN = 23.0  # CIE76: ten times what is just noticed side by side (2.3; Mahy et al. 1994), since lines lie apart


def linear(colour):
    v = np.array([int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ np.clip(rgb, 0.0, 1.0)
    t = xyz / np.array([0.9505, 1.0, 1.089])
    f = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def contrast(a, b):
    """WCAG 2.2's ratio."""
    x, y = sorted(float(linear(c) @ [0.2126, 0.7152, 0.0722]) + 0.05 for c in (a, b))
    return y / x


@pytest.mark.parametrize("vision", VISIONS)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_colours_can_be_told_apart(scheme, vision):
    places = {c: lab(np.array(VISIONS[vision]) @ linear(SCHEMES[scheme][c])) for c in look.COLOURS}
    apart = {(a, b): np.linalg.norm(places[a] - places[b]) for a, b in itertools.combinations(places, 2)}
    assert min(apart.values()) > SEEN, min(apart, key=apart.get)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_text_can_be_read(scheme):
    """WCAG 2.2 AA: 4.5 for text, which all colours of lines also are; 3 for the front and the truth beside paper is not asked,
    since names stand beside them."""
    chosen = SCHEMES[scheme]
    assert contrast(chosen[look.INK], chosen[look.PAPER]) >= 7.0
    for colour in (*look.COLOURS, look.DIM):
        assert contrast(chosen[colour], chosen[look.PAPER]) >= 4.5, colour


def test_a_chart_has_all_its_colours_in_both_schemes():
    drawn = lobes.scatter("t", [(1.0, 0.1, "a"), (2.0, 0.01, "b"), (3.0, 0.0, "c")], "y")
    ElementTree.fromstring(drawn)
    assert "prefers-color-scheme:dark" in drawn
    body = drawn.split("</style>")[1]
    used = {c for _, c in re.findall(r'(fill|stroke)="([^"]+)"', body)} - {"none"}
    assert used <= set(look.DARK), used


def test_names_take_free_places():
    places = labels.Places((0, 0, 200, 100))
    places.cover(labels.along([(0, 90), (200, 10)]))
    first = places.place([(100, 50)], 60)
    second = places.place([(100, 50)], 60)
    boxes = [(x - {"start": 0, "middle": 30, "end": 60}[a], y - 9, x + {"start": 60, "middle": 30, "end": 0}[a], y + 2)
             for x, y, a, _ in (first, second)]
    (a, b, c, d), (e, f, g, h) = boxes
    assert c <= e or g <= a or d <= f or h <= b
    for left, top, right, bottom in boxes:
        assert left >= 0 and right <= 200 and top >= 0 and bottom <= 100
    inside = labels.Places((0, 0, 100, 40)).place([(100, 20)], 50)
    assert inside[2] == "end"
