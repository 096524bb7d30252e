# SPDX-License-Identifier: Apache-2.0
"""Runs a command again and again, each time with another of the calls that write failing, and then with none; tells a line of
JSON for each. Of many equal calls in a row the first two, one in the middle and the last stand for all. Started with failNth.c
preloaded, its library the first argument.

Usage: faultyHost.py LIBRARY FOLDER ERRNO COMMAND..."""
import ctypes
import glob
import hashlib
import json
import os
import sys

OLD = "an image that was there before"
NEVER = 1 << 30  # a call that does not come


def _child(library, folder, at, number, words):
    from patina.cli import main

    error = os.open(os.path.join(os.path.dirname(folder), "stderr.txt"), os.O_RDWR | os.O_CREAT | os.O_TRUNC, 0o600)
    os.dup2(error, 2)
    sys.stderr = open(2, "w", errors="replace", closefd=False)
    library.failNthBegin(folder.encode(), at, number)
    status = main.main(words)
    library.failNthWhich.restype = library.failNthTrace.restype = ctypes.c_char_p
    sys.stderr.flush()
    which = (library.failNthTrace if at == NEVER else library.failNthWhich)().decode()
    library.failNthBegin(folder.encode(), 0, 0)
    with open(os.path.join(os.path.dirname(folder), "which.txt"), "w", encoding="utf-8") as file:
        file.write(which)
    os._exit(status)


def main():
    library, folder, number = ctypes.CDLL(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    # loaded once, before any fork
    import numpy  # noqa: F401
    from pxr import Usd, UsdGeom  # noqa: F401

    import _patina  # noqa: F401
    from patina.cli import merge, record  # noqa: F401

    calls = _run(library, folder, NEVER, number)["which"].split()
    for at in _chosen(calls):
        print(json.dumps(_run(library, folder, at, number)), flush=True)
    print(json.dumps(dict(_run(library, folder, NEVER, number), which="")), flush=True)


def _chosen(calls):
    """:returns: numbers of the calls that fail, from 1"""
    found, start = [], 0
    for end in range(1, len(calls) + 1):
        if end == len(calls) or calls[end] != calls[start]:
            found += sorted({start + 1, min(start + 2, end), (start + 1 + end) // 2, end})
            start = end
    return found


def _whole(image):
    """:returns: whether an image can be read. By a process of its own: OpenEXR's threads, once started here, would be missing
    in
        every process that is forked later, which waits for them for ever"""
    process = os.fork()
    if not process:
        import _patina

        try:
            _patina.read_image(image)
        except (OSError, RuntimeError):
            os._exit(1)
        os._exit(0)
    return os.waitpid(process, 0)[1] == 0


def _run(library, folder, at, number):
    """:returns: what became of the command, its files and its words"""
    for name in glob.glob(os.path.join(glob.escape(folder), "*")):
        os.remove(name)
    images = [word for word in sys.argv[4:] if word.startswith(folder)]
    for image in images:
        with open(image, "w", encoding="utf-8") as file:
            file.write(OLD)
    process = os.fork()
    if not process:
        _child(library, folder, at, number, sys.argv[4:])
    _, state = os.waitpid(process, 0)
    told = {"at": at, "status": os.waitstatus_to_exitcode(state), "files": sorted(os.listdir(folder)), "images": {},
            "whole": True}
    for name, key in (("stderr.txt", "error"), ("which.txt", "which")):
        with open(os.path.join(os.path.dirname(folder), name), encoding="utf-8", errors="replace") as file:
            told[key] = file.read()
    for image in images:
        with open(image, "rb") as file:
            data = file.read()
        told["images"][os.path.basename(image)] = "old" if data == OLD.encode() else hashlib.sha256(data).hexdigest()
        if image.endswith((".exr", ".png")) and data != OLD.encode():
            told["whole"] = told["whole"] and _whole(image)
    return told


if __name__ == "__main__":
    main()
