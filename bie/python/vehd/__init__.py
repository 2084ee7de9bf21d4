"""Lipid vesicles in viscous flow and electric field, by spectral boundary integral equations.

    scene = vehd.Scene("scene.toml")          # from a file, a text or a dict
    run = vehd.Simulation(scene, "out/run")   # with the files of `vehd run`, or without a folder in memory
    for status in run: ...                    # one accepted step each
    run.state[0].position                     # numpy view of the solver's own numbers

    surface = vehd.Surface.from_shape("ellipsoid", axes=[1, 1, 2], degree=16)
    surface.single_layer.matrix               # layer operators as matrices or scipy LinearOperators
    vehd.solve_electric(surface, ...)         # charges, potentials and forces of a frozen surface

Fields on a membrane are coefficients of real orthonormal spherical harmonics, index n² + n + m; values on a grid have
one row per point, latitude by latitude from the north pole. Everything is in the units of the scene.
"""

import os as _os

# Threads that spin while they wait lose whole time slices as soon as anything else runs on the machine. OpenMP reads
# this once, when it is loaded.
_os.environ.setdefault("OMP_WAIT_POLICY", "passive")

from ._core import (  # noqa: E402
    ConvergenceError,
    InputError,
    OutputError,
    SceneError,
    ShapeError,
    library_versions,
    threads,
)
from ._core import version as _version  # noqa: E402
from .checking import CheckResult, check, has_finite_elements, solve_by_elements  # noqa: E402
from .example1 import example1, example1_sources  # noqa: E402
from .fitting import fit  # noqa: E402
from .harmonics import (  # noqa: E402
    coefficient_index,
    degree_of,
    evaluate_harmonics,
    n_coefficients,
    resize_degree,
)
from .machine import set_threads  # noqa: E402
from .scenes import Scene  # noqa: E402
from .simulation import Simulation  # noqa: E402
from .solves import point_source_fields, solve_electric, solve_jumps, solve_tension  # noqa: E402
from .surface import Operator, Surface  # noqa: E402
from .tables import Table, concat, read_history  # noqa: E402
from . import plot  # noqa: E402

__version__ = _version()

__all__ = [
    "CheckResult", "ConvergenceError", "InputError", "Operator", "OutputError", "Scene", "SceneError",
    "ShapeError", "Simulation", "Surface", "Table", "check", "coefficient_index", "concat", "degree_of",
    "evaluate_harmonics", "example1", "example1_sources", "fit", "has_finite_elements", "library_versions",
    "n_coefficients", "plot", "point_source_fields", "read_history", "resize_degree", "set_threads",
    "solve_by_elements", "solve_electric", "solve_jumps", "solve_tension", "threads",
]
