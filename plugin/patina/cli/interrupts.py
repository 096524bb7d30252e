# SPDX-License-Identifier: Apache-2.0
"""Ctrl+C, the end of a batch job and of a terminal: noted, and not resisted twice."""
import contextlib
import os
import signal
import sys
import threading
import time

NUMBERS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
# The same signal counts once within this time: `timeout` sends it to a process, and at once again to its group. Who presses a
# key again takes longer.
ONCE_SECONDS = 0.3
_early = []  # numbers of signals that came before there was a command


class _Count:
    """Tells the first signal from the second, at which it ends the process."""

    def __init__(self):
        self._first = None  # (number, when)

    def begins(self, number):
        """:returns: whether a signal is the first"""
        now = time.monotonic()
        if self._first and (number != self._first[0] or now - self._first[1] > ONCE_SECONDS):
            signal.signal(number, signal.SIG_DFL)
            os.kill(os.getpid(), number)
        first, self._first = not self._first, self._first or (number, now)
        return first


_count = _Count()  # of signals that came before there was a command


def begin(command):
    """Notes signals while the command is imported. To be called before all else; the launcher holds signals until then.

    :param command: list of its name"""
    for number in NUMBERS:
        if signal.getsignal(number) not in (signal.SIG_IGN, None):
            signal.signal(number, _note_early)
    if command == ["record"] and hasattr(signal, "SIGUSR1"):  # it asks for a snapshot, and would end the process
        signal.signal(signal.SIGUSR1, _note_early)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [*NUMBERS, getattr(signal, "SIGUSR1", signal.SIGINT)])


def _note_early(number, _frame):
    if number not in NUMBERS or _count.begins(number):
        _early.append(number)


def came_early(number):
    """:returns: whether a signal came before there was a command; it is told once"""
    found = number in _early
    _early[:] = [other for other in _early if other != number]
    return found


def harden():
    """Ends the process at the second signal, also while it is in the code of a library, where no handler of Python runs: as
    while OpenUSD composes a stage. Needs the compiled module."""
    module = sys.modules.get("_patina")
    if module and threading.current_thread() is threading.main_thread():
        module.end_at_second_signal(NUMBERS, ONCE_SECONDS)


class _Handlers:
    """Within the block, the first signal that is not ignored (as by nohup) comes to _note(); the next ends the process."""

    def __init__(self):
        self._before, self._count = {}, _Count()

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            for number in NUMBERS:
                if signal.getsignal(number) not in (signal.SIG_IGN, None):
                    self._before[number] = signal.signal(number, self._hear)
            harden()
        return self

    def __exit__(self, *_):
        for number, handler in self._before.items():
            signal.signal(number, handler)
        if Endings.open:
            harden()
        return False

    def _hear(self, number, frame):
        if self._count.begins(number):
            self._note(number, frame)


class Interrupts(_Handlers):
    """While a render runs: the first signal sets `met`. The next ends the process, also after the block."""

    def __init__(self):
        super().__init__()
        self.met = False

    def __exit__(self, *problem):
        return False if self.met else super().__exit__(*problem)

    def _note(self, *_):
        self.met = True


class Endings(_Handlers):
    """While a command runs: the first signal ends it as an exception does, so that what it has begun is tidied up.

    Imports are let end first: libraries print an exception that comes into theirs. `met` stays set, because libraries also
    turn it into others or drop it: check() then raises it again."""

    open = None  # that of the command that runs
    _POLL_SECONDS = 0.01

    def __init__(self):
        super().__init__()
        self.met = 0
        self._timer = None  # what SIGALRM did before
        self._settled = False
        self.holds = False  # the first signal waits

    def __enter__(self):
        global _count
        Endings.open = self
        super().__enter__()
        self.met = next(filter(came_early, NUMBERS), 0)
        if self.met:
            self._count, _count = _count, _Count()
        return self

    def __exit__(self, *problem):
        Endings.open = None
        self._disarm()
        if self._timer is not None:
            signal.signal(signal.SIGALRM, self._timer)
        return super().__exit__(*problem)

    @staticmethod
    def check():
        """:raises KeyboardInterrupt: where the command that runs was told to end"""
        if Endings.open and Endings.open.met:
            Endings.open._disarm()  # one exception: a second one would come into what tidies up after the first
            raise KeyboardInterrupt

    def settle(self):
        """The command has ended: nothing interrupts what is told of it. A second signal still does what it always does."""
        self._settled = True
        self._disarm()

    def _disarm(self):
        if self._timer is not None:
            signal.setitimer(signal.ITIMER_REAL, 0.0)

    def _note(self, number, frame):
        self.met = number
        self._end(number, frame)

    def _end(self, _number, frame):
        if self._settled or self.holds:
            return
        if not _imports(frame):
            raise KeyboardInterrupt
        if self._timer is None:
            self._timer = signal.signal(signal.SIGALRM, self._end)
        signal.setitimer(signal.ITIMER_REAL, self._POLL_SECONDS)

    def text(self):
        return {"SIGTERM": "terminated", "SIGHUP": "ended with its terminal"}.get(
            signal.Signals(self.met).name if self.met else "", "interrupted")


@contextlib.contextmanager
def held():
    """Within the block the first signal waits for the end of the block: for a call that leaves half of its work where an
    exception comes."""
    endings = Endings.open
    if endings:
        endings.holds = True
    try:
        yield
    finally:
        if endings:
            endings.holds = False
    Endings.check()


def _imports(frame):
    """:returns: whether a module is being imported in a frame or above it"""
    while frame:
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False


def hold_standard_streams():
    """Opens what was closed (`2>&-`) as /dev/null: else the first file that is written would take its place, and
    the messages of libraries would go into that file."""
    for descriptor in (0, 1, 2):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
