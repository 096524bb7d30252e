# SPDX-License-Identifier: Apache-2.0
"""How to go on with a render that was ended: the command line, ready for a shell."""
import os
import shlex

from patina.cli import frames

_SPEC = ("--frames", "-f")


def command(arguments, left):
    """:param arguments: those of `patina record`, with `argv`, what was typed
    :param left: time codes of the frames that are not done, of several
    :returns: a command line that renders the rest"""
    words = list(getattr(arguments, "argv", None) or [])
    if arguments.frames and left:
        words = _without_frames(words) + ["--frames", frames.spec_of(left)]
    if "--resume" not in words:
        words.append("--resume")
    return shlex.join([os.environ.get("PATINA_COMMAND") or "patina", *words])


def _without_frames(words):
    kept, skip = [], False
    for word in words:
        if skip:
            skip = False
        elif word in _SPEC:
            skip = True
        elif not (word.startswith("--frames=") or (word.startswith("-f") and word[2:3].isdigit())):
            kept.append(word)
    return kept
