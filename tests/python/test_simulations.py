"""Simulations: the bits of the program, views, files, signals, threads."""

import gc
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np
import vehd
from helpers import ADAPTIVE, IN_SI, SEVERAL, SHEARED, TURNED, InFolder, address, table_of


class Bits(InFolder):
    def assert_same_table(self, table, expected):
        self.assertEqual(list(table), list(expected))
        for name, column in expected.items():
            np.testing.assert_array_equal(table[name], column, err_msg=name)

    def test_histories_are_those_of_the_program(self):
        for name, scene in {"sheared": SHEARED, "turned": TURNED, "several": SEVERAL, "adaptive": ADAPTIVE,
                            "si": IN_SI}.items():
            with self.subTest(name):
                file = self.write(scene, name + ".toml")
                self.run_program("run", file, "-o", self.folder / name, "--no-plot", "--quiet")
                expected = table_of(self.folder / name / "history.csv")
                run = vehd.Simulation(file).run()
                self.assertTrue(run.completed)
                self.assert_same_table(run.history, expected)
                self.assert_same_table(vehd.read_history(self.folder / name), expected)
                if name == "several":
                    self.assert_same_table(run.vesicle_history, table_of(self.folder / name / "vesicles.csv"))
                if name == "si":
                    self.assertEqual(run.history.units["time"], "ms")
                    self.assertAlmostEqual(run.time, 60.0)

    def test_files_are_those_of_the_program_whoever_goes_on(self):
        file = self.write(SHEARED)
        self.run_program("run", file, "-o", self.folder / "program", "--no-plot", "--quiet")
        expected = (self.folder / "program/history.csv").read_bytes()

        with vehd.Simulation(file, self.folder / "python") as run:
            run.run(until=0.03)
            self.assertEqual(run.status.step, 2)
        with self.assertRaisesRegex(RuntimeError, "closed"):
            run.step()
        with self.assertRaisesRegex(vehd.InputError, "resume"):
            vehd.Simulation(file, self.folder / "python")
        with vehd.Simulation(file, self.folder / "python", resume=True) as run:
            self.assertTrue(run.step())
            self.assertEqual(run.status.step, 3)
        self.run_program("run", file, "-o", self.folder / "python", "--no-plot", "--quiet", "--resume")
        self.assertEqual((self.folder / "python/history.csv").read_bytes(), expected)

        run = vehd.Simulation(file, self.folder / "python", resume=True)
        self.assertTrue(run.completed)
        self.assertFalse(run.step())
        self.assertEqual(len(run.history["time"]), 6)

    def assert_snapshot(self, run, time):
        self.assertAlmostEqual(run.time, time)
        scene = vehd.Scene.from_dict({"shape": {"kind": "file", "path": str(self.folder / "run/run.h5"), "time": time},
                                      "membrane": {}, "numerics": {"degree": 6, "dt": 1.0, "end_time": 0.0}})
        np.testing.assert_allclose(scene.position(), run.state[0].position, atol=1e-14)

    def test_a_snapshot_is_added_when_it_is_requested_and_at_the_end(self):
        file = self.write(SHEARED)
        expected = vehd.Simulation(file).run().history
        run = vehd.Simulation(file, self.folder / "run")
        run.step()
        run.snapshot()
        self.assert_snapshot(run, 0.02)
        run.run(until=0.05).close()
        self.assert_snapshot(run, 0.06)
        with self.assertRaisesRegex(RuntimeError, "closed"):
            run.snapshot()
        with self.assertRaisesRegex(vehd.InputError, "in memory"):
            vehd.Simulation(file).snapshot()
        run = vehd.Simulation(file, self.folder / "run", resume=True).run()
        self.assert_snapshot(run, 0.1)
        np.testing.assert_array_equal(run.history["inclination_deg"], expected["inclination_deg"])

    def test_another_scene_does_not_go_on(self):
        scene = vehd.Scene.from_text(SHEARED)
        vehd.Simulation(scene, self.folder / "run").run(until=0.01).close()
        other = vehd.Scene.from_text(SHEARED.replace("rate = 1.0", "rate = 2.0"))
        with self.assertRaisesRegex(vehd.InputError, 'scene:13: "flow.rate" is 2'):
            vehd.Simulation(other, self.folder / "run", resume=True)

    def test_a_run_goes_on_in_another_flow_as_that_of_the_program_does(self):
        first = self.folder / "first"
        vehd.Simulation(vehd.Scene.from_text(SHEARED), first).run()
        after = self.write(SHEARED.replace("rate = 1.0", "rate = 2.0").replace("end_time = 0.1", "end_time = 0.2"),
                           "after.toml")
        self.run_program("run", after, "--from", first, "-o", self.folder / "program", "--no-plot", "--quiet")
        run = vehd.Simulation(after, self.folder / "python", from_run=first).run()
        self.assertTrue(run.completed)
        self.assertGreater(run.history["time"][0], 0.0)
        self.assertEqual((self.folder / "python/history.csv").read_bytes(),
                         (self.folder / "program/history.csv").read_bytes())

    def test_a_run_goes_on_only_from_and_in_a_directory(self):
        file = self.write(SHEARED)
        for wrong in ({"resume": True}, {"from_run": self.folder}, {"resume": True, "from_run": self.folder}):
            with self.subTest(wrong), self.assertRaisesRegex(vehd.InputError, "no directory"):
                vehd.Simulation(file, **wrong)
        for directory in (None, self.folder / "run"):
            with self.assertRaisesRegex(vehd.InputError, "from_run is ''; accepted: the directory of a run"):
                vehd.Simulation(file, directory, from_run="")
        self.assertEqual(list(self.folder.iterdir()), [file])

    def test_a_directory_is_for_one_at_a_time(self):
        scene = vehd.Scene.from_text(SHEARED)
        run = vehd.Simulation(scene, self.folder / "run")
        with self.assertRaises(vehd.InputError):
            vehd.Simulation(scene, self.folder / "run", resume=True)
        run.close()
        vehd.Simulation(scene, self.folder / "run", resume=True).close()


