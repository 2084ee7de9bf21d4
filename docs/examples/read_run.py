"""Reads runs of vehd without vehd, and draws Figure 4 of the paper from them.

    read_run.py RUN RUN [-o figure4.png]

The folders are those of the runs of docs/scenes/figure2.toml and figure3.toml; the stiffer membrane is dashed. The
lines are columns of history.csv, one row for each step. The circles are computed here from the fields in run.h5, one for
each snapshot: an integral over the membrane, and values at its north pole.

Needs h5py, numpy and matplotlib (Debian: python3-h5py, python3-numpy, python3-matplotlib).
"""

import argparse
import csv
import pathlib
import tomllib

import h5py
import matplotlib

matplotlib.use("Agg")  # Draws to a file and needs no display.
import matplotlib.pyplot as plt
import numpy as np


def read_history(run):
    """Columns of history.csv by name. A header may carry a unit behind the name: "time [ms]" is found as "time"."""
    with open(pathlib.Path(run) / "history.csv", newline="") as file:
        names, *rows = csv.reader(file)
    values = np.array(rows, dtype=float)
    return {name.split("[")[0].strip(): values[:, i] for i, name in enumerate(names)}


def read_snapshots(run):
    """Of each snapshot: time, ∫λ dA, and V_m and q at the north pole."""
    result = {"time": [], "tension_integral": [], "Vm_north": [], "q_north": []}
    with h5py.File(pathlib.Path(run) / "run.h5") as file:
        # Gauss weights of the latitudes; the membrane grid is [latitude, longitude].
        weight = file["grid/weight"][:].reshape(-1, 1)
        for snapshot in file["snapshots"].values():
            result["time"].append(snapshot.attrs["time"])
            # ∫ f dA = Σ f · weight · area_element
            result["tension_integral"].append(np.sum(snapshot["tension"] * weight * snapshot["area_element"]))
            # Points of the closed surface: those of the grid, then the north pole, then the south pole.
            result["Vm_north"].append(snapshot["surface/Vm"][-2])
            result["q_north"].append(snapshot["surface/q"][-2])
    return {name: np.array(values) for name, values in result.items()}


def read_run(folder):
    with open(pathlib.Path(folder) / "scene.toml", "rb") as file:
        modulus = tomllib.load(file)["membrane"]["bending_modulus"]
    return {"modulus": modulus, "history": read_history(folder), "snapshots": read_snapshots(folder)}


def draw(axes, runs, column, label, colour):
    for run, style in zip(runs, ("-", "--")):
        history, snapshots = run["history"], run["snapshots"]
        axes.plot(history["time"], history[column], style, color=colour)
        if column in snapshots:
            few = slice(None, None, max(1, len(snapshots["time"]) // 20))
            axes.plot(snapshots["time"][few], snapshots[column][few], "o", color=colour, mfc="none", ms=4)
    axes.set_ylabel(label, color=colour)
    axes.tick_params(axis="y", colors=colour)


def draw_figure(runs, file):
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.6), constrained_layout=True)
    # Two quantities of different size: each has an axis in its colour.
    draw(left, runs, "bending_energy_scaled", r"bending energy $\int H^2\, d\gamma$", "tab:blue")
    draw(left.twinx(), runs, "tension_integral", r"tension $\int \lambda\, d\gamma$", "tab:green")
    draw(right, runs, "Vm_north", r"$V_m$ at the north pole", "tab:blue")
    draw(right.twinx(), runs, "q_north", "$q$ at the north pole", "tab:green")
    for axes, title in ((left, "(a)"), (right, "(b)")):
        axes.set_title(title, loc="left")
        axes.set_xlabel("time")
    for run, style in zip(runs, ("-", "--")):
        right.plot([], [], "k" + style, label=rf"$\kappa_B = {run['modulus']}$")
    right.plot([], [], "ko", mfc="none", ms=4, label="from run.h5")
    right.legend(loc="center right")
    figure.savefig(file, dpi=120)


def main():
    parser = argparse.ArgumentParser(description="Draws Figure 4 of the paper from two runs of vehd.")
    parser.add_argument("runs", metavar="RUN", nargs=2, help="folder of a run in an electric field")
    parser.add_argument("-o", "--output", default="figure4.png")
    arguments = parser.parse_args()
    runs = sorted(map(read_run, arguments.runs), key=lambda run: run["modulus"])
    draw_figure(runs, arguments.output)
    for run in runs:
        history, snapshots = run["history"], run["snapshots"]
        # The last row and the last snapshot are both the end of the run.
        difference = max(abs(snapshots[column][-1] - history[column][-1]) / np.max(np.abs(history[column]))
                         for column in ("tension_integral", "Vm_north", "q_north"))
        print(f"κ_B = {run['modulus']}: energy {history['bending_energy_scaled'][-1]:.5g} at time "
              f"{history['time'][-1]:g}; history and snapshots agree to {difference:.0e}")
    print(arguments.output)


if __name__ == "__main__":
    main()
