# SPDX-License-Identifier: Apache-2.0
"""Findings, and inputs that were found once: a finding is a file FUZZER-REASON.EXTENSION with a .txt beside it; a kept one is a
file of testenv/fuzz/corpus/FUZZER, which a test runs again."""
import hashlib
import os
import re
import shutil

CORPUS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "corpus")


def save(folder, name, extension, finding):
    """:param finding: (kind, signature, data, what was told)
    :returns: the path of the input"""
    kind, signature, data, error = finding
    os.makedirs(folder, exist_ok=True)
    words = re.sub(r"[^A-Za-z]+", "-", signature).strip("-")[:40]
    base = os.path.join(folder, f"{name}-{kind}-{words}-{hashlib.sha256(data).hexdigest()[:8]}")
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
    if not os.path.isdir(os.path.join(CORPUS, fuzzer)):
        raise ValueError(f"{path} is no finding: its name does not begin with that of a fuzzer")
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name):
        raise ValueError(f"'{name}' is no name of a test: letters and digits")
    target = os.path.join(CORPUS, fuzzer, name + os.path.splitext(path)[1])
    if os.path.exists(target):
        raise ValueError(f"there is a {name} of {fuzzer} already")
    shutil.copyfile(path, target)
    return target


def corpus(fuzzer):
    """:returns: paths of the kept inputs of a fuzzer"""
    folder = os.path.join(CORPUS, fuzzer)
    return sorted(os.path.join(folder, name) for name in os.listdir(folder)) if os.path.isdir(folder) else []
