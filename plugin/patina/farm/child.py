# SPDX-License-Identifier: Apache-2.0
"""`python -m patina.farm.child PARENT FOLDER HANDLE ARGUMENTS...`: a command of Patina that ends when the worker that asked for
it does. Files of FOLDER are those of the descriptor HANDLE, whatever has come to stand in its place."""
import functools
import os
import sys
import threading
import time

POLL_SECONDS = 0.5


def _watch(parent):
    while os.getppid() == parent:
        time.sleep(POLL_SECONDS)
    os._exit(1)  # the worker is gone, and someone else renders this part


def _pinned(folder, handle, words):
    """:returns: words that name the folder's files by the descriptor; messages go on naming them by the folder"""
    named, own = folder + os.sep, f"/proc/self/fd/{handle}/"
    for stream in (sys.stdout, sys.stderr):
        stream.write = functools.partial(lambda write, text: write(text.replace(own, named)), stream.write)
    return [word.replace(named, own) for word in words]


def run(arguments):
    from patina.cli import ending, interrupts

    parent, folder, handle, *words = arguments
    interrupts.begin(words[:1])
    from patina.cli import main

    threading.Thread(target=_watch, args=(int(parent),), daemon=True).start()
    return ending.end(main.main(_pinned(folder, handle, words)))


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
