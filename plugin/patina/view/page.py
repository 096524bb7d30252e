# SPDX-License-Identifier: Apache-2.0
"""Puts a page together."""
import html
import json
import math

from patina import pagePolicy
from patina.cli.errors import CommandError
from patina.view import albedo, blobs, bundle, glslText


def as_json(data):
    """JSON that a script element holds safely: no `<` is left in it."""
    text = json.dumps(data, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def finite(data):
    """:returns: the data with 0 for every number that is not finite, which JSON does not know; and how many"""
    count = 0

    def walk(item):
        nonlocal count
        if isinstance(item, dict):
            return {key: walk(value) for key, value in item.items()}
        if isinstance(item, (list, tuple)):
            return [walk(value) for value in item]
        if isinstance(item, float) and not math.isfinite(item):
            count += 1
            return 0.0
        return item

    return walk(data), count


def document(data, lobes):
    """:param data: what web/src reads, without what all pages share
    :returns: the text of the page, and warnings as lines"""
    data, replaced = finite(data)
    warnings = [f"{replaced} numbers of the page are not finite and shown as 0"] if replaced else []
    texts = {"library": glslText.library(), "programs": [m["programs"] for m in data["materials"]],
             "layers": [m["layer"] for m in data["materials"]], "plans": [m["plan"] for m in data["materials"]]}
    kept = [{k: v for k, v in m.items() if k not in ("programs", "layer", "plan")} for m in data["materials"]]
    whole = {**data, "materials": kept, "texts": blobs.pack_text(json.dumps(texts, allow_nan=False)),
             "albedo": albedo.texture(lobes)}
    script = bundle.script()
    if "</script" in script.lower():
        raise CommandError("the page's script cannot stand in a page")
    return pagePolicy.filled(pagePolicy.text(bundle.WEB, "page.html"), script, TITLE=html.escape(data["title"]),
                             STYLE=pagePolicy.text(bundle.WEB, "page.css"), DATA=as_json(whole)), warnings
