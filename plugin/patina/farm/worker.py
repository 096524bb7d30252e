# SPDX-License-Identifier: Apache-2.0
"""The work of a farm's worker. Everything goes through paths that the worker shares with the sender."""
import contextlib
import itertools
import os
import socket
import subprocess
import sys
import time

from patina.cli import interrupts
from patina.cli.errors import TEMPORARY, CommandError, is_temporary
from patina.farm import folders

_TAIL = 1 << 16  # bytes that a command prints last, with the reason of a failure
_SIGKILL = 9  # by which the kernel ends what takes too much memory
# Statuses of commands that may do it when they are run again.
PASSING = (TEMPORARY, -_SIGKILL, *(-int(number) for number in interrupts.NUMBERS))
_checked = {}  # job -> problems of this process


class Refused(Exception):
    """This worker cannot take parts of the job: nothing is wrong with the part. The reason, and the worker's address."""


class PartFailed(Exception):
    """A command ended with a reason, its log lies in a file. The reason, the worker's address, and whether it may pass."""


def check(job, files, folders, machine, home=None):
    """:param job: a name; what was found of files is kept for it. The build is looked at each time: a checkout may be built
        anew while a job runs
    :param files: that the render reads
    :param folders: that it writes to
    :param machine: identity.of_machine() that the worker must have; None takes any
    :param home: the folder that commands run in
    :returns: list of problems, in words"""
    if job not in _checked:
        _checked[job] = _problems(files, folders, home)
    return _checked[job] + _differences(machine)


def _problems(files, folders, home):
    found = [f"cannot read {file}" for file in files if not os.access(file, os.R_OK)]
    found += [f"cannot write to {folder}" for folder in folders if not os.access(folder, os.W_OK | os.X_OK)]
    if home and not (os.path.isdir(home) and os.access(home, os.X_OK)):
        found.append(f"cannot enter {home}")
    return found


def _differences(machine):
    try:
        import _patina

        from patina.farm import identity

        own = identity.of_machine(_patina)
    except (ImportError, OSError) as error:
        return [f"has no Patina: {error}"]
    return [f"{name} is {own[name]}, not {value}" for name, value in (machine or {}).items() if own.get(name) != value]


# `-m patina.farm.child`, but for what lies in the folder of the sender: a patina/ there is not meant.
_CHILD = ("import sys; sys.path[:] = [folder for folder in sys.path if folder]; import runpy; "
          "runpy.run_module('patina.farm.child', run_name='__main__', alter_sys=True)")


class _Log:
    """The file that takes what a command prints, within the block. It is made anew: what others put in its place in a shared
    folder, as a link or a pipe, is removed.

    :raises PartFailed: with the reason in one line, where there can be none, or the folder is neither the user's nor this
        process's"""

    def __init__(self, path, user):
        self._path, self._name, self._open = path, os.path.basename(path), contextlib.ExitStack()
        self._user = user
        self._end = b""

    def __enter__(self):
        try:
            self.folder = self._open.enter_context(folders.own(os.path.dirname(self._path), (self._user,)))
            with contextlib.suppress(FileNotFoundError):
                self.folder.remove(self._name)
            self._file = self._open.enter_context(open(self.folder.new(self._name), "wb", buffering=0))
        except (OSError, CommandError) as error:
            self._open.close()
            reason = f"cannot write {self._path}: {error.strerror}" if isinstance(error, OSError) else str(error)
            raise PartFailed(reason, place()[2], is_temporary(error)) from error
        return self

    def __exit__(self, *_):
        self._open.close()

    def remove(self):
        with contextlib.suppress(OSError):  # what was asked for is done, whatever became of its log
            self.folder.remove(self._name)

    def keep(self):
        """Gives it a name of its own, which no other failure has. :returns: its path"""
        stem = f"{self._name[:-len('.log')]}.{time.strftime('%Y%m%d-%H%M%S')}.{os.getpid()}"
        for number in itertools.count(1):
            kept = stem + (f".{number}" if number > 1 else "") + ".failed.log"
            try:
                os.close(self.folder.new(kept))
                self.folder.rename(self._name, kept)
            except FileExistsError:
                continue
            except OSError:  # the reason counts, with its log or without
                with contextlib.suppress(OSError):
                    self.folder.remove(kept)
            return os.path.join(os.path.dirname(self._path), kept)

    def take(self, said):
        """:param said: bytes. The reason of a failure is kept, though the log's disk may be full"""
        self._end = (self._end + said)[-_TAIL:]
        with contextlib.suppress(OSError):
            self._file.write(said)

    def last_line(self):
        """:returns: an empty text where there is none"""
        lines = [line.strip() for line in self._end.decode(errors="replace").splitlines() if line.strip()]
        return lines[-1] if lines else ""


def run(arguments, folder, log, checks, variables=None, user=-1):
    """Runs a command of Patina in a process of its own.

    :param arguments: of the command line
    :param folder: that the sender runs in
    :param log: path of the file that takes what it prints; it is removed when all is well
    :param checks: arguments of check()
    :param variables: of the sender's environment, on which images depend; None where one is not set
    :param user: number of the one whose folder the sender has made for the log
    :returns: dict of the worker's name, host and address, and the seconds that it took
    :raises Refused: where this worker should not take it
    :raises PartFailed: with the reason in one line"""
    name, host, address = place()
    problems = check(*checks)
    if problems:
        raise Refused(f"{name} {words(problems)}", address)
    begin = time.perf_counter()
    with _Log(log, user) as kept:
        handle = kept.folder.handle  # the command writes there, whatever comes in the folder's place meanwhile
        command = [sys.executable, "-c", _CHILD, str(os.getpid()), kept.folder.path, str(handle), *arguments]
        environment = {name: value for name, value in {**os.environ, **(variables or {})}.items() if value is not None}
        status = _execute(command, kept.take, cwd=folder, env=environment, pass_fds=[handle])
        if status != 0:
            reason = f"killed by signal {-status}" if status < 0 else kept.last_line() or f"it ended with status {status}"
            raise PartFailed(f"{reason} (on {name}, see {kept.keep()})", address, status in PASSING)
        kept.remove()
    return {"worker": name, "host": host, "address": address, "seconds": time.perf_counter() - begin}


def _execute(command, take, **options):
    """:param take: function of bytes that the command prints; options: of subprocess.Popen
    :returns: the command's status"""
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          **options) as process:
        while said := os.read(process.stdout.fileno(), _TAIL):
            take(said)
    return process.returncode


def nothing():
    """A task that tells what sending one costs."""


def words(problems):
    """:returns: problems in one line"""
    return problems[0] + (f", and {len(problems) - 1} more" if len(problems) > 1 else "")


def place():
    """:returns: this worker's name, its host, and its address in Dask"""
    host = socket.gethostname()
    try:
        from distributed import get_worker

        own = get_worker()
    except (ImportError, ValueError):
        return str(os.getpid()), host, ""
    return str(own.name), host, own.address
