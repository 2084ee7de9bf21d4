"""Threads."""

import os

from . import _core
from .arguments import whole


def set_threads(count: int) -> None:
    """Sets the number of threads of later calls from this Python thread; others have numbers of their own. It changes no
    bit of a result.

    InputError: the number is below 1 or above the limit of the program.
    """
    _core.set_threads(whole("count", count, 1, _core.most_threads))


# A process that was forked has no threads of OpenMP but its first, and would wait for the others without end.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=lambda: _core.set_threads(1))
