#include <array>
#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

struct VectorHarmonics {
  Matrix v;  ///< ∇Y − (n+1) Y r̂
  Matrix w;  ///< ∇Y + n Y r̂
  Matrix x;  ///< r̂ × ∇Y
};

/// Cartesian coefficients of the three vector harmonics that Y_nm makes.
VectorHarmonics vector_harmonics(const SphereTransform& fine, const Surface& unit_sphere, int n, int m) {
  const SphereDerivatives y = fine.synthesize_gradient(harmonic(fine.order(), n, m));
  const Matrix gradient = surface_gradient(unit_sphere, y);
  const Matrix radial = y.value.col(0).asDiagonal() * unit_sphere.normal;
  Matrix curl(gradient.rows(), 3);
  for (Index i = 0; i < curl.rows(); ++i) {
    curl.row(i) = Vector3(unit_sphere.normal.row(i)).cross(Vector3(gradient.row(i))).transpose();
  }
  return {fine.analyze(gradient - (n + 1.0) * radial), fine.analyze(gradient + n * radial), fine.analyze(curl)};
}

/// Largest ‖S u − eigenvalue u‖/‖u‖ (norms over the unit sphere) per family over 1 ≤ n ≤ p/2 and all m.
std::array<double, 3> stokes_spectrum_errors(int order, double radius, const Vector3& centre) {
  const Space space(order);
  const StokesOperator layer = assemble(space, translated(sphere(order, radius), centre), kStokesLayer).stokes_single;
  const Surface unit_sphere = make_surface(space.fine, sphere(order));
  std::array<double, 3> errors{};
  for (int n = 1; n <= order / 2; ++n) {
    const double odd = 2.0 * n + 1.0;
    const std::array<double, 3> eigenvalues{n / (odd * (2.0 * n + 3.0)), (n + 1.0) / (odd * (2.0 * n - 1.0)),
                                            1.0 / odd};
    for (int m = -n; m <= n; ++m) {
      const VectorHarmonics harmonics = vector_harmonics(space.fine, unit_sphere, n, m);
      const std::array<const Matrix*, 3> families{&harmonics.v, &harmonics.w, &harmonics.x};
      for (int i = 0; i < 3; ++i) {
        const Matrix& u = *families[i];
        // The layer scales with R, and its density is J f = R² f.
        const double error = (layer.apply(u) - eigenvalues[i] / radius * u).norm() / u.norm();
        errors[i] = std::max(errors[i], error);
      }
    }
  }
  return errors;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(stokes_sphere)

BOOST_AUTO_TEST_CASE(single_layer_has_the_eigenvalues_of_the_vector_harmonics) {
  for (const int order : {8, 16}) {
    const std::array<double, 3> errors = stokes_spectrum_errors(order, 1.0, Vector3::Zero());
    BOOST_TEST_CONTEXT("order " << order) {
      BOOST_TEST(errors[0] < 1e-11);
      BOOST_TEST(errors[1] < 1e-11);
      BOOST_TEST(errors[2] < 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(eigenvalues_scale_with_the_radius_wherever_the_centre_is) {
  for (const double error : stokes_spectrum_errors(8, 0.4, {1.0, 2.0, -3.0})) BOOST_TEST(error < 1e-11);
}

BOOST_AUTO_TEST_CASE(translating_sphere_obeys_the_law_of_stokes) {
  // A uniform force density F/(4πR²) moves the sphere at F/(6πμR).
  const double radius = 1.7;
  const Space space(8);
  const StokesOperator layer = assemble(space, sphere(8, radius), kStokesLayer).stokes_single;
  const Vector3 force(0.3, -0.8, 0.5);
  Matrix density = Matrix::Zero(n_coefficients(8), 3);
  density.row(0) = force.transpose() / std::sqrt(4.0 * std::numbers::pi);
  const Matrix velocity = space.fine.synthesize(layer.apply(density));
  const Vector3 expected = force / (6.0 * std::numbers::pi * radius);
  BOOST_TEST((velocity.rowwise() - expected.transpose()).cwiseAbs().maxCoeff() < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
