# SPDX-License-Identifier: Apache-2.0
"""What charts, benchmarks and the tests of a checkout measure with: renders to their end, runs in turns, medians, errors, and
rows as CSV or Markdown. The statistics of tests are in significance.py and regression/welch.py."""
import concurrent.futures
import csv
import statistics

import numpy as np

from patina.cli import outputs

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def draw(renderer, scene, camera, settings, film, backend=""):
    """Renders to the end.

    :param backend: the one that it has to be; empty: any
    :returns: what Renderer.progress() says then
    :raises RuntimeError: where the render fails, or another back end has taken over"""
    renderer.start(scene, camera, settings, film)
    try:
        while not renderer.wait(0.2):  # signals are heard in between
            pass
    except BaseException:
        renderer.stop()
        raise
    state = renderer.progress()
    if state["failed"]:
        raise RuntimeError(state["error"])
    if backend and state["backend"] != backend:
        raise RuntimeError(f"{state['backend']} rendered instead of {backend}: "
                           f"{[w['prim'] + ': ' + w['message'] for w in scene.warnings()]}")
    return state


def turns(runs, subjects, measure):
    """Subjects take turns, so that what disturbs the machine disturbs all of them.

    :param measure: function of a subject and of the run's number, from 1
    :returns: dict of each subject to its figures, run by run"""
    found = {subject: [] for subject in subjects}
    for run in range(1, runs + 1):
        for subject, figures in found.items():
            figures.append(measure(subject, run))
    return found


def as_done(pool, function, tasks):
    """Runs tasks in the processes or threads of a pool. Leaving the loop, by an error too, drops those that have not begun.

    :param tasks: tuples of arguments
    :returns: iterator of (task, future), in the order in which they are done"""
    waiting = {pool.submit(function, *task): task for task in tasks}
    try:
        for future in concurrent.futures.as_completed(waiting):
            yield waiting[future], future
    finally:
        pool.shutdown(cancel_futures=True)


def spread(ratios):
    """:returns: dict of their median, least and most"""
    return {"ratio": statistics.median(ratios), "least": min(ratios), "most": max(ratios)}


def medians(runs, names, of=lambda run, name: run[name]):
    """:returns: dict of each name to its median over the runs"""
    return {name: statistics.median(of(run, name) for run in runs) for name in names}


def relative_error(image, truth):
    """:returns: what a tolerance is about: the mean over the pixels of |luminance - truth| over (truth + 0.01)"""
    return float((np.abs(image - truth) / (truth + 0.01)).mean())


def table(head, rows=()):
    """:returns: lines of a table in Markdown"""
    return [table_row(head), "|" + "---|" * len(head), *map(table_row, rows)]


def table_row(cells):
    return "| " + " | ".join(cells) + " |"


def write_csv(path, columns, rows, digits=6):
    """:param rows: dicts, which may have more than the columns; None is an empty cell
    :param digits: of numbers that are no whole ones; None: all"""
    def cell(value):
        return "" if value is None else f"{value:.{digits}g}" if digits and isinstance(value, float) else value

    with outputs.writing(path, newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows({name: cell(row[name]) for name in columns} for row in rows)


def read_csv(path):
    """:returns: list of rows, dicts of texts"""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
