#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "bie/scene/model_of.hpp"
#include "tests/invariance/columns.hpp"
#include "tests/invariance/moved_scene.hpp"
#include "tests/invariance/scenes.hpp"
#include "tests/invariance/short_run.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(place_of_a_scene, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

namespace {

constexpr int kSteps = 3;
/// Solvers stop at a relative tolerance of 1e-9. Adaptive step sizes differ if rounding differs, and the result of each
/// run is as accurate as its tolerance.
double bound_of(const Scene& scene) { return 1e-6 + scene.numerics.tolerance.value_or(0.0); }

Vector3 random_vector(std::mt19937_64& random, double size) {
  std::normal_distribution<double> normal;
  const Vector3 v(normal(random), normal(random), normal(random));
  return size * v.normalized();
}

AxisAngle random_rotation(std::mt19937_64& random, const Scene& scene) {
  std::uniform_real_distribution<double> angle(20.0, 160.0);
  const bool along_x = scene.flow && scene.flow->kind == FlowKind::poiseuille;
  const Vector3 axis = along_x ? Vector3(Vector3::UnitX()) : random_vector(random, 1.0);
  return {axis.x(), axis.y(), axis.z(), angle(random)};
}

/// The scene without use of symmetry, so that all positions are computed in the same way, at a degree of at most 10.
Scene plain(Scene scene) {
  scene.numerics.symmetry = SymmetryUse::off;
  scene.numerics.order = std::min(scene.numerics.order, 10);
  return scene;
}

double radius_of(const ShortRun& run) {
  return std::sqrt(run.rows.front().diagnostics.area / (4.0 * std::numbers::pi));
}

// A linear flow about another point is the same flow with a drift. Poiseuille flow depends on the position: it is
// unchanged only along its axis.
void expect_the_same_elsewhere_in_a_drift(const NamedScene& of, const ShortRun& base, std::mt19937_64 random) {
  const bool poiseuille = of.scene.flow && of.scene.flow->kind == FlowKind::poiseuille;
  Vector3 by = random_vector(random, 3.0 * radius_of(base));
  if (poiseuille) by = Vector3(by.norm(), 0.0, 0.0);
  const Scene moved = shifted_scene(of.scene, by);
  Problem problem = problem_of(moved);
  const double speed = 3.0 * radius_of(base) / base.rows.back().state.time;
  if (moved.membrane.mobile && !poiseuille && std::isfinite(speed)) {
    Vector3 drift = random_vector(random, speed);
    // Only a drift along the wall keeps the distance from it.
    if (const auto& wall = problem.model.wall) drift -= wall->normal.dot(drift) * wall->normal;
    problem.model.effects.push_back(uniform_drift(drift));
  }
  const ShortRun elsewhere = short_run(problem, moved, kSteps);
  Deviation worst = largest_deviation(base, elsewhere, {}, Column::Depends::on_axes);
  if (worst.size >= bound_of(of.scene) && !of.scene.numerics.tolerance) {
    // An iteration that ends elsewhere leaves a different residual.
    worst = largest_deviation(solved_run(of.scene, kSteps), solved_run(problem, moved, kSteps), {},
                              Column::Depends::on_axes);
  }
  BOOST_TEST(worst.size < bound_of(of.scene),
             of.name << " elsewhere, in a drift: " << worst.column << " by " << worst.size);
}

void expect_the_same_scalars_rotated(const NamedScene& of, const ShortRun& base, std::mt19937_64 random) {
  const ShortRun rotated = short_run(rotated_scene(of.scene, random_rotation(random, of.scene)), kSteps);
  // Another grid on the same shape resolves the same degrees but truncates differently.
  double truncation = 0.0;
  for (const RunRow& row : base.rows) {
    // The fields of one vesicle on another have higher degrees than its shape.
    truncation = std::max(truncation, of.scene.vesicles.empty() ? row.diagnostics.spectrum_tail : row.truncation);
  }
  const Deviation worst = largest_deviation(base, rotated, {}, Column::Depends::on_nothing);
  BOOST_TEST(worst.size < bound_of(of.scene) + truncation,
             of.name << " rotated: " << worst.column << " by " << worst.size);
}

}  // namespace

BOOST_AUTO_TEST_CASE(another_place_a_drift_and_a_rotation_change_nothing_of_a_vesicle) {
  for (const NamedScene& shipped : all_scenes()) {
    const NamedScene of{shipped.name, plain(shipped.scene)};
    const ShortRun base = short_run(of.scene, kSteps);
    expect_the_same_elsewhere_in_a_drift(of, base, random_of(of, "place"));
    expect_the_same_scalars_rotated(of, base, random_of(of, "rotation"));
  }
}

BOOST_AUTO_TEST_SUITE_END()
