"""Makes the figure of the paper: PYTHONPATH=build/python python3 docs/paper/figure.py [--quick] [FILE]"""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import vehd  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parent / "scenes"


def errors(axes, quick: bool) -> None:
    """Example 1 of the paper of the method: q and f_E of point sources on shape (33)."""
    degrees = (6, 8) if quick else range(8, 33, 4)
    found = [vehd.example1(degree) for degree in degrees]
    axes.semilogy(degrees, [one["error_q"] for one in found], "o-", label="charge density")
    axes.semilogy(degrees, [one["error_force"] for one in found], "s-", label="electric force")
    axes.set_xlabel("degree of the harmonics")
    axes.set_ylabel("largest error")
    axes.legend()


def shapes(axes, quick: bool) -> None:
    """Example 2: outlines through the axis of the field."""
    times = (0.0, 1.0) if quick else (0.0, 20.0, 30.0, 40.0, 80.0)
    run = vehd.Simulation(SCENES / "figure2.toml")
    for time, colour in zip(times, plt.cm.viridis(np.linspace(0, 0.9, len(times)))):
        run.run(until=time)
        vehd.plot.outline(run.state[0], axes, color=colour, label=f"t = {time:g}")
    axes.set_xlabel("x")
    axes.set_ylabel("z, along the field")
    axes.legend(loc="center", fontsize="small", frameon=False, labelspacing=0.2)


def drive(frequency, ratio):
    """The mean stress that draws a sphere out along the field (above 0) or compresses it: Q of
    docs/experiments/ac_field.md, over the permittivity."""
    radius, permittivity, capacitance, outside = 10e-6, 80 * 8.8541878128e-12, 0.01, 1e-3
    omega = 2 * np.pi * frequency
    k_in, k_out = ratio * outside + 1j * omega * permittivity, outside + 1j * omega * permittivity
    inside = 3 / (2 + k_in / k_out + 2 * k_in / (1j * omega * radius * capacitance))
    return abs(1.5 + 0.5 * k_in / k_out * inside) ** 2 - 4 * abs(inside) ** 2


def diagram(axes, quick: bool) -> None:
    """Shapes over frequency and ratio of conductivities."""
    frequencies = np.logspace(2, 7, 2 if quick else 9)
    ratios = np.logspace(-1, 0.5, 2 if quick else 6)

    def aspect(frequency: float, ratio: float) -> float:
        history = vehd.Simulation(vehd.Scene(SCENES / "ac_field_averaged.toml", {
            "electric.conductivity_in": f"{10 * ratio} uS/cm", "electric.waveform.frequency": f"{frequency} Hz",
            "numerics.degree": 6, "numerics.dt": "10 ms", "numerics.end_time": "20 ms" if quick else "1 s"})).run().history
        return history["aspect_ratio_field"][-1]

    final = [[aspect(frequency, ratio) for frequency in frequencies] for ratio in ratios]
    colours = axes.pcolormesh(frequencies, ratios, final, shading="nearest", cmap="coolwarm", vmin=0.85, vmax=1.15)
    axes.figure.colorbar(colours, ax=axes, label="length over width")
    x, y = np.meshgrid(np.logspace(1.7, 7.3, 300), np.logspace(-1.15, 0.65, 200))
    axes.contour(x, y, drive(x, y), [0.0], colors="k")
    axes.set(xscale="log", yscale="log", xlabel="frequency (Hz)", ylabel="conductivity inside over outside")


def main() -> None:
    """Writes the picture."""
    parser = argparse.ArgumentParser(description="Makes the figure of the paper.")
    parser.add_argument("file", nargs="?", default=HERE / "figure.svg", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="little of it, to see that it works")
    given = parser.parse_args()
    figure, panels = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
    for panel, draw, letter in zip(panels, (errors, shapes, diagram), "abc"):
        draw(panel, given.quick)
        panel.set_title(f"({letter})", loc="left")
    # The same bytes at every run.
    plt.rcParams["svg.hashsalt"] = "vehd"
    figure.savefig(given.file, metadata={"Date": None} if given.file.suffix == ".svg" else None)


if __name__ == "__main__":
    main()
