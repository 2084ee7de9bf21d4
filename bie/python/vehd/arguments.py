"""Checks of the arguments of public functions, so that none is truncated or converted silently."""

import difflib
import json
import math
import operator
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _core

Shape = Sequence[Union[int, str]]


def _text(shape: Shape) -> str:
    return "(" + ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "") + ")"


def shown(value: Any) -> str:
    """A value as messages quote it, cut after 60 characters."""
    text = repr(value.item() if isinstance(value, np.generic) else value)
    return text if len(text) <= 60 else text[:60] + " ..."


def toml_value(value: Any) -> str:
    """TOML text of a number, a string, a boolean, or a list of these."""
    return json.dumps(value.tolist() if hasattr(value, "tolist") else value, ensure_ascii=False)


def _fits(shape: tuple, accepted: Shape) -> bool:
    return len(shape) == len(accepted) and all(isinstance(n, str) or n == size for size, n in zip(shape, accepted))


def reals(name: str, values: Any, *shapes: Shape) -> np.ndarray:
    """Finite real numbers in double precision.

    shapes: that are accepted; a letter stands for any count.
    InputError: other values; ShapeError: another shape.
    """
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise _core.ShapeError(f"{name} is not an array: {error}") from None
    if array.dtype.kind == "c":
        raise _core.InputError(f"{name} is complex; accepted: real numbers, so pass the real and the imaginary part "
                               "one after the other")
    if array.dtype.kind not in "biuf":
        raise _core.InputError(f"{name} holds values of type {array.dtype}; accepted: real numbers")
    if np.ma.is_masked(values):
        raise _core.InputError(f"{name} is masked; accepted: arrays without masked values")
    if not any(_fits(array.shape, shape) for shape in shapes):
        raise _core.ShapeError(f"{name} has the shape {_text(array.shape)}; accepted: {' or '.join(map(_text, shapes))}")
    array = np.asarray(array, dtype=float)
    wrong = np.argwhere(~np.isfinite(array))
    if wrong.size > 0:
        place = ", ".join(map(str, wrong[0]))
        raise _core.InputError(f"{name}[{place}] is {array[tuple(wrong[0])]}; accepted: finite numbers")
    return array


def magnitude(name: str, values: Any) -> Any:
    """Real numbers whose largest is of a magnitude that scenes may have; squares of others may overflow or vanish.
    InputError: others."""
    largest = float(np.max(np.abs(values), initial=0.0))
    if largest != 0.0 and not 1e-50 <= largest <= 1e50:
        raise _core.InputError(f"{name} is {largest:g} in magnitude; accepted: 1e-50 ... 1e+50 unless 0")
    return values


def real(name: str, value: Any, above: Optional[float] = None, least: Optional[float] = None,
         below: Optional[float] = None) -> float:
    """A finite real number within bounds, of a magnitude that scenes may have. InputError: anything else."""
    bounds = [f"{word} {bound:g}" for word, bound in (("above", above), ("at least", least), ("below", below))
              if bound is not None]
    accepted = "a finite number" if not bounds else "a number " + " and ".join(bounds)
    array = np.asarray(value)
    is_real = array.ndim == 0 and array.dtype.kind in "iuf"
    number = float(array) if is_real else math.nan
    if (not math.isfinite(number) or (above is not None and number <= above) or (least is not None and number < least)
            or (below is not None and number >= below)):
        raise _core.InputError(f"{name} is {shown(value)}; accepted: {accepted}")
    return magnitude(name, number)


def whole(name: str, value: Any, least: int, most: int = 10**9) -> int:
    """A whole number within bounds. InputError: anything else."""
    try:
        number = least - 1 if isinstance(value, (bool, np.bool_)) else operator.index(value)
    except TypeError:
        number = least - 1
    if not least <= number <= most:
        raise _core.InputError(f"{name} is {shown(value)}; accepted: a whole number, {least} to {most}")
    return number


def word(name: str, value: Any, accepted: Sequence[str]) -> str:
    """One of some words. InputError: anything else."""
    if value in accepted:
        return value
    nearest = difflib.get_close_matches(str(value), accepted, 1)
    raise _core.InputError(f"{name} is {shown(value)}; accepted: {', '.join(accepted)}"
                           + (f"; did you mean {nearest[0]!r}?" if nearest else ""))
