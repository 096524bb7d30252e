# SPDX-License-Identifier: Apache-2.0
"""Errors that end the reading of a stage; all else is a warning."""


class StageError(RuntimeError):
    """A one-line reason why there is nothing to render."""


def one_line(error):
    """:returns: the text of an exception, without where in pxr's code it was raised"""
    texts = [str(getattr(item, "commentary", item)) for item in error.args]
    return " ".join(" ".join(texts).split()) or type(error).__name__
