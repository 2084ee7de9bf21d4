"""Scenes, and what is wrong with them."""

import unittest

import numpy as np
import vehd
from helpers import IN_SI, SEVERAL, SHEARED, InFolder


class Scenes(InFolder):
    def test_a_scene_is_the_same_from_file_text_and_dict(self):
        from_file = vehd.Scene(self.write(SHEARED))
        self.assertEqual(from_file, vehd.Scene.from_text(SHEARED))
        tables = {
            "shape": {"kind": "ellipsoid", "axes": np.array([1.6, 1.0, 1.1]), "rotation": (1, 2, 3, 40)},
            "membrane": {"bending_modulus": np.float64(0.1), "conductance": 5},
            "fluid": {"viscosity_ratio": 2.0},
            "flow": {"kind": "shear", "rate": 1},
            "electric": {"field": [0.3, 0.1, 1.0], "conductivity_in": 2.0, "conductivity_out": 1.0},
            "numerics": {"degree": np.int64(6), "dt": 0.02, "end_time": 0.1},
            "output": {"every": 0.04},
        }
        self.assertEqual(from_file, vehd.Scene.from_dict(tables))
        self.assertEqual(from_file, vehd.Scene.from_text(from_file.text))
        self.assertNotEqual(from_file, vehd.Scene.from_text(IN_SI))

    def test_several_vesicles_are_a_list(self):
        scene = vehd.Scene.from_dict({
            "shape": {"kind": "ellipsoid", "axes": [1.0, 1.0, 1.5]},
            "membrane": {"bending_modulus": 0.1},
            "flow": {"kind": "shear", "rate": 1.0},
            "numerics": {"degree": 6, "dt": 0.05, "end_time": 0.1},
            "vesicle": [{"name": "lower", "shape": {"centre": [0.2, 0.0, -2.0]}},
                        {"name": "upper", "shape": {"centre": [0.0, 0.1, 2.0]}}],
        })
        self.assertEqual(scene, vehd.Scene.from_text(SEVERAL))
        self.assertEqual(scene.n_vesicles, 2)
        self.assertEqual(scene.position(1).shape, (49, 3))

    def test_settings_take_the_place_of_values(self):
        file = self.write(SHEARED)
        scene = vehd.Scene(file, {"flow.rate": 2.5, "electric.field": np.array([0.0, 0.0, 1.0])})
        self.assertEqual(scene, vehd.Scene.from_text(
            SHEARED.replace("rate = 1.0", "rate = 2.5").replace("[0.3, 0.1, 1.0]", "[0.0, 0.0, 1.0]")))

    def test_settings_take_numbers_of_numpy_and_any_character(self):
        file = self.write(SHEARED)
        self.assertEqual(vehd.Scene(file, {"numerics.degree": np.int64(7)}), vehd.Scene(file, {"numerics.degree": 7}))
        with self.assertRaisesRegex(vehd.SceneError, "\U0001F596"):
            vehd.Scene(file, {"flow.kind": "\U0001F596"})


