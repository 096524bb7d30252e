# SPDX-License-Identifier: Apache-2.0
"""What is bound beside a binding that names no collection, at which pxr raises: the same as without it."""
import random

import pytest
from pxr import Sdf, Usd

from patina.stage.boundMaterials import BoundMaterials
from patina.stage.collectionBindings import CollectionBindings

PRIMS, NAMED = ("/g", "/g/h", "/g/h/s"), ("/g", "/g/h", "/g/h/s", "/none")
MATERIALS, STRENGTHS = ("red", "green", "none"), ("", "", '(bindMaterialAs = "strongerThanDescendants")')
APIS = ", ".join(f'"{api}"' for api in ("MaterialBindingAPI", *(f"CollectionAPI:k{k}" for k in range(3))))
BROKEN = "".join(f"rel material:binding:collection:{purpose}b = [</g.nothing>, </red>]\n" for purpose in ("", "full:"))


def bindings(chance, path):
    """Yields statements of a prim that binds by collections and directly."""
    for k in range(3):
        yield f"rel collection:k{k}:includes = [{', '.join(f'<{at}>' for at in chance.sample(NAMED, chance.randint(0, 2)))}]"
        yield from [f"rel collection:k{k}:excludes = <{chance.choice(NAMED)}>"] * chance.randint(0, 1)
        names = [f"collection:{chance.choice(['', 'full:'])}k{k}"] * chance.randint(0, 1)
        yield from (f"rel material:binding:{name} = [<{path}.collection:k{k}>, </{chance.choice(MATERIALS)}>] "
                    f"{chance.choice(STRENGTHS)}" for name in names)
    for purpose in chance.sample(["", ":full"], chance.randint(0, 2)):
        yield f"rel material:binding{purpose} = </{chance.choice(MATERIALS)}> {chance.choice(STRENGTHS)}"


def bound(text, purpose):
    """:returns: list of (path of material, path of its binding) of the prims"""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString("#usda 1.0\n" + text)
    stage = Usd.Stage.Open(layer)
    found = BoundMaterials(CollectionBindings(stage), lambda *_: None).of(list(map(stage.GetPrimAtPath, PRIMS)), purpose)
    return [(str(material.GetPath()), str(rel.GetPath())) if material else None for material, rel in found]


@pytest.mark.parametrize("purpose", ["full", ""])
def test_a_broken_binding_counts_for_nothing(purpose):
    chance, all_bound = random.Random(1), set()
    for _ in range(100):
        text = "".join(f'def Material "{name}" {{\n}}\n' for name in MATERIALS[:2])
        for path in PRIMS:
            own = "\n".join(bindings(chance, path))
            text += f'def Xform "{path.rpartition("/")[2]}" (prepend apiSchemas = [{APIS}]) {{\nBROKEN{own}\n'
        text += "}\n" * len(PRIMS)
        expected = bound(text.replace("BROKEN", ""), purpose)
        assert bound(text.replace("BROKEN", BROKEN), purpose) == expected
        all_bound.update(expected)
    assert {None} < all_bound
