#include <boost/test/unit_test.hpp>

#include "bie/stepping/space/resolution.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kSharedOrder = 14;

const SphereTransform& share_grid() {
  static const SphereTransform transform(kSharedOrder, make_grid(2 * kSharedOrder));
  return transform;
}

/// An ellipsoid whose points have slid along it by waves of degree 9, and V_m = 2x − z at every point.
SurfaceFields slid(double by) {
  const SphereDerivatives wave = share_grid().synthesize_gradient(harmonic(kSharedOrder, 9, 4));
  const SphereGrid& grid = share_grid().grid();
  Matrix points = grid_directions(grid);
  const SphereDerivatives place = share_grid().synthesize_gradient(sphere(kSharedOrder));
  for (Index i = 0; i < points.rows(); ++i) {
    const Vector3 d1 = place.d1.row(i), d2 = place.d2.row(i);
    const Vector3 along = wave.d1(i, 0) * d1 / d1.squaredNorm() + wave.d2(i, 0) * d2 / d2.squaredNorm();
    points.row(i) = (Vector3(points.row(i)) + by * along).normalized();
  }
  SurfaceFields fields;
  fields.position = share_grid().analyze(points * Vector3(1.0, 1.3, 0.8).asDiagonal());
  fields.transmembrane_potential = 2.0 * fields.position.col(0) - fields.position.col(2);
  return fields;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(visible_shares)

BOOST_AUTO_TEST_CASE(points_that_slide_are_not_seen) {
  for (const double by : {1e-3, 1e-4}) {
    const VisibleShare share = visible_share(share_grid(), slid(by));
    // The visible part is of second order in the sliding.
    BOOST_TEST(share.shape < 20.0 * by);
    BOOST_TEST(share.potential < 20.0 * by);
  }
}

BOOST_AUTO_TEST_CASE(ripples_are_seen) {
  SurfaceFields fields;
  const Vector radius = 1.0 + share_grid().synthesize(1e-3 * harmonic(kSharedOrder, 10, 0)).col(0).array();
  fields.position = share_grid().analyze(radius.asDiagonal() * grid_directions(share_grid().grid()));
  fields.transmembrane_potential = harmonic(kSharedOrder, 1, 0) + 1e-3 * harmonic(kSharedOrder, 10, 0);
  const VisibleShare share = visible_share(share_grid(), fields);
  BOOST_TEST(share.shape > 0.5);
  BOOST_TEST(share.shape <= 1.0);
  BOOST_TEST(share.potential > 0.5);
  BOOST_TEST(share.potential <= 1.0);
}

BOOST_AUTO_TEST_CASE(there_is_no_estimate_without_high_degrees) {
  SurfaceFields fields;
  fields.position = ellipsoid(kSharedOrder, {1.0, 1.3, 0.8});
  BOOST_TEST(visible_share(share_grid(), fields).shape == 1.0);
  BOOST_TEST(visible_share(share_grid(), fields).potential == 1.0);
}

BOOST_AUTO_TEST_CASE(components_that_are_not_seen_need_no_degree) {
  State state = at_rest(shape_33(kSharedOrder));
  state.vesicles[0].reference_area = 13.0;
  const double all = Resolution(Model{}, state.vesicles[0]).remainder();
  BOOST_TEST(Resolution(Model{}, state.vesicles[0], {.shape = 0.25}).remainder() == 0.25 * all,
             boost::test_tools::tolerance(1e-12));
  // A charge that has only a share of its size in high degrees keeps its size.
  const Model model = field_model();
  state.vesicles[0].position = ellipsoid(kSharedOrder, {1.0, 1.3, 0.8});
  state.vesicles[0].transmembrane_potential = shape_33(kSharedOrder).col(2);
  const double charged = Resolution(model, state.vesicles[0]).remainder();
  BOOST_TEST(Resolution(model, state.vesicles[0], {.potential = 0.25}).remainder() == 0.25 * charged,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
