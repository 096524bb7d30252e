# SPDX-License-Identifier: Apache-2.0
"""Ctrl+C, the end of a batch job and of a terminal: noted, and not resisted twice."""
import os
import signal
import sys
import threading

NUMBERS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
_early = []  # numbers of signals that came before there was a command


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
    _early.append(number)
    if number in NUMBERS:
        signal.signal(number, signal.SIG_DFL)


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
        module.end_at_second_signal(NUMBERS)


class _Handlers:
    """Within the block, signals that are not ignored (as by nohup) come to _note()."""

    def __init__(self):
        self._before = {}

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            for number in NUMBERS:
                if signal.getsignal(number) not in (signal.SIG_IGN, None):
                    self._before[number] = signal.signal(number, self._note)
            harden()
        return self

    def __exit__(self, *_):
        for number, handler in self._before.items():
            signal.signal(number, handler)
        if Endings.open:
            harden()
        return False


class Interrupts(_Handlers):
    """While a render runs: the first signal sets `met`; the next does what it always does."""

    def __init__(self):
        super().__init__()
        self.met = False

    def _note(self, number, _frame):
        self.met = True
        signal.signal(number, signal.SIG_DFL)


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

    def __enter__(self):
        Endings.open = self
        super().__enter__()
        self.met = next(filter(came_early, NUMBERS), 0)
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
        signal.signal(number, signal.SIG_DFL)
        self._end(number, frame)

    def _end(self, _number, frame):
        if self._settled:
            return
        if not _imports(frame):
            raise KeyboardInterrupt
        if self._timer is None:
            self._timer = signal.signal(signal.SIGALRM, self._end)
        signal.setitimer(signal.ITIMER_REAL, self._POLL_SECONDS)

    def text(self):
        return {"SIGTERM": "terminated", "SIGHUP": "ended with its terminal"}.get(
            signal.Signals(self.met).name if self.met else "", "interrupted")


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
