# SPDX-License-Identifier: Apache-2.0
"""How a frame is cut: into groups of tiles, and each of these into ranges of samples.

Part 1 of 4x2 has the first group of tiles and the first range of samples, part 4 the last group and the first range, part 5
the first group and the second range.
"""
import re
from dataclasses import dataclass

from patina.cli.compiled import _patina
from patina.cli.errors import CommandError

MOST = 1 << 20  # parts: who lists those that are missing makes each of them
_CUT = re.compile(r"([1-9]\d{0,5})(?:x([1-9]\d{0,3}))?")


@dataclass(frozen=True)
class Cut:
    tiles: int  # groups of tiles
    ranges: int = 1  # of samples

    @property
    def parts(self):
        return self.tiles * self.ranges

    def __str__(self):
        return f"{self.tiles}x{self.ranges}" if self.ranges > 1 else str(self.tiles)


@dataclass(frozen=True)
class Part:
    number: int  # from 1
    cut: Cut

    @property
    def tile_group(self):
        return (self.number - 1) % self.cut.tiles

    @property
    def range_index(self):
        return (self.number - 1) // self.cut.tiles

    def __str__(self):
        return f"{self.number}/{self.cut}"


def cut(text):
    """:raises ValueError: where the text is none; argparse says so"""
    match = _CUT.fullmatch(text)
    if not match:
        raise ValueError
    found = Cut(int(match[1]), int(match[2] or 1))
    if found.parts > MOST:
        raise ValueError
    return found


def part(text):
    """:raises ValueError: where the text is none, or there is no such part; argparse says so"""
    number, slash, of = text.partition("/")
    found = Part(int(number), cut(of if slash else ""))
    if not 1 <= found.number <= found.cut.parts:
        raise ValueError
    return found


# argparse shows the name of the function in its message about a bad value.
cut.__name__ = "cut (TILES or TILESxRANGES)"
part.__name__ = "part (K/TILES or K/TILESxRANGES)"


def ranges(ends, count):
    """Equal shares of the samples, as near as the ends of spans allow.

    :param ends: of spans, ascending; the last is the number of samples
    :returns: list of (begin, end)
    :raises CommandError: where there are not so many"""
    if count > len(ends):
        raise CommandError(f"{ends[-1]} samples can be cut into {len(ends)} ranges at most, not {count}")
    cuts, left = [0], list(ends)
    for index in range(1, count):
        wanted = ends[-1] * index / count
        room = left[:len(left) - (count - index)]  # one end for each range that follows
        cuts.append(min(room, key=lambda end: (abs(end - wanted), end)))
        left = [end for end in left if end > cuts[-1]]
    return list(zip(cuts, cuts[1:] + [ends[-1]]))


def tiles(settings, part):
    """:returns: the tiles of a part
    :raises CommandError: where the image has fewer tiles than groups"""
    window = settings.get("dataWindow") or (0, 0, -1, -1)
    every = _patina.tiles_of_part(settings["width"], settings["height"], window)
    if part.cut.tiles > len(every):
        raise CommandError(f"an image of {len(every)} tiles cannot be cut into {part.cut.tiles} groups")
    return _patina.tiles_of_part(settings["width"], settings["height"], window, part.tile_group, part.cut.tiles)
