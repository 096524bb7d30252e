# SPDX-License-Identifier: Apache-2.0
"""Folders that others may be able to write: no link is followed, and what is done there is done by descriptor, so that nobody
puts another folder in its place in between."""
import contextlib
import os
import pwd
import stat
import tempfile

from patina.cli.errors import CommandError

_NEW = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
_READ = os.O_RDONLY | os.O_NONBLOCK | os.O_NOFOLLOW | os.O_CLOEXEC


class Folder:
    """An open folder. All of its methods raise OSError."""

    def __init__(self, path, handle):
        self.path, self.handle = path, handle

    @property
    def user(self):
        return os.fstat(self.handle).st_uid

    def names(self):
        return os.listdir(self.handle)

    def changed(self, name):
        """:returns: when a file was written, in nanoseconds"""
        return os.stat(name, dir_fd=self.handle, follow_symlinks=False).st_mtime_ns

    def remove(self, name):
        os.remove(name, dir_fd=self.handle)

    def rename(self, name, other):
        os.replace(name, other, src_dir_fd=self.handle, dst_dir_fd=self.handle)

    def new(self, name):
        """:returns: a descriptor of a file that was not there"""
        return os.open(name, _NEW, 0o666, dir_fd=self.handle)

    def read(self, name, most):
        """:returns: the first bytes of a regular file, so many at most"""
        with open(os.open(name, _READ, dir_fd=self.handle), "rb") as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise OSError(f"{name} is no regular file")
            return file.read(most)


@contextlib.contextmanager
def opened(path):
    """Yields a Folder.

    :raises OSError: where it is none, or a link"""
    handle = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        yield Folder(path, handle)
    finally:
        os.close(handle)


@contextlib.contextmanager
def own(path, others=()):
    """Yields a Folder of this user's.

    :param others: numbers of users whose folder it may be as well
    :raises FileNotFoundError: where there is none
    :raises CommandError: where it is a link, something else, or somebody else's"""
    with contextlib.ExitStack() as stack:
        try:
            folder = stack.enter_context(opened(path))
        except FileNotFoundError:
            raise
        except OSError as error:
            reason = "it is a link; remove it" if os.path.islink(path) else error.strerror
            raise CommandError(f"cannot use the folder {path}: {reason}") from error
        if folder.user not in (os.geteuid(), *others) and folder.user != _maker(path):
            raise CommandError(f"cannot use the folder {path}: it belongs to {_name(folder.user)}; remove it, or name another "
                               "image")
        yield folder


def open_to_others(path):
    """:returns: why this folder holds nothing that is safe from others than this user and root, who might put something in its
    place; an empty text where it does"""
    path = os.path.realpath(path)
    if not os.access(path, os.W_OK | os.X_OK):
        return f"{path} cannot be written"
    while True:
        try:
            found = os.stat(path)
        except OSError as error:
            return f"{path}: {error.strerror}"
        if found.st_uid not in (0, os.geteuid(), _unknown_root()):
            return f"{path} belongs to {_name(found.st_uid)}"
        if found.st_mode & 0o022 and not found.st_mode & stat.S_ISVTX:
            return f"others may rename what is in {path}"
        if path == os.path.dirname(path):
            return ""
        path = os.path.dirname(path)


def _unknown_root():
    """:returns: the number that stands for the host's root in a user namespace (a sandbox) that does not know it; else None"""
    try:
        with open("/proc/self/uid_map", encoding="ascii") as known, open("/proc/sys/fs/overflowuid", encoding="ascii") as other:
            return None if known.read().split() == ["0", "0", "4294967295"] else int(other.read())
    except (OSError, ValueError):
        return None


def close(path):
    """Takes the right to write from all but the user of a folder, which is made where it is missing.

    :raises OSError: where there is none, or it is somebody else's"""
    with contextlib.suppress(FileExistsError):
        os.mkdir(path, 0o700)
    found = os.stat(path)
    if found.st_uid != os.geteuid():
        raise PermissionError(f"{path} belongs to {_name(found.st_uid)}")
    if found.st_mode & 0o022:
        os.chmod(path, stat.S_IMODE(found.st_mode) & ~0o022)


def _maker(path):
    """:returns: whose a new file beside a folder is, None where this process makes none there. File systems of others may give
    all files to one user, which is then not the process's"""
    try:
        with tempfile.TemporaryFile(dir=os.path.dirname(path)) as file:
            return os.fstat(file.fileno()).st_uid
    except OSError:
        return None


def _name(uid):
    try:
        return pwd.getpwuid(uid).pw_name
    except KeyError:
        return f"user {uid}"
