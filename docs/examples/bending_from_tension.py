"""The bending modulus from the aspect ratio of a vesicle in ac fields of several strengths:

    python3 docs/examples/bending_from_tension.py [--deviation 0.001]

As in Kummrow and Helfrich 1991: the shape in each field gives the tension, by the balance of stresses of a nearly
spherical vesicle, and the area that undulations have set free; the slope of ln σ against α is 8πκ_c/k_BT. The data are
aspect ratios that vehd computes, with normal noise of the given standard deviation.

Needs the Python module vehd and NumPy.
"""

import argparse
import pathlib

import numpy as np
import vehd

SCENE = pathlib.Path(__file__).with_name("stretched_by_field.toml")
FIELDS = np.array([1e3, 2e3, 4e3, 8e3, 1.6e4])  # V/m
RADIUS = 10e-6
THERMAL_ENERGY = 1.380649e-23 * 298.0
STRETCHING_MODULUS = 0.24
CONDUCTIVITY_IN, CONDUCTIVITY_OUT, PERMITTIVITY = 3e-3, 1e-3, 80 * 8.8541878128e-12
CAPACITANCE, FREQUENCY = 0.01, 1e3
TRUE_MODULUS = 1e-19


def aspect_ratio(field: float) -> float:
    """Of the shape at rest."""
    simulation = vehd.Simulation(vehd.Scene(SCENE, {"electric.field": [0, 0, f"{field} V/m"]})).run()
    return simulation.history["aspect_ratio_field"][-1]


def deforming_stress() -> float:
    """Q of docs/experiments/ac_field.md: E²Q/6 deforms a sphere, all fluids of one permittivity."""
    omega = 2 * np.pi * FREQUENCY
    inside, outside = (sigma + 1j * omega * PERMITTIVITY for sigma in (CONDUCTIVITY_IN, CONDUCTIVITY_OUT))
    ratio = inside / outside
    field = 3 / (2 + ratio + 2 * ratio * outside / (RADIUS * 1j * omega * CAPACITANCE))
    return PERMITTIVITY * (abs(1.5 + ratio * field / 2) ** 2 - 4 * abs(field) ** 2)


def excess_area(ratio: np.ndarray) -> np.ndarray:
    """A/4πa² − 1 of the prolate spheroid with this ratio of its axes."""
    short, eccentricity = ratio ** (-1 / 3), np.sqrt(1 - ratio**-2)
    return short**2 / 2 + short**2 * ratio / 2 * np.arcsin(eccentricity) / eccentricity - 1


def bending_modulus(ratios: np.ndarray) -> float:
    """κ_c in J."""
    free_area = excess_area(ratios)
    amplitude = np.sqrt(2.5 * free_area)  # s₂
    modulus = 1e-19
    for _ in range(50):  # Bending is a small part of the balance of stresses.
        tension = FIELDS**2 * deforming_stress() * RADIUS / (24 * amplitude) - 6 * modulus / RADIUS**2
        logarithm = np.log(1 + 0.1 * tension * 4 * np.pi * RADIUS**2 / modulus)
        slope = np.polyfit(free_area - tension / STRETCHING_MODULUS, logarithm, 1)[0]
        modulus = THERMAL_ENERGY * slope / (8 * np.pi)
    return modulus


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--deviation", type=float, default=0.001, help="of an aspect ratio")
    deviation = parser.parse_args().deviation
    exact = np.array([aspect_ratio(field) for field in FIELDS])
    noise = np.random.default_rng(1).normal(scale=deviation, size=(1000, len(FIELDS)))
    found = [bending_modulus(exact + one) for one in noise]
    for field, ratio in zip(FIELDS, exact):
        print(f"{field / 1e3:5.1f} kV/m: aspect ratio {ratio:.4f}")
    print(f"κ_c without noise: {bending_modulus(exact):.4g} J; true: {TRUE_MODULUS:.4g} J")
    print(f"with noise of {deviation:g}: {np.mean(found):.4g} ± {np.std(found):.2g} J in 1000 repetitions")


if __name__ == "__main__":
    main()
