"""The check by finite elements."""

import json
import os
from pathlib import Path
from typing import Any, Mapping, Optional, Union

from . import _core
from .scenes import Scene, _settings
from .simulation import Simulation


class CheckResult(dict):
    """What `vehd check --json` writes (docs/check.md); `agrees`: every row agrees within errors that are small enough;
    `note`: where another time was compared than the one asked for."""

    agrees: bool
    note: str


def _program_folder() -> str:
    """Of the finite-element program: the next folder above this one that has it, or a folder bin there."""
    for parent in Path(__file__).resolve().parents:
        for folder in (parent, parent / "bin"):
            if os.access(folder / "vehd_fem", os.X_OK):
                return str(folder)
    return str(Path(__file__).resolve().parents[2])


def check(what: Union[Simulation, Scene, str, "os.PathLike[str]"],
          directory: Optional[Union[str, "os.PathLike[str]"]] = None, *, time: Optional[Union[float, str]] = None,
          quick: bool = False, require: Optional[float] = None, ranks: int = 1,
          settings: Optional[Mapping[str, Any]] = None) -> CheckResult:
    """Compares the fields of a frozen shape with finite elements, as `vehd check` does.

    what: a simulation with files, its run.h5 or its folder; or a scene, or its file, for its initial state.
    directory: for the results; "check" beside a run.h5 if left out.
    time: of a snapshot, as "0.5 ms" or a number in the unit of the history; the last one if left out.
    quick: coarse elements, about ten seconds. require: largest error of either method, as a share of each field, with
    which they may agree. ranks: MPI processes of the finite elements.

    InputError: there is no finite-element program, or it does not know something of the scene.
    """
    if isinstance(what, Simulation):
        if what.directory is None:
            raise _core.InputError("a simulation in memory has no snapshots: give it a directory, or check its scene")
        what = what.directory
    overrides = _settings(settings)
    if isinstance(what, Scene):
        if directory is None:
            raise _core.InputError("a scene has no folder of its own: give a directory")
        os.makedirs(directory, exist_ok=True)
        file = Path(directory) / "scene.toml"
        file.write_text(what.text)
    else:
        file = Path(what)
        if file.is_dir():
            file = file / "run.h5"
    if directory is None:
        if file.suffix == ".toml":
            raise _core.InputError("a scene has no folder of its own: give a directory")
        directory = file.parent / "check"
    code, text, note = _core.check(_program_folder(), os.fspath(file), overrides, os.fspath(directory),
                                   None if time is None else str(time), quick, require, ranks)
    result = CheckResult(json.loads(text) or {})
    result.agrees = code == 0
    result.note = note
    return result
