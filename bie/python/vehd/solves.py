"""Electric and tension problems on a frozen surface."""

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from . import _core
from .arguments import magnitude, real, reals, shown
from .surface import Surface

Sources = List[Tuple[Sequence[float], float, bool]]


def conductivities(inside: float, outside: float) -> Tuple[float, float]:
    """σ_i and σ_e, neither below zero and one above. InputError: others."""
    pair = real("conductivity_in", inside, least=0.0), real("conductivity_out", outside, least=0.0)
    if pair == (0.0, 0.0):
        raise _core.InputError("conductivity_in and conductivity_out are both 0; accepted: at least one above 0")
    return pair


def point_sources(surface: Surface, sources: Sources) -> Sources:
    """Point sources on the side of the surface that each of them names. InputError: others."""
    checked = []
    for i, source in enumerate(sources):
        try:
            place, strength, inside = source
        except (TypeError, ValueError):
            raise _core.InputError(f"sources[{i}] is {shown(source)}; accepted: (place, strength, whether it is "
                                   "inside)") from None
        if not isinstance(inside, (bool, np.bool_)):
            raise _core.InputError(f"sources[{i}] has {shown(inside)} for whether it is inside; accepted: True or False")
        checked.append((reals(f"the place of sources[{i}]", place, (3,)), real(f"the strength of sources[{i}]", strength),
                        bool(inside)))
    found = surface.evaluate(np.array([place for place, _, _ in checked]).reshape(-1, 3))
    for i, (place, _, inside) in enumerate(checked):
        if found.inside[i] != inside:
            raise _core.InputError(f"sources[{i}] at {place} is inside: {inside}, but the surface has it "
                                   f"{'inside' if found.inside[i] else 'outside'}")
    return checked


def solve_electric(surface: Surface, field: Sequence[float], conductivity_in: float, conductivity_out: float,
                   potential: Optional[np.ndarray] = None, permittivity: float = 1.0, permittivity_ratio: float = 1.0,
                   tolerance: float = 1e-10) -> "_core.ElectricSolution":
    """A membrane between leaky dielectrics in a uniform field, Eqs. (11)–(15).

    field: E_∞, [3]; potential: V_m = φ_i − φ_e, coefficients [(p+1)²], zero if left out.
    Returns charge (q = [[∂φ/∂n]]), flux_in, flux_out (∂φ/∂n) [n_points], force (f_E = [[n·Σ_el]]) [n_points, 3] on the
    grid of the surface; potential_in, potential_out, coefficients [(p+1)²]; iterations, residual.

    ConvergenceError: the solve has not reached the tolerance.
    """
    return _core.solve_electric(
        surface._core, magnitude("field", reals("field", field, (3,))), *conductivities(conductivity_in, conductivity_out),
        None if potential is None else magnitude("potential", surface._scalar("potential", potential)),
        real("permittivity", permittivity, above=0.0), real("permittivity_ratio", permittivity_ratio, above=0.0),
        real("tolerance", tolerance, above=0.0, below=1.0))


def solve_jumps(surface: Surface, potential: np.ndarray, current: np.ndarray, conductivity_in: float,
                conductivity_out: float, permittivity: float = 1.0,
                tolerance: float = 1e-10) -> "_core.ElectricSolution":
    """Harmonic potentials inside and outside with given jumps [[φ]] and [[σ ∂φ/∂n]], Eq. (35).

    potential: [[φ]], coefficients [(p+1)²]; current: [[σ ∂φ/∂n]] on the grid, [n_points], of zero integral where
    conductivity_out is 0. Returns as solve_electric.

    InputError: conductivity_out is 0 and the current has an integral.
    ConvergenceError: the solve has not reached the tolerance.
    """
    potential = magnitude("potential", surface._scalar("potential", potential))
    current = magnitude("current", reals("current", current, surface.weight.shape))
    inside, outside = conductivities(conductivity_in, conductivity_out)
    tolerance = real("tolerance", tolerance, above=0.0, below=1.0)
    net = surface.integrate(current)
    if outside == 0.0 and abs(net) > tolerance * surface.integrate(np.abs(current)):
        raise _core.InputError(f"current has the integral {net:.6g}; accepted: 0 where conductivity_out is 0, as no "
                               "current can leave")
    return _core.solve_jumps(surface._core, potential, current, inside, outside,
                             real("permittivity", permittivity, above=0.0), tolerance)


def solve_tension(surface: Surface, velocity: np.ndarray, viscosity: float = 1.0,
                  tolerance: float = 1e-9) -> "_core.TensionSolution":
    """The tension that keeps an inextensible membrane from stretching in a flow, ∇_γ·(u + S[f_λ]/μ) = 0, Eq. (27b).

    velocity: u, coefficients [(p+1)², 3]. Returns tension (λ, force per length) [(p+1)²], velocity of the membrane
    [(p+1)², 3], iterations, residual. On a sphere the mean of λ is free, and zero here.

    ConvergenceError: the solve has not reached the tolerance.
    """
    return _core.solve_tension(surface._core, magnitude("velocity", surface._vector("velocity", velocity)),
                               real("viscosity", viscosity, above=0.0),
                               real("tolerance", tolerance, above=0.0, below=1.0))


def point_source_fields(surface: Surface, sources: Sources) -> Dict[str, Any]:
    """Exact traces of the potentials strength/(4π|x − y|) of point sources (place, strength, whether it is inside), on
    the grid: potential_in, potential_out, flux_in, flux_out [n_points], gradient_in, gradient_out [n_points, 3]. Sources
    inside make the potential outside, and vice versa; Eq. (34).

    InputError: a source is not on the side that it names.
    """
    return _core.point_source_fields(surface._core, point_sources(surface, sources))
