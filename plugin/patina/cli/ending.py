# SPDX-License-Identifier: Apache-2.0
"""How the process of a command ends: without the destructors of libraries.

OpenUSD frees layers on threads that nothing joins (WorkRunDetachedTask). On a busy machine one of them is still at work when
the objects of TBB are destroyed, and ends the process by "pure virtual method called", after all has been done and written.
"""
import atexit
import os
import sys

_status = None


def end(status):
    """:returns: the same exit status, which the process will have"""
    global _status
    _status = status
    return status


@atexit.register  # on import, before other modules register theirs: the first comes last
def _leave():
    if _status is None:  # an error that nothing handles: Python tells of it
        return
    status = _status
    for stream in filter(None, (sys.stdout, sys.stderr)):
        try:
            stream.flush()
        except (OSError, ValueError):
            status = status or 1
    os._exit(status)
