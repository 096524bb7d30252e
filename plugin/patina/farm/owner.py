# SPDX-License-Identifier: Apache-2.0
"""The job that a folder of parts belongs to, told by a file in it: two jobs of one image would remove each other's parts."""
import contextlib
import errno
import fcntl
import json
import os
import socket

from patina.cli.errors import CommandError
from patina.farm import folders

NAME = "owner.json"
_LONGEST = 4096  # bytes of the file


def path_of(folder):
    return os.path.join(folder, NAME)


def check(folder, job):
    """:param job: a name
    :raises CommandError: where the folder is not this user's, or belongs to another job, which may be running"""
    with contextlib.suppress(FileNotFoundError), folders.own(folder) as place:
        _check(place, job)


def _check(place, job):
    if NAME not in place.names():
        return
    path, found = path_of(place.path), _read(place)
    if found is None:
        raise CommandError(f"{path} does not tell whose it is; remove it if no job renders this image")
    if found["job"] != job and not _is_gone(found):
        raise CommandError(f"process {found['pid']} on {found['host']} renders this image; remove {path} if it has ended")


def take(folder, job):
    """Makes the folder this job's, where that of its last owner has ended.

    :returns: number of the user whose folder it is
    :raises CommandError: where it belongs to another job, or the file cannot be written"""
    path = path_of(folder)
    told = json.dumps({"host": socket.gethostname(), "pid": os.getpid(), "begun": _begun(os.getpid()), "job": job})
    try:
        with folders.own(folder) as place, _alone(place):
            _check(place, job)
            with contextlib.suppress(FileNotFoundError):
                place.remove(NAME)
            handle = place.new(NAME)
            try:
                _write(handle, place, told.encode())
            finally:
                os.close(handle)
            return place.user
    except (BlockingIOError, FileExistsError):
        raise CommandError(f"{path} is of another job that begins just now; remove it if no job renders this image") from None
    except OSError as error:
        raise CommandError(f"cannot write {path}: {error.strerror}") from error


@contextlib.contextmanager
def _alone(place):
    """Of two jobs that find the same owner gone, one takes its place. Owners of other machines are never found gone, so that a
    lock of this machine is enough; a file system without locks of folders goes without.

    :raises BlockingIOError: while another job takes the folder"""
    try:
        fcntl.flock(place.handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise
    except OSError:
        pass
    yield  # the lock goes with the descriptor


def _write(handle, place, data):
    try:
        if os.write(handle, data) != len(data):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    except OSError:  # half of it would tell nothing, and stop every job
        with contextlib.suppress(OSError):
            place.remove(NAME)
        raise


def release(folder, job):
    """Removes the file where it is this job's."""
    with contextlib.suppress(CommandError, OSError), folders.own(folder) as place:
        found = _read(place)
        if found and found["job"] == job:
            place.remove(NAME)


def _read(place):
    """:returns: dict of what the file says, or None where it says nothing that can be trusted"""
    try:
        found = json.loads(place.read(NAME, _LONGEST))
        texts = isinstance(found["host"], str) and isinstance(found["job"], str)
        return found if texts and type(found["pid"]) is int and 0 < found["pid"] < 1 << 31 else None
    except (KeyError, OSError, RecursionError, TypeError, ValueError):
        return None


def _is_gone(found):
    """:returns: whether the process has ended for certain: of another host that is not known"""
    if found["host"] != socket.gethostname():
        return False
    try:
        os.kill(found["pid"], 0)
    except ProcessLookupError:
        return True
    except OSError:  # of another user
        return False
    # A later process may have its number, as after a container was started again.
    begun = _begun(found["pid"])
    return begun is not None and found.get("begun") is not None and begun != found["begun"]


def _begun(pid):
    """:returns: when a process began, in ticks since the machine did; -1 where it has ended and nobody has noticed, None where
        the system does not tell"""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
            state, *numbers = file.read().rpartition(")")[2].split()
        return -1 if state in "ZX" else int(numbers[18])
    except (IndexError, OSError, ValueError):
        return None
