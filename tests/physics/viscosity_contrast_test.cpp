#include "bie/physics/effects/viscosity_contrast.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "bie/support/errors.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/point_force.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/vector_harmonics.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// A surface with its Stokes layers, for maps of many ratios.
struct Layered : LayeredSurface {
  Layered(int order, Matrix coefficients) : LayeredSurface(order, std::move(coefficients), kStokesLayers) {}

  ViscosityContrast map(double ratio) const {
    return {{ratio}, space.fine, surface, layers.stokes_double, SymmetrySubspace({}, space.fine.order())};
  }
  double flux(const Matrix& velocity) const {
    return row_dot(space.fine.synthesize(velocity), surface.normal).dot(surface.quadrature);
  }
};

Matrix3 general_gradient() {
  Matrix3 gradient;
  gradient << 0.3, -0.7, 1.1, 0.5, -0.4, 0.2, -0.6, 0.9, 0.1;
  return gradient;
}

/// Largest error for a flow, driven by a distant point force, that is the same in both fluids: the membrane must supply
/// the difference of the tractions, f = (ratio − 1) t.
double common_flow_error(const Layered& g, double ratio) {
  const PointForce flow = point_force(g.surface, {2.4, 1.1, -1.6}, {0.7, -0.4, 0.6});
  const Matrix background = g.space.fine.analyze(flow.velocity);
  const Matrix driven =
      background + (ratio - 1.0) * g.layers.stokes_single.apply(weighted(g.space, g.surface, flow.traction));
  return relative_difference(g.map(ratio).velocity(driven), background);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(viscosity_contrast)

BOOST_AUTO_TEST_CASE(spheres_have_the_closed_spectrum_at_every_ratio) {
  const int order = 12;
  const Layered g(order, translated(sphere(order, 1.7), {2.0, -1.0, 0.5}));
  const Surface unit_sphere = make_surface(g.space.fine, sphere(order));
  for (const double ratio : {0.0, 1e-3, 0.2, 3.0, 1e3, 1e6}) {
    const ViscosityContrast map = g.map(ratio);
    double error = 0.0;
    for (int n = 0; n <= order / 2; ++n) {
      const ContrastSpectrum spectrum = contrast_spectrum(ratio, n);
      for (int m = -n; m <= n; ++m) {
        const VectorHarmonics h = vector_harmonics(g.space.fine, unit_sphere, n, m);
        error = std::max(error, max_difference(map.velocity(h.v), h.v / spectrum.v));
        error = std::max(error, max_difference(map.velocity(h.w), h.w / spectrum.w));
        error = std::max(error, max_difference(map.velocity(h.x), h.x / spectrum.x));
      }
    }
    BOOST_TEST_CONTEXT("ratio " << ratio) { BOOST_TEST(error < 1e-11); }
  }
}

// Taylor's drop without surface tension: the strain E x is slowed to 5/(3 + 2 ratio) E x, the rotation is unchanged.
BOOST_AUTO_TEST_CASE(spherical_drop_in_linear_flow_strains_by_the_law_of_taylor) {
  const Layered g(8, sphere(8, 1.3));
  const Matrix3 gradient = general_gradient();
  const Matrix3 strain = 0.5 * (gradient + gradient.transpose());
  for (const double ratio : {0.0, 0.1, 1.0, 10.0, 1e6}) {
    const Matrix velocity = g.map(ratio).velocity(g.position * gradient.transpose());
    const Matrix3 expected = gradient - strain + 5.0 / (3.0 + 2.0 * ratio) * strain;
    BOOST_TEST(max_difference(velocity, g.position * expected.transpose()) < 1e-12);
  }
}

// Angular velocity of a torque-free rigid ellipsoid (Jeffery).
BOOST_AUTO_TEST_CASE(very_viscous_ellipsoid_moves_as_a_rigid_one) {
  const Vector3 axes(1.0, 0.8, 1.6);
  const Matrix3 a = general_gradient();
  const auto rate = [&](int i, int j) {
    const double bi = axes[i] * axes[i];
    const double bj = axes[j] * axes[j];
    return (bj * a(i, j) - bi * a(j, i)) / (bi + bj);
  };
  Matrix3 spin = Matrix3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i != j) spin(i, j) = rate(i, j);
    }
  }
  const auto error = [&](const Layered& g, double ratio) {
    return relative_difference(g.map(ratio).velocity(g.position * a.transpose()), g.position * spin.transpose());
  };
  const Layered coarse(6, ellipsoid(6, axes));
  const Layered fine(16, ellipsoid(16, axes));
  BOOST_TEST(error(fine, 1e12) < 1e-2 * error(coarse, 1e12));
  BOOST_TEST(error(fine, 1e12) < 1e-6);
  // At a large ratio the remaining difference is the deformation of the inner fluid.
  BOOST_TEST(error(fine, 1e3) < 1e-2);
  BOOST_TEST(error(fine, 1e3) > 1e-4);
}

BOOST_AUTO_TEST_CASE(rigid_motions_pass_unchanged_and_nothing_expands) {
  const Layered g(10, asymmetric_shape(10));
  const Vector3 b(-0.8, 0.5, 1.2);
  Matrix3 spin;
  spin << 0.0, -b.z(), b.y(), b.z(), 0.0, -b.x(), -b.y(), b.x(), 0.0;
  const Matrix motion = translated(g.position * spin.transpose(), {0.3, -1.1, 0.6});
  Matrix any = smooth_coefficients(10, 6, 3, 91);
  const Matrix normal = g.space.fine.analyze(g.surface.normal);
  any -= g.flux(any) / g.flux(normal) * normal;
  for (const double ratio : {0.0, 1e-6, 0.3, 4.0, 1e6, 1e12}) {
    const ViscosityContrast map = g.map(ratio);
    BOOST_TEST_CONTEXT("ratio " << ratio) {
      BOOST_TEST(max_difference(map.velocity(motion), motion) < 1e-12);
      BOOST_TEST(std::abs(g.flux(map.velocity(any))) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(flow_common_to_both_fluids_is_found_with_spectral_accuracy_at_every_ratio) {
  const Layered coarse(6, asymmetric_shape(6));
  const Layered fine(18, asymmetric_shape(18));
  for (const double ratio : {0.0, 1e-3, 4.0, 1e6}) {
    const double error = common_flow_error(fine, ratio);
    BOOST_TEST_CONTEXT("ratio " << ratio) {
      BOOST_TEST(error < 1e-2 * common_flow_error(coarse, ratio));
      BOOST_TEST(error < 1e-5);
    }
  }
}

BOOST_AUTO_TEST_CASE(map_tends_to_the_identity_where_the_viscosities_meet) {
  const Layered g(10, asymmetric_shape(10));
  const Matrix w = smooth_coefficients(10, 6, 3, 92);
  const auto change = [&](double ratio) { return relative_difference(g.map(ratio).velocity(w), w); };
  BOOST_TEST(change(1.0) < 1e-15);
  for (const double sign : {-1.0, 1.0}) {
    BOOST_TEST(change(1.0 + 1e-6 * sign) < 2e-6);
    BOOST_TEST(change(1.0 + 1e-6 * sign) > 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(negative_ratio_is_refused) {
  const Layered g(4, sphere(4));
  BOOST_CHECK_THROW(g.map(-0.1), InputError);
  BOOST_CHECK_THROW(g.map(std::numeric_limits<double>::quiet_NaN()), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
