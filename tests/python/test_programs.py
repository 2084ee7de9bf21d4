"""What a user meets first: python3 -m vehd, the scripts of the pages, the check, pictures."""

import json
import os
import re
import runpy
import shutil
import subprocess
import sys
import unittest

import numpy as np
import vehd
from helpers import PROGRAM, SHEARED, SOURCE, InFolder

try:
    import matplotlib
except ImportError:
    matplotlib = None

has_elements = os.access(os.path.join(os.path.dirname(PROGRAM), "vehd_fem"), os.X_OK)


def blocks_of(page):
    """The scripts of a page, one after the other."""
    return re.findall(r"```python\n(.*?)```", (SOURCE / page).read_text(), re.S)


class Programs(InFolder):
    def test_example_1_is_that_of_the_program(self):
        self.run_program("verify", "--degree", "10", "--json", self.folder / "verify.json")
        expected = json.loads((self.folder / "verify.json").read_text())
        result = subprocess.run([sys.executable, "-m", "vehd", "--degree", "10"], capture_output=True, text=True,
                                check=True)
        self.assertIn(f"vehd {vehd.__version__}\n", result.stdout)
        self.assertIn("eigen", result.stdout.lower())
        found = vehd.example1(10)
        self.assertIn(f"error of q {found['error_q']:.2e}", result.stdout)
        self.assertEqual(found["iterations"], expected["iterations"])
        for key in ("error_q", "error_force"):
            self.assertAlmostEqual(found[key], expected[key], delta=1e-6 * expected[key])

    def test_steps_of_pairs_take_turns_with_those_of_one(self):
        result = subprocess.run([sys.executable, SOURCE / "docs/examples/pair_step_cost.py", "--steps", "6", "--degree",
                                 "6"], capture_output=True, text=True, check=True)
        lines = result.stdout.splitlines()
        self.assertEqual([line.split(":")[0] for line in lines], ["one alone", "gap 0.10", "gap 0.20", "gap 0.69"])
        self.assertIn(" 1.00 times one alone", lines[0])

    def test_cost_of_a_step_of_a_suspension_is_a_row_of_the_table_of_the_page(self):
        result = subprocess.run([sys.executable, SOURCE / "docs/examples/suspension_step_cost.py", "--steps", "1",
                                 "3:6"], capture_output=True, text=True, check=True)
        heading, _, row = result.stdout.splitlines()
        self.assertIn(heading, (SOURCE / "docs/several_vesicles.md").read_text())
        self.assertRegex(row, r"^\| 3 \| 6 \| [\d.e-]+ \| [\d.e-]+ s \| 0\.\d GB \| \d+ \|$")

    def test_printed_output_of_a_page_is_compared_and_renewed(self):
        page = self.folder / "page.md"
        shown = "```sh\nbuild/vehd verify --degree 6\n```\n\n```text\n…\n     6   {}   {} …\n```\n"
        page.write_text(shown.format("9.99e-04", "9.99e-02"))

        def code(*options):
            return subprocess.run([sys.executable, SOURCE / "docs/examples/printed_output.py", page, "--program", PROGRAM,
                                   *options], capture_output=True).returncode

        self.assertEqual(code("--check"), 1)
        self.assertIn("9.99e-04", page.read_text())
        self.assertEqual(code(), 0)
        self.assertNotIn("9.99e-04", page.read_text())
        self.assertEqual(code("--check"), 0)
        page.write_text(shown.replace("     6 ", "degree six").format("1", "1"))
        self.assertEqual(code(), 1)

    def test_students_get_notebooks_without_answers_and_with_links_to_the_pages(self):
        subprocess.run([sys.executable, SOURCE / "docs/notebooks/editions.py", "-o", self.folder / "editions"],
                       capture_output=True, check=True)
        sources = sorted((SOURCE / "docs/notebooks").glob("*.ipynb"))
        self.assertGreaterEqual(len(sources), 9)
        for source in sources:
            student, teacher = (json.loads((self.folder / "editions" / edition / source.name).read_text())["cells"]
                                for edition in ("student", "teacher"))
            texts = ["".join(cell["source"]) for cell in student]
            self.assertFalse(any("## Answers" in text for text in texts), source.name)
            self.assertIn("## Exercises", texts[-1], source.name)
            self.assertEqual(len(teacher), len(json.loads(source.read_text())["cells"]))
            self.assertLessEqual(len(student), len(teacher))
            for page in re.findall(r"\]\(([^)#:]+\.md)", texts[0]):
                self.assertTrue((self.folder / "editions/student" / page).exists(), f"{source.name}: {page}")

    def test_memory_is_that_of_a_command_and_of_what_it_starts(self):
        holding = "import time; held = b'x' * 200_000_000; time.sleep(1.5)"
        starting = f"import subprocess, sys; sys.exit(subprocess.call([sys.executable, '-c', {holding!r}]) + 4)"
        result = subprocess.run([sys.executable, SOURCE / "docs/examples/memory_of_processes.py", sys.executable, "-c",
                                 starting], capture_output=True, text=True)
        self.assertEqual(result.returncode, 4, result.stderr)
        gigabytes = float(result.stdout.split()[0])
        self.assertGreater(gigabytes, 0.19)
        self.assertLess(gigabytes, 0.3)

    def test_error_bars_of_a_shipped_scene_are_compared_with_a_reference(self):
        result = subprocess.run([sys.executable, SOURCE / "docs/examples/error_bar_coverage.py", PROGRAM, "--tolerance",
                                 "1e-2", "relaxation"], capture_output=True, text=True, check=True)
        match = re.fullmatch(r"relaxation at 1e-2: 20 rows, (\d+) % above the error, (\d+) % below 30 times, median .*\n"
                             r"all: 20 rows, .*\n",
                             result.stdout)
        self.assertTrue(match, result.stdout)
        self.assertGreaterEqual(int(match[1]), 90)
        self.assertGreaterEqual(int(match[2]), 90)

    def test_fields_of_a_tolerance_are_compared_everywhere_on_the_membrane(self):
        result = subprocess.run([sys.executable, SOURCE / "docs/examples/field_errors.py", SOURCE /
                                 "docs/scenes/figure2.toml", "--tolerance", "1e-2", "--reference", "1e-4", "--end",
                                 "2.0"], capture_output=True, text=True, check=True)
        number = r"([\d.e-]+) at most, ([\d.e-]+) in the mean"
        match = re.fullmatch(rf"1e-2: shape {number}; Vm {number}; q {number}\n", result.stdout)
        self.assertTrue(match, result.stdout)
        for largest, mean in zip(match.groups()[::2], match.groups()[1::2]):
            self.assertLess(float(mean), float(largest))
            self.assertGreater(float(mean), 0.0)
            self.assertLess(float(largest), 1.0)

    def test_tensions_in_several_fields_give_the_bending_modulus(self):
        result = subprocess.run([sys.executable, SOURCE / "docs/examples/bending_from_tension.py"], capture_output=True,
                                text=True, check=True)
        found, true = re.search(r"without noise: (\S+) J; true: (\S+) J", result.stdout).groups()
        self.assertLess(abs(float(found) / float(true) - 1), 0.02)
        mean, deviation = re.search(r"with noise of 0.001: (\S+) ± (\S+) J", result.stdout).groups()
        self.assertLess(abs(float(mean) / float(true) - 1), 0.02)
        self.assertLess(float(deviation), 0.02 * float(true))

    @unittest.skipIf(matplotlib is None, "matplotlib (Debian package python3-matplotlib) is missing")
    def test_pictures_of_the_theory_are_drawn_with_the_curvature_of_the_solver(self):
        script = SOURCE / "docs/examples/theory_pictures.py"
        for page in ("model", "electric", "flow", "space"):
            picture = self.folder / f"{page}.png"
            subprocess.run([sys.executable, script, page, picture], check=True)
            self.assertEqual(picture.read_bytes()[1:4], b"PNG")
        degree, found = runpy.run_path(str(script))["curvature_coefficients"](16, 200)
        surface = vehd.Surface.from_shape("ellipsoid", 16, axes=[1.0, 1.0, 2.0])
        expected = surface.analyze(surface.mean_curvature)[[vehd.coefficient_index(n, 0) for n in degree]]
        np.testing.assert_allclose(found, expected, atol=1e-9)

    @unittest.skipIf(matplotlib is None, "matplotlib (Debian package python3-matplotlib) is missing")
    def test_scripts_of_the_pages_run(self):
        (self.folder / "docs/scenes").mkdir(parents=True)
        for scene in (SOURCE / "docs/scenes").glob("*.toml"):
            text = re.sub(r"degree = \d+", "degree = 8", scene.read_text())
            (self.folder / "docs/scenes" / scene.name).write_text(re.sub(r"end_time = [\d.]+$", "end_time = 0.3", text,
                                                                         flags=re.M))
        for page in ("README.md", "docs/python.md"):
            blocks = blocks_of(page)
            self.assertTrue(blocks, page)
            script = "\n".join(blocks)
            if not has_elements:
                script = re.sub(r"^.*vehd\.check\(.*\n", "", script, flags=re.M)
            result = subprocess.run([sys.executable, "-c", script], cwd=self.folder, capture_output=True, text=True,
                                    check=False)
            self.assertEqual(result.returncode, 0, page + "\n" + result.stderr)
            shutil.rmtree(self.folder / "out", ignore_errors=True)
        self.assertEqual(len(blocks_of("README.md")), 1)
        self.assertLessEqual(len(blocks_of("README.md")[0].splitlines()), 15)


