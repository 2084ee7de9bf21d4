"""What a step from Python costs against one of the program:

    python3 step_cost.py VEHD [REPEATS]          processor time, of runs in turn
    python3 step_cost.py VEHD --instructions     counted by valgrind, whatever else runs on the machine; of a build that
                                                 valgrind knows all instructions of, such as build-levels

The same run with the same files, at degrees 8 and 16, with arrays on the state of every step. From either a shorter run is
taken off.
"""

import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile

import vehd

SCENE = """
[shape]
kind = "ellipsoid"
axes = [1.3, 1.0, 1.1]
[membrane]
bending_modulus = 0.1
conductance = 1.0
[flow]
kind = "shear"
rate = 1.0
[electric]
field = [0.0, 0.0, 1.0]
conductivity_in = 2.0
conductivity_out = 1.0
[numerics]
degree = {degree}
dt = 0.02
end_time = {end}
"""


def step_all(scene: str, target: str) -> None:
    """The run from Python."""
    run = vehd.Simulation(scene, target)
    for _ in run:
        run.state[0].position
    run.close()


def of_program(program: str, scene: str, target: str) -> list:
    return [program, "run", scene, "-o", target, "--no-plot", "--quiet"]


def seconds_of(who: int) -> float:
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def seconds_of_program(program: str, scene: str, target: str) -> float:
    before = seconds_of(resource.RUSAGE_CHILDREN)
    subprocess.run(of_program(program, scene, target), check=True, stdout=subprocess.DEVNULL)
    return seconds_of(resource.RUSAGE_CHILDREN) - before


def seconds_of_python(scene: str, target: str) -> float:
    before = seconds_of(resource.RUSAGE_SELF)
    step_all(scene, target)
    return seconds_of(resource.RUSAGE_SELF) - before


def instructions_of(command: list) -> int:
    # The program starts itself anew where this is not set, which valgrind cannot follow.
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "1"}
    result = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command], text=True,
                            env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(result.stderr)
    return int(re.search(r"Collected : (\d+)", result.stderr).group(1))


class Runs:
    """A run of some steps and a shorter one, each in a folder of its own whenever it is made."""

    def __init__(self, folder: pathlib.Path, degree: int, steps: tuple):
        self.folder, self.count = folder, 0
        self.scenes = []
        for n in steps:
            self.scenes.append(str(folder / f"steps{n}.toml"))
            pathlib.Path(self.scenes[-1]).write_text(SCENE.format(degree=degree, end=0.02 * n))

    def difference(self, measure) -> float:
        """Of what both cost."""
        costs = []
        for scene in self.scenes:
            self.count += 1
            costs.append(measure(scene, str(self.folder / f"run{self.count}")))
        return costs[1] - costs[0]


def compare_times(program: str, repeats: int) -> None:
    for degree, n_steps in ((8, 100), (16, 20)):
        with tempfile.TemporaryDirectory() as folder:
            runs = Runs(pathlib.Path(folder), degree, (0, n_steps))
            pairs = [(runs.difference(seconds_of_python),
                      runs.difference(lambda *run: seconds_of_program(program, *run))) for _ in range(repeats)]
        python, other = (1e3 * min(seconds) / n_steps for seconds in zip(*pairs))
        ratio = statistics.median(one / two for one, two in pairs)
        print(f"degree {degree}: {other:.2f} ms a step of the program, {python:.2f} ms from Python (least of {repeats}), "
              f"{python / other:.3f} times as much; median of pairs {ratio:.3f}")


def compare_instructions(program: str) -> None:
    for degree, steps in ((8, (5, 15)), (16, (2, 6))):
        with tempfile.TemporaryDirectory() as folder:
            runs = Runs(pathlib.Path(folder), degree, steps)
            python = runs.difference(lambda *run: instructions_of([sys.executable, __file__, "--step", *run]))
            other = runs.difference(lambda *run: instructions_of(of_program(program, *run)))
        n_steps = steps[1] - steps[0]
        print(f"degree {degree}: {other / n_steps / 1e6:.2f} million instructions a step of the program, "
              f"{python / n_steps / 1e6:.2f} from Python, {python / other:.4f} times as many")


def main() -> None:
    """Prints a line for each degree."""
    if sys.argv[1] == "--step":
        step_all(*sys.argv[2:])
    elif sys.argv[2:] == ["--instructions"]:
        compare_instructions(sys.argv[1])
    else:
        compare_times(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 7)


if __name__ == "__main__":
    main()
