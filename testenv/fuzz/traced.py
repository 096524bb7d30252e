# SPDX-License-Identifier: Apache-2.0
"""Runs the fuzzers of pythonTargets.py, each in a process that may die; after a finding it begins anew with another seed."""
import importlib.util
import json
import os
import re
import subprocess
import sys

import following

HERE = os.path.dirname(os.path.abspath(__file__))
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


def _why(file, said):
    """:returns: (kind, reason) of an input that failed"""
    raised = re.findall(r"^(\w+(?:Error|Exception)\b.*)", said, re.MULTILINE)
    kind = "hang" if "-timeout-" in file else "memory" if "-oom-" in file else "traceback" if raised else "crash"
    return kind, re.sub(r"\d+|'[^']*'", "*", raised[-1] if raised else os.path.basename(file).split("-")[1])[:160]


def _bytes(file, *_):
    with open(file, "rb") as stream:
        return stream.read()


def run(name, fuzzer, corpus, seconds, plateau, seed, say):
    """As following.search(). :param fuzzer: of fuzzers.py"""
    return following.search(name, command(name, f"-timeout={HANG_SECONDS}"), corpus, seconds, plateau, seed, say, _why, _bytes,
                            lambda work, _: coverage(name, fuzzer.sources, work),
                            lambda scratch: {"env": dict(os.environ, TMPDIR=scratch)})
