# SPDX-License-Identifier: Apache-2.0
"""The pages of docs/generated say what the code says now."""
import pytest

import generateDocs


@pytest.mark.parametrize("page", generateDocs.PAGES)
def test_is_not_stale(page):
    if page in ("methods",):
        pytest.importorskip("_patina")
    assert not generateDocs.is_stale(page), "./patina python testenv/generateDocs.py writes it anew"


def test_every_row_of_nodes_is_understood():
    with pytest.raises(ValueError):
        generateDocs.categories('const NodeRow rows[] = {\n    UNKNOWN("a"),\n};')
    assert generateDocs.categories('const NodeRow rows[] = {\n    {"ND_a_$", "a", "$ in=0, $ x=1", "$", f}, {"ND_b", "b", "",'
                                   ' "$"}, // of b\n};') == ["a", "b"]
