"""Scenes: what is simulated."""

import os
import re
from typing import Any, Mapping, Optional, Union

import numpy as np

from . import _core
from .arguments import shown, toml_value


def _place(error: BaseException) -> tuple:
    """File and line that a message begins with."""
    found = re.match(r"(.+?):(\d+): ", str(error))
    return (found.group(1), int(found.group(2))) if found else (None, None)


# The compiled part knows the message alone.
_core.SceneError.file = property(lambda error: _place(error)[0])
_core.SceneError.line = property(lambda error: _place(error)[1])

Path = Union[str, "os.PathLike[str]"]


def _settings(values: Optional[Mapping[str, Any]]) -> list:
    """As the option --set takes them."""
    if not isinstance(values or {}, Mapping):
        raise _core.InputError(f"settings is {shown(values)}; accepted: a mapping from \"table.key\" to values")
    return [f"{key}={toml_value(value)}" for key, value in (values or {}).items()]


class Scene:
    """A validated scene, with the keys of `vehd help scene`.

        Scene("scene.toml", {"flow.rate": 2.0})  # other values for some keys
        Scene.from_text(toml)
        Scene.from_dict({"shape": {"kind": "ellipsoid", "axes": [1, 1, 2]}, "numerics": {...}})

    SceneError: the scene cannot be used; the message is that of the program with file, line, value, accepted values and,
    for an unknown key, the nearest one. Its attributes `file` and `line` give the place.
    """

    def __init__(self, path: Path, settings: Optional[Mapping[str, Any]] = None):
        self._core = _core.Scene(os.fspath(path), _settings(settings))

    @classmethod
    def _of(cls, core: "_core.Scene") -> "Scene":
        scene = cls.__new__(cls)
        scene._core = core
        return scene

    @classmethod
    def from_text(cls, text: str, name: str = "scene", folder: Path = "",
                  settings: Optional[Mapping[str, Any]] = None) -> "Scene":
        """A scene from TOML in memory.

        name: stands for the file in messages.
        folder: where relative paths in the scene start.
        """
        return cls._of(_core.Scene.from_text(text, name, os.fspath(folder), _settings(settings)))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], folder: Path = "") -> "Scene":
        """A scene from a dict of tables; several vesicles are a list of dicts under "vesicle".

        Messages give lines of the TOML made from the dict, table by table.
        """
        return cls._of(_core.Scene.from_dict(tables, os.fspath(folder)))

    @property
    def text(self) -> str:
        """The scene as TOML with every default spelled out."""
        return self._core.text

    @property
    def path(self) -> str:
        """The file of the scene, or the name given with a text."""
        return str(self._core.path)

    @property
    def degree(self) -> int:
        """Degree p of the harmonics; with a tolerance the highest."""
        return self._core.degree

    @property
    def n_vesicles(self) -> int:
        """Number of vesicles."""
        return self._core.n_vesicles

    def position(self, vesicle: int = 0) -> np.ndarray:
        """Initial shape, coefficients [(p+1)², 3]."""
        return self._core.position(vesicle)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self._core == other._core

    def __repr__(self) -> str:
        return f"<vehd.Scene {self.path}: degree {self.degree}, {self.n_vesicles} vesicle(s)>"
