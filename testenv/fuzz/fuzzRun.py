# SPDX-License-Identifier: Apache-2.0
"""Runs the fuzzers, one after the other, and tells what they found. `patina fuzz` calls it."""
import importlib
import os
import tempfile
import time

import generated
import keptFindings
import native
import traced
from fuzzers import FUZZERS


def listing():
    """:returns: one line for each fuzzer"""
    return [f"  {name:<18}{fuzzer.kind:<11}{fuzzer.reads}" for name, fuzzer in FUZZERS.items()]


def unknown(names):
    return [name for name in names if name not in FUZZERS]


def _extension(name):
    return importlib.import_module(name).EXTENSION if FUZZERS[name].kind == "generated" else ""


def _line(name, found):
    rate = found["inputs"] / max(found["seconds"], 1e-3)
    lines = "-" if not found["lines"] or not found["lines"][1] else f"{100 * found['lines'][0] / found['lines'][1]:.0f} %"
    kinds = ", ".join(f"{count} {kind}" for kind, count in sorted(found["counts"].items()))
    return (f"{name:<18}{found['inputs']:>9}{found['seconds']:>8.0f}{rate:>10.1f}{lines:>8}{len(found['findings']):>10}"
            f"   {kinds}")


def _in_turn(names):
    """:returns: names, first those that end where they reach nothing new: the others get the time that these leave"""
    return sorted(names, key=lambda name: FUZZERS[name].kind == "generated")


def run(names, seconds, plateau, seed, corpus, findings, build, say=print):
    """:param names: of fuzzers; none: all
    :param seconds: of all together
    :param plateau: seconds of following.Plateau after which a fuzzer that follows edges ends; None: a third of its share, at
        most an hour
    :param corpus: folder of inputs that grows, or None: nothing is kept between runs
    :param findings: folder that findings are written to
    :param build: folder of the instrumented build
    :returns: dict of each fuzzer's numbers, see generated.run()"""
    names = _in_turn(names or list(FUZZERS))
    natives = [name for name in names if FUZZERS[name].kind == "native"]
    left_out = ""
    if natives:
        try:
            native.build(build, natives, os.cpu_count() or 1)
        except native.Missing as error:
            left_out = str(error)
            say(f"left out: {', '.join(natives)}: {left_out}")
    if left_out:
        names = [name for name in names if name not in natives]
    if traced.missing():
        for name in [name for name in names if FUZZERS[name].kind == "python"]:
            say(f"left out: {name}: {traced.missing()}")
            names.remove(name)
    results, start = {}, time.monotonic()
    say(f"{'fuzzer':<18}{'inputs':>9}{'seconds':>8}{'inputs/s':>10}{'lines':>8}{'findings':>10}")
    with tempfile.TemporaryDirectory() as scratch:
        for place, name in enumerate(names):
            fuzzer, left = FUZZERS[name], seconds - (time.monotonic() - start)
            share = left * fuzzer.share / sum(FUZZERS[other].share for other in names[place:])
            if share <= 0.0:
                say(f"left out: {name}: no time is left")
                continue
            quiet = plateau or min(share / 3.0, 3600.0)

            def report(line, name=name):
                say(f"  {name}: {line}")
            if fuzzer.kind == "generated":
                results[name] = generated.run(importlib.import_module(name), share, seed, report)
            elif fuzzer.kind == "python":
                results[name] = traced.run(name, fuzzer, corpus or scratch, share, quiet, seed, report)
            else:
                results[name] = native.run(name, fuzzer, build, corpus or scratch, share, quiet, seed, report)
            say(_line(name, results[name]))
            for finding in results[name]["findings"]:
                say(f"  saved {keptFindings.save(findings, name, _extension(name), finding)}")
    return results


def figures(results):
    """:returns: the numbers of a run without its inputs, for a file of JSON"""
    return {name: {key: found[key] for key in ("inputs", "seconds", "counts", "lines", "plateau", "edges") if key in found} |
            {"findings": [{"kind": kind, "reason": reason} for kind, reason, *_ in found["findings"]]}
            for name, found in results.items()}