class Checks(InFolder):
    def test_what_cannot_be_checked_says_why(self):
        scene = vehd.Scene.from_text(SHEARED)
        with self.assertRaisesRegex(vehd.InputError, "in memory"):
            vehd.check(vehd.Simulation(scene))
        with self.assertRaisesRegex(vehd.InputError, "give a directory"):
            vehd.check(scene)
        if not has_elements:
            with self.assertRaisesRegex(vehd.InputError, "VEHD_FEM_CHECK=ON"):
                vehd.check(scene, self.folder / "check")
            with self.assertRaisesRegex(vehd.InputError, "VEHD_FEM_CHECK=ON"):
                vehd.solve_by_elements(vehd.Surface.sphere(degree=8), vehd.example1_sources(), 2.0, 1.0)

    def test_a_check_is_a_table(self):
        row = {"l2": 0.25, "max": 0.5, "fem_error": 1e-3, "bie_error": 1e-4, "verdict": "agree", "fem_solver": 0.0}
        table = vehd.CheckResult({"verdict": "agree", "fields": {"q": row}, "from_shape": {},
                                  "stored": {"q": {**row, "verdict": "undecided"}}, "in_time": {"Vm": row}}).table
        self.assertEqual(list(table["group"]), ["fields", "stored", "in_time"])
        self.assertEqual(list(table["verdict"]), ["agree", "undecided", "agree"])
        np.testing.assert_array_equal(table["l2"], 0.25)
        self.assertEqual(list(table), ["group", "field", "l2", "max", "fem_error", "bie_error", "verdict"])

    @unittest.skipUnless(has_elements, "the finite elements are not built (VEHD_FEM_CHECK)")
    def test_a_time_to_advance_from_goes_with_a_run(self):
        with self.assertRaisesRegex(vehd.InputError, "--from goes with a run"):
            vehd.check(vehd.Scene.from_text(SHEARED), self.folder / "check", from_time=0.0, quick=True)

    @unittest.skipUnless(has_elements, "the finite elements are not built (VEHD_FEM_CHECK)")
    def test_the_present_state_of_a_run_is_checked(self):
        scene = SHEARED.replace("every = 0.04", "every = 0.1")
        run = vehd.Simulation(vehd.Scene.from_text(scene), self.folder / "run").run(until=0.03)
        found = vehd.check(run, quick=True)
        self.assertEqual(found.time, "0.04")
        self.assertEqual(found.note, "")

    @unittest.skipUnless(has_elements, "the finite elements are not built (VEHD_FEM_CHECK)")
    def test_elements_find_the_charge_of_point_sources(self):
        # Exact solution; a degree more divides the error by about four (docs/two_methods.md).
        shape = vehd.Surface.from_shape("radial", 16, base=1.0, amplitude=0.2, exponent=-3.0,
                                        modes=[{"n": 3, "m": 2, "a": 1.0}])
        errors = [vehd.solve_by_elements(shape, vehd.example1_sources(), 2.0, 1.0, degree=k)["fields"]["q"]["l2"]
                  for k in (2, 3)]
        self.assertLess(errors[0], 0.02)
        self.assertLess(errors[1], 0.5 * errors[0])


