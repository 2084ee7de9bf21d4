"""Surfaces and layers on a shape without symmetry, against what is known exactly."""

import inspect
import unittest

import numpy as np
import vehd

DEGREE = 16


def bumpy(degree=DEGREE, **keys):
    """No symmetry, and not centred."""
    modes = [{"n": 2, "m": 1, "a": 0.1}, {"n": 3, "m": -2, "a": 0.08}, {"n": 1, "m": 0, "a": 0.1}]
    return vehd.Surface.from_shape("radial", degree, base=1.0, modes=modes, rotation=[1.0, 1.0, 0.3, 50.0],
                                   centre=[0.3, -0.2, 0.1], **keys)


def harmonic(x):
    """A potential and its gradient."""
    value = x[:, 0] ** 2 - x[:, 1] ** 2 + x[:, 0] * x[:, 2] + x[:, 1]
    gradient = np.column_stack([2 * x[:, 0] + x[:, 2], 1 - 2 * x[:, 1], x[:, 0]])
    return value, gradient


class Geometry(unittest.TestCase):
    def test_an_ellipsoid_has_its_volume_and_place(self):
        s = vehd.Surface.from_shape("ellipsoid", 12, axes=[1.0, 1.2, 0.8], centre=[1.0, 2.0, 3.0],
                                    rotation=[1.0, 2.0, 3.0, 30.0])
        self.assertAlmostEqual(s.volume, 4 * np.pi / 3 * 0.96, delta=1e-12)
        np.testing.assert_allclose(s.centroid, [1.0, 2.0, 3.0], atol=1e-12)

    def test_integrals_that_every_closed_surface_has(self):
        s = bumpy()
        self.assertAlmostEqual(s.integrate(s.gauss_curvature), 4 * np.pi, delta=1e-6)
        np.testing.assert_allclose(s.integrate(s.normal), 0.0, atol=1e-12)
        self.assertAlmostEqual(s.integrate(np.ones(s.weight.size)), s.area, delta=1e-12)
        self.assertAlmostEqual(s.integrate(np.sum(s.position * s.normal, axis=1)) / 3, s.volume, delta=1e-12)

    def test_calculus_on_the_surface(self):
        s = bumpy()
        np.testing.assert_allclose(s.laplacian(s.coefficients), 2 * s.mean_curvature[:, None] * s.normal, atol=1e-10)
        np.testing.assert_allclose(s.divergence(s.coefficients), 2.0, atol=1e-11)
        # x restricted to the surface has the gradient e_x − n_x n.
        expected = np.array([1.0, 0.0, 0.0]) - s.normal[:, :1] * s.normal
        np.testing.assert_allclose(s.gradient(s.coefficients[:, 0]), expected, atol=1e-11)

    def test_harmonics_forth_and_back(self):
        rng = np.random.default_rng(1)
        s = bumpy()
        c = rng.standard_normal((vehd.n_coefficients(DEGREE), 2))
        np.testing.assert_allclose(s.analyze(s.synthesize(c)), c, atol=1e-12)
        self.assertEqual(s.synthesize(c[:, 0]).shape, (s.shape[0] * s.shape[1],))
        theta, phi = (a.ravel() for a in np.meshgrid(s.theta, s.phi, indexing="ij"))
        np.testing.assert_allclose(vehd.evaluate_harmonics(c, theta, phi), s.synthesize(c), atol=1e-11)
        self.assertEqual(vehd.coefficient_index(3, -2), 10)
        self.assertEqual(vehd.degree_of(10), 3)

    def test_forces_of_the_membrane_balance(self):
        s = bumpy(24)
        np.testing.assert_allclose(s.integrate(s.bending_force()), 0.0, atol=1e-5)
        tension = np.zeros(s.coefficients.shape[0])
        tension[:4] = [1.0, 0.3, 0.2, 0.1]
        np.testing.assert_allclose(s.integrate(s.tension_force(tension)), 0.0, atol=1e-8)
        self.assertAlmostEqual(vehd.Surface.sphere(3.0, 8).bending_energy_scaled, 4 * np.pi, delta=1e-12)


