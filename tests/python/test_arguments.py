"""What public functions accept, and that nothing else is cut or converted in silence."""

import inspect
import re
import typing
import unittest

import numpy as np
import vehd

DEGREE = 4
N = vehd.n_coefficients(DEGREE)
SURFACE = vehd.Surface.from_shape("radial", DEGREE, base=1.0, modes=[{"n": 2, "m": 1, "a": 0.1}])
POINTS = SURFACE.weight.size
RNG = np.random.default_rng(1)
SCALAR, VECTOR = RNG.standard_normal(N), RNG.standard_normal((N, 3))
VALUES = RNG.standard_normal((POINTS, 2))
OUTSIDE = np.array([[3.0, 0.0, 0.0], [0.0, 0.0, -4.0]])
ANGLES = np.array([0.5, 1.0, 2.0])
FIELD = np.array([0.0, 0.0, 1.0])


def same(name):
    """What a layer gives off the surface."""
    return lambda density: getattr(SURFACE.evaluate(OUTSIDE, **{name: density}), name)


# Every array that a public function takes: how it is given, one that is right.
ARRAYS = {
    "Surface.__init__.coefficients": (lambda a: vehd.Surface(a).position, SURFACE.coefficients),
    "Surface.integrate.values": (SURFACE.integrate, VALUES),
    "Surface.analyze.values": (SURFACE.analyze, VALUES),
    "Surface.synthesize.coefficients": (SURFACE.synthesize, VECTOR),
    "Surface.gradient.scalar": (SURFACE.gradient, SCALAR),
    "Surface.divergence.vector": (SURFACE.divergence, VECTOR),
    "Surface.laplacian.fields": (SURFACE.laplacian, VECTOR),
    "Surface.tension_force.tension": (SURFACE.tension_force, SCALAR),
    "Surface.evaluate.points": (lambda a: SURFACE.evaluate(a, single=SCALAR).single, OUTSIDE),
    "Surface.evaluate.single": (same("single"), SCALAR),
    "Surface.evaluate.double": (same("double"), SCALAR),
    "Surface.evaluate.stokes_single": (same("stokes_single"), VECTOR),
    "Surface.evaluate.stokes_double": (same("stokes_double"), VECTOR),
    "solve_electric.field": (lambda a: vehd.solve_electric(SURFACE, a, 2.0, 1.0).charge, FIELD),
    "solve_electric.potential": (lambda a: vehd.solve_electric(SURFACE, FIELD, 2.0, 1.0, a).charge, SCALAR),
    "solve_jumps.potential": (lambda a: vehd.solve_jumps(SURFACE, a, VALUES[:, 0], 2.0, 1.0).charge, SCALAR),
    "solve_jumps.current": (lambda a: vehd.solve_jumps(SURFACE, SCALAR, a, 2.0, 1.0).charge, VALUES[:, 0]),
    "solve_tension.velocity": (lambda a: vehd.solve_tension(SURFACE, a).tension, VECTOR),
    "evaluate_harmonics.coefficients": (lambda a: vehd.evaluate_harmonics(a, ANGLES, ANGLES), VECTOR),
    "evaluate_harmonics.theta": (lambda a: vehd.evaluate_harmonics(VECTOR, a, ANGLES), ANGLES),
    "evaluate_harmonics.phi": (lambda a: vehd.evaluate_harmonics(VECTOR, ANGLES, a), ANGLES),
    "resize_degree.coefficients": (lambda a: vehd.resize_degree(a, 6), VECTOR),
}
# Operators take complex densities as well.
OPERATORS = {name: VECTOR if name.startswith("stokes") else SCALAR
             for name in ("single_layer", "double_layer", "adjoint", "hypersingular", "stokes_single", "stokes_double")}