@unittest.skipIf(matplotlib is None, "matplotlib (Debian package python3-matplotlib) is missing")
class Pictures(unittest.TestCase):
    def test_curves_are_those_of_the_data(self):
        run = vehd.Simulation(vehd.Scene.from_text(SHEARED)).run(until=0.03)
        figure = vehd.plot.history(run, ["extent_x", "Vm_max"])
        np.testing.assert_array_equal(figure.axes[1].lines[0].get_ydata(), run.history["Vm_max"])
        self.assertEqual(figure.axes[1].get_xlabel(), "time")
        self.assertEqual([axes.get_ylabel() for axes in vehd.plot.history(run.history, "extent_z").axes], ["extent_z"])
        with self.assertRaisesRegex(TypeError, "what is 'out/relaxation'; accepted: a simulation, or a table"):
            vehd.plot.history("out/relaxation")
        line = vehd.plot.outline(vehd.Surface.from_shape("ellipsoid", 8, axes=[1.0, 1.0, 2.0])).lines[0]
        x, z = line.get_data()
        np.testing.assert_allclose(x**2 + z**2 / 4, 1.0, atol=1e-12)
        axes = vehd.plot.shape(run.state[0], run.state[0].Vm)
        self.assertEqual(len(axes.collections), 1)

    def test_meshes_of_pyvista_are_the_shape(self):
        try:
            import pyvista  # noqa: F401
        except ImportError:
            self.skipTest("pyvista (not in Debian 12; pip) is missing")
        surface = vehd.Surface.from_shape("ellipsoid", 8, axes=[1.0, 1.0, 2.0])
        mesh = vehd.plot.pyvista_mesh(surface, surface.coefficients[:, 2])
        x, y, z = mesh.points.T
        np.testing.assert_allclose(x**2 + y**2 + z**2 / 4, 1.0, atol=1e-6)
        np.testing.assert_allclose(mesh["values"], z, atol=1e-6)

    def test_tables_become_frames_of_pandas(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas (Debian package python3-pandas) is missing")
        run = vehd.Simulation(vehd.Scene.from_text(SHEARED))
        frame = run.history.to_pandas()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(list(frame), list(run.history))
        self.assertEqual(frame.attrs["units"], run.history.units)

    def test_tables_of_one_unit_are_put_together(self):
        def table(unit, time):
            result = vehd.Table({"time": np.array(time), "volume": np.ones(len(time))})
            result.units = {"time": unit, "volume": ""}
            return result

        together = vehd.concat([table("ms", [0.0, 1.0]), table("ms", [2.0])])
        self.assertEqual(list(together["time"]), [0.0, 1.0, 2.0])
        self.assertEqual(list(together["run"]), [0, 0, 1])
        self.assertEqual(together.units["time"], "ms")
        with self.assertRaisesRegex(vehd.InputError, "column 'time' has the units 'ms', 's'; accepted: one"):
            vehd.concat([table("ms", [0.0]), table("s", [1.0])])
        for wrong in ([table("ms", [0.0]), 3], table("ms", [0.0])):
            with self.assertRaisesRegex(TypeError, "tables is .*; accepted: a list of tables"):
                vehd.concat(wrong)


if __name__ == "__main__":
    unittest.main()
