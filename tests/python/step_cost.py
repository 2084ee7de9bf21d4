"""What a step from Python costs against one of the program: python3 step_cost.py VEHD [REPEATS]

The same run with the same files, in turn from Python and from the program, at degrees 8 and 16: processor time of the steps
alone, which other work on the machine disturbs less than seconds do. Of the program a run that only starts is taken off.
"""

import pathlib
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


def seconds_of(who: int) -> float:
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def of_program(program: str, scene: pathlib.Path, target: pathlib.Path) -> float:
    before = seconds_of(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "run", scene, "-o", target, "--no-plot", "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return seconds_of(resource.RUSAGE_CHILDREN) - before


def of_python(scene: pathlib.Path, target: pathlib.Path) -> float:
    run = vehd.Simulation(scene, target)
    before = seconds_of(resource.RUSAGE_SELF)
    for _ in run:
        run.state[0].position
    return seconds_of(resource.RUSAGE_SELF) - before


def main() -> None:
    """Prints a line for each degree."""
    program, repeats = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 7
    for degree, n_steps in ((8, 50), (16, 10)):
        ratios, least = [], {"python": float("inf"), "program": float("inf")}
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            scene, start = folder / "scene.toml", folder / "start.toml"
            scene.write_text(SCENE.format(degree=degree, end=0.02 * n_steps))
            start.write_text(SCENE.format(degree=degree, end=0.0))
            for repeat in range(repeats):
                python = of_python(scene, folder / f"python{repeat}")
                steps = (of_program(program, scene, folder / f"program{repeat}")
                         - of_program(program, start, folder / f"start{repeat}"))
                least = {"python": min(python, least["python"]), "program": min(steps, least["program"])}
                ratios.append(python / steps)
        print(f"degree {degree}: {1e3 * least['program'] / n_steps:.2f} ms a step of the program, "
              f"{1e3 * least['python'] / n_steps:.2f} ms from Python (least of {repeats}); median ratio "
              f"{statistics.median(ratios):.3f}")


if __name__ == "__main__":
    main()
