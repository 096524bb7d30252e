# SPDX-License-Identifier: Apache-2.0
"""Shows how far a command is: one line that moves on a terminal, a line now and then elsewhere."""
import shutil
import sys
import time

from patina.cli import causes, colours

BAR = 30
SPARSE_SECONDS = 10.0


def _clock(seconds):
    seconds = int(seconds + 0.5)
    if seconds < 60:
        return f"{seconds} s"
    if seconds < 3600:
        return f"{seconds // 60}:{seconds % 60:02d} min"
    return f"{seconds // 3600}:{seconds // 60 % 60:02d} h"


def _noise(state):
    """:returns: the noise reached, or the denoised image's error, and that which ends the render, where a tolerance asks for
        one"""
    wanted, reached, what = state.get("noiseWanted", 0.0), state.get("noise", -1.0), "noise"
    if "denoisedError" in state.get("statistics", {}):
        reached, what = state["statistics"]["denoisedError"], "denoised error"
    return f"{what} {100 * reached:.2g} %, {100 * wanted:.2g} % is asked for  " if wanted > 0.0 and reached >= 0.0 else ""


class Progress:
    """Writes to standard error; nothing when quiet."""

    def __init__(self, label, quiet=False, stream=None):
        self.stream = stream or sys.stderr
        self.label, self.quiet = label, quiet
        self.terminal = not quiet and self.stream.isatty()
        self.started = time.monotonic()
        self.last = self.started - (1.0 if self.terminal else 0.0)  # on a terminal the first line comes at once

    def show(self, state):
        """:param state: what Renderer.progress() says"""
        if not self._due():
            return
        fraction = min(max(state["fraction"], 0.0), 1.0)
        text = f"{100 * fraction:3.0f} %  {_noise(state)}{state.get('samplesMean', state['samplesDone']):.4g} samples"
        if fraction == 0.0 and state["samplesDone"] == 0:  # shapes, textures, and what drivers compile
            text = self._preparing(state, self.last)
        elif state["secondsLeft"] > 0.5:
            text += f"  {_clock(state['secondsLeft'])} left"
        self._write(fraction, text)

    def step(self, done, total, what):
        """Of work in equal steps; the time left follows from what they took so far.

        :param done, total: numbers of steps, of which the total may still be a guess
        :param what: is done now"""
        if done >= total > 0 or not self._due():
            return
        fraction = max(done / total, 0.0) if total > 0 else 0.0
        left = f"{_clock((self.last - self.started) * (1.0 - fraction) / fraction)} left  " if fraction > 0.0 else ""
        self._write(fraction, f"{100 * fraction:3.0f} %  {left}{what}")

    def _due(self):
        """:returns: whether it is time for the next line"""
        now = time.monotonic()
        if self.quiet or now - self.last < (0.1 if self.terminal else SPARSE_SECONDS):
            return False
        self.last = now
        return True

    def _write(self, fraction, text):
        if self.terminal:
            filled = int(BAR * fraction + 0.5)
            bar = f" [{'#' * filled}{'.' * (BAR - filled)}] "
            # A line that wraps would stay: long labels, which are paths, show their ends.
            room = shutil.get_terminal_size().columns - 1
            maximum = max(room - len(bar) - len(text), 12)
            label = causes.printable(self.label)
            label = label if len(label) <= maximum else "..." + label[3 - maximum:]
            self.stream.write("\r\033[K" + (label + bar + causes.printable(text))[:room])
        else:
            self.stream.write(causes.printable(f"{self.label}: {text}") + "\n")
        self.stream.flush()

    def _preparing(self, state, now):
        statistics = state.get("statistics", {})
        ready, wanted = (int(statistics.get(name, 0)) for name in ("materialsReady", "materialsWanted"))
        drawn = int(statistics.get("materialsDrawn", 0))
        if ready >= wanted:
            return f"preparing for {_clock(now - self.started)}" + (f", drawn {drawn} of {wanted} materials" if drawn else "")
        left = f", about {_clock(state['secondsLeft'])} left" if state["secondsLeft"] > 0.5 else ""
        return f"compiled {ready} of {wanted} materials{left}"

    def clear(self):
        """Leaves an empty line for what is printed next."""
        if self.terminal:
            self.stream.write("\r\033[K")
            self.stream.flush()

    def say(self, text):
        if not self.quiet:
            self.clear()
            print(colours.painted(causes.printable(text), self.stream), file=self.stream)
