"""Draws a picture of one of the pages of docs/theory from its formulas on the sphere and a prolate:

    python3 docs/examples/theory_pictures.py model|electric|flow|space PICTURE.png

Needs numpy and matplotlib (Debian: python3-numpy, python3-matplotlib).
"""

import argparse

import matplotlib

matplotlib.use("Agg")  # Draws to a file and needs no display.
import matplotlib.pyplot as plt
import numpy as np


def draw_model(left, right):
    """A sphere that charges: V_m at its pole, and the stress Q that deforms it, for three ratios of conductivities."""
    time = np.linspace(0, 4, 400)  # t/τ
    left.plot(time, 1 - np.exp(-time), "k")
    left.set(xlabel=r"$t/\tau$", ylabel=r"$V/(1.5\,aE)$")
    for ratio in (0.1, 0.5, 2.0):
        inner = 3 * np.exp(-time) / (2 + ratio)  # field inside over E
        stress = (1.5 + ratio * inner / 2) ** 2 - 4 * inner**2
        line, = right.plot(time, stress, label=rf"$\sigma_i/\sigma_e = {ratio:g}$")
        if ratio < 1:
            right.plot(np.log((4 - ratio) / (2 + ratio)), 0, "o", color=line.get_color())
    right.axhline(0, color="grey", lw=0.8)
    right.set(xlabel=r"$t/\tau$", ylabel=r"$Q_2/\varepsilon$")


def draw_electric(left, right):
    """Layers of the density cos θ on the unit sphere and their derivatives, along the axis θ = 0."""
    inside, outside = np.linspace(0, 1, 50), np.linspace(1, 3, 100)
    for axes, layers in ((left, {"S[f]": (inside / 3, outside**-2 / 3), "D[f]": (-2 * inside / 3, outside**-2 / 3)}),
                         (right, {r"\partial_nS[f]": (0 * inside + 1 / 3, -2 * outside**-3 / 3),
                                  r"\partial_nD[f]": (0 * inside - 2 / 3, -2 * outside**-3 / 3)})):
        for (name, (within, beyond)), style in zip(layers.items(), ("-", "--")):
            line, = axes.plot(inside, within, style, label=f"${name}$")
            axes.plot(outside, beyond, style, color=line.get_color())
        axes.axvline(1, color="grey", lw=0.8)
        axes.set_xlabel("$r/a$")
    left.set_ylabel(r"layer over $a$ ($S$), layer ($D$)")
    right.set_ylabel(r"derivative ($S$), derivative times $a$ ($D$)")


def draw_flow(left, right):
    """Magnitudes of the eigenvalues of the Stokes layers on the unit sphere at viscosity 1."""
    n = np.arange(1, 33)
    single = {"V": n / ((2 * n + 1) * (2 * n + 3)), "W": (n + 1) / ((2 * n + 1) * (2 * n - 1)), "X": 1 / (2 * n + 1)}
    double = {"V": 1.5 / ((2 * n + 1) * (2 * n + 3)), "W": 1.5 / ((2 * n - 1) * (2 * n + 1)), "X": 1.5 / (2 * n + 1)}
    for axes, values, label in ((left, single, r"eigenvalue of $\mu S/a$"), (right, double, "|eigenvalue| of $D$")):
        for (name, value), style in zip(values.items(), "osv"):
            axes.loglog(n, value, style, ms=4, label=f"${name}$")
        axes.set(xlabel="degree $n$", ylabel=label)


def curvature_coefficients(degree, n_nodes):
    """Coefficients of degrees 0, 2, … of the mean curvature of the prolate 1:1:2, from Gauss-Legendre nodes in cos θ."""
    cosine, weight = np.polynomial.legendre.leggauss(n_nodes)
    stretch = 4 - 3 * cosine**2  # |∂x/∂θ|²
    curvature = -(1 / stretch**1.5 + 1 / stretch**0.5)
    even = np.arange(0, degree + 1, 2)
    harmonics = np.array([np.sqrt((2 * n + 1) / (4 * np.pi)) * np.polynomial.legendre.Legendre.basis(n)(cosine)
                          for n in even])
    return even, 2 * np.pi * harmonics @ (weight * curvature)


def draw_space(left, right):
    """The spectrum of H of a prolate, and the aliasing of a grid of degree p = 16 and of one of degree 2p."""
    p = 16
    degree, exact = curvature_coefficients(p, 200)
    left.semilogy(degree, abs(exact), "ko-")
    left.set(xlabel="degree $n$", ylabel="$|H_n|a$")
    for factor, style in ((1, "o-"), (2, "s-")):
        error = abs(curvature_coefficients(p, factor * p + 1)[1] - exact)
        right.semilogy(degree, error, style, label="grid of degree $p$" if factor == 1 else "grid of degree $2p$")
    right.set(xlabel="degree $n$", ylabel="error of $H_na$")


DRAW = {"model": draw_model, "electric": draw_electric, "flow": draw_flow, "space": draw_space}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", choices=DRAW)
    parser.add_argument("picture")
    arguments = parser.parse_args()
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    DRAW[arguments.page](*panels)
    for axes in panels:
        if axes.get_legend_handles_labels()[0]:
            axes.legend()
    figure.savefig(arguments.picture, dpi=120)


if __name__ == "__main__":
    main()
