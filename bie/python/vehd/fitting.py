"""Fits keys of scenes to measured data."""

import json
import os
from typing import Any, Dict, Mapping, Optional, Union

from . import _core
from .arguments import toml_value, whole


def _toml(fit: Mapping[str, Any]) -> str:
    """The text of a fit file."""

    def keys(table: Mapping[str, Any]) -> list:
        return [f"{toml_value(key)} = {toml_value(value)}" for key, value in table.items()]

    lines = []
    for experiment in fit.get("experiment", []):
        lines += ["[[experiment]]", *keys(experiment)]
    lines.append("[free]")
    lines += [f"{toml_value(key)} = {{{', '.join(keys(interval))}}}" for key, interval in fit.get("free", {}).items()]
    return "\n".join(lines) + "\n"


def fit(what: Union[str, "os.PathLike[str]", Mapping[str, Any]], directory: Union[str, "os.PathLike[str]"], *,
        jobs: Optional[int] = None, plot: bool = True) -> Dict[str, Any]:
    """Fits keys of scenes to measured data, as `vehd fit` does (docs/fit.md).

    what: a fit file, or a dict of its tables: {"experiment": [{"scene": ..., "data": ..., "quantity": ...}],
    "free": {"membrane.capacitance": {"from": "0.2 uF/cm^2", "to": "5 uF/cm^2"}}}, with paths relative to the present
    folder.
    directory: for the results and the runs; runs that are there already are not computed again.
    jobs: runs at a time, by default one for each processor.
    plot: draws fit.png.

    Returns the content of fit.json: values, errors (None where the data do not determine the key), correlation, chi2,
    undetermined and more.

    InputError: a fit file, a scene or its data cannot be used, or the model has no value at the start.
    """
    is_file = not isinstance(what, Mapping)
    count = (os.cpu_count() or 1) if jobs is None else whole("jobs", jobs, 1, 1024)
    return json.loads(_core.fit(os.fspath(what) if is_file else "dict", None if is_file else _toml(what),
                                os.fspath(directory), count, plot))
