# SPDX-License-Identifier: Apache-2.0
"""usdrecord for one image after the other, as hydraBuild.py's _Server asks for them: to load OpenUSD and the plugin takes
longer than a small image."""
import os
import runpy
import sys
import traceback


def attempt(script, words):
    """:returns: the exit status"""
    sys.argv = [script, *words]
    try:
        runpy.run_path(script, run_name="__main__")
    except SystemExit as end:
        return end.code or 0
    except Exception:
        traceback.print_exc()
        return 1
    return 0


def serve(script):
    with os.fdopen(os.dup(1), "w") as answers:
        for line in sys.stdin:
            *streams, words = line.rstrip("\n").split("\t", 2)
            for path, number in zip(streams, (1, 2)):
                file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
                os.dup2(file, number)
                os.close(file)
            status = attempt(script, words.split("\t"))
            sys.stdout.flush()
            sys.stderr.flush()
            print(status, file=answers, flush=True)


serve(sys.argv[1])
