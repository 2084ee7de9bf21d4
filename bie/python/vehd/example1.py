"""Example 1 of the paper: the charge density and the electric force on shape (33)."""

from typing import List, Tuple

import numpy as np

from . import _core
from .solves import point_source_fields, solve_jumps
from .surface import Surface


def example1_sources() -> List[Tuple[np.ndarray, float, bool]]:
    """The six point sources of Example 1: place, strength, whether it is inside."""
    return _core.example1_sources()


def example1(degree: int = 16) -> dict:
    """Solves Example 1 as `vehd verify` does. Returns order, error_q and error_force relative to the largest exact value,
    and iterations."""
    surface = Surface.from_shape("radial", degree, upsampling=1, base=1.0, amplitude=0.2, exponent=-3.0,
                                 modes=[{"n": 3, "m": 2, "a": 1.0}])
    exact = point_source_fields(surface, example1_sources())
    jump = surface.analyze(exact["potential_in"] - exact["potential_out"])
    found = solve_jumps(surface, jump, 2.0 * exact["flux_in"] - exact["flux_out"], conductivity_in=2.0,
                        conductivity_out=1.0)
    charge = exact["flux_in"] - exact["flux_out"]
    force = _traction(surface, exact["gradient_in"]) - _traction(surface, exact["gradient_out"])
    return {"order": degree, "error_q": np.abs(found.charge - charge).max() / np.abs(charge).max(),
            "error_force": _size(found.force - force).max() / _size(force).max(), "iterations": found.iterations}


def _size(vectors: np.ndarray) -> np.ndarray:
    return np.linalg.norm(vectors, axis=1)


def _traction(surface: Surface, gradient: np.ndarray) -> np.ndarray:
    """n·Σ_el of E = −∇φ at permittivity 1, Eq. (3)."""
    flux = np.sum(gradient * surface.normal, axis=1)
    return flux[:, None] * gradient - 0.5 * np.sum(gradient**2, axis=1)[:, None] * surface.normal
