"""Ctrl+C and the end of a batch job, while a render runs: noted first, and not resisted twice."""
import signal
import threading


class Interrupts:
    """Within the block, the first SIGINT or SIGTERM sets `met`; the next does what it always does."""

    def __init__(self):
        self.met = False
        self._before = {}

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGINT, signal.SIGTERM):
                self._before[number] = signal.signal(number, self._note)
        return self

    def _note(self, number, _frame):
        self.met = True
        signal.signal(number, signal.SIG_DFL)

    def __exit__(self, *_):
        for number, handler in self._before.items():
            signal.signal(number, handler)
        return False
