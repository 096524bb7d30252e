# SPDX-License-Identifier: Apache-2.0
"""Runs the fuzzers, one after the other, and tells what they found. `patina fuzz` calls it."""
import importlib
import os
import tempfile

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


def run(names, seconds, seed, corpus, findings, build, say=print):
    """:param names: of fuzzers; none: all
    :param seconds: of all together
    :param corpus: folder of inputs that grows, or None: nothing is kept between runs
    :param findings: folder that findings are written to
    :param build: folder of the instrumented build
    :returns: dict of each fuzzer's numbers, see generated.run()"""
    names = names or list(FUZZERS)
    total = sum(FUZZERS[name].share for name in names)
    natives = [name for name in names if FUZZERS[name].kind == "native"]
    left_out = ""
    if natives:
        try:
            native.build(build, natives, os.cpu_count() or 1)
        except native.Missing as error:
            left_out = str(error)
            say(f"left out: {', '.join(natives)}: {left_out}")
    results = {}
    say(f"{'fuzzer':<18}{'inputs':>9}{'seconds':>8}{'inputs/s':>10}{'lines':>8}{'findings':>10}")
    with tempfile.TemporaryDirectory() as scratch:
        for name in names:
            fuzzer, share = FUZZERS[name], seconds * FUZZERS[name].share / total

            def report(line, name=name):
                say(f"  {name}: {line}")
            if fuzzer.kind == "generated":
                results[name] = generated.run(importlib.import_module(name), share, seed, report)
            elif fuzzer.kind == "python":
                if traced.missing():
                    say(f"left out: {name}: {traced.missing()}")
                    continue
                results[name] = traced.run(name, fuzzer, corpus or scratch, share, seed, report)
            elif not left_out:
                results[name] = native.run(name, fuzzer, build, corpus or scratch, share, seed, report)
            else:
                continue
            say(_line(name, results[name]))
            for finding in results[name]["findings"]:
                say(f"  saved {keptFindings.save(findings, name, _extension(name), finding)}")
    return results


def figures(results):
    """:returns: the numbers of a run without its inputs, for a file of JSON"""
    return {name: {key: found[key] for key in ("inputs", "seconds", "counts", "lines")} |
            {"findings": [{"kind": kind, "reason": reason} for kind, reason, *_ in found["findings"]]}
            for name, found in results.items()}
