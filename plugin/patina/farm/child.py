# SPDX-License-Identifier: Apache-2.0
"""`python -m patina.farm.child PARENT ARGUMENTS...`: a command of Patina that ends when the worker that asked for it does."""
import os
import sys
import threading
import time

POLL_SECONDS = 0.5


def _watch(parent):
    while os.getppid() == parent:
        time.sleep(POLL_SECONDS)
    os._exit(1)  # the worker is gone, and someone else renders this part


def run(arguments):
    from patina.cli import ending, interrupts

    interrupts.begin(arguments[1:2])
    from patina.cli import main

    threading.Thread(target=_watch, args=(int(arguments[0]),), daemon=True).start()
    return ending.end(main.main(arguments[1:]))


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
