"""python3 -m vehd: versions, and Example 1 of the paper."""

import argparse

import numpy

import vehd


def main() -> None:
    """Prints both."""
    parser = argparse.ArgumentParser(prog="python3 -m vehd", description="Versions, and Example 1 of the paper.")
    parser.add_argument("--degree", type=int, default=16, help="degree p of the harmonics (default: 16)")
    degree = parser.parse_args().degree
    print(f"vehd {vehd.__version__}")
    for library, version in {**vehd.library_versions(), "numpy": numpy.__version__}.items():
        print(f"{library} {version}")
    found = vehd.example1(degree)
    print("Example 1: shape (33), sigma_i = 2, sigma_e = 1, six point sources")
    print(f"degree {found['order']}: error of q {found['error_q']:.2e}, of f_E {found['error_force']:.2e}, "
          f"{found['iterations']} iterations")


if __name__ == "__main__":
    main()