BELOW_ZERO, ZERO, WHOLE = (-2.0,), (0.0, -2.0), (0, -1, 1.5, 2**31)
# Every number that a public function takes: how it is given, and what is refused besides what no number may be.
NUMBERS = {
    "Surface.__init__.upsampling": (lambda x: vehd.Surface(SURFACE.coefficients, upsampling=x), (*WHOLE, 10**9)),
    "Surface.__init__.quadrature": (lambda x: vehd.Surface(SURFACE.coefficients, quadrature=x), (*ZERO, 1e9)),
    "Surface.bending_force.modulus": (SURFACE.bending_force, BELOW_ZERO),
    "Surface.evaluate.tolerance": (lambda x: SURFACE.evaluate(OUTSIDE, tolerance=x), (*ZERO, 1.0)),
    "solve_electric.conductivity_in": (lambda x: vehd.solve_electric(SURFACE, FIELD, x, 0.0), ZERO),
    "solve_electric.conductivity_out": (lambda x: vehd.solve_electric(SURFACE, FIELD, 0.0, x), ZERO),
    "solve_electric.permittivity": (lambda x: vehd.solve_electric(SURFACE, FIELD, 2.0, 1.0, permittivity=x), ZERO),
    "solve_electric.permittivity_ratio": (
        lambda x: vehd.solve_electric(SURFACE, FIELD, 2.0, 1.0, permittivity_ratio=x), ZERO),
    "solve_electric.tolerance": (lambda x: vehd.solve_electric(SURFACE, FIELD, 2.0, 1.0, tolerance=x), (*ZERO, 1.0)),
    "solve_jumps.conductivity_in": (lambda x: vehd.solve_jumps(SURFACE, SCALAR, VALUES[:, 0], x, 1.0), BELOW_ZERO),
    "solve_jumps.conductivity_out": (lambda x: vehd.solve_jumps(SURFACE, SCALAR, VALUES[:, 0], 1.0, x), BELOW_ZERO),
    "solve_jumps.permittivity": (
        lambda x: vehd.solve_jumps(SURFACE, SCALAR, VALUES[:, 0], 2.0, 1.0, permittivity=x), ZERO),
    "solve_jumps.tolerance": (
        lambda x: vehd.solve_jumps(SURFACE, SCALAR, VALUES[:, 0], 2.0, 1.0, tolerance=x), (*ZERO, 1.0)),
    "solve_tension.viscosity": (lambda x: vehd.solve_tension(SURFACE, VECTOR, x), ZERO),
    "solve_tension.tolerance": (lambda x: vehd.solve_tension(SURFACE, VECTOR, tolerance=x), (*ZERO, 1.0)),
    "solve_by_elements.conductivity_in": (lambda x: vehd.solve_by_elements(SURFACE, [], x, 0.0), ZERO),
    "solve_by_elements.conductivity_out": (lambda x: vehd.solve_by_elements(SURFACE, [], 0.0, x), ZERO),
    "solve_by_elements.degree": (lambda x: vehd.solve_by_elements(SURFACE, [], 2.0, 1.0, degree=x), WHOLE),
    "solve_by_elements.cells": (lambda x: vehd.solve_by_elements(SURFACE, [], 2.0, 1.0, cells=x), WHOLE),
    "solve_by_elements.outer_radius": (lambda x: vehd.solve_by_elements(SURFACE, [], 2.0, 1.0, outer_radius=x), (1.0,)),
    "fit.jobs": (lambda x: vehd.fit("none.toml", "none", jobs=x), (*WHOLE, 10**6)),
    "n_coefficients.degree": (vehd.n_coefficients, (-1, 1.5, 2**31)),
    "coefficient_index.n": (lambda x: vehd.coefficient_index(x, 0), (-1, 1.5, 2**31)),
    "coefficient_index.m": (lambda x: vehd.coefficient_index(2, x), (3, -3, 1.5)),
    "degree_of.index": (vehd.degree_of, (-1, 1.5, 2**63)),
    "resize_degree.degree": (lambda x: vehd.resize_degree(VECTOR, x), (-1, 1.5, 10**18)),
    "set_threads.count": (vehd.set_threads, (*WHOLE, 10**6)),
}
# Names of other kinds that a scene or a file checks, or that a message of Python itself refuses.
ELSEWHERE = re.compile(r"(example1|Scene|Simulation|Table|check|Surface\.(sphere|from_shape))\b")


