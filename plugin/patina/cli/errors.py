# SPDX-License-Identifier: Apache-2.0
"""Failures that a user caused or met, as opposed to defects of Patina, and which of them pass by themselves."""
import errno

FAILED, USAGE, TEMPORARY = 1, 2, 75  # exit statuses; the last as EX_TEMPFAIL of sysexits.h

# As hdDelegate/film/temporaryFailure.h has it.
_PASSING = {getattr(errno, name) for name in (
    "ENOSPC", "EDQUOT", "ENOMEM", "EAGAIN", "EINTR", "EMFILE", "ENFILE", "EIO", "ESTALE", "ETIMEDOUT", "ENOLCK", "EBUSY",
    "ETXTBSY") if hasattr(errno, name)}


class CommandError(Exception):
    """Ends the command with exit status 1 and this one-line reason."""


class TemporaryError(CommandError):
    """Ends the command with exit status 75: the same command may do it when it is run again."""


class UsageError(Exception):
    """Ends the command with exit status 2: the arguments cannot be understood."""


def is_temporary(error):
    """:returns: whether what an error came from may pass: memory that ran out, a full disk, a server that did not answer"""
    while error is not None:
        if isinstance(error, (TemporaryError, MemoryError)) or type(error).__name__ == "TemporaryFailure":
            return True
        if isinstance(error, OSError) and error.errno in _PASSING:
            return True
        error = error.__cause__
    return False
