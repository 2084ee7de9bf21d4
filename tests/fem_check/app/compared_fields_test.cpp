#include "fem_check/app/compared_fields.hpp"

#include <boost/test/unit_test.hpp>

#include "fem_check/app/comparison.hpp"
#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(compared_fields)

namespace {

/// V_m = z on the unit sphere with dV_m/dt = z from boundary integrals; the part `truncation` of it comes from a
/// conductance that the file does not contain.
CheckInput porous_sphere(double truncation) {
  CheckInput input;
  input.position = shapes::project(1, [](const meshes::Point& r) { return r; });
  input.potential = input.position.col(2);
  input.physics.capacitance = 0.5;
  input.conductance = 3.0 * shapes::project(1, [](const meshes::Point&) { return meshes::Point::Ones(); }).col(0);
  input.bie.potential_rate = input.bie_high.potential_rate = input.potential;
  input.bie.rate_truncation = truncation * input.potential;
  return input;
}

/// Levels whose elements lack a share of the current with which the boundary integrals charge the membrane.
LevelSequence levels_without(double share, const CheckInput& input, const SurfacePoints& points) {
  Level level;
  level.n_unknowns = 1000;
  level.surface["flux_in"] = -(input.physics.capacitance * (1.0 - share) + 3.0) * points.direction.row(2);
  LevelSequence sequence;
  sequence.levels = {level, level};
  sequence.truncated = sequence.loose = level;
  return sequence;
}

}  // namespace

// The conductance of pores that open on a small part of the membrane has a higher degree than the run.
BOOST_AUTO_TEST_CASE(conductance_of_pores_beyond_the_degree_of_the_run_is_an_error_of_the_run) {
  const Discretisation space = discretise(unit_sphere(), {.degree = 2});
  const ComparisonPoints at{space.quadrature_points(6), 1.0, Vector3::Zero()};
  const double missing = 0.01;
  for (const double truncation : {0.0, missing}) {
    const CheckInput input = porous_sphere(truncation);
    const ComparedField compared = charging_currents(input, at).front();
    const FieldComparison row = compare(compared, levels_without(missing, input, at.surface), {0.02});
    BOOST_TEST((row.verdict == (truncation > 0.0 ? Verdict::agree : Verdict::disagree)));
    BOOST_TEST(row.bie_error() >= truncation * row.difference.l2 / missing);
  }
}

BOOST_AUTO_TEST_SUITE_END()
