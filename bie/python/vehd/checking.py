"""The check by finite elements, and their solution of a problem of their own."""

import json
import os
from pathlib import Path
from typing import Any, Dict, Mapping, Optional, Union

import numpy as np

from . import _core
from .arguments import real, whole
from .scenes import Scene, _settings
from .simulation import Simulation
from .solves import Sources, conductivities, point_sources
from .surface import Surface
from .tables import Table


class CheckResult(dict):
    """What `vehd check --json` writes (docs/check.md); `agrees`: every row agrees within errors that are small enough;
    `time`: of the snapshot that was compared, as in "0.5 ms", a number where the scene has no unit of time; `note`: says
    if that is not the requested time and what could not be verified as intact; otherwise empty."""

    agrees: bool
    time: str
    note: str

    @property
    def table(self) -> Table:
        """One row for each comparison: group ("fields", "from_shape", "stored", "in_time"), field, l2 and max of the
        relative difference, fem_error, bie_error, verdict; of two vesicles the name of the vesicle first.
        `table.to_pandas()` is a DataFrame."""
        rows = [{"vesicle": part.get("name", ""), "group": group, "field": field, **values}
                for part in self.get("vesicles", [self]) for group in ("fields", "from_shape", "stored", "in_time")
                for field, values in part.get(group, {}).items() if isinstance(values, dict)]
        names = ("group", "field", "l2", "max", "fem_error", "bie_error", "verdict")
        if "vesicles" in self:
            names = ("vesicle", *names)
        table = Table({name: np.array([row[name] for row in rows]) for name in names})
        table.units = {name: "" for name in names}
        return table


def _program_folder() -> str:
    """Of the finite-element program: the next folder above this one that has it, or a folder bin there."""
    for parent in Path(__file__).resolve().parents:
        for folder in (parent, parent / "bin"):
            if os.access(folder / "vehd_fem", os.X_OK):
                return str(folder)
    return str(Path(__file__).resolve().parents[2])


def has_finite_elements() -> bool:
    """Whether `check` and `solve_by_elements` find the finite-element program (cmake -DSTEP=check -P bie/setup.cmake)."""
    return os.access(os.path.join(_program_folder(), "vehd_fem"), os.X_OK)


def check(what: Union[Simulation, Scene, str, "os.PathLike[str]"],
          directory: Optional[Union[str, "os.PathLike[str]"]] = None, *, time: Optional[Union[float, str]] = None,
          from_time: Optional[Union[float, str]] = None, quick: bool = False, require: Optional[float] = None,
          ranks: int = 1, settings: Optional[Mapping[str, Any]] = None) -> CheckResult:
    """Compares the fields of a frozen shape with finite elements, as `vehd check` does.

    what: a simulation with files, to which a snapshot of its present state is added if it is not closed; its run.h5 or
    its folder; or a scene, or its file, for its initial state.
    directory: for the results; "check" beside a run.h5 if left out.
    time: of a snapshot, as "0.5 ms" or a number in the unit of the history; the last one if left out.
    from_time: of an earlier snapshot, likewise; the elements then also advance V_m from there by themselves.
    quick: coarse elements, 5 to 20 s of processor time for smooth shapes.
    require: largest relative error of either method with which a row may agree.
    ranks: MPI processes of the finite elements.

    InputError: there is no finite-element program, or it lacks an effect of the scene.
    """
    if isinstance(what, Simulation):
        if what.directory is None:
            raise _core.InputError("a simulation in memory has no snapshots: give it a directory, or check its scene")
        if not what.closed:
            what.snapshot()
        what = what.directory
    overrides = _settings(settings)
    if isinstance(what, Scene):
        if directory is None:
            raise _core.InputError("a scene has no folder of its own: give a directory")
        os.makedirs(directory, exist_ok=True)
        file = Path(directory) / "checked_scene.toml"
        file.write_text(what.text)
    else:
        file = Path(what)
        if file.is_dir():
            file = file / "run.h5"
    if directory is None:
        if file.suffix == ".toml":
            raise _core.InputError("a scene has no folder of its own: give a directory")
        directory = file.parent / "check"
    times = [None if moment is None else str(moment) for moment in (time, from_time)]
    required = None if require is None else real("require", require, above=0.0, below=1.0)
    code, text, note, found = _core.check(_program_folder(), os.fspath(file), overrides, os.fspath(directory), *times,
                                          bool(quick), required, whole("ranks", ranks, 1))
    result = CheckResult(json.loads(text) or {})
    result.agrees = code == 0
    result.time = found
    result.note = note
    return result


def solve_by_elements(surface: Surface, sources: Sources, conductivity_in: float, conductivity_out: float, *,
                      degree: int = 5, cells: int = 3, outer_radius: float = 8.0) -> Dict[str, Any]:
    """The problem of `solve_jumps` for the jumps of point sources, by finite elements in the volume, in a program of its
    own, and how far its solution is from the exact one.

    sources: as of `point_source_fields`; conductivity_in, conductivity_out: σ_i, σ_e; degree: of the elements; cells:
    along an edge of each block of the mesh; outer_radius: where the space ends, over the radius of the shape.
    Returns dofs (unknowns), cells, seconds (processor time from the shape to the fields; seconds_mesh of it for the
    mesh), memory_bytes (peak of the program), fields{"q", "force"}{"l2", "max"}: errors relative to the exact solution.

    InputError: there is no finite-element program.
    RuntimeError: it did not finish.
    """
    code, text = _core.solve_sources_by_elements(
        _program_folder(), surface.coefficients, point_sources(surface, sources),
        *conductivities(conductivity_in, conductivity_out), whole("degree", degree, 1), whole("cells", cells, 1),
        real("outer_radius", outer_radius, above=1.0))
    if code != 0:
        raise RuntimeError(f"the finite elements ended with exit code {code}; their messages are on standard error")
    return json.loads(text)
