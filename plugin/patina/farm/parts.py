# SPDX-License-Identifier: Apache-2.0
"""Parts that lie in files: whether they belong together, and which are missing."""
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.farm import cut, identity, partial


class Parts:
    """The parts of one frame."""

    def __init__(self, files, mixed=False):
        """:param mixed: parts of other builds and instruction sets go together, too
        :raises CommandError: naming the file that does not belong to the first, and what differs"""
        self.found = {}  # number -> Description
        self.first = None
        for file in files:
            description = partial.read(_patina, file)
            self.first = self.first or description
            self._check(description, mixed)
            self.found.setdefault(description.part.number, description)

    def _check(self, description, mixed):
        ours, theirs = self.first.identity, description.identity
        if mixed:
            ours, theirs = ({name: value for name, value in one.items() if name not in ("build", "instruction set")}
                            for one in (ours, theirs))
        problem = identity.difference(theirs, ours)
        if problem:
            raise CommandError(f"{description.file} does not belong to {self.first.file}: {problem}")

    def missing(self):
        """:returns: list of cut.Part"""
        whole = self.first.part.cut
        return [cut.Part(number, whole) for number in range(1, whole.parts + 1) if number not in self.found]

    def in_order(self):
        """:returns: descriptions in the order in which they are merged: of the same tiles by their samples"""
        return [self.found[number] for number in sorted(self.found)]


def names(missing):
    """:returns: parts in words, such as `parts 3, 5 and 8 of 4x2 are missing`"""
    numbers = [str(part.number) for part in missing]
    if len(numbers) > 20:
        numbers = numbers[:20] + [f"{len(numbers) - 20} more"]
    listed = numbers[0] if len(numbers) == 1 else ", ".join(numbers[:-1]) + " and " + numbers[-1]
    return f"part{'s' if len(numbers) > 1 else ''} {listed} of {missing[0].cut} {'are' if len(numbers) > 1 else 'is'} missing"
