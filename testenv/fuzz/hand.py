# SPDX-License-Identifier: Apache-2.0
"""Runs inputs one by one, each in a process of its own that may die: it has all modules loaded, and forks for each.

Reads lines of JSON from standard input (module, file, folder, action), and answers with a line each."""
import faulthandler
import importlib
import json
import os
import resource
import signal
import sys
import time

CPU_SECONDS = 20  # a module may name more
WALL_SECONDS = 120  # where the machine is busy; at least six times the processor's
BYTES = 6 << 30  # of addresses: Python, USD and the driver's libraries take 2 GiB of them
TOLD = 8000  # bytes of standard error that are answered, of its head and of its tail: a message may repeat a long word


def _child(module, ask):
    error = os.open(os.path.join(ask["folder"], "stderr.txt"), os.O_RDWR | os.O_CREAT | os.O_TRUNC, 0o600)
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, 0)
    os.dup2(null, 1)
    os.dup2(error, 2)
    sys.stdout, sys.stderr = open(1, "w", closefd=False), open(2, "w", errors="replace", closefd=False)
    faulthandler.enable(sys.stderr)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    seconds = getattr(module, "CPU_SECONDS", CPU_SECONDS)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    status = 1
    try:
        execute = ask["action"] == "execute"
        status = module.execute(ask["file"], ask["folder"]) if execute else module.without(ask["file"])
    except BaseException:  # whatever it is, it is told
        import traceback

        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status or 0)


def _head_and_tail(file, size):
    """:returns: the bytes of a file, or where they are more than twice the size its first and last ones"""
    whole = os.fstat(file.fileno()).st_size
    if whole <= 2 * size:
        return file.read()
    head = file.read(size)
    file.seek(whole - size)
    return head + b"\n...\n" + file.read(size)


def _run(module, ask):
    start = time.monotonic()
    process = os.fork()
    if not process:
        _child(module, ask)
    timed_out, most = False, max(WALL_SECONDS, 6 * getattr(module, "CPU_SECONDS", CPU_SECONDS))
    while True:
        ended, state, usage = os.wait4(process, os.WNOHANG)
        if ended:
            break
        if time.monotonic() - start > most and not timed_out:
            timed_out = True
            os.kill(process, signal.SIGKILL)
        time.sleep(0.002)
    number = os.WTERMSIG(state) if os.WIFSIGNALED(state) else 0
    with open(os.path.join(ask["folder"], "stderr.txt"), "rb") as file:
        text = _head_and_tail(file, TOLD).decode(errors="replace")
    return {"status": os.WEXITSTATUS(state) if os.WIFEXITED(state) else -1, "signal": number,
            "timedOut": timed_out or number == signal.SIGXCPU, "seconds": time.monotonic() - start,
            "peak": usage.ru_maxrss * 1024, "error": text}


def main():
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    # loaded once, before any fork
    from pxr import Usd, UsdGeom  # noqa: F401

    import _patina  # noqa: F401
    from patina.cli import bsdf, check, compare, explain, merge, record  # noqa: F401

    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    modules = {}
    for line in sys.stdin:
        ask = json.loads(line)
        if ask["module"] not in modules:
            modules[ask["module"]] = importlib.import_module(ask["module"])
        answers.write(json.dumps(_run(modules[ask["module"]], ask)) + "\n")
        answers.flush()


if __name__ == "__main__":
    main()
