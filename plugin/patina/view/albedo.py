# SPDX-License-Identifier: Apache-2.0
"""The albedo tables as a texture of half floats, with zeros for what no lobe of the page reads."""
import numpy as np

from patina.cli.compiled import _patina
from patina.view import blobs

WIDTH = 1024
MICROFACETS = ("conductor", "dielectric", "schlick")


def texture(lobes):
    """
    :param lobes: the `lobes` of every material of the page
    :returns: dict of height and data
    """
    table = np.array(_patina.albedo_table())
    used = {(words[0], words[3]) for words in (lobe.split() for lobe in lobes)}
    size = _patina.ALBEDO_MICROFACET_SIZE
    for ndf in (0, 1):
        if not any(kind in MICROFACETS and distribution == str(ndf) for kind, distribution in used):
            table[ndf * size:(ndf + 1) * size] = 0.0
    if not any(kind == "ward" for kind, _ in used):
        table[_patina.ALBEDO_WARD_TABLE:] = 0.0
    rows = in_rows(table)
    return {"width": WIDTH, "height": len(rows), "data": blobs.pack_smooth(blobs.half(rows.ravel()))}


def in_rows(table):
    """:returns: a table as the rows of an image that is WIDTH wide, with zeros behind it"""
    rows = np.zeros((-(-len(table) // WIDTH), WIDTH), np.float32)
    rows.flat[:len(table)] = table
    return rows