class Tables(unittest.TestCase):
    def test_the_nearest_column_is_named(self):
        table = vehd.Simulation(vehd.Scene.from_text(SHEARED)).history
        with self.assertRaisesRegex(KeyError, "no column 'extentx'; did you mean 'extent_x'"):
            table["extentx"]


class Views(unittest.TestCase):
    def setUp(self):
        self.run_ = vehd.Simulation(vehd.Scene.from_text(SHEARED))

    def test_arrays_are_the_numbers_of_the_solver(self):
        for scene, n_fields in ((SHEARED.replace("degree = 6", "degree = 12"), 9), (SEVERAL, 6)):
            run = vehd.Simulation(vehd.Scene.from_text(scene))
            for _ in range(2):
                for number, vesicle in enumerate(run.state):
                    addresses = run._core.addresses(number)
                    self.assertEqual(len(addresses), n_fields)
                    for name, place in addresses.items():
                        self.assertEqual(address(getattr(vesicle, name)), place, name)
                run.step()
        self.assertGreater(vehd.Simulation(vehd.Scene.from_text(SHEARED)).state[0].position.nbytes, 1000)

    def test_arrays_stay_what_they_are(self):
        vesicle = self.run_.state[0]
        fields = {name: getattr(vesicle, name) for name in (
            "position", "area_strain", "Vm", "velocity", "tension", "q", "force_bending", "force_tension",
            "force_electric")}
        copies = {name: (address(array), array.copy()) for name, array in fields.items()}
        self.run_.run()
        self.assertGreater(np.abs(self.run_.state[0].position - fields["position"]).max(), 1e-3)
        del self.run_, vesicle
        gc.collect()
        for name, (place, copy) in copies.items():
            self.assertEqual(address(fields[name]), place, name)
            np.testing.assert_array_equal(fields[name], copy, err_msg=name)

    def test_arrays_outlive_a_simulation_that_has_not_gone_on(self):
        copy = self.run_.state[0].position.copy()
        vesicle = self.run_.state[0]
        position = vesicle.position
        place = address(position)
        del self.run_
        gc.collect()
        others = [np.random.default_rng(1).random(copy.shape) for _ in range(100)]
        self.assertEqual(len(others), 100)
        self.assertEqual(address(position), place)
        np.testing.assert_array_equal(position, copy)
        np.testing.assert_array_equal(vesicle.position, copy)

    def test_arrays_are_read_only(self):
        for array in (self.run_.state[0].position, vehd.Surface.sphere(degree=6).normal):
            with self.assertRaises(ValueError):
                array[0, 0] = 1.0

    def test_absent_effects_have_no_field(self):
        run = vehd.Simulation(vehd.Scene.from_text(SEVERAL))
        self.assertEqual(len(run.state), 2)
        self.assertIsNone(run.state[1].Vm)
        self.assertIsNone(run.state[1].force_electric)
        with self.assertRaises(IndexError):
            run.state[2]

    def test_states_are_those_of_the_laboratory(self):
        run = vehd.Simulation(vehd.Scene.from_text(TURNED))
        x = vehd.Surface(run.state[0]).position
        np.testing.assert_allclose(np.ptp(x, axis=0), [3.0, 2.0, 2.0], rtol=0.03)
        self.assertLess(run.state.time, 1e-12)


