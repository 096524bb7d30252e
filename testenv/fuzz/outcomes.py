# SPDX-License-Identifier: Apache-2.0
"""The outcomes of an input: in the process that runs it, and seen from outside."""
import ctypes
import json
import os
import re
import sys
import traceback

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))  # for what inputs are made of

BROKEN = 99  # exit status of an input that breaks a promise; the last line of standard error says which
LIBRARY = 98  # of one that another library dies of, as it would without Patina
KINDS = ("crash", "hang", "memory", "traceback", "promise")  # findings
GOOD = ("fine", "message", "library")
SENTINEL = b"an image that was there before\n"
SMALL = ("-w", "24", "--samples", "1", "--maxDepth", "4", "--threads", "1", "--quiet")
# A reason that begins with the type of an exception was not foreseen by whoever wrote the command.
_UNFORESEEN = re.compile(r"^patina: [A-Z]\w*(?:Error|Exception|Warning|Iteration): ", re.MULTILINE)


def broken(reason):
    """:returns: the exit status of a promise that does not hold"""
    print(f"promise broken: {reason}", file=sys.stderr)
    return BROKEN


def in_lines(values):
    """:returns: the bytes of a list as JSON, a value a line: shrink.py leaves out lines"""
    return ("[\n" + ",\n".join(map(json.dumps, values)) + "\n]\n").encode()


def from_lines(path):
    """:returns: the list of in_lines() from a file, empty where shrinking has broken it"""
    with open(path, encoding="utf-8") as file:
        try:
            return json.loads(file.read().replace(",\n]", "\n]"))
        except ValueError:
            return []


def tell_memory(warnings):
    """Has warnings of missing memory told in the words that kind_of() knows."""
    for warning in warnings:
        if "memory" in warning["message"]:
            print(f"out of memory: {warning['prim']}: {warning['message']}", file=sys.stderr)


def put_old(folder, name):
    """An image that was there before. :returns: its path"""
    path = os.path.join(folder, name)
    with open(path, "wb") as file:
        file.write(SENTINEL)
    return path


def command(words, folder):
    """:returns: the exit status of a command that runs in a folder"""
    from patina.cli import main

    os.chdir(folder)
    return main.main([str(word) for word in words])


# Exceptions that validation raises; any other exception that a prim's reader meets is a defect, though it ends as a warning.
_FORESEEN = ("StageError", "InputError", "ValueError", "ErrorException", "RuntimeError")


def tell_swallowed():
    """Has what becomes a warning of a prim told with its traceback, where nobody has foreseen it: else it would count as
    fine."""
    from patina.stage import context

    leave = context.Guard.__exit__

    def told(self, kind, error, trace):
        if kind is not None and kind.__name__ not in _FORESEEN:
            traceback.print_exception(kind, error, trace)
        return leave(self, kind, error, trace)
    context.Guard.__exit__ = told


def end_with_parent():
    """Has this process killed when the one that has started it ends: no input leaves something running."""
    ctypes.CDLL(None).prctl(1, 9)  # PR_SET_PDEATHSIG, SIGKILL


def leave(status):
    """Ends a process that was forked, with all that it has said."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status or 0)


def record(words, folder, darkens=False):
    """The same of a render to image.exr, which exists before: it is the old one afterwards, or a whole new one of numbers.

    :param darkens: whether lights of the stage take light away, so that numbers may be negative"""
    image = put_old(folder, "image.exr")
    tell_swallowed()
    status = command([*words, *SMALL, "--json=told.json"], folder)
    if not os.path.exists(image):
        return broken("the image that was there before is lost")
    with open(image, "rb") as file:
        same = file.read(len(SENTINEL)) == SENTINEL
    if status:
        return status if same else broken("a render that failed has changed the image")
    if same:
        return broken("a render that is done has written no image")
    with open(os.path.join(folder, "told.json"), encoding="utf-8") as file:
        tell_memory(json.load(file)["warnings"])
    import numpy as np

    import _patina

    found = _patina.read_image(image)
    colors = np.array(found.pixels)[..., [found.channels.index(c) for c in "RGBA"]]
    if not np.isfinite(colors).all() or (not darkens and (colors < 0).any()):
        return broken("the image holds values that are no numbers, or negative")
    return 0


def kind_of(answer):
    """:param answer: of hand.py
    :returns: one of KINDS or GOOD"""
    if answer["timedOut"]:
        return "hang"
    text = answer["error"]
    if answer["signal"]:
        return "memory" if "bad_alloc" in text else "crash"
    if answer["status"] == BROKEN:
        return "promise"
    if answer["status"] == LIBRARY:
        return "library"
    if "Traceback (most recent call last)" in text or _UNFORESEEN.search(text):
        return "traceback"
    if "out of memory" in text or "bad_alloc" in text:
        return "memory"
    if answer["status"] == 0:
        return "fine"
    return "message" if answer["status"] in (1, 2, 75) and "patina" in text else "traceback"


def signature(kind, answer):
    """:returns: a text that is equal for findings of one cause, as far as can be told from outside"""
    lines = [line for line in answer["error"].splitlines() if line.strip() and not line.startswith("counted: ")]
    if kind == "crash":
        frames = [line for line in lines if line.lstrip().startswith("File ")]
        return f"signal {answer['signal']}" + (" " + frames[0].strip() if frames else "")
    reason = lines[-1] if lines else ""
    return kind + " " + re.sub(r"-?\d[\d.e+-]*|'[^']*'|/\S+", "*", reason)[:160]
