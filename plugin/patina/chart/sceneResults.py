# SPDX-License-Identifier: Apache-2.0
"""Rows and findings of a stage's renders: what the CSV, the charts and the page show."""
import statistics
from dataclasses import dataclass, field

from patina import experiment
from patina.chart import sceneMeasures
from patina.chart.sceneRenders import BACKENDS, WORDS

COLUMNS = ("stage", "backend", "samples", "tolerance", "toleranceMet", "repeats", "seed", "seconds", "secondsInAll", "cores",
           "relMSE", "rmse", "flip", "meanError", "relative", "relMSEDirect", "rmseDirect", "flipDirect", "meanErrorDirect")
DIRECT = ("relMSE", "rmse", "flip", "meanError")  # also measured against direct light, for the rasterizer
# error measure -> how its noise falls with samples: as samples to the power of minus this
ORDERS = {"relMSE": 1.0, "flip": 0.5, "rmse": 0.5}
NAMES = {"relMSE": "relMSE", "flip": "mean FLIP", "rmse": "RMSE"}


@dataclass
class StageResult:
    stage: str
    problem: str = ""         # why there is nothing else
    ladder: object = None
    rows: list = field(default_factory=list)
    floors: dict = field(default_factory=dict)      # (back end, measure) -> error
    slopes: dict = field(default_factory=dict)      # back end -> dict of slope and tiles
    crossovers: dict = field(default_factory=dict)  # measure -> dict of crossover() and its text
    images: dict = field(default_factory=dict)      # title -> image


def of(name, ladder, seed):
    """:param name: the stage as the user called it
    :param seed: the first one of the command"""
    result = StageResult(name, ladder=ladder)
    if not ladder.references["all"].image.any():
        ladder.notes.append("the reference is black: there is nothing to compare")
    for rung in ladder.rungs:
        result.rows.append(_row(name, ladder, rung, seed))
    for backend in ladder.first:
        steps = [row for row in result.rows if row["backend"] == backend and not row["tolerance"]]
        _find_floors(result, backend, steps)
        result.slopes[backend] = _slopes(ladder, backend)
    _find_crossovers(result)
    return result


def _find_floors(result, backend, steps):
    for measure, order in ORDERS.items():
        found = sceneMeasures.floor([r["samples"] for r in steps], [r[measure] for r in steps], order)
        if found is not None:
            result.floors[backend, measure] = found


def _find_crossovers(result):
    for measure in ("relMSE", "flip"):
        found = _crossover(result.rows, measure)
        if found:
            result.crossovers[measure] = found


def _row(name, ladder, rung, seed):
    row = {"stage": name, "backend": rung.backend, "samples": rung.samples, "tolerance": rung.tolerance or "",
           "toleranceMet": ("yes" if rung.met else "no") if rung.tolerance else "", "repeats": len(rung.renders),
           "seed": seed, "seconds": rung.seconds, "secondsInAll": ladder.seconds_in_all(rung),
           "cores": rung.busy, "told": statistics.median(r.told for r in rung.renders)}

    def against(reference):
        return sceneMeasures.averaged([sceneMeasures.errors(r.image, reference.image, with_flip=i == 0)
                                       for i, r in enumerate(rung.renders)])

    row.update(against(ladder.references["all"]))
    direct = ladder.references.get("direct")
    found = against(direct) if direct and rung.backend == "raster" else {}
    row.update({measure + "Direct": found.get(measure) for measure in DIRECT})
    return row


def _slopes(ladder, backend):
    """Of log RMSE over log samples, against what the back end converges to; None with a single count."""
    rungs = ladder.of(backend)
    lights = list(ladder.references) if backend == "raster" else ["all"]
    # The rasterizer draws direct light, but it also looks through glass.
    errors = {name: sceneMeasures.rmse(rungs[-1].renders[0].image, ladder.references[name].image) for name in lights}
    light = min(lights, key=lambda name: (errors[name] is None, errors[name] or 0.0))
    reference = ladder.references[light].image
    counts = [r.samples for r in rungs]
    by_count = []
    for rung in rungs:
        tiles = [sceneMeasures.tile_errors(r.image, reference) for r in rung.renders]
        by_count.append({tile: (sum(t[tile] ** 2 for t in tiles) / len(tiles)) ** 0.5 for tile in tiles[0]})
    whole = [sceneMeasures.averaged([{"rmse": sceneMeasures.rmse(r.image, reference)} for r in rung.renders])["rmse"]
             for rung in rungs]
    found = sceneMeasures.slope(counts, whole)
    if found is None:
        return None
    return {"slope": found, "against": light, "samples": counts, "rmse": whole,
            "byTile": sceneMeasures.tile_slopes(counts, by_count)}


def _crossover(rows, measure):
    points = {b: [(r["seconds"], r[measure]) for r in rows if r["backend"] == b and r[measure]] for b in BACKENDS}
    if not all(points.values()):
        return None
    found = sceneMeasures.crossover(points["embree"], points["raster"])
    expected = None
    if found["open"]:
        expected = sceneMeasures.expected_level(points["embree"], points["raster"], ORDERS[measure])
    return {**found, "expected": expected, "text": sceneMeasures.crossover_text(found, expected)}


def write_csv(results, path):
    experiment.write_csv(path, COLUMNS, [row for result in results for row in result.rows])


def read_csv(path):
    """The results that write_csv() wrote, as far as charts are drawn from it: without pictures and without slopes by tile.

    :returns: a StageResult for each stage"""
    results = {}
    for row in experiment.read_csv(path):
        for name in COLUMNS:
            if name not in ("stage", "backend", "toleranceMet"):
                row[name] = float(row[name]) if row[name] else "" if name == "tolerance" else None
        results.setdefault(row["stage"], StageResult(row["stage"])).rows.append(row)
    for result in results.values():
        for backend in WORDS:
            steps = [row for row in result.rows if row["backend"] == backend and not row["tolerance"]]
            if steps:
                _find_floors(result, backend, steps)
                last, direct = steps[-1]["rmse"], steps[-1]["rmseDirect"]
                light = "direct" if direct and (last is None or direct < last) else "all"
                counts = [row["samples"] for row in steps]
                errors = [row["rmseDirect" if light == "direct" else "rmse"] for row in steps]
                found = sceneMeasures.slope(counts, errors)
                result.slopes[backend] = found and {"slope": found, "against": light, "samples": counts, "rmse": errors}
        _find_crossovers(result)
    return list(results.values())


def as_json(results, machine, command):
    """Everything but images, as dicts and lists."""
    stages = []
    for result in results:
        entry = {"stage": result.stage, "problem": result.problem}
        if result.ladder:
            ladder = result.ladder
            entry.update(
                width=ladder.renders.width, height=ladder.renders.height, camera=ladder.renders.info.camera,
                secondsToRead=ladder.renders.seconds_to_read, firstFrame=ladder.first, rows=result.rows,
                references={name: {"what": r.words, "samples": r.samples, "noise": r.noise, "seconds": r.seconds}
                            for name, r in ladder.references.items()},
                floors=[{"backend": b, "measure": m, "error": e} for (b, m), e in result.floors.items()],
                slopes=result.slopes, crossovers=result.crossovers, notes=ladder.notes, problems=ladder.problems)
        stages.append(entry)
    return {"machine": machine, "command": command, "stages": stages}
