"""Coefficients of real orthonormal spherical harmonics, index n² + n + m."""

import math

import numpy as np

from . import _core
from .arguments import reals, whole


def n_coefficients(degree: int) -> int:
    """(p + 1)², the number of harmonics of degree up to p."""
    return _core.n_coefficients(whole("degree", degree, 0))


def coefficient_index(n: int, m: int) -> int:
    """n² + n + m, −n ≤ m ≤ n."""
    n = whole("n", n, 0)
    return _core.coefficient_index(n, whole("m", m, -n, n))


def degree_of(index: int) -> int:
    """The degree n of the harmonic at an index."""
    return _core.degree_of(whole("index", index, 0))


def coefficients_of(name: str, values: np.ndarray) -> np.ndarray:
    """Coefficients of some degree, [(p+1)²] or [(p+1)², k]. ShapeError: the number of rows is no such square."""
    array = reals(name, values, ("(p+1)²",), ("(p+1)²", "k"))
    if array.shape[0] == 0 or math.isqrt(array.shape[0]) ** 2 != array.shape[0]:
        raise _core.ShapeError(f"{name} has {array.shape[0]} rows; accepted: (p+1)² of a degree p")
    return array


def evaluate_harmonics(coefficients: np.ndarray, theta: np.ndarray, phi: np.ndarray) -> np.ndarray:
    """Values [n] or [n, k] from coefficients [(p+1)²] or [(p+1)², k] in any directions: angles from +z and longitudes in
    radians, both [n].

    ShapeError: the number of rows is not (p+1)², or theta and phi differ in shape.
    """
    coefficients = coefficients_of("coefficients", coefficients)
    theta = reals("theta", theta, ("n",))
    return _core.evaluate_harmonics(coefficients, theta, reals("phi", phi, theta.shape))


def resize_degree(coefficients: np.ndarray, degree: int) -> np.ndarray:
    """Coefficients [(p+1)²] or [(p+1)², k] truncated or padded with zeros to another degree.

    ShapeError: the number of rows is not (p+1)².
    """
    return _core.resize_degree(coefficients_of("coefficients", coefficients), whole("degree", degree, 0))