def parameters():
    """Of all public functions and methods: name and annotation."""
    for name in vehd.__all__:
        thing = getattr(vehd, name)
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            functions = {f"{name}.{key}": getattr(value, "__func__", value) for key, value in vars(thing).items()
                         if key in ("__init__", "__matmul__") or not key.startswith("_")}
        else:
            functions = {name: thing}
        for path, function in functions.items():
            if inspect.isfunction(function):
                hints = typing.get_type_hints(function, vars(inspect.getmodule(function)))
                yield from ((f"{path}.{key}", hint) for key, hint in hints.items() if key != "return")


class Completeness(unittest.TestCase):
    def test_every_array_and_number_of_a_public_function_is_tested(self):
        missing = []
        for path, hint in parameters():
            kinds = {np.ndarray: ARRAYS, float: NUMBERS, int: NUMBERS}
            for kind in (hint, *typing.get_args(hint)):
                known = kinds.get(kind)
                if known is not None and path not in known and path not in ARRAYS and not ELSEWHERE.match(path):
                    missing.append(path)
        self.assertEqual(missing, ["Operator.__matmul__.density"])


class Arrays(unittest.TestCase):
    def assert_refused(self, error, path, take, given):
        name = path.split(".")[-1]
        with self.subTest(path, given=str(given)[:40]):
            with self.assertRaises(error) as caught:
                take(given)
            self.assertRegex(str(caught.exception), rf"^{name}\b.*; accepted: ")

    def test_kinds_that_are_no_real_numbers_are_refused(self):
        for path, (take, right) in ARRAYS.items():
            nan, infinite = right.copy(), right.copy()
            nan.flat[1], infinite.flat[2] = np.nan, -np.inf
            masked = np.ma.masked_array(right, mask=right > right.mean())
            for wrong in (right + 0j, right.astype(np.complex64), right.astype(object), right.astype(str), nan, infinite,
                          masked, right.astype("datetime64[s]")):
                self.assert_refused(vehd.InputError, path, take, wrong)

    def test_shapes_that_do_not_fit_are_refused(self):
        for path, (take, right) in ARRAYS.items():
            other = right[np.newaxis] if path.endswith("points") else right[:-1]
            if path in ("evaluate_harmonics.coefficients", "resize_degree.coefficients"):
                other = right[:-1]
            for wrong in (other, right[np.newaxis], right[:0] if path != "Surface.evaluate.points" else 1.0, 1.0):
                if path == "Surface.evaluate.points" and wrong is other:
                    continue
                with self.subTest(path, shape=np.shape(wrong)), self.assertRaises(vehd.ShapeError):
                    take(wrong)

    def test_solves_take_magnitudes_of_scenes_alone(self):
        for path, (take, right) in ARRAYS.items():
            if path.startswith("solve"):
                for wrong in (1e-200 * right, 1e-51 * right / abs(right).max(), 1e51 * right, 1e200 * right):
                    self.assert_refused(vehd.InputError, path, take, wrong)
        for path in ("solve_electric.field", "solve_tension.velocity"):
            take, right = ARRAYS[path]
            for scale in (1e-49, 1e49):
                expected = take(right)
                np.testing.assert_allclose(take(scale * right) / scale, expected, atol=1e-10 * abs(expected).max())

    def test_all_real_numbers_are_the_same(self):
        for path, (take, right) in ARRAYS.items():
            whole = np.rint(8 * right)
            wide = np.empty((2 * right.shape[0],) + right.shape[1:])
            for numbers, others in ((whole, [whole.astype(np.int64), whole.astype(np.int8), whole.astype(np.float32),
                                             whole.tolist()]),
                                    (right, [np.asfortranarray(right), right.astype(np.longdouble)])):
                if numbers is whole and path.startswith(("Surface.__init__", "Surface.evaluate.points")):
                    continue  # no surface, no points off it
                read_only = numbers.copy()
                read_only.flags.writeable = False
                wide[::2] = numbers
                expected = take(numbers)
                for other in (*others, read_only, wide[::2], numbers.astype(">f8")):
                    np.testing.assert_array_equal(take(other), expected, err_msg=path)

    def test_points_may_be_none_at_all(self):
        found = SURFACE.evaluate(np.empty((0, 3)), single=SCALAR, stokes_double=VECTOR, gradients=True)
        self.assertEqual(found.single.shape, (0,))
        self.assertEqual(found.single_gradient.shape, (0, 3))
        self.assertEqual(found.stokes_double_error.shape, (0,))
        self.assertIsNone(found.double)

    def test_operators_are_linear_in_complex_densities(self):
        for name, density in OPERATORS.items():
            operator = getattr(SURFACE, name)
            found = operator @ (density + 2j * density[::-1])
            np.testing.assert_array_equal(found.real, operator @ density, err_msg=name)
            np.testing.assert_array_equal(found.imag, operator @ (2 * density[::-1]), err_msg=name)
            for wrong in (np.full_like(density, np.nan), np.full(density.shape, complex(0.0, np.inf)), density.astype(str)):
                with self.assertRaises(vehd.InputError):
                    operator @ wrong
            with self.assertRaises(vehd.ShapeError):
                operator @ density[:-1]


    def test_matrices_are_read_only(self):
        with self.assertRaises(ValueError):
            SURFACE.single_layer.matrix[0, 0] = 1.0


