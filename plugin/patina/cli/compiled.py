# SPDX-License-Identifier: Apache-2.0
"""The compiled module, or a reason why it is not there."""
from patina.cli import interrupts
from patina.cli.errors import CommandError


def load():
    """:returns: the module _patina"""
    try:
        import _patina as module
    except ImportError as error:
        raise CommandError(f"the compiled module is missing or of another Python ({error}); "
                           "run ./patina of a checkout, which builds it") from error
    interrupts.harden()
    return module


class _Compiled:
    """The module, which is imported when something of it is first asked for: --help and usage errors need no build."""

    def __getattr__(self, name):
        return getattr(load(), name)


_patina = _Compiled()
