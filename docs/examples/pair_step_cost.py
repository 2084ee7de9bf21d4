"""Compares the cost of a step of two vesicles with that of the tilted one alone:

    PYTHONPATH=build/python python3 docs/examples/pair_step_cost.py [--steps 40] [--degree 16]

All simulations take turns step by step in one process, on one thread, so that other load of the machine slows all of them
equally. The first four steps are not counted: later solves are faster because they recycle directions of earlier ones.
"""

import argparse
import pathlib
import statistics
import time
import tomllib

import vehd

PLACE_OF_GAP = {0.10: 2.33, 0.20: 2.43, 0.69: 2.92}  # x of the second centre
NOT_COUNTED = 4  # first steps


def scenes(degree: int) -> dict:
    """One vesicle alone, and two with each gap."""
    pair = tomllib.loads((pathlib.Path(__file__).parent / "pair_off_axis.toml").read_text())
    pair["numerics"] |= {"degree": degree, "end_time": 1e3}
    vesicles = pair.pop("vesicle")
    result = {"one alone": pair | {"shape": pair["shape"] | {"rotation": vesicles[1]["shape"]["rotation"]}}}
    for gap, x in PLACE_OF_GAP.items():
        _, y, z = vesicles[1]["shape"]["centre"]
        second = vesicles[1] | {"shape": vesicles[1]["shape"] | {"centre": [x, y, z]}}
        result[f"gap {gap:.2f}"] = pair | {"vesicle": [vesicles[0], second]}
    return result


def main() -> None:
    """Prints a line for each scene."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--steps", type=int, default=40)
    arguments.add_argument("--degree", type=int, default=16)
    options = arguments.parse_args()
    vehd.set_threads(1)
    runs = {name: vehd.Simulation(scene) for name, scene in scenes(options.degree).items()}
    seconds = {name: [] for name in runs}
    for i in range(options.steps):
        for name, run in runs.items():
            begin = time.process_time()
            run.step()
            if i >= NOT_COUNTED:
                seconds[name].append(time.process_time() - begin)
    alone = seconds["one alone"]
    for name, own in seconds.items():
        of_pairs = statistics.median(a / b for a, b in zip(own, alone))
        print(f"{name}: {1e3 * statistics.median(own):.1f} ms a step, {statistics.median(own) / statistics.median(alone):.2f} "
              f"times one alone; of steps in turn {of_pairs:.2f}")


if __name__ == "__main__":
    main()
