#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/point_potential.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

const Vector3 kInside(0.25, -0.1, 0.3);
const Vector3 kOutside(2.4, 1.1, -1.6);

/// A surface with its Laplace layers.
struct Layered : LayeredSurface {
  Layered(int order, Matrix coefficients) : LayeredSurface(order, std::move(coefficients), kLaplaceLayers) {}
};

/// Largest error of S[∂φ/∂n] − D[φ] = ½φ (φ harmonic inside) or of its negative (outside), relative to φ.
double green_error(const Layered& g, const Vector3& source, double side) {
  const PointPotential phi = point_potential(g.surface, source);
  const Vector representation = g.layers.laplace_single.apply(weighted(g.space, g.surface, phi.flux)) -
                                g.layers.laplace_double.apply(g.space.fine.analyze(phi.value));
  return relative_difference(g.space.fine.synthesize(representation), 0.5 * side * phi.value);
}

/// Requires errors at p = 32 below the bound and three orders below those at p = 8, for a source on either side.
void require_green_convergence(Matrix (*shape)(int), double bound) {
  const Layered coarse(8, shape(8));
  const Layered fine(32, shape(32));
  for (const auto& [source, side] : {std::pair{kOutside, 1.0}, std::pair{kInside, -1.0}}) {
    const double error = green_error(fine, source, side);
    BOOST_TEST(error < 1e-3 * green_error(coarse, source, side));
    BOOST_TEST(error < bound);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(laplace_identities)

BOOST_AUTO_TEST_CASE(double_layer_of_constant_density_is_minus_half) {
  for (const int order : {16, 24}) {
    for (const Matrix& position : {asymmetric_shape(order), shape_33(order)}) {
      const Layered g(order, position);
      const Vector one = std::sqrt(4.0 * std::numbers::pi) * harmonic(order, 0, 0);
      BOOST_TEST(max_difference(g.layers.laplace_double.apply(one), -0.5 * one) < (order == 16 ? 1e-4 : 1e-6));
    }
  }
}

BOOST_AUTO_TEST_CASE(adjoint_layer_halves_the_total_charge) {
  // ∫ S′[g] dA = −½ ∫ g dA; integrals of weighted coefficients are their degree 0.
  const Layered g(24, asymmetric_shape(24));
  const Matrix density = smooth_coefficients(24, 8, 3, 31);
  const Matrix result = g.layers.laplace_adjoint.apply(density);
  BOOST_TEST(max_difference(result.row(0), -0.5 * density.row(0)) < 1e-10);
}

BOOST_AUTO_TEST_CASE(single_layer_is_symmetric_and_adjoint_layer_is_the_transpose_of_double_layer) {
  // Bilinear forms ∫∫ f K g dA dA in weighted coefficients are plain products.
  const Layered g(24, asymmetric_shape(24));
  const Matrix f = smooth_coefficients(24, 8, 4, 32);
  const Matrix h = smooth_coefficients(24, 8, 4, 33);
  const Matrix single = f.transpose() * g.layers.laplace_single.apply(h);
  const Matrix swapped = g.layers.laplace_single.apply(f).transpose() * h;
  BOOST_TEST(relative_difference(single, swapped) < 1e-9);
  const Matrix adjoint = f.transpose() * g.layers.laplace_adjoint.apply(h);
  const Matrix transposed = g.layers.laplace_double.apply(f).transpose() * h;
  BOOST_TEST(relative_difference(adjoint, transposed) < 1e-8);
}

BOOST_AUTO_TEST_CASE(single_layer_is_positive) {
  const Layered g(12, shape_33(12));
  const Matrix f = random_coefficients(12, 20, 34);
  BOOST_TEST((f.cwiseProduct(g.layers.laplace_single.apply(f))).colwise().sum().minCoeff() > 0.0);
}

BOOST_AUTO_TEST_CASE(green_representation_converges_spectrally_on_shape_33) {
  require_green_convergence(shape_33, 1e-6);
}

BOOST_AUTO_TEST_CASE(green_representation_converges_spectrally_without_symmetry) {
  require_green_convergence(asymmetric_shape, 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
