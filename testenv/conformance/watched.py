# SPDX-License-Identifier: Apache-2.0
"""Runs a program with limits of time and memory, and says how it ended."""
import dataclasses
import os
import resource
import signal
import subprocess
import tempfile
import time

TOLD = 20000  # last bytes of standard error that are kept
POLL = 0.01  # seconds


@dataclasses.dataclass
class Ending:
    """Of a process. `status`: its exit status, or -N for signal N; `peak`: resident memory in bytes"""
    status: int
    timed_out: bool
    seconds: float
    peak: int
    error: str

    def word(self):
        """:returns: ok, message, crash, timeout or memory"""
        if self.timed_out:
            return "timeout"
        if self.status == 0:
            return "ok"
        if "bad_alloc" in self.error or "out of memory" in self.error or "MemoryError" in self.error:
            return "memory"
        if self.status < 0 or "Traceback (most recent call last)" in self.error:
            return "crash"
        return "message" if self.reason() else "crash"

    def reason(self):
        """:returns: the last line that was said, or the signal that ended the process"""
        lines = [line.strip() for line in self.error.splitlines() if line.strip()]
        if self.status < 0:
            return f"signal {-self.status} ({signal.Signals(-self.status).name})"
        return lines[-1] if lines else ""


def run(command, environment=None, seconds=60.0, gigabytes=8.0):
    """:param gigabytes: of addresses, beyond which memory is refused
    :returns: an Ending"""
    with tempfile.TemporaryFile() as error:
        start = time.monotonic()
        process = subprocess.Popen([str(word) for word in command], env=environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=error, start_new_session=True)
        _limit(process.pid, int(gigabytes * (1 << 30)))
        timed_out = False
        while True:
            ended, state, usage = os.wait4(process.pid, os.WNOHANG)
            if ended:
                break
            if not timed_out and time.monotonic() - start > seconds:
                timed_out = True
                os.killpg(process.pid, signal.SIGKILL)
            time.sleep(POLL)
        process.returncode = os.waitstatus_to_exitcode(state)  # it is waited for: Popen has nothing left to do
        size = error.seek(0, os.SEEK_END)
        error.seek(max(0, size - TOLD))
        return Ending(process.returncode, timed_out, time.monotonic() - start, usage.ru_maxrss * 1024,
                      error.read().decode(errors="replace"))


def _limit(process, size):
    """A process that has ended already needs no limit."""
    try:
        resource.prlimit(process, resource.RLIMIT_AS, (size, size))
        resource.prlimit(process, resource.RLIMIT_CORE, (0, 0))
    except ProcessLookupError:
        pass