class Numbers(unittest.TestCase):
    def test_numbers_out_of_bounds_are_refused_by_name(self):
        for path, (take, wrong_ones) in NUMBERS.items():
            name = path.split(".")[-1]
            for wrong in (*wrong_ones, np.nan, np.inf, 1e-200, 1e200, 1 + 0j, "1", [1.0], True):
                with self.subTest(path, given=wrong):
                    with self.assertRaises(vehd.InputError) as caught:
                        take(wrong)
                    self.assertRegex(str(caught.exception), rf"\b{name}\b.*; accepted: ")

    def test_sides_are_named(self):
        with self.assertRaisesRegex(vehd.InputError, "side is 'interor'; accepted: interior, .* did you mean 'interior'"):
            SURFACE.evaluate(OUTSIDE, side="interor")

    def test_sources_are_on_the_side_that_they_name(self):
        at = ([0.1, 0.0, 0.0], 1.0)
        for wrong in ((*at, False), (*at, "inside"), at, ([0.1, 0.0], 1.0, True), (at[0], np.nan, True),
                      ([3.0, 0.0, 0.0], 1.0, True)):
            for take in (lambda s: vehd.point_source_fields(SURFACE, s),
                         lambda s: vehd.solve_by_elements(SURFACE, s, 2.0, 1.0)):
                with self.assertRaisesRegex(ValueError, r"sources\[1\]"):
                    take([(*at, True), wrong])

    def test_no_current_leaves_where_nothing_conducts(self):
        with self.assertRaisesRegex(vehd.InputError, "current has the integral 1[0-9.]+; accepted: 0 where"):
            vehd.solve_jumps(SURFACE, SCALAR, np.ones(POINTS), 1.0, 0.0)
        vehd.solve_jumps(SURFACE, SCALAR, SURFACE.normal[:, 0], 1.0, 0.0)

    def test_an_inside_out_surface_is_refused(self):
        for wrong in (-SURFACE.coefficients, SURFACE.coefficients * [1.0, 1.0, 0.0], SURFACE.coefficients[:, [1, 0, 2]]):
            with self.assertRaisesRegex(vehd.InputError, "encloses the volume -?[0-9.]+; accepted"):
                vehd.Surface(wrong)
        for size in (0.0, 1e200, 1e-200):
            with self.assertRaisesRegex(vehd.InputError, r"has the radius .*; accepted: 1e-30 \.\.\. 1e\+30"):
                vehd.Surface(size * SURFACE.coefficients)
        order = np.concatenate([np.arange(-n, n + 1) for n in range(DEGREE + 1)])
        turned = vehd.Surface(np.where(order[:, None] < 0, 1.0, -1.0) * SURFACE.coefficients)
        self.assertAlmostEqual(turned.volume, SURFACE.volume, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
