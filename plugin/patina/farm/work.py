# SPDX-License-Identifier: Apache-2.0
"""The frames and parts of a job: what is to be done, in which order, and which commands do it."""
import contextlib
import os
import re
from dataclasses import dataclass, field

from patina.cli import checkpoints
from patina.cli.errors import CommandError
from patina.farm import cut, folders, identity, owner, partial

TRIES = 4  # of a part: the first, and three more, on other workers where there are any
LOSSES = 16  # times that Dask gives a part up because its workers died (four of them): parts run beside workers and end none
_PART = r"\d+\.part"
_DONE = _PART + r"|\.\d+\.\d+-\d+\.part|(\d+|image)\.log"  # of no use behind a whole image, or never whole
_OWN = re.compile(_DONE + r"|(\d+|image)\.\d{8}-\d{6}\.\d+(\.\d+)?\.failed\.log")


@dataclass
class Task:
    """One command on one worker."""
    frame: "Frame"
    part: object  # cut.Part; None merges the parts, or renders a frame that is not cut
    failures: list = field(default_factory=list)  # (address of the worker that it failed on, why)
    passing: bool = False  # whether the reason of the last failure may pass
    refusals: int = 0  # by workers that take nothing of this job
    losses: int = 0  # of workers that went away with it

    def __str__(self):
        what = f"part {self.part}" if self.part else "merging" if self.frame.cut.parts > 1 else "the image"
        return f"{what} of {self.frame.image}"

    @property
    def file(self):
        return self.frame.part_file(self.part) if self.part else self.frame.image

    @property
    def log(self):
        return os.path.join(self.frame.folder, f"{self.part.number}.log" if self.part else "image.log")

    def arguments(self, record, threads):
        """:param record: arguments of `patina record` for all frames, without --frames
        :returns: those of the command line"""
        frame = self.frame
        shared = [f"--threads={threads}"] if threads else []
        if not self.part and frame.cut.parts > 1:
            files = [frame.part_file(part) for part in frame.parts()]
            return ["merge", *files, frame.image, *shared, *frame.merge_flags]
        # A later flag counts.
        found = ["record", *record, *frame.flags, *shared, "--quiet"]
        # A worker that is told to end leaves nothing that --resume would take for a whole image.
        return found + ([f"--part={self.part}", f"--partial={self.file}"] if self.part else ["--onlyWhole"])


@dataclass
class Frame:
    time: object  # time code; None is the default time
    image: str
    cut: cut.Cut
    flags: list  # that choose the frame
    merge_flags: list = field(default_factory=list)
    left: int = 0  # parts that are not there
    job: str = ""  # that the folder of the parts belongs to, while it does
    user: int = -1  # number of the one whose folder it is

    @property
    def folder(self):
        return os.path.abspath(self.image) + ".parts"

    def parts(self):
        return [cut.Part(number, self.cut) for number in range(1, self.cut.parts + 1)]

    def part_file(self, part):
        return os.path.join(self.folder, f"{part.number}.part")

    def prepare(self, job):
        """Makes the folder of the parts, which belongs to a job from now on.

        :param job: its name
        :raises CommandError: where it belongs to another that may be running, or cannot be made"""
        try:
            os.mkdir(self.folder)
        except FileExistsError:
            pass  # owner.take() looks at what it is
        except OSError as error:
            raise CommandError(f"cannot make the folder {self.folder}: {error.strerror}") from error
        self.user = owner.take(self.folder, job)
        self.job = job

    def tasks(self, there):
        """:param there: numbers of parts whose files are there
        :returns: the tasks that can begin; the merge follows them"""
        if self.cut.parts == 1:
            self.left = 0
            return [Task(self, None)]
        waiting = [Task(self, part) for part in self.parts() if part.number not in there]
        self.left = len(waiting)
        return waiting or [Task(self, None)]

    def tidy(self):
        """Removes parts and logs of an image that is whole; logs of failures stay."""
        self._remove(_DONE)
        self.leave()

    def tidy_after(self, job):
        """Removes what a job has left that was killed after it had written the image. Parts that are newer than the image are
        of another render, and stay."""
        with contextlib.suppress(CommandError, OSError):
            with folders.own(self.folder) as place:
                names = [name for name in place.names() if re.fullmatch(_DONE, name) or name == owner.NAME]
                newest = max((place.changed(name) for name in names if re.fullmatch(_PART, name)), default=0)
            if names and newest <= os.stat(self.image).st_mtime_ns:
                owner.take(self.folder, job)
                self.job = job
                self.tidy()

    def _remove(self, pattern):
        """Removes files of the folder by their names."""
        with contextlib.suppress(CommandError, OSError), folders.own(self.folder) as place:
            for name in place.names():
                if re.fullmatch(pattern, name):
                    with contextlib.suppress(OSError):
                        place.remove(name)

    def kept(self, since):
        """:param since: seconds of the clock, when the job began
        :returns: whether it has left something that --resume goes on with"""
        files = [self.image, checkpoints.path_of(self.image), *map(self.part_file, self.parts() if self.cut.parts > 1 else ())]
        return any(os.path.isfile(file) and os.stat(file).st_mtime >= since for file in files)

    def leave(self):
        """Gives the folder back, and removes it where nothing is in it."""
        if self.job:
            owner.release(self.folder, self.job)
            self.job = ""
        with contextlib.suppress(OSError):
            os.rmdir(self.folder)

    def forget(self):
        """Removes what an earlier job has left: files by the names that a job gives."""
        self._remove(_OWN)

    def check(self, files):
        """:param files: that the render reads
        :raises CommandError: where one lies in the folder of the parts"""
        folder = os.path.realpath(self.folder)
        for file in files:
            if os.path.realpath(file).startswith(folder + os.sep):
                raise CommandError(f"{file} lies in {self.folder}, where parts lie and are removed; name another image")


def parts_there(module, frame, wanted):
    """:param wanted: dict of the record flags that the parts must have been made with
    :returns: numbers of the parts that an earlier job has made of the same stage with the same flags"""
    found = set()
    for part in frame.parts():
        file = frame.part_file(part)
        if os.path.islink(file):  # no job makes one
            continue
        try:
            description = partial.read(module, file)
        except CommandError:
            continue
        same = all(description.arguments.get(name) == value for name, value in wanted.items())
        if same and str(description.part) == str(part) and identity.still_true(module, description.identity, wanted["stage"]):
            found.add(part.number)
    return found
