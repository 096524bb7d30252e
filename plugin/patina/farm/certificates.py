# SPDX-License-Identifier: Apache-2.0
"""Certificates of a farm's connections. Dask runs what anybody sends who connects; with TLS only who has the key connects."""
import contextlib
import os
import stat
import tempfile

from patina.cli.errors import CommandError, UsageError
from patina.farm import folders

FILES = ("tls_ca_file", "tls_client_cert", "tls_client_key")  # names of options, as Dask's Security has them


def of_run(distributed):
    """:returns: distributed.Security with a key that is made for this run, and lies in memory
    :raises CommandError: where none can be made"""
    try:
        return distributed.Security.temporary()
    except ImportError as error:
        raise CommandError(f"a farm's connections need cryptography (pip install cryptography): {error}") from error


def check(options):
    """:param options: those of --engineOption for a scheduler that others run
    :returns: whether they name certificates
    :raises UsageError: where one is missing"""
    given = [name for name in FILES if name in options]
    for name in FILES if given else ():
        if name not in options:
            raise UsageError(f"patina farm: --engineOption {given[0]}=FILE wants {name}=FILE too")
        if not os.path.isfile(str(options[name])):
            raise UsageError(f"patina farm: --engineOption {name}={options[name]}: there is no such file")
    return bool(given)


def of_files(distributed, options):
    """:returns: (distributed.Security or None, the other options)"""
    given = {name: str(options[name]) for name in FILES if name in options}
    others = {name: value for name, value in options.items() if name not in FILES}
    return distributed.Security(require_encryption=True, **given) if given else None, others


@contextlib.contextmanager
def private_folder(*parents, checked=True):
    """Yields a folder that this user alone may enter, or rename; it goes with the block.

    :param parents: where it may be, the first that others cannot change is taken
    :param checked: False takes the first as it is
    :raises CommandError: where there can be none"""
    parents = [os.path.expanduser(os.path.expandvars(parent)) for parent in parents]
    open_ = {parent: checked and folders.open_to_others(parent) for parent in parents}
    parent = next((parent for parent in parents if not open_[parent]), None)
    if parent is None:
        raise CommandError(f"cannot make a private folder in {parents[0]}: {open_[parents[0]]}; name another by TMPDIR, and "
                           "for the keys of a queue by --engineOption shared_temp_directory=FOLDER")
    try:
        folder = tempfile.TemporaryDirectory(prefix=".patina-farm-", dir=parent)
    except OSError as error:
        raise CommandError(f"cannot make a private folder in {parent}: {error.strerror}") from error
    with folder as path:
        if stat.S_IMODE(os.stat(path).st_mode) & 0o077:
            raise CommandError(f"{parent} keeps nothing private: its file system knows no permissions; --engineOption "
                               "shared_temp_directory=FOLDER names another place for the keys")
        yield path
