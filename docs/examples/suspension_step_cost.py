"""Prints the cost of a step of suspensions of equal volume fraction in shear, the table of docs/several_vesicles.md:

    PYTHONPATH=build/python python3 docs/examples/suspension_step_cost.py [--steps 5] [--threads 2] [50:8 500:8 100:12]

Each argument is a number of vesicles and their degree. Each suspension has a process of its own, so that its memory is its own.
Times are medians over the steps after the first, which sets up the operators.
"""

import argparse
import multiprocessing
import pathlib
import re
import statistics
import time
import tomllib

import vehd


def scene(vesicles: int, degree: int) -> dict:
    """That of fifty prolates in a box of another size, with as many vesicles per volume."""
    result = tomllib.loads((pathlib.Path(__file__).parent / "fifty_prolates.toml").read_text())
    suspension = result["suspension"]
    scale = (vesicles / suspension["count"]) ** (1 / 3)
    suspension |= {"count": vesicles, "size": [scale * length for length in suspension["size"]]}
    result["numerics"] |= {"degree": degree, "end_time": 1e3}
    return result


def row(vesicles: int, degree: int, steps: int, threads: int) -> str:
    """A row of the table."""
    vehd.set_threads(threads)
    run = vehd.Simulation(scene(vesicles, degree))
    seconds, processor_seconds = [], []
    for _ in range(1 + steps):
        begin, processor_begin = time.perf_counter(), time.process_time()
        run.step()
        seconds.append(time.perf_counter() - begin)
        processor_seconds.append(time.process_time() - processor_begin)
    gigabytes = int(re.search(r"VmHWM:\s*(\d+) kB", pathlib.Path("/proc/self/status").read_text())[1]) / 1e6
    iterations = statistics.median(run.history["iterations_flow"][-steps:]) / vesicles
    return (f"| {vesicles} | {degree} | {statistics.median(seconds[1:]):.2g} | {statistics.median(processor_seconds[1:]):.2g} s "
            f"| {gigabytes:.1f} GB | {iterations:.0f} |")


def main() -> None:
    """Prints the rows."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("suspensions", nargs="*", default=["50:8", "500:8", "100:12"], help="VESICLES:DEGREE")
    arguments.add_argument("--steps", type=int, default=5)
    arguments.add_argument("--threads", type=int, default=2)
    options = arguments.parse_args()
    print("| vesicles | degree | seconds | processor time | memory | flow iterations per vesicle |")
    print("| --- | --- | --- | --- | --- | --- |")
    for suspension in options.suspensions:
        vesicles, degree = map(int, suspension.split(":"))
        with multiprocessing.get_context("spawn").Pool(1) as process:
            print(process.apply(row, (vesicles, degree, options.steps, options.threads)), flush=True)


if __name__ == "__main__":
    main()
