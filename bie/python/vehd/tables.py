"""Histories of runs as tables."""

import difflib
import os
from pathlib import Path
from typing import Any, Iterable, Union

import numpy as np

from . import _core
from .arguments import shown


class Table(dict):
    """Columns of history.csv by name (docs/run_files.md), numpy arrays [n_rows]; `units` has the unit of each, empty for
    pure numbers and without units in the scene.

    KeyError: there is no column of a name; the message gives the nearest one.
    """

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
        """A pandas.DataFrame with the units in `attrs["units"]`; needs pandas."""
        import pandas

        frame = pandas.DataFrame(dict(self))
        frame.attrs["units"] = dict(self.units)
        return frame

    def column(self, name: str, vesicle: int) -> np.ndarray:
        """A column of a vesicle_history, the rows of one vesicle."""
        return self[name][self["vesicle"] == vesicle]

    def label(self, name: str) -> str:
        """Name with unit."""
        return f"{name} [{self.units[name]}]" if self.units.get(name) else name

    def __repr__(self) -> str:
        rows = len(next(iter(self.values()), ()))
        return f"<vehd.Table: {rows} rows of {', '.join(self)}>"


def concat(tables: Iterable[Table]) -> Table:
    """The rows of several tables one after another, with the column `run`: 0 for the first table, 1 for the second …
    Columns are those that all tables have.

    InputError: a column has two units, or there is no table. TypeError: something else than tables.
    """
    parts = list(tables)
    if not parts:
        raise _core.InputError("concat of no tables")
    if not all(isinstance(part, Table) for part in parts):
        raise TypeError(f"tables is {shown(tables)}; accepted: a list of tables, such as histories of simulations")
    result = Table({"run": np.repeat(np.arange(len(parts)), [len(next(iter(part.values()), ())) for part in parts])})
    result.units = {"run": ""}
    for name in parts[0]:
        if not all(name in part for part in parts):
            continue
        units = sorted({part.units.get(name, "") for part in parts})
        if len(units) > 1:
            raise _core.InputError(f"column {name!r} has the units {', '.join(map(repr, units))}; accepted: one")
        result[name] = np.concatenate([part[name] for part in parts])
        result.units[name] = units[0]
    return result


def read_history(path: Union[str, "os.PathLike[str]"]) -> Table:
    """The history of a run from its folder, or from a history.csv or vesicles.csv.

    InputError: the file cannot be read, or rows were altered or are missing.
    """
    file = Path(path)
    if file.is_dir():
        file = file / "history.csv"
    return Table._of(_core.HistoryTable(os.fspath(file)))
