# SPDX-License-Identifier: Apache-2.0
"""The page about a run of `pytest --patina-scenes`: what failed first, each stage with its golden image, the new one and the
difference. It is one file that loads nothing and runs no script."""
import html
import time

from patina import __version__, pagePolicy
from patina.chart import png
from patina.cli import outputs

LARGEST = 640  # pixels on the longer side of a picture
# Outcomes, in the order of the page, and what they mean.
OUTCOMES = {"differs": "another picture", "unseen": "noise hides too much", "broken": "cannot be rendered or compared",
            "missing": "without a golden image", "made": "golden images made", "same": "the same picture",
            "equal": "the same bits"}
FAILED = ("differs", "unseen", "broken", "missing")
_STYLE = """body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 62em; padding: 0 1em; color: #222 }
h1 { font-size: 1.4em } h2 { font-size: 1.05em; margin: 1.6em 0 .3em; border-top: 1px solid #ccc; padding-top: .8em }
.failed { color: #a11 } .passed { color: #176 } pre { white-space: pre-wrap; background: #f4f4f4; padding: .6em }
figure { display: inline-block; margin: .4em .8em 0 0; vertical-align: top; max-width: 19em } img { max-width: 100% }
figcaption { font-size: .85em; color: #555 } table { border-collapse: collapse } td { padding: .15em 1em .15em 0 }
@media (prefers-color-scheme: dark) { body { background: #1b1b1b; color: #ddd } pre { background: #262626 }
.failed { color: #f77 } .passed { color: #7d9 } figcaption { color: #aaa } h2 { border-color: #444 } }"""


def picture(caption, linear):
    """:param linear: (height, width, 3), as png takes it
    :returns: what a page shows: caption, data URI, size"""
    step = max(1, -(-max(linear.shape[:2]) // LARGEST))
    return {"caption": caption, "uri": png.data_uri(linear[::step, ::step]), "size": linear.shape[1::-1]}


def write(path, stages, about):
    """:param stages: list of dicts: name, outcome, text, seconds, pictures
    :param about: list of (what, value) above the table"""
    order = {outcome: i for i, outcome in enumerate(OUTCOMES)}
    stages = sorted(stages, key=lambda stage: (order[stage["outcome"]], stage["name"]))
    count = sum(stage["outcome"] in FAILED for stage in stages)
    title = f"{count} of {len(stages)} stages failed" if count else f"{len(stages)} stages passed"
    rows = [("rendered", time.strftime("%Y-%m-%d %H:%M")), ("Patina", __version__), *about]
    rows += [(words, number) for outcome, words in OUTCOMES.items()
             if (number := sum(stage["outcome"] == outcome for stage in stages))]
    table = "".join(f"<tr><td>{html.escape(str(what))}</td><td>{html.escape(str(value))}</td></tr>\n" for what, value in rows)
    text = (f'<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n{pagePolicy.meta()}\n<title>{title}</title>\n'
            f"<style>{_STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<table>\n{table}</table>\n"
            + "".join(map(_stage, stages)) + "</body>\n</html>\n")
    with outputs.Together() as files, open(files.add(path), "w", encoding="utf-8") as file:
        file.write(text)


def _stage(stage):
    kind = "failed" if stage["outcome"] in FAILED else "passed"
    lines = [f'<h2>{html.escape(stage["name"])} <span class="{kind}">{OUTCOMES[stage["outcome"]]}</span></h2>\n']
    if stage["text"]:
        lines.append(f'<pre>{html.escape(stage["text"])}</pre>\n')
    for shown in stage["pictures"]:
        width, height = shown["size"]
        lines.append(f'<figure><img src="{shown["uri"]}" alt="{html.escape(shown["caption"])}"><figcaption>'
                     f'{html.escape(shown["caption"])}, {width} x {height}</figcaption></figure>\n')
    lines.append(f'<p>{stage["seconds"]:.1f} s</p>\n')
    return "".join(lines)
