"""Measures quality and cost of error bars for shipped scenes at given tolerances:

    python3 docs/examples/error_bar_coverage.py build/vehd --tolerance 1e-2,1e-3 figure2 dc_pulse

Each scene runs with error bars, without them, and at the tolerance of the reference. Bars and errors are divided by the
largest value of their column; a row at a snapshot has the largest bar and the largest error of its columns. Each line prints
the share of rows whose bar is above the error, the share whose bar is below 30 times the error, median and range of bar over
error, and the additional processor time with error bars, from the faster of two runs of either kind. The last line prints
the shares of all rows.
"""

import argparse
import csv
import math
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"
# End and time between snapshots of scenes that are long or have few snapshots.
SHORTENED = {
    "ac_field_averaged": ('"125 ms"', '"6.25 ms"'),
    "figure5_half": ("2.5", "0.125"),
    "figure5_two": ("2.5", "0.125"),
    "settling_in_shear": ('"3 s"', '"0.25 s"'),
    "two_prolates": ("5.0", "0.25"),
}
# The columns that count for error_bars in summary.json.
COLUMNS = ["reduced_volume", "bending_energy_scaled", "tension_integral", "Vm_north", "q_north", "Vm_max", "extent_x",
           "extent_y", "extent_z", "inclination_deg", "smallest_gap"]
UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1.0}


def scene_at(name: str, tolerance: str, error_bars: bool) -> str:
    """Returns the scene with degree and order that follow from the tolerance."""
    text = re.sub(r"\n(degree|dt|tolerance|time_order) = .*", "", (SCENES / f"{name}.toml").read_text())
    bars = "true" if error_bars else "false"
    text = text.replace("[numerics]", f"[numerics]\ntolerance = {tolerance}\nerror_bars = {bars}")
    if name in SHORTENED:
        shorter_end, every = SHORTENED[name]
        text = re.sub(r"\nend_time = .*", f"\nend_time = {shorter_end}", text)
        text = re.sub(r"\nevery = .*", f"\nevery = {every}", re.sub(r"\ntimes = .*", "", text))
    return text


def seconds_of(text: str, key: str) -> float:
    """Returns a time of the scene, in seconds if it has a unit."""
    value, _, unit = re.search(rf'\n{key} = "?([^"\n]*)', text).group(1).partition(" ")
    return float(value) * UNITS.get(unit, 1.0)


def run(program: str, text: str, folder: pathlib.Path) -> float:
    """Runs the scene on one thread and returns its processor seconds."""
    folder.mkdir(parents=True)
    (folder / "scene.toml").write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "run", folder / "scene.toml", "-o", folder / "run", "--no-plot", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL, env=dict(os.environ, OMP_NUM_THREADS="1"))
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def table(path: pathlib.Path) -> list:
    with path.open() as file:
        return [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def numbered(rows: list) -> dict:
    """Returns rows by time and a number, because a jump of the forcing has two rows."""
    result, count = {}, {}
    for index, row in enumerate(rows):
        time = float(f"{row['time']:.8g}")
        count[time] = count.get(time, -1) + 1
        result[time, count[time]] = index
    return result


def sizes_of(history: list) -> dict:
    sizes = {name: 180 / math.pi if name == "inclination_deg" else max(abs(row[name]) for row in history)
             for name in COLUMNS if name in history[0]}
    if "Vm_north" in sizes and sizes["Vm_north"] <= 1e-9 * sizes["Vm_max"]:
        del sizes["Vm_north"], sizes["q_north"]  # zero by symmetry
    return {name: size for name, size in sizes.items() if size > 0 and math.isfinite(size)}


def largest(difference, sizes: dict) -> float:
    def of(name):
        value = abs(difference(name))
        return min(value, 180 - value) if name == "inclination_deg" else value
    return max(of(name) / size for name, size in sizes.items())


def ratios_of(folder: pathlib.Path, reference: pathlib.Path, n_snapshots: int) -> list:
    """Returns bar over error at the snapshots after the start."""
    history, errors = table(folder / "run/history.csv"), table(folder / "run/history_error.csv")
    exact = table(reference / "run/history.csv")
    sizes, there = sizes_of(history), numbered(exact)
    end = history[-1]["time"]
    due = {float(f"{end * k / n_snapshots:.8g}") for k in range(1, n_snapshots + 1)}
    ratios = []
    for key, i in numbered(history).items():
        if key[0] in due and key in there:
            true = largest(lambda name: history[i][name] - exact[there[key]][name], sizes)
            ratios.append(largest(lambda name: errors[i][name], sizes) / true)
    return ratios


def shares(ratios: list) -> str:
    """Returns the shares of bars above the error and below 30 times the error."""
    above = sum(ratio >= 1 for ratio in ratios) / len(ratios)
    below = sum(ratio <= 30 for ratio in ratios) / len(ratios)
    return f"{len(ratios)} rows, {100 * above:.0f} % above the error, {100 * below:.0f} % below 30 times"


def line_of(ratios: list, more: float) -> str:
    if not ratios:
        return "no snapshots"
    return (f"{shares(ratios)}, median {statistics.median(ratios):.2g}, from {min(ratios):.2g} to {max(ratios):.2g}, "
            f"{100 * more:.0f} % more seconds")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", default=sorted(path.stem for path in SCENES.glob("*.toml")))
    parser.add_argument("--tolerance", type=lambda text: text.split(","), default=["1e-3"], help="such as 1e-2,1e-3")
    parser.add_argument("--reference", default="1e-6", help="tolerance of the runs that count as exact")
    arguments = parser.parse_intermixed_args()
    all_ratios = []
    with tempfile.TemporaryDirectory() as temporary:
        for name in arguments.scenes:
            reference = pathlib.Path(temporary) / f"{name}_at_{arguments.reference}"
            run(arguments.program, scene_at(name, arguments.reference, False), reference)
            for tolerance in arguments.tolerance:
                folder = pathlib.Path(temporary) / f"{name}_of_{tolerance}"
                text, plain_text = scene_at(name, tolerance, True), scene_at(name, tolerance, False)
                # Other load of the machine makes runs slower, never faster.
                plain = min(run(arguments.program, plain_text, folder / f"plain_{k}") for k in range(2))
                more = min(run(arguments.program, text, folder / f"bars_{k}") for k in range(2)) / plain - 1
                n_snapshots = round(seconds_of(text, "end_time") / seconds_of(text, "every"))
                ratios = ratios_of(folder / "bars_0", reference, n_snapshots)
                print(f"{name} at {tolerance}: {line_of(ratios, more)}", flush=True)
                all_ratios += ratios
    print(f"all: {shares(all_ratios)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