class Interruptions(unittest.TestCase):
    def test_ctrl_c_ends_after_the_step_in_hand_and_tears_nothing(self):
        # It has no end that the signal could miss.
        scene = vehd.Scene.from_text(SHEARED.replace("end_time = 0.1", "end_time = 1000.0"))
        run = vehd.Simulation(scene)
        in_step = threading.Thread(target=lambda: self.wait_for_step(run) and os.kill(os.getpid(), signal.SIGINT))
        in_step.start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in run:
                pass
        in_step.join()
        self.assertFalse(run.completed)
        self.assertEqual(len(run.history["time"]), run.status.step + 1)
        run.run(until=run.time + 0.05)
        expected = vehd.Simulation(scene).run(until=run.time)
        np.testing.assert_array_equal(run.history["bending_energy_scaled"], expected.history["bending_energy_scaled"])

    def test_other_threads_run_during_a_step(self):
        run = vehd.Simulation(vehd.Scene.from_text(SHEARED))
        worker = threading.Thread(target=run.run)
        worker.start()
        # Only a thread that runs during a step can be told of it.
        seen = self.wait_for_step(run)
        worker.join()
        self.assertTrue(seen)
        self.assertTrue(run.completed)

    def test_a_forked_process_computes(self):
        code = ("import os, vehd\n"
                "vehd.set_threads(2)\n"
                "trace = vehd.Surface.sphere(degree=24).single_layer.matrix.trace()\n"
                "child = os.fork()\n"
                "if child == 0:\n"
                "    other = vehd.Surface.sphere(degree=24).single_layer.matrix.trace()\n"
                "    os._exit(int(abs(other - trace) < 1e-9))\n"
                "assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 1\n")
        subprocess.run([sys.executable, "-c", code], check=True, timeout=60)

    def test_a_forked_process_leaves_the_files_alone(self):
        code = ("import os, sys, vehd\n"
                "run = vehd.Simulation(sys.argv[1], sys.argv[2])\n"
                "run.step()\n"
                "child = os.fork()\n"
                "if child == 0:\n"
                "    try:\n"
                "        run.step()\n"
                "    except RuntimeError as error:\n"
                "        sys.exit(int('forked' in str(error)))\n"
                "    sys.exit(0)\n"
                "assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 1\n"
                "assert not os.path.exists(os.path.join(sys.argv[2], 'summary.json'))\n"
                "assert run.run().completed\n")
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "scene.toml"
            scene.write_text(SHEARED)
            subprocess.run([sys.executable, "-c", code, scene, f"{folder}/run"], check=True, timeout=60)

    @staticmethod
    def wait_for_step(run):
        """Whether there is one before the end."""
        while True:
            try:
                if run.completed:
                    return False
            except RuntimeError:
                return True


if __name__ == "__main__":
    unittest.main()
