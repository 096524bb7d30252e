# SPDX-License-Identifier: Apache-2.0
"""The second signal ends a command, whatever it does. One that comes twice at once is no second one."""
import os
import signal
import subprocess
import sys

import pytest

from test_signals import _folder  # noqa: F401

HERE = os.path.dirname(os.path.abspath(__file__))


def run(program):
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)


def test_the_second_signal_ends_what_hears_none(folder):
    """As a library does that computes without end: both come in one call into C, after which Python's handlers would run."""
    program = """
import os, signal, sys
from patina.cli import compiled, explain, main
def run(_):
    compiled.load()
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT, signal.SIGTERM])
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.raise_signal(number)  # waits for this thread; one of the process would go to a thread that blocks none
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT, signal.SIGTERM])
explain.run = run
sys.exit(main.main(["explain", "m.mtlx"]))
"""
    done = run(program)
    assert done.returncode in (-signal.SIGINT, -signal.SIGTERM) and done.stderr == ""


# A render that is ended by SIGTERM.
RENDER = f"""
import os, signal, sys
sys.path += {[HERE, os.path.dirname(HERE)]!r}
from test_signals import LONG, _patina, _Signals, interrupts, main, record, send
times = 1
make, write = _patina.make_renderer, record._Job._write
_patina.make_renderer = lambda backend: _Signals(make(backend), signal.SIGTERM, times)
%s
sys.exit(main.main(["record", "stage.usda", "a.exr", *LONG]))
"""


def test_the_second_signal_ends_a_command_whose_render_is_over(folder):
    """As while it denoises, or writes the image."""
    done = run(RENDER % """
def signalled(*arguments):
    send(signal.SIGINT)
    write(*arguments)
record._Job._write = signalled
""")
    assert done.returncode == -signal.SIGINT and done.stderr == "" and not os.path.exists("a.exr")


def test_a_signal_that_comes_twice_at_once_saves_the_image(folder):
    """`timeout` sends it to a process, and then to the group that the process is in."""
    done = run(RENDER % "times, interrupts.ONCE_SECONDS = 2, 3600.0")
    assert done.returncode == 75 and "--resume continues" in done.stderr
    assert sorted(os.listdir()) == ["a.exr", "a.exr.checkpoint", "stage.usda"]


@pytest.mark.parametrize("compiled", (False, True), ids=("python", "compiled"))
@pytest.mark.parametrize("seconds, status, said", [(3600.0, 1, "patina: terminated\n"), (0.0, -signal.SIGTERM, "")],
                         ids=("at once", "later"))
def test_a_signal_that_comes_again_is_the_second_when_it_is_late(folder, seconds, status, said, compiled):
    program = f"""
import os, signal, sys
from patina.cli import compiled, explain, interrupts, main
interrupts.ONCE_SECONDS = {seconds}
def run(_):
    if {compiled}:
        compiled.load()
    try:
        os.kill(os.getpid(), signal.SIGTERM)
        for _ in range(100000):  # until the signal is handled
            pass
    except KeyboardInterrupt:
        os.kill(os.getpid(), signal.SIGTERM)
        raise
explain.run = run
sys.exit(main.main(["explain", "m.mtlx"]))
"""
    done = run(program)
    assert (done.returncode, done.stderr) == (status, said)