class Layers(unittest.TestCase):
    def setUp(self):
        self.s = bumpy()
        value, gradient = harmonic(self.s.position)
        self.value = self.s.analyze(value)
        self.flux = self.s.analyze(np.sum(gradient * self.s.normal, axis=1))

    def assert_near(self, coefficients, expected, error):
        self.assertLess(np.abs(self.s.synthesize(coefficients - expected)).max(), error)

    def test_spectra_of_the_sphere(self):
        s = vehd.Surface.sphere(degree=8, quadrature=2.0)
        n = np.array([vehd.degree_of(i) for i in range(vehd.n_coefficients(8))])
        for operator, spectrum in ((s.single_layer, 1 / (2 * n + 1)), (s.double_layer, -0.5 / (2 * n + 1)),
                                   (s.adjoint, -0.5 / (2 * n + 1)), (s.hypersingular, -n * (n + 1) / (2 * n + 1))):
            np.testing.assert_allclose(operator.matrix, np.diag(spectrum), atol=1e-10, err_msg=operator.name)

    def test_green_s_identity_and_its_normal_derivative(self):
        s = self.s
        self.assert_near(0.5 * self.value + s.double_layer @ self.value, s.single_layer @ self.flux, 1e-5)
        self.assert_near(0.5 * self.flux - s.adjoint @ self.flux, -(s.hypersingular @ self.value), 1e-3)

    def test_stokes_identities(self):
        s = self.s
        gradient = np.array([[0.2, 1.0, -0.3], [0.4, 0.1, 0.0], [0.5, 0.2, -0.3]])
        velocity = s.analyze(s.position @ gradient.T)
        traction = s.analyze(s.normal @ (gradient + gradient.T))
        found = 0.5 * velocity + s.stokes_double @ velocity - s.stokes_single @ traction
        self.assertEqual(found.shape, velocity.shape)
        self.assert_near(found, 0.0, 1e-4)
        pressure = s.analyze(s.normal)
        self.assert_near(s.stokes_single @ pressure, 0.0, 1e-4)

    def test_matrices_do_what_operators_do(self):
        rng = np.random.default_rng(2)
        s = bumpy(6)
        for operator in (s.single_layer, s.double_layer, s.adjoint, s.hypersingular, s.stokes_single, s.stokes_double):
            density = rng.standard_normal((operator.shape[1], 2))
            np.testing.assert_allclose(operator.matrix @ density, operator @ density, atol=1e-11, err_msg=operator.name)
            np.testing.assert_allclose(operator @ density[:, 0], (operator @ density)[:, 0], atol=1e-14)

    def test_scipy_solves_with_them(self):
        try:
            from scipy.sparse.linalg import aslinearoperator, gmres
        except ImportError:
            self.skipTest("scipy (Debian package python3-scipy) is missing")
        # The interior Neumann problem without its free constant; S' of scipy and of the matrix agree.
        a = self.s.adjoint.linear_operator()
        self.assertEqual(a.shape, aslinearoperator(self.s.adjoint.matrix).shape)
        density = self.s.analyze(np.sin(self.s.position[:, 2]))
        right = 0.5 * density + 0.9 * (self.s.adjoint @ density)
        identity = aslinearoperator(np.eye(density.size))
        # The relative tolerance is tol before SciPy 1.12, rtol from 1.14 on.
        relative = "rtol" if "rtol" in inspect.signature(gmres).parameters else "tol"
        found, info = gmres(0.5 * identity + 0.9 * a, right, atol=0.0, **{relative: 1e-12})
        self.assertEqual(info, 0)
        np.testing.assert_allclose(found, density, atol=1e-9)

    def test_scipy_comes_only_when_asked_for(self):
        import subprocess
        import sys

        code = ("import sys, vehd; vehd.Surface.sphere(degree=6).single_layer.matrix; "
                "sys.exit(any(m in sys.modules for m in ('scipy', 'matplotlib', 'pandas')))")
        self.assertEqual(subprocess.run([sys.executable, "-c", code], check=False).returncode, 0)

    def test_fields_off_the_surface_with_their_error(self):
        s = self.s
        k = np.argmax(s.position[:, 0])
        near = s.position[k] + np.array([[-1e-3], [1e-3], [-0.3], [2.0]]) * s.normal[k]
        found = s.evaluate(near, single=self.flux, double=self.value)
        np.testing.assert_array_equal(found.inside, [True, False, True, False])
        np.testing.assert_allclose(found.distance[:2], 1e-3, rtol=1e-6)
        self.assertTrue(found.resolved.all())
        self.assertLess(max(found.single_error.max(), found.double_error.max()), 1e-7)
        expected = np.where(found.inside, harmonic(near)[0], 0.0)
        np.testing.assert_allclose(found.single - found.double, expected, atol=1e-5)

    def test_the_side_counts_on_the_surface(self):
        one = np.zeros(self.value.size)
        one[0] = np.sqrt(4 * np.pi)
        point = self.s.position[40:41]
        for side, expected in (("interior", -1.0), ("exterior", 0.0), ("principal_value", -0.5)):
            found = self.s.evaluate(point, double=one, side=side)
            np.testing.assert_allclose(found.double, expected, atol=1e-9, err_msg=side)
            self.assertIsNone(found.single)


