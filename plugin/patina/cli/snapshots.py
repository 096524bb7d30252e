# SPDX-License-Identifier: Apache-2.0
"""Images of a render while it runs: every so many seconds, and when SIGUSR1 asks for one. Each appears whole, beside the image
that the render will write, and goes when that is written."""
import contextlib
import os
import signal
import threading
import time

from patina.cli import interrupts, outputs
from patina.cli.errors import CommandError, is_temporary

SUFFIX = "_part"  # husk's


def path_of(image, suffix):
    """:returns: where the snapshot of an image lies: its name with the suffix before the extension"""
    stem, extension = os.path.splitext(image)
    return stem + suffix + extension


class Snapshots:
    """Within the block SIGUSR1 asks for a snapshot instead of ending the process. One that is asked for before there are
    samples is taken when there are."""

    def __init__(self, seconds):
        """:param seconds: between two; 0: only those that are asked for"""
        self._seconds, self._write = seconds, None
        self._last = None  # when the last one was, or the first samples were there
        self._asked = False
        self._before = None
        self._images = {}  # real path -> name of every image that the command writes
        self._written = []  # of the render that runs

    def __enter__(self):
        if hasattr(signal, "SIGUSR1") and threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGUSR1, self._ask)
            self._asked = interrupts.came_early(signal.SIGUSR1)
        return self

    def __exit__(self, *_):
        self._write = None  # it holds the stage, which the next reader of the file would find unchanged
        if self._before is not None:
            signal.signal(signal.SIGUSR1, self._before)
        return False

    def check(self, images, suffix):
        """Says whether snapshots may be written.

        :param images: the command writes, of all renders
        :raises CommandError: where one would take the place of an image, or of a file that is read"""
        self._images = {os.path.realpath(image): image for image in images}
        for image in images if self._seconds > 0.0 else ():
            self.place_of(image, suffix)

    def place_of(self, image, suffix):
        """:returns: where the snapshot of an image may be written
        :raises CommandError: where it may not"""
        path = path_of(image, suffix)
        outputs.check(path)
        taken = self._images.get(os.path.realpath(path))
        if taken:
            raise CommandError(f"cannot write '{path}': it is a snapshot's name and that of the image {taken}; "
                               "--snapshotSuffix makes others")
        return path

    def wrote(self, path):
        """Notes a snapshot that goes with the render."""
        if path not in self._written:
            self._written.append(path)

    def remove(self):
        """Removes what this render wrote: its images are there."""
        for path in self._written:
            with contextlib.suppress(OSError):
                os.remove(path)
        self._written = []

    def begin(self, write):
        """Another render starts.

        :param write: function(film) that writes a snapshot of it"""
        self._write, self._last, self._written = write, None, []

    def _ask(self, *_):
        self._asked = True

    def look(self, renderer, film):
        """Takes one where it is time. To be called often, once the whole image has samples.

        :returns: None, or an error: the render is worth more than a snapshot"""
        now = time.monotonic()
        if self._last is None:
            self._last = now
        if not self._asked and not (0.0 < self._seconds <= now - self._last):
            return None
        self._asked = False
        renderer.pause()  # no thread works on the film while it is copied
        try:
            copy = film.copy()
        except MemoryError as error:
            return error
        finally:
            renderer.resume()
        try:
            self._write(copy)
        except Exception as error:  # a folder that is gone is told; the render goes on
            return error
        finally:
            self._last = time.monotonic()
        return None


def message(error):
    """:returns: id and field of a message why there is no snapshot"""
    return "snapshotLater" if is_temporary(error) else "snapshotMissing", error
