"""Threads."""

import os

from . import _core
from .arguments import whole


def set_threads(count: int) -> None:
    """Number of threads of all that follows; what other threads of Python call has its own. The last digits of results
    may depend on it."""
    _core.set_threads(whole("count", count, 1, _core.most_threads))


# A process that was forked has no threads of OpenMP but its first, and would wait for the others without end.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=lambda: _core.set_threads(1))