class Densities(unittest.TestCase):
    """A density of degree 5 on a surface of degree 12: all that the same fields of degree 22 have, and no more errors."""

    def setUp(self):
        rng = np.random.default_rng(5)
        self.s = bumpy(12)
        self.finer = vehd.Surface(vehd.resize_degree(self.s.coefficients, 22))
        self.scalar = vehd.resize_degree(rng.standard_normal(36), 12)
        self.vector = vehd.resize_degree(rng.standard_normal((36, 3)), 12)

    def test_nothing_of_them_is_cut_off_the_surface(self):
        k = np.arange(0, self.s.weight.size, 41)
        for distance in (1e-3, -1e-3, 0.0, 0.1, 1.0):
            at = self.s.position[k] + distance * self.s.normal[k]
            found = self.s.evaluate(at, single=self.scalar, double=self.scalar, stokes_single=self.vector,
                                    stokes_double=self.vector, gradients=True)
            scalar, vector = vehd.resize_degree(self.scalar, 22), vehd.resize_degree(self.vector, 22)
            exact = self.finer.evaluate(at, single=scalar, double=scalar, stokes_single=vector, stokes_double=vector,
                                        gradients=True, tolerance=1e-11)
            for name in ("single", "single_gradient", "double", "double_gradient", "stokes_single", "stokes_double"):
                difference = abs(getattr(found, name) - getattr(exact, name)).reshape(k.size, -1).max(axis=1)
                np.testing.assert_array_less(difference, getattr(found, name + "_error") + 1e-13, err_msg=name)
                self.assertLess(difference.max(), 1e-8, name)

    def test_operators_lose_what_the_degree_cannot_hold(self):
        for name in ("single_layer", "double_layer", "adjoint", "hypersingular", "stokes_single", "stokes_double"):
            density = self.vector if name.startswith("stokes") else self.scalar
            exact = getattr(self.finer, name) @ vehd.resize_degree(density, 22)
            held = vehd.resize_degree(exact, 12)
            lost = self.finer.synthesize(exact - vehd.resize_degree(held, 22))
            found = self.s.synthesize(getattr(self.s, name) @ density - held)
            self.assertLess(abs(found).max(), abs(lost).max(), name)

    def test_weighted_operators_reach_the_errors_of_example_1(self):
        for degree in (12, 24):
            s = vehd.Surface.from_shape("radial", degree, upsampling=1, base=1.0, amplitude=0.2, exponent=-3.0,
                                        modes=[{"n": 3, "m": 2, "a": 1.0}])
            exact = vehd.point_source_fields(s, vehd.example1_sources())
            jump = s.analyze(exact["potential_in"] - exact["potential_out"])
            eta, current = 1 / 3, (2.0 * exact["flux_in"] - exact["flux_out"]) / 3.0
            adjoint, of_jump = s.adjoint.weighted, s.hypersingular.weighted @ jump
            q = np.linalg.solve(0.5 * np.eye(jump.size) + eta * adjoint.matrix,
                                eta * of_jump + s.analyze(s.area_element * current))
            found = 2 * (current + eta * s.synthesize(of_jump - adjoint @ q) / s.area_element)
            charge = exact["flux_in"] - exact["flux_out"]
            error = np.abs(found - charge).max() / np.abs(charge).max()
            self.assertLess(error, 3.0 * vehd.example1(degree)["error_q"])

    def test_weighted_operators_take_the_density_times_the_area_element(self):
        s = bumpy(20)
        f = vehd.resize_degree(self.scalar, 20)
        weighted = s.analyze(s.area_element * s.synthesize(f))
        adjoint = s.analyze(s.area_element * s.synthesize(s.adjoint @ f))
        np.testing.assert_allclose(s.single_layer.weighted @ weighted, s.single_layer @ f, atol=1e-7)
        np.testing.assert_allclose(s.adjoint.weighted @ weighted, adjoint, atol=1e-7)
        np.testing.assert_allclose(s.double_layer.weighted @ f, s.double_layer @ f, atol=1e-12)
        self.assertIs(s.adjoint.weighted.weighted, s.adjoint.weighted)
        at = 1.5 * s.position[:3]
        np.testing.assert_allclose(s.evaluate(at, single=weighted, weighted=True).single,
                                   s.evaluate(at, single=f).single, atol=1e-9)


class Solves(unittest.TestCase):
    def test_a_sphere_in_a_field(self):
        s = vehd.Surface.sphere(degree=8, quadrature=2.0)
        cosine = s.position[:, 2]
        for inside, outside in ((2.0, 1.0), (1.0, 1.0), (1e-3, 1.0)):
            found = vehd.solve_electric(s, [0.0, 0.0, 1.5], inside, outside)
            slope = -1.5 * 3 * outside / (inside + 2 * outside)
            np.testing.assert_allclose(found.flux_in, slope * cosine, atol=1e-9)
            np.testing.assert_allclose(found.charge, slope * (1 - inside / outside) * cosine, atol=1e-9)
            np.testing.assert_allclose(s.synthesize(found.potential_in), slope * cosine, atol=1e-9)

    def test_a_tension_keeps_area_elements(self):
        s = bumpy(10)
        velocity = s.analyze(s.position[:, ::-1])
        found = vehd.solve_tension(s, velocity)
        weighted = s.analyze(s.area_element * s.divergence(found.velocity))
        self.assertLess(np.abs(weighted).max(), 1e-7)
        before = s.analyze(s.area_element * s.divergence(velocity))
        self.assertGreater(np.abs(before).max(), 1e-2)
        force = s.analyze(s.tension_force(found.tension))
        np.testing.assert_allclose(velocity + s.stokes_single @ force, found.velocity, atol=1e-4)


if __name__ == "__main__":
    unittest.main()