class Errors(InFolder):
    def test_a_wrong_scene_says_what_the_program_says(self):
        for wrong in (SHEARED.replace("viscosity_ratio", "viscocity_ratio"), SHEARED.replace("rate = 1.0", 'rate = "x"'),
                      SHEARED.replace("dt = 0.02", "dt = -1"), SHEARED.replace("[flow]", "[flow")):
            file = self.write(wrong)
            with self.assertRaises(vehd.SceneError) as caught:
                vehd.Scene(file)
            program = self.run_program("plan", file, code=1)
            self.assertEqual(str(caught.exception), program.stderr.strip())
            self.assertEqual(caught.exception.file, str(file))
            self.assertEqual(f"{file}:{caught.exception.line}", ":".join(program.stderr.split(":")[:2]))

    def test_the_nearest_key_is_named(self):
        with self.assertRaisesRegex(vehd.SceneError, 'my scene:10: unknown key "viscocity_ratio".*"viscosity_ratio"'):
            vehd.Scene.from_text(SHEARED.replace("viscosity_ratio", "viscocity_ratio"), name="my scene")
        with self.assertRaisesRegex(vehd.SceneError, 'dict:[0-9]+: unknown key "axis".*"axes"'):
            vehd.Scene.from_dict({"shape": {"kind": "ellipsoid", "axis": [1, 1, 2]}, "membrane": {}, "numerics": {}})
        with self.assertRaisesRegex(vehd.InputError, r"settings is \['flow.rate=1'\]; accepted: a mapping"):
            vehd.Scene(self.write(SHEARED), ["flow.rate=1"])
        with self.assertRaisesRegex(vehd.SceneError, "--set flow.rat=1"):
            vehd.Scene(self.write(SHEARED), {"flow.rat": 1})

    def test_what_no_scene_can_hold_is_refused(self):
        with self.assertRaisesRegex(vehd.SceneError, '"kind" is a complex'):
            vehd.Scene.from_dict({"shape": {"kind": 1j}})
        for wrong in (2**70, -2**64, "\udc80", np.complex64(1j), None, {1}, np.array([1 + 1j])):
            with self.subTest(wrong=repr(wrong)), self.assertRaisesRegex(vehd.SceneError, '"axes" is .*; accepted: '):
                vehd.Scene.from_dict({"shape": {"axes": wrong}})
        for key in ("a\nb", "a\tb"):
            for tables in ({key: {"kind": 1}}, {"shape": {key: 1}}):
                with self.assertRaisesRegex(vehd.SceneError, r"'a\\[nt]b' is a key; accepted: "):
                    vehd.Scene.from_dict(tables)
        with self.assertRaisesRegex(vehd.SceneError, "dict:[0-9]+: unknown table"):
            vehd.Scene.from_dict({'sh"ape\'': {"kind": 1}})
        nested = {}
        nested["shape"] = {"kind": [nested]}
        with self.assertRaises(RecursionError):
            vehd.Scene.from_dict(nested)

    def test_numbers_of_numpy_are_those_of_python(self):
        tables = {"shape": {"kind": "ellipsoid", "axes": [1, 1, 2]}, "membrane": {"inextensible": False},
                  "numerics": {"degree": 6, "dt": 0.5, "end_time": 1.0}}
        expected = vehd.Scene.from_dict(tables)
        tables["shape"]["axes"] = np.array([1, 1, 2], dtype=np.float32)
        tables["membrane"]["inextensible"] = np.bool_(False)
        tables["numerics"] = {"degree": np.int8(6), "dt": np.array(0.5), "end_time": np.longdouble(1.0)}
        self.assertEqual(vehd.Scene.from_dict(tables), expected)

    def test_shapes_name_arguments_in_place_of_lines(self):
        from_shape, sphere = vehd.Surface.from_shape, vehd.Surface.sphere
        for take, message in ((lambda: sphere(8, 1.0), '"degree" is 1.0; accepted: an integer'),
                              (lambda: sphere("1"), "radius is '1'; accepted: a number above 0"),
                              (lambda: from_shape("ellipsod"), '"kind" is the text .* did you mean "ellipsoid"'),
                              (lambda: from_shape(axis=[1, 1, 2]), 'unknown key "axis"; did you mean "axes"'),
                              (lambda: from_shape(axes=[1, 2]), '"axes" has 2 components; accepted: 3 numbers')):
            with self.assertRaisesRegex(vehd.InputError, "^" + message):
                take()

    def test_exceptions_are_those_of_python_as_well(self):
        self.assertTrue(issubclass(vehd.SceneError, vehd.InputError))
        self.assertTrue(issubclass(vehd.InputError, ValueError))
        self.assertTrue(issubclass(vehd.OutputError, OSError))
        with self.assertRaises(vehd.SceneError):
            vehd.Scene(self.folder / "nothing.toml")
        with self.assertRaisesRegex(vehd.ShapeError, "degree"):
            vehd.Surface(np.zeros((4, 3)))
        with self.assertRaises(vehd.ShapeError):
            vehd.Surface.sphere(degree=6).single_layer @ np.zeros(7)


if __name__ == "__main__":
    unittest.main()
