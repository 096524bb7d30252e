# SPDX-License-Identifier: Apache-2.0
"""Runs the fuzzers of pythonTargets.py, each in a process that may die; after a finding it begins anew with another seed."""
import glob
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
import time

import following
import keptFindings

HERE = os.path.dirname(os.path.abspath(__file__))
LONGEST_INPUT = 4096  # bytes
HANG_SECONDS = 60


def missing():
    """:returns: why they cannot run, or an empty text"""
    return "" if importlib.util.find_spec("atheris") else "Python's atheris is missing (pip install atheris)"


def command(name, *arguments):
    return [sys.executable, os.path.join(HERE, "pythonTargets.py"), name, *arguments]


def coverage(name, sources, folder):
    """:param sources: beginnings of paths from the root of the checkout
    :returns: (lines of functions that a folder's inputs reach, lines that there are); None where they cannot be counted"""
    below = ",".join(source[len("plugin/patina/"):] for source in sources)
    done = subprocess.run(command(name, "--lines", below, folder), capture_output=True, text=True, errors="replace")
    try:
        return tuple(json.loads(done.stdout.strip().splitlines()[-1]))
    except (IndexError, ValueError):
        return None


def run(name, fuzzer, corpus, seconds, plateau, seed, say):
    """:param fuzzer: of fuzzers.py
    :param corpus: folder of inputs that grows
    :param plateau: seconds of processors without a new edge after which it ends
    :returns: as native.run()"""
    work = os.path.join(corpus, name)
    os.makedirs(work, exist_ok=True)
    start, inputs, findings, part, edges = time.monotonic(), 0, {}, 0, following.Plateau()
    with tempfile.TemporaryDirectory(dir=following.IN_MEMORY) as scratch:
        while (left := seconds - (time.monotonic() - start)) > 1 and edges.seconds() < plateau:
            prefix = os.path.join(scratch, f"found{part}-")
            status, said, tried = following.run(
                command(name, work, os.path.join(keptFindings.CORPUS, name), f"-max_total_time={int(left)}",
                        f"-seed={seed + part + 1}", f"-max_len={LONGEST_INPUT}", f"-timeout={HANG_SECONDS}",
                        "-print_final_stats=1", f"-artifact_prefix={prefix}"), edges, plateau,
                env=dict(os.environ, TMPDIR=scratch))
            inputs += tried
            part += 1
            found = [path for path in glob.glob(glob.escape(prefix) + "*") if "-slow-unit-" not in path]
            if not found:
                if status:
                    raise RuntimeError(f"{name} ended with {status}: {said[-500:]}")
                break
            raised = re.findall(r"^(\w+(?:Error|Exception)\b.*)", said, re.MULTILINE)
            kind = ("hang" if "-timeout-" in found[0] else "memory" if "-oom-" in found[0] else "traceback" if raised else
                    "crash")
            reason = re.sub(r"\d+|'[^']*'", "*", raised[-1] if raised else os.path.basename(found[0]).split("-")[1])[:160]
            if reason not in findings:
                say(f"{kind}: {reason}")
                with open(found[0], "rb") as file:
                    findings[reason] = (kind, reason, file.read(), said[-4000:])
    counts = {"fine": inputs}
    for kind, *_ in findings.values():
        counts[kind] = counts.get(kind, 0) + 1
    return {"inputs": inputs, "seconds": time.monotonic() - start, "counts": counts, "findings": list(findings.values()),
            "lines": coverage(name, fuzzer.sources, work), "plateau": edges.seconds()}
