#include <array>
#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/vector_harmonics.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(stokes_sphere)

namespace {

using Eigenvalues = std::array<double, 3>;

Eigenvalues single_layer(int n) {
  const double odd = 2.0 * n + 1.0;
  return {n / (odd * (2.0 * n + 3.0)), (n + 1.0) / (odd * (2.0 * n - 1.0)), 1.0 / odd};
}

Eigenvalues double_layer(int n) {
  const double odd = 2.0 * n + 1.0;
  return {1.5 / (odd * (2.0 * n + 3.0)), -1.5 / (odd * (2.0 * n - 1.0)), -1.5 / odd};
}

/// Largest ‖layer u − scale eigenvalue u‖/‖u‖ (norms over the unit sphere) per family over n ≤ p/2 and all m.
std::array<double, 3> spectrum_errors(const Space& space, const StokesOperator& layer, Eigenvalues (*eigenvalues)(int),
                                      double scale) {
  const int order = space.coarse.order();
  const Surface unit_sphere = make_surface(space.fine, sphere(order));
  std::array<double, 3> errors{};
  for (int n = 0; n <= order / 2; ++n) {
    for (int m = -n; m <= n; ++m) {
      const VectorHarmonics harmonics = vector_harmonics(space.fine, unit_sphere, n, m);
      const std::array<const Matrix*, 3> families{&harmonics.v, &harmonics.w, &harmonics.x};
      // At n = 0 the only harmonic is V, the expansion.
      for (int i = 0; i < (n == 0 ? 1 : 3); ++i) {
        const Matrix& u = *families[i];
        const double error = (layer.apply(u) - scale * eigenvalues(n)[i] * u).norm() / u.norm();
        errors[i] = std::max(errors[i], error);
      }
    }
  }
  return errors;
}

}  // namespace

BOOST_AUTO_TEST_CASE(layers_have_the_eigenvalues_of_the_vector_harmonics) {
  for (const int order : {8, 16}) {
    const Space space(order);
    const LayerOperators layers = assemble(space, sphere(order), kStokesLayers);
    BOOST_TEST_CONTEXT("order " << order) {
      for (const double error : spectrum_errors(space, layers.stokes_single, single_layer, 1.0)) {
        BOOST_TEST(error < 1e-11);
      }
      for (const double error : spectrum_errors(space, layers.stokes_double, double_layer, 1.0)) {
        BOOST_TEST(error < 1e-11);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(radius_scales_the_single_layer_alone_and_the_centre_nothing) {
  // S scales with R, and its density is J f = R² f.
  const double radius = 0.4;
  const Space space(8);
  const LayerOperators layers = assemble(space, translated(sphere(8, radius), {1.0, 2.0, -3.0}), kStokesLayers);
  for (const double error : spectrum_errors(space, layers.stokes_single, single_layer, 1.0 / radius)) {
    BOOST_TEST(error < 1e-11);
  }
  for (const double error : spectrum_errors(space, layers.stokes_double, double_layer, 1.0)) BOOST_TEST(error < 1e-11);
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
