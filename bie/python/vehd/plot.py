"""Pictures with matplotlib, which is imported when the first one is drawn."""

from typing import Any, Optional, Sequence, Union

import numpy as np

from .arguments import real, reals, shown, whole
from .harmonics import evaluate_harmonics
from .simulation import Simulation
from .surface import Surface
from .tables import Table


def _surface(what: Any) -> Surface:
    return what if isinstance(what, Surface) else Surface(what)


def history(what: Union[Table, Simulation], columns: Union[str, Sequence[str]] = ("bending_energy_scaled", "extent_z"),
            axes: Optional[Any] = None) -> Any:
    """Columns of a history, or one, against time, one panel each. Returns the figure."""
    import matplotlib.pyplot as plt

    table = what.history if isinstance(what, Simulation) else what
    if not isinstance(table, Table):
        raise TypeError(f"what is {shown(what)}; accepted: a simulation, or a table as of vehd.read_history")
    columns = [columns] if isinstance(columns, str) else columns
    if axes is None:
        _, axes = plt.subplots(len(columns), 1, sharex=True, squeeze=False, layout="constrained")
    panels = np.ravel(axes)
    for panel, name in zip(panels, columns):
        panel.plot(table["time"], table[name])
        panel.set_ylabel(table.label(name))
    panels[-1].set_xlabel(table.label("time"))
    return panels[-1].figure


def outline(what: Any, axes: Optional[Any] = None, azimuth: float = 0.0, **style: Any) -> Any:
    """The meridian of a surface or vesicle through both poles at this azimuth, in radians: distance along it against z.
    Returns the axes."""
    import matplotlib.pyplot as plt

    if axes is None:
        _, axes = plt.subplots(layout="constrained")
    azimuth = real("azimuth", azimuth)
    angle = np.linspace(0.0, 2.0 * np.pi, 400)
    theta = np.where(angle <= np.pi, angle, 2.0 * np.pi - angle)
    phi = np.where(angle <= np.pi, azimuth, azimuth + np.pi)
    x = evaluate_harmonics(getattr(what, "coefficients", getattr(what, "position", what)), theta, phi)
    axes.plot(x[:, 0] * np.cos(azimuth) + x[:, 1] * np.sin(azimuth), x[:, 2], **style)
    axes.set_aspect("equal")
    return axes


def _mesh(surface: Surface, values: Optional[np.ndarray], n: int) -> tuple:
    """Points of a closed mesh [n, 2n, 3] and values there."""
    n = whole("n", n, 2)
    theta, phi = np.meshgrid(np.linspace(0, np.pi, n), np.linspace(0, 2 * np.pi, 2 * n), indexing="ij")
    at = theta.ravel(), phi.ravel()
    x = evaluate_harmonics(surface.coefficients, *at).reshape(n, 2 * n, 3)
    if values is None:
        return x, None
    return x, evaluate_harmonics(reals("values", values, ("(p+1)²",)), *at).reshape(n, 2 * n)


def shape(what: Any, values: Optional[np.ndarray] = None, axes: Optional[Any] = None, n: int = 40,
          cmap: str = "coolwarm") -> Any:
    """A surface or vesicle in three dimensions, coloured by the field with the coefficients `values`, [(p+1)²], if given.
    Returns the axes."""
    import matplotlib.pyplot as plt
    from matplotlib import cm, colors

    x, field = _mesh(_surface(what), values, n)
    if axes is None:
        axes = plt.figure(layout="constrained").add_subplot(projection="3d")
    if field is None:
        axes.plot_surface(x[..., 0], x[..., 1], x[..., 2], rstride=1, cstride=1, color="lightsteelblue")
    else:
        lowest, highest = field.min(), field.max()
        if lowest < 0 < highest:  # white is zero
            highest = max(-lowest, highest)
            lowest = -highest
        colour = cm.ScalarMappable(colors.Normalize(lowest, highest), cmap)
        axes.plot_surface(x[..., 0], x[..., 1], x[..., 2], rstride=1, cstride=1, facecolors=colour.to_rgba(field),
                          shade=False)
        axes.figure.colorbar(colour, ax=axes, shrink=0.6)
    axes.set_box_aspect(np.ptp(x.reshape(-1, 3), axis=0), zoom=0.85)
    axes.locator_params(nbins=3)
    return axes


def pyvista_mesh(what: Any, values: Optional[np.ndarray] = None, n: int = 40) -> Any:
    """The same as a pyvista.StructuredGrid, with the field "values"; needs pyvista."""
    import pyvista

    x, field = _mesh(_surface(what), values, n)
    grid = pyvista.StructuredGrid(x[..., 0], x[..., 1], x[..., 2])
    if field is not None:
        grid["values"] = field.ravel(order="F")
    return grid
