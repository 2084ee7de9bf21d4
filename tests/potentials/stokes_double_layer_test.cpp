#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/point_force.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(stokes_double_layer)

namespace {

const Vector3 kInside(0.25, -0.1, 0.3);
const Vector3 kOutside(2.4, 1.1, -1.6);
const Vector3 kForce(0.7, -0.4, 0.6);

/// A surface with its Stokes layers.
struct Layered : LayeredSurface {
  Layered(int order, Matrix coefficients) : LayeredSurface(order, std::move(coefficients), kStokesLayers) {}
};

/// Largest error of S[t] − D[u] = ½u (Stokes flow inside) or of its negative (outside), relative to u.
double green_error(const Layered& g, const Vector3& source, double side) {
  const PointForce flow = point_force(g.surface, source, kForce);
  const Matrix representation = g.layers.stokes_single.apply(weighted(g.space, g.surface, flow.traction)) -
                                g.layers.stokes_double.apply(g.space.fine.analyze(flow.velocity));
  return relative_difference(g.space.fine.synthesize(representation), 0.5 * side * flow.velocity);
}

/// Coefficients of the rigid motion a + b × x.
Matrix rigid_motion(const Matrix& position, const Vector3& a, const Vector3& b) {
  Matrix3 cross;
  cross << 0.0, -b.z(), b.y(), b.z(), 0.0, -b.x(), -b.y(), b.x(), 0.0;
  return translated(position * cross.transpose(), a);
}

}  // namespace

BOOST_AUTO_TEST_CASE(rigid_motion_gives_minus_half_of_itself) {
  const auto error = [](int order) {
    const Layered g(order, asymmetric_shape(order));
    const Matrix motion = rigid_motion(g.position, {0.3, -1.1, 0.6}, {-0.8, 0.5, 1.2});
    return relative_difference(g.layers.stokes_double.apply(motion), -0.5 * motion);
  };
  const double fine = error(32);
  BOOST_TEST(fine < 1e-3 * error(8));
  BOOST_TEST(fine < 1e-8);
}

BOOST_AUTO_TEST_CASE(half_minus_layer_of_any_density_has_no_flux) {
  const Layered g(32, asymmetric_shape(32));
  const Matrix density = smooth_coefficients(32, 8, 3, 51);
  const Matrix values = g.space.fine.synthesize(0.5 * density - g.layers.stokes_double.apply(density));
  const double flux = row_dot(values, g.surface.normal).dot(g.surface.quadrature);
  BOOST_TEST(std::abs(flux) < 1e-8 * values.rowwise().norm().dot(g.surface.quadrature));
}

BOOST_AUTO_TEST_CASE(green_representation_converges_spectrally_on_shape_33) {
  const Layered coarse(8, shape_33(8));
  const Layered fine(32, shape_33(32));
  for (const auto& [source, side] : {std::pair{kOutside, 1.0}, std::pair{kInside, -1.0}}) {
    const double error = green_error(fine, source, side);
    BOOST_TEST(error < 1e-3 * green_error(coarse, source, side));
    BOOST_TEST(error < 1e-5);
  }
}

BOOST_AUTO_TEST_CASE(mirror_images_share_rows_without_change) {
  const int order = 10;
  const Space space(order);
  const Matrix position = ellipsoid(order, {2.0, 0.8, 1.1});
  std::vector<Reflection> reflections;
  for (int bits = 0; bits < 8; ++bits) reflections.push_back({bits & 1 ? -1 : 1, bits & 2 ? -1 : 1, bits & 4 ? -1 : 1});
  Instruments instruments;
  const LayerOperators shared =
      assemble_layer_operators(space.quadrature, space.coarse, position, kStokesLayers, instruments, reflections);
  const LayerOperators all = assemble(space, position, kStokesLayers);
  const Matrix density = random_coefficients(order, 3, 52);
  BOOST_TEST(max_difference(shared.stokes_double.apply(density), all.stokes_double.apply(density)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(layer_is_the_same_whatever_is_assembled_with_it) {
  const Space space(8);
  const Matrix position = asymmetric_shape(8);
  const Matrix density = random_coefficients(8, 3, 53);
  LayerSelection everything = kAllLayers;
  everything.stokes_double = true;
  const Matrix among_all = assemble(space, position, everything).stokes_double.apply(density);
  const Matrix alone = assemble(space, position, {.stokes_double = true}).stokes_double.apply(density);
  BOOST_TEST(max_difference(among_all, alone) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
