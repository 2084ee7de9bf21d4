"""Simulations, step by step."""

import math
import os
import sys
from typing import Any, Callable, Iterator, Mapping, Optional, Union

from . import _core
from .arguments import real
from .scenes import Scene
from .tables import Table

Progress = Union[bool, Callable[["_core.Status"], Any]]


def _show(status: "_core.Status") -> None:
    unit = f" {status.time_unit}" if status.time_unit else ""
    print(f"\rstep {status.step}  t {status.time:.4g}/{status.end_time:.4g}{unit}  dt {status.dt:.3g}  "
          f"drift {status.drift:.1e}", end="", file=sys.stderr, flush=True)


class Simulation:
    """Steps a scene through time, bit for bit as `vehd run` does.

    scene: Scene, path of a scene file, or dict of tables.
    directory: for the files of a run as of `vehd run -o`, up to date after every step; `--resume` of the program and
        `resume=True` here continue it. None: everything stays in memory.
    resume: continue the run in the directory if there is one.
    from_run: directory of a run that the new one continues with another field, waveform or flow, as `--from` does.

    SceneError, InputError, OutputError, ConvergenceError: with the messages of the program.

    Other threads of Python run during a step; one that meanwhile steps the simulation or reads its state or history gets
    a RuntimeError.
    Ctrl-C lets the current step end and raises KeyboardInterrupt; the simulation can then continue.
    """

    def __init__(self, scene: Union[Scene, str, "os.PathLike[str]", Mapping[str, Any]],
                 directory: Optional[Union[str, "os.PathLike[str]"]] = None, *, resume: bool = False,
                 from_run: Optional[Union[str, "os.PathLike[str]"]] = None):
        if isinstance(scene, Mapping):
            scene = Scene.from_dict(scene)
        elif not isinstance(scene, Scene):
            scene = Scene(scene)
        self.scene = scene
        if from_run == "":
            raise _core.InputError("from_run is ''; accepted: the directory of a run")
        if directory is None and (resume or from_run is not None):
            raise _core.InputError("resume and from_run continue a run in a directory, but there is no directory")
        self._core = _core.SceneRun(scene._core, None if directory is None else os.fspath(directory), resume,
                                    "" if from_run is None else os.fspath(from_run))

    def step(self) -> bool:
        """Takes one accepted step. Returns False if the end of the scene is reached already.

        ConvergenceError: no step is acceptable; the state is the last good one.
        """
        return self._core.step()

    def __iter__(self) -> Iterator["_core.Status"]:
        """Steps to the end of the scene; yields the status after each."""
        while self.step():
            yield self.status

    def run(self, until: Optional[float] = None, progress: Progress = False) -> "Simulation":
        """Steps to the end of the scene, or until a time is reached or passed.

        until: in the unit of the history. No step is shortened to end there, so the steps are those of `vehd run`.
        progress: True shows a line on standard error; a function is called with the status after every step.
        """
        if until is not None and until != math.inf:
            until = real("until", until)
        show = _show if progress is True else progress
        try:
            while (until is None or self.time < until) and self.step():
                if show:
                    show(self.status)
        finally:
            if progress is True:
                print(file=sys.stderr)
        return self

    @property
    def status(self) -> "_core.Status":
        """step, time, end_time, dt, drift, seconds, time_unit; times are those of the history."""
        return self._core.status

    @property
    def time(self) -> float:
        """Time of the state, in the unit of the history."""
        return self._core.status.time

    @property
    def completed(self) -> bool:
        """Whether the end of the scene is reached."""
        return self._core.completed

    @property
    def closed(self) -> bool:
        """Whether no step can follow."""
        return self._core.closed

    @property
    def state(self) -> "_core.State":
        """The vesicles as they are now: `state[0].position` and so on, coefficients of their degrees.

        Arrays are read-only views of the solver's own numbers and do not change when the simulation continues. If it
        computes in axes of its own, as along a field, they are rotated to those of the laboratory once.
        Vesicles: position [(p+1)², 3], area_strain, Vm, tension, q [(p+1)²], velocity, force_bending, force_tension,
        force_electric, force_contact [(p+1)², 3]; None where the effect is absent. Forces act as in f = f_b + f_λ − f_E +
        f_contact. Numbers are those of the scene, dimensionless in one with [units].
        """
        return self._core.state

    @property
    def history(self) -> Table:
        """One row per accepted step, that of history.csv bit for bit."""
        return Table._of(self._core.history())

    @property
    def vesicle_history(self) -> Table:
        """One row per step and vesicle, that of vesicles.csv; of one vesicle the history."""
        return Table._of(self._core.vesicle_history())

    @property
    def directory(self) -> Optional[str]:
        """Folder of the files, or None."""
        return None if self._core.directory is None else str(self._core.directory)

    def snapshot(self) -> None:
        """Adds a snapshot of the present state to run.h5 unless it has one, and brings all files up to date.

        InputError: the simulation has no directory. RuntimeError: it is closed.
        """
        self._core.snapshot()

    def close(self) -> None:
        """Adds a snapshot of the present state, writes the summary and unlocks the directory; no step can follow. The end
        of the scene, of a `with` block and of the object do the same. Without a directory nothing is written."""
        self._core.close()

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<vehd.Simulation of {self.scene.path}: step {self.status.step}, time {self.time:g}>"
