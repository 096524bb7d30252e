# SPDX-License-Identifier: Apache-2.0
"""The page of `patina view --library`: every material with its pictures and its source, in one file."""
import html
import os

from patina import pagePolicy
from patina.chart import png
from patina.cli.progress import Progress
from patina.library import catalog, pictures
from patina.report.page import WEB

_WEB = os.path.join(os.path.dirname(os.path.abspath(__file__)), "web")


def document(width, samples, chosen=None):
    """:param width, samples: of the pictures
    :param chosen: entries of the catalogue; None: all
    :returns: the text of the page, and a list of warnings"""
    chosen = catalog.entries() if chosen is None else chosen
    progress, warnings, cards = Progress("library"), [], {}
    for done, entry in enumerate(chosen):
        progress.step(done, len(chosen), entry.name)
        shown, told = pictures.render(entry, width, samples)
        warnings += [{**warning, "prim": entry.name, "input": ""} for warning in told]
        cards.setdefault(entry.group, []).append(_card(entry, shown, width))
    progress.clear()
    page, style, script = (pagePolicy.text(_WEB, name) for name in ("library.html", "library.css", "library.js"))
    return pagePolicy.filled(page, script, STYLE=pagePolicy.text(WEB, "report.css") + style, COUNT=str(len(chosen)),
                             BODY="".join(_section(group, found) for group, found in cards.items())), warnings


def _section(group, cards):
    return f'<section><h2>{html.escape(group)}</h2><div class="materials">{"".join(cards)}</div></section>\n'


def _card(entry, shown, width):
    title, name = html.escape(entry.title), html.escape(entry.name)
    figures = "".join(f'<img src="{png.data_uri(picture)}" width="{width}" height="{width}" alt="{title}, {words}" '
                      f'title="{words}">' for words, picture in shown)
    return (f'<article data-words="{html.escape(" ".join((entry.title, entry.name, entry.group, entry.source)).lower())}">'
            f'<h3>{title}</h3><div class="pair">{figures}</div><p class="dim">{html.escape(entry.source)}</p>'
            f'<p><code>patina view {catalog.PREFIX}{name} -o {name}.html</code></p></article>\n')
