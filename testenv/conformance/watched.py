# SPDX-License-Identifier: Apache-2.0
"""Runs a program with limits of time and memory, and says how it ended."""
import dataclasses
import os
import signal
import subprocess
import tempfile
import time

TOLD = 20000  # last bytes of standard error that are kept
POLL = 0.01  # seconds
LIMITED = ("/bin/sh", "-c", 'ulimit -v "$0" && ulimit -c 0 && exec "$@"')  # kB, then the program


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


def run(command, environment=None, seconds=60.0, gigabytes=8.0, folder=None):
    """:param gigabytes: of addresses, beyond which memory is refused
    :param folder: to run in: stages may name files that are written
    :returns: an Ending"""
    with tempfile.TemporaryFile() as error:
        start = time.monotonic()
        process = subprocess.Popen([*LIMITED, str(int(gigabytes * (1 << 20))), *map(str, command)], env=environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=error, cwd=folder,
                                   start_new_session=True)
        timed_out, peak = False, 0
        while True:
            peak = _peak(process.pid) or peak
            ended, state = os.waitpid(process.pid, os.WNOHANG)
            if ended:
                break
            if not timed_out and time.monotonic() - start > seconds:
                timed_out = True
                os.killpg(process.pid, signal.SIGKILL)
            time.sleep(POLL)
        process.returncode = os.waitstatus_to_exitcode(state)  # it is waited for: Popen has nothing left to do
        size = error.seek(0, os.SEEK_END)
        error.seek(max(0, size - TOLD))
        return Ending(process.returncode, timed_out, time.monotonic() - start, peak,
                      error.read().decode(errors="replace"))


def _peak(process):
    """What wait4() tells begins with the memory of this process, from which the other was started; the system's count does not.

    :returns: the most bytes that were resident so far, 0 where the process has ended"""
    try:
        with open(f"/proc/{process}/status", encoding="ascii", errors="replace") as file:
            found = [line.split()[1] for line in file if line.startswith("VmHWM:")]
    except OSError:
        return 0
    return int(found[0]) << 10 if found else 0
