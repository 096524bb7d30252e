# SPDX-License-Identifier: Apache-2.0
"""Digests of files. Those of large files are kept between processes, by the file's path, size and time of change."""
import contextlib
import hashlib
import json
import os
import tempfile

from patina import inputs
from patina.farm import folders

KEPT_FROM = 1 << 20  # bytes: smaller files are read again
_CHUNK = 1 << 20


def of_file(path):
    """:returns: hexadecimal digest of a file's content
    :raises OSError: where it cannot be read"""
    inputs.check_regular(path)
    status = os.stat(path)
    if status.st_size < KEPT_FROM:
        return content(path)
    place = _place(path)
    state = [status.st_size, status.st_mtime_ns]
    with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
        _prepare(os.path.dirname(place))
        with open(place, encoding="utf-8") as file:
            kept = json.load(file)
            trusted = os.environ.get("PATINA_CACHE") or os.fstat(file.fileno()).st_uid == os.geteuid()
        if trusted and kept["state"] == state:
            return str(kept["digest"])
    digest = content(path)
    with contextlib.suppress(OSError):
        _keep(place, {"state": state, "digest": digest})
    return digest


def content(path):
    """:returns: SHA-256 of a file, hexadecimal"""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        for chunk in iter(lambda: file.read(_CHUNK), b""):
            digest.update(chunk)
    return digest.hexdigest()


def _place(path):
    name = hashlib.sha256(os.path.realpath(path).encode(errors="surrogateescape")).hexdigest()
    return os.path.join(_folder(), name + ".json")


def _folder():
    """:returns: beside what the renderer keeps ($PATINA_CACHE, or the user's own cache)"""
    if os.environ.get("PATINA_CACHE"):
        return os.path.join(os.environ["PATINA_CACHE"], "digests")
    base = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return os.path.join(base, "patina", "digests")


def _prepare(folder):
    """Makes the folder. In the user's own cache others may write neither it nor the one that holds it, whatever umask says."""
    base = os.path.dirname(folder)
    os.makedirs(os.path.dirname(base), exist_ok=True)
    for one in (base, folder):
        if os.environ.get("PATINA_CACHE"):
            os.makedirs(one, exist_ok=True)
        else:
            folders.close(one)


def _keep(place, value):
    _prepare(os.path.dirname(place))
    handle, temporary = tempfile.mkstemp(dir=os.path.dirname(place))
    try:
        with open(handle, "w", encoding="utf-8") as file:
            json.dump(value, file)
        os.replace(temporary, place)
    except OSError:
        with contextlib.suppress(OSError):
            os.remove(temporary)
        raise
