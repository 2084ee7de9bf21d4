#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kOrder = 24;

struct StokesLayer {
  Space space{kOrder};
  Matrix position = asymmetric_shape(kOrder);
  Surface surface = make_surface(space.fine, position);
  StokesOperator layer = assemble(space, position, kStokesLayer).stokes_single;
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(stokes_identities, StokesLayer)

BOOST_AUTO_TEST_CASE(pressure_density_moves_nothing) {
  const Matrix velocity = layer.apply(weighted(space, surface, surface.normal));
  BOOST_TEST(velocity.cwiseAbs().maxCoeff() < 1e-12);
}

BOOST_AUTO_TEST_CASE(velocity_of_any_density_has_no_flux) {
  const Matrix velocity = space.fine.synthesize(layer.apply(smooth_coefficients(kOrder, 8, 3, 41)));
  const double flux = row_dot(velocity, surface.normal).dot(surface.quadrature);
  BOOST_TEST(std::abs(flux) < 1e-11 * velocity.rowwise().norm().dot(surface.quadrature));
}

BOOST_AUTO_TEST_CASE(operator_is_symmetric_and_dissipates) {
  const Matrix f = smooth_coefficients(kOrder, 8, 3, 42);
  const Matrix g = smooth_coefficients(kOrder, 8, 3, 43);
  const auto work = [](const Matrix& density, const Matrix& velocity) { return density.cwiseProduct(velocity).sum(); };
  const double f_on_g = work(f, layer.apply(g));
  const double power = work(f, layer.apply(f));
  BOOST_TEST(power > 0.0);
  BOOST_TEST(std::abs(f_on_g - work(g, layer.apply(f))) < 1e-9 * power);
}

BOOST_AUTO_TEST_CASE(operator_is_symmetric_to_rounding_for_any_densities) {
  const Matrix f = random_coefficients(kOrder, 3, 44);
  const Matrix g = random_coefficients(kOrder, 3, 45);
  const double f_on_g = f.cwiseProduct(layer.apply(g)).sum(), g_on_f = g.cwiseProduct(layer.apply(f)).sum();
  BOOST_TEST(std::abs(f_on_g - g_on_f) < 1e-13 * f.norm() * layer.apply(g).norm());
}

BOOST_AUTO_TEST_SUITE_END()
