# SPDX-License-Identifier: Apache-2.0
"""Findings of fuzzers and of random graphs: a finding is a file FUZZER-REASON.EXTENSION with a .txt beside it; a kept one is a
file of the fuzzer's folder, which a test runs again."""
import hashlib
import os
import re
import shutil

HERE = os.path.dirname(os.path.abspath(__file__))
CORPUS = os.path.join(HERE, "corpus")
ELSEWHERE = {"randomGraphs": os.path.join(HERE, "..", "stability", "corpus")}


def folder(fuzzer):
    """:returns: that of its kept inputs"""
    return ELSEWHERE.get(fuzzer, os.path.join(CORPUS, fuzzer))


def save(place, name, extension, finding):
    """:param finding: (kind, signature, data, what was told)
    :returns: the path of the input"""
    kind, signature, data, error = finding
    os.makedirs(place, exist_ok=True)
    words = re.sub(r"[^A-Za-z]+", "-", signature).strip("-")[:40]
    base = os.path.join(place, f"{name}-{kind}-{words}-{hashlib.sha256(data).hexdigest()[:8]}")
    with open(base + extension, "wb") as file:
        file.write(data)
    with open(base + ".txt", "w", encoding="utf-8") as file:
        file.write(f"{kind}: {signature}\n\n{error}\n")
    return base + extension


def keep(path, name):
    """Makes a finding a regression test.

    :param name: that the test has: letters and digits
    :returns: the path in the corpus
    :raises ValueError: with a one-line reason"""
    fuzzer = os.path.basename(path).partition("-")[0]
    if not os.path.isdir(folder(fuzzer)):
        raise ValueError(f"{path} is no finding: its name does not begin with that of a fuzzer")
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name):
        raise ValueError(f"'{name}' is no name of a test: letters and digits")
    target = os.path.join(folder(fuzzer), name + os.path.splitext(path)[1])
    if os.path.exists(target):
        raise ValueError(f"there is a {name} of {fuzzer} already")
    shutil.copyfile(path, target)
    return target


def corpus(fuzzer):
    """:returns: paths of the kept inputs of a fuzzer"""
    place = folder(fuzzer)
    return sorted(os.path.join(place, name) for name in os.listdir(place)) if os.path.isdir(place) else []
