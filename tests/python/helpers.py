"""What several tests need."""

import csv
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

PROGRAM = os.environ["VEHD_PROGRAM"]
SOURCE = pathlib.Path(os.environ["VEHD_SOURCE_DIR"])

# No symmetry: a sheared ellipsoid with a field across, and another viscosity inside.
SHEARED = """
[shape]
kind = "ellipsoid"
axes = [1.6, 1.0, 1.1]
rotation = [1.0, 2.0, 3.0, 40.0]
[membrane]
bending_modulus = 0.1
conductance = 5.0
[fluid]
viscosity_ratio = 2.0
[flow]
kind = "shear"
rate = 1.0
[electric]
field = [0.3, 0.1, 1.0]
conductivity_in = 2.0
conductivity_out = 1.0
[numerics]
degree = 6
dt = 0.02
end_time = 0.1
[output]
every = 0.04
"""

# The solver turns it: the field lies along x.
TURNED = """
[shape]
kind = "ellipsoid"
axes = [1.5, 1.0, 1.0]
[membrane]
bending_modulus = 0.1
[electric]
field = [1.0, 0.0, 0.0]
conductivity_in = 1.0
conductivity_out = 2.0
[numerics]
degree = 8
dt = 0.05
end_time = 0.2
"""

SEVERAL = """
[shape]
kind = "ellipsoid"
axes = [1.0, 1.0, 1.5]
[membrane]
bending_modulus = 0.1
[flow]
kind = "shear"
rate = 1.0
[numerics]
degree = 6
dt = 0.05
end_time = 0.1
[[vesicle]]
name = "lower"
shape.centre = [0.2, 0.0, -2.0]
[[vesicle]]
name = "upper"
shape.centre = [0.0, 0.1, 2.0]
"""

ADAPTIVE = TURNED.replace("dt = 0.05", "tolerance = 1e-2\n") + "\n[output]\nevery = 0.03\n"

# In SI units, so that the history has others than the scene.
IN_SI = """
[units]
length = "10 um"
[shape]
kind = "ellipsoid"
axes = [1.0, 1.0, 1.4]
[membrane]
bending_modulus = "4e-20 J"
[fluid]
viscosity = "1e-3 Pa s"
[flow]
kind = "shear"
rate = "1 1/s"
[numerics]
degree = 6
dt = "20 ms"
end_time = "60 ms"
"""


class InFolder(unittest.TestCase):
    """Each test works in a folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, text, name="scene.toml"):
        file = self.folder / name
        file.write_text(text)
        return file

    def run_program(self, *arguments, code=0):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, code, result.stderr)
        return result


def table_of(file):
    """A csv as columns by their plain names, without the checksum that ends each row."""
    with open(file, newline="") as lines:
        rows = list(csv.reader(lines))
    if rows[0][-1] == "checksum":
        rows = [row[:-1] for row in rows]
    values = np.array([[float(cell) for cell in row] for row in rows[1:]])
    return {name.split(" [")[0]: values[:, i] for i, name in enumerate(rows[0])}


def address(array):
    return array.__array_interface__["data"][0]
