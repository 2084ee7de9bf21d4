"""Histories of runs as tables."""

import difflib
import os
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _core


class Table(dict):
    """Columns by name, numpy arrays [n_rows]; `units` holds the unit of each, empty of pure numbers and where the scene
    has no units. Columns are those of history.csv (docs/run_files.md)."""

    units: dict

    @classmethod
    def _of(cls, core: "_core.HistoryTable") -> "Table":
        table = cls(core.columns())
        table.units = core.units()
        return table

    def __missing__(self, name: Any) -> None:
        nearest = difflib.get_close_matches(str(name), self, 1)
        raise KeyError(f"no column {name!r}" + (f"; did you mean {nearest[0]!r}?" if nearest else ""))

    def to_pandas(self) -> Any:
        """A pandas.DataFrame; needs pandas."""
        import pandas

        return pandas.DataFrame(dict(self))

    def column(self, name: str, vesicle: int) -> np.ndarray:
        """A column of a table of each vesicle, the rows of one of them."""
        return self[name][self["vesicle"] == vesicle]

    def label(self, name: str) -> str:
        """Name with unit."""
        return f"{name} [{self.units[name]}]" if self.units.get(name) else name

    def __repr__(self) -> str:
        rows = len(next(iter(self.values()), ()))
        return f"<vehd.Table: {rows} rows of {', '.join(self)}>"


def read_history(path: Union[str, "os.PathLike[str]"]) -> Table:
    """The history of a run: of its folder, or of a history.csv or vesicles.csv. Raises InputError where rows were altered
    or are missing."""
    file = Path(path)
    if file.is_dir():
        file = file / "history.csv"
    return Table._of(_core.HistoryTable(os.fspath(file)))
