# SPDX-License-Identifier: Apache-2.0
"""Puts the page of a render together."""
import html
import os

from patina import pagePolicy
from patina.cli import planText, shots
from patina.cli.compiled import _patina
from patina.report import pictures, sections
from patina.view.page import as_json, finite

LABELS = {"color": "image", "color.noisy": "image before denoising", "sampleCount": "samples", "primId": "prims",
          "instanceId": "instances", "elementId": "faces", "denoisingAlbedo": "albedo for denoising",
          "denoisingNormal": "normal for denoising"}
WEB = os.path.join(os.path.dirname(os.path.abspath(__file__)), "web")


def document(job, film, shot, settings, info):
    """:param job: record's, whose statistics hold this frame's numbers
    :returns: the text of a page that needs no other file"""
    frame = job.statistics.current()
    error = pictures.relative_error(film)
    options = shots.image_options(job.arguments, shot, shot.outputs[0], settings)
    window = settings.get("dataWindow") or (0, 0, film.width - 1, film.height - 1)
    if window[2] < window[0] or window[3] < window[1]:
        window = (0, 0, film.width - 1, film.height - 1)
    data = {"layers": _layers(film, options, error, settings["aovs"]), "probe": pictures.probe(film, error),
            "colors": pictures.colormap(), "prims": job.scene.paths("geometry"), "origin": [0, 0]}
    for layer in data["layers"]:
        layer["label"] = LABELS.get(layer["name"], layer["name"])
    body = sections.body(sections.Facts(
        arguments=job.arguments, frame=frame, frames=job.statistics.frames(), image=shot.image, images=shot.images, info=info,
        settings=settings, warnings=job.statistics.warnings(), notes=job.statistics.notes(), interrupted=job.interrupted,
        error=error, samples=film.resolve("sampleCount"), window=window, materials=_materials(job),
        plan_lines=planText.choice_lines(job.renderer.progress()["sceneChoices"])))
    page, style, script = (pagePolicy.text(WEB, name) for name in ("report.html", "report.css", "report.js"))
    return pagePolicy.filled(page, script, TITLE=html.escape(f"{os.path.basename(shot.image)}: Patina"), STYLE=style, BODY=body,
                             DATA=as_json(finite(data)[0]))


def _layers(film, options, error, aovs):
    """:returns: list of pictures, those that say most first"""
    counts = film.resolve("sampleCount")
    unseen = counts <= 0
    made = [{"name": "color", "uri": pictures.shown(film, options), "legend": None},
            pictures.heat("error", error, unit="%", log=True, missing=unseen),
            pictures.heat("sampleCount", counts.astype(float), missing=unseen)]
    names = list(dict.fromkeys(["albedo", "normal", "depth", "primId", *aovs]))
    if "color.noisy" in film.aovs:
        names.insert(0, "color.noisy")
    for name in names:
        if name not in ("sampleCount", "variance", "color", "alpha"):
            made.append(pictures.layer(name, film.resolve(name)))
    return made


def _materials(job, most=60):
    """:returns: list of (path, plan or None, text of what is modelled), those that took most of the time first"""
    state = job.renderer.progress()
    spent, paths = state["materialSeconds"], job.scene.paths("materials")
    paths.sort(key=lambda path: -spent.get(path, 0.0))
    found = []
    for path in paths[:most]:
        plan = state["plans"].get(path)
        methods = dict(job.settings["methods"], **({c["point"]: c["method"] for c in plan["choices"]} if plan else {}))
        found.append((path, plan, _patina.explain_material(job.scene.material(path), [], methods)))
    return found
