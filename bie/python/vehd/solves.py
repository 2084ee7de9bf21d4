"""Electric and tension problems on a frozen surface."""

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from . import _core
from .surface import Surface


def solve_electric(surface: Surface, field: Sequence[float], conductivity_in: float, conductivity_out: float,
                   potential: Optional[np.ndarray] = None, permittivity: float = 1.0, permittivity_ratio: float = 1.0,
                   tolerance: float = 1e-10) -> "_core.ElectricSolution":
    """A membrane between leaky dielectrics in a uniform field, Eqs. (11)–(15).

    field: E_∞, [3]; potential: V_m = φ_i − φ_e, coefficients [(p+1)²], zero if left out.
    Returns charge (q = [[∂φ/∂n]]), flux_in, flux_out (∂φ/∂n) [n_points], force (f_E = [[n·Σ_el]]) [n_points, 3] on the
    grid of the surface; potential_in, potential_out, coefficients; iterations, residual.
    ConvergenceError: the solve has not reached the tolerance.
    """
    return _core.solve_electric(surface._core, field, conductivity_in, conductivity_out, potential, permittivity,
                                permittivity_ratio, tolerance)


def solve_jumps(surface: Surface, potential: np.ndarray, current: np.ndarray, conductivity_in: float,
                conductivity_out: float, permittivity: float = 1.0,
                tolerance: float = 1e-10) -> "_core.ElectricSolution":
    """Harmonic potentials inside and outside with given jumps [[φ]] and [[σ ∂φ/∂n]], Eq. (35).

    potential: [[φ]], coefficients [(p+1)²]; current: [[σ ∂φ/∂n]] on the grid, [n_points]. Returns as solve_electric.
    """
    return _core.solve_jumps(surface._core, potential, current, conductivity_in, conductivity_out, permittivity,
                             tolerance)


def solve_tension(surface: Surface, velocity: np.ndarray, viscosity: float = 1.0,
                  tolerance: float = 1e-9) -> "_core.TensionSolution":
    """The tension that keeps an inextensible membrane from stretching in a flow, ∇_γ·(u + S[f_λ]/μ) = 0, Eq. (27b).

    velocity: u, coefficients [(p+1)², 3]. Returns tension (λ, force per length) [(p+1)²], velocity of the membrane
    [(p+1)², 3], iterations, residual. On a sphere the mean of λ is free, and zero here.
    """
    return _core.solve_tension(surface._core, velocity, viscosity, tolerance)


def point_source_fields(surface: Surface,
                        sources: List[Tuple[Sequence[float], float, bool]]) -> Dict[str, Any]:
    """Exact traces of the potentials strength/(4π|x − y|) of point sources (place, strength, whether it is inside), on
    the grid: potential_in, potential_out, flux_in, flux_out [n_points], gradient_in, gradient_out [n_points, 3]. Sources
    inside make the potential outside, and the other way round; Eq. (34)."""
    return _core.point_source_fields(surface._core, [(np.asarray(p, dtype=float), s, i) for p, s, i in sources])
