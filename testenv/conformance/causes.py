# SPDX-License-Identifier: Apache-2.0
"""Why stages of others fail, or look otherwise through Hydra: one row for each cause that is known."""
import fnmatch

SETS = {}  # name of a set -> a sentence that says what it is
CAUSES = ()  # (set, pattern of stages, pattern of ways, the cause)


def of(name, stage, way):
    """:returns: the cause, or an empty text"""
    return next((text for known, stages, ways, text in CAUSES if known == name and fnmatch.fnmatchcase(stage, stages)
                 and fnmatch.fnmatchcase(way, ways)), "")
