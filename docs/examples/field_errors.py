"""How wrong a scene is at its end with some tolerances, everywhere on the membrane:

    python3 docs/examples/field_errors.py docs/scenes/figure5_two.toml --tolerance 1e-4,1e-5 --end 1.5

Each run is compared with one at the tolerance of the reference, point by point of its grid with the nearest point of
the other membrane: the displacement along the normal over the radius, and V_m and q over their largest magnitude, in
the maximum and the root mean square over the membrane, all over the tolerance that was asked for. Needs numpy and the
module vehd (docs/python.md).
"""

import argparse
import pathlib
import re

import numpy as np
import vehd


def scene_at(path: pathlib.Path, tolerance: str, end: str) -> vehd.Scene:
    """The scene with degree and order of the tolerance, and no snapshots but that of its end."""
    text = re.sub(r"\n(degree|dt|tolerance|time_order|every|times) = .*", "", path.read_text())
    text = text.replace("[numerics]", f"[numerics]\ntolerance = {tolerance}")
    if end:
        text = re.sub(r"\nend_time = .*", f"\nend_time = {end}", text)
    return vehd.Scene.from_text(text, folder=str(path.parent))


def nearest(coefficients: np.ndarray, points: np.ndarray, theta: np.ndarray, phi: np.ndarray):
    """Angles of the points of a surface that are nearest to others, from angles nearby."""
    step = 1e-5

    def place(t, p):
        return vehd.evaluate_harmonics(coefficients, t, p)

    for _ in range(4):
        away = points - place(theta, phi)
        along = [(place(theta + step, phi) - place(theta - step, phi)) / (2 * step),
                 (place(theta, phi + step) - place(theta, phi - step)) / (2 * step)]
        metric = np.array([[np.sum(a * b, axis=1) for b in along] for a in along])
        force = np.array([np.sum(a * away, axis=1) for a in along])
        change = np.linalg.solve(metric.transpose(2, 0, 1), force.T[..., None])
        theta, phi = theta + change[:, 0, 0], phi + change[:, 1, 0]
    return theta, phi


def errors(run: vehd.Simulation, exact: vehd.Simulation) -> dict:
    """Largest and root mean square error of each quantity, over its size."""
    found, true = run.state[0], exact.state[0]
    surface = vehd.Surface(found.position)
    theta, phi = (a.ravel() for a in np.meshgrid(surface.theta, surface.phi, indexing="ij"))
    theta, phi = nearest(true.position, surface.position, theta, phi)
    radius = np.sqrt(surface.area / (4 * np.pi))
    away = surface.position - vehd.evaluate_harmonics(true.position, theta, phi)
    values = {"shape": (np.sum(away * surface.normal, axis=1), radius)}
    for name in ("Vm", "q"):
        if getattr(true, name) is not None:
            there = vehd.evaluate_harmonics(getattr(true, name)[:, None], theta, phi).ravel()
            values[name] = (surface.synthesize(getattr(found, name)).ravel() - there, np.abs(there).max())
    return {name: (np.abs(error).max() / size, np.sqrt(np.sum(surface.weight * error**2) / surface.area) / size)
            for name, (error, size) in values.items()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--tolerance", type=lambda text: text.split(","), default=["1e-3"], help="such as 1e-2,1e-3")
    parser.add_argument("--reference", default="1e-7", help="tolerance of what counts as true")
    parser.add_argument("--end", default="", help="of the runs, in the words of the scene; its own if not given")
    arguments = parser.parse_args()
    exact = vehd.Simulation(scene_at(arguments.scene, arguments.reference, arguments.end)).run()
    for tolerance in arguments.tolerance:
        run = vehd.Simulation(scene_at(arguments.scene, tolerance, arguments.end)).run()
        told = "; ".join(f"{name} {largest / float(tolerance):.2g} at most, {mean / float(tolerance):.2g} in the mean"
                         for name, (largest, mean) in errors(run, exact).items())
        print(f"{tolerance}: {told}", flush=True)


if __name__ == "__main__":
    main()
