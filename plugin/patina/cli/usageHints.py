# SPDX-License-Identifier: Apache-2.0
"""What a user who typed something that is not understood may have meant."""
import difflib
import re

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?", re.IGNORECASE)


def nearest(word, known):
    """:returns: the known word that is most like this one whatever its capitals, or None"""
    lower = {name.lower(): name for name in known}
    found = difflib.get_close_matches(word.lower(), lower, n=1, cutoff=0.7)
    return lower[found[0]] if found else None


def hint(parser, words, message):
    """:param parser: whose message it is
    :param words: that were typed
    :param message: of argparse
    :returns: a text to follow the message, empty where nothing is known"""
    if message.startswith("unrecognized arguments: "):
        return _of_unknown(parser, words, message.partition(": ")[2].split())
    percent = re.fullmatch(r"argument (\S+?)(?:/.*)?: .*'([0-9.]+) ?%'", message)
    if percent and _NUMBER.fullmatch(percent[2]):
        return f"; a share is written as a number: {percent[1]} {float(percent[2]) / 100.0:g}"
    return ""


def _of_unknown(parser, words, left):
    flags = {flag: action for action in parser._actions for flag in action.option_strings}
    for word in left:
        name, equals, value = word.partition("=")
        if name.startswith("-") and not _NUMBER.match(name):
            found = nearest(name, [flag for flag in flags if flag.startswith("--")])
            return f"; did you mean {found}{equals}{value}?" if found else ""
    if not left or not all(_NUMBER.fullmatch(word) for word in left):
        return ""
    for at, word in enumerate(words):  # a vector that was typed as several words
        name, equals, value = word.partition("=")
        taken = [value] if equals else words[at + 1:at + 2]
        typed = words[at + 2 - bool(equals):][:len(left)]
        is_vector = name in flags and "," in str(flags[name].metavar)
        if is_vector and typed == left and len(taken + left) == 3 and "," not in taken[0]:
            return f"; write it with commas: {name} {','.join(taken + left)}"
    return ""
