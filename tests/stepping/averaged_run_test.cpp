#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/physics/averaged_field.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/stepping/evolution.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(averaged_run)

using namespace vehd;
using namespace vehd::testing;

namespace {

Model averaged_model(double frequency) {
  Model model = relaxation_model(0.05);
  set_electric(model, {{0.0, 0.0, 1.0}, 0.5, 1.0, 1.0}, {1.0, 0.2});
  model.electric->averaged_frequency = frequency;
  return model;
}

/// The same field with every period resolved.
Model resolved_model(double frequency) {
  Model model = averaged_model(frequency);
  model.electric->averaged_frequency.reset();
  model.electric->waveform = Waveform::alternating(1.0, frequency, 0.0);
  return model;
}

/// Extents across and along the field, independent of the parametrisation.
Vector extents_after(const Model& model, const Matrix& position, const Vector& potential, int time_order, double dt,
                     int n_steps) {
  const Discretisation discretisation = symmetric_discretisation(model, position, time_order);
  State state = start(model, discretisation, position, dt);
  if (potential.size() > 0) state.vesicles[0].transmembrane_potential = potential;
  state = run(model, discretisation, std::move(state), dt, n_steps);
  const VesicleDiagnostics d = evaluated(model, discretisation, state).diagnostics;
  return Vector{{d.extent_x, d.extent_z}};
}

double prolate_rate_of(const Model& model, const Matrix& position) {
  const int order = order_of(position.rows());
  const Discretisation discretisation = discretisation_of(order);
  const State state = start(model, discretisation, position, 1.0);
  const SphereTransform transform(order, make_grid(order));
  const Matrix velocity = evaluated(model, discretisation, state).fields.velocity;
  const Vector radial = row_dot(transform.synthesize(velocity), grid_directions(transform.grid()));
  return transform.analyze(radial)(coefficient_index(2, 0), 0);
}

/// ρ = 1 + amplitude Y_{4,0} with an area of 4π a²: the excess area is available to degree 2.
Matrix nearly_a_sphere(int order, double radius, double amplitude) {
  const SphereTransform transform(order, make_grid(2 * order));
  const Vector rho =
      Vector::Ones(transform.grid().n_points()) + amplitude * transform.synthesize(harmonic(order, 4, 0));
  const Matrix position = transform.analyze(rho.asDiagonal() * grid_directions(transform.grid()));
  const double area = surface_area(make_surface(transform, position));
  return position * radius / std::sqrt(area / (4.0 * std::numbers::pi));
}

}  // namespace

BOOST_AUTO_TEST_CASE(resolved_shapes_approach_the_averaged_one_as_the_frequency_rises) {
  const Matrix position = nearly_a_sphere(8, 1.0, 0.05);
  // The shape changes within μ/(εE²) = 1/9, the membrane charges within 0.13.
  constexpr double kShapeTime = 1.0 / 9.0;
  std::vector<double> differences;
  const std::vector<double> frequencies{100.0, 200.0};
  const auto strong = [](Model model) {
    model.electric->field *= 3.0;
    model.vesicles[0].charging.capacitance = 0.05;
    return model;
  };
  for (const double frequency : frequencies) {
    const Model averaged = strong(averaged_model(frequency));
    // An eighth of a period after a whole number of periods, where the ripple is largest.
    const double end = (0.1 * frequency + 0.125) / frequency;
    const Vector mean = extents_after(averaged, position, {}, 4, end / 40, 40);
    BOOST_TEST(std::abs(mean[1] - extents_after(averaged, position, {}, 1, end, 0)[1]) > 0.01, mean[1]);
    // The start is free of transients: V_m is the real part of the amplitude there.
    const Discretisation discretisation = symmetric_discretisation(averaged, position);
    const Vector potential = evaluated(averaged, discretisation, start(averaged, discretisation, position, 1.0))
                                 .fields.potential_amplitude.col(0);
    const int n_steps = static_cast<int>(std::lround(end * frequency * 16));
    const Vector resolved =
        extents_after(strong(resolved_model(frequency)), position, potential, 4, end / n_steps, n_steps);
    differences.push_back(max_difference(mean, resolved));
  }
  BOOST_TEST(std::abs(differences[0] / differences[1] - 2.0) < 0.5, differences[0] << ", " << differences[1]);
  // Scaled to 100 periods in the time of the shape.
  BOOST_TEST(differences[1] * frequencies[1] / (100.0 / kShapeTime) < 1e-3);
}

BOOST_AUTO_TEST_CASE(nearly_spherical_vesicle_switches_where_the_drive_does) {
  constexpr double kRadius = 1e-5;
  Model model = averaged_model(1.0);
  model.viscosity = 1e-3;
  model.vesicles[0].bending.reset();
  for (const double conductivity_ratio : {0.1, 0.5}) {
    set_electric(model, {{0.0, 0.0, 1e4}, conductivity_ratio * 1e-3, 1e-3, 80.0 * 8.8541878128e-12}, {0.01, 0.0});
    model.electric->displacement_current = true;
    const auto at = [&](double frequency) -> const Model& {
      model.electric->averaged_frequency = frequency;
      return model;
    };
    const auto drive = [&](double frequency) {
      at(frequency);
      return sphere_in_ac_field(electric_parameters(model, model.vesicles[0]), {0.01, 0.0}, kRadius).drive;
    };
    const Matrix position = nearly_a_sphere(8, kRadius, 2e-3);
    for (const auto& [low, high, sign] : {std::tuple{10.0, 1e4, 1.0}, std::tuple{1e5, 1e7, -1.0}}) {
      double a = low, b = high;
      for (int i = 0; i < 40; ++i) {
        const double middle = std::sqrt(a * b);
        (sign * drive(middle) > 0.0 ? a : b) = middle;
      }
      BOOST_TEST(sign * prolate_rate_of(at(0.995 * a), position) > 0.0, a);
      BOOST_TEST(sign * prolate_rate_of(at(1.005 * a), position) < 0.0, a);
    }
  }
}

BOOST_AUTO_TEST_CASE(symmetry_changes_nothing) {
  const Model model = averaged_model(0.3);
  const Matrix position = ellipsoid(8, {1.0, 1.0, 1.3});
  BOOST_TEST(find_symmetry(model, at_rest(position)).axisymmetric);
  BOOST_TEST(difference_with_symmetry(model, position, 0.1, 2) < 1e-9);
}

BOOST_AUTO_TEST_CASE(history_has_magnitudes_and_the_phase_of_a_sphere) {
  Model model = averaged_model(0.3);
  model.electric->displacement_current = true;
  model.vesicles[0].inside.permittivity_ratio = 0.7;
  const ElectricParameters electric = electric_parameters(model, model.vesicles[0]);
  const SphereInAcField exact = sphere_in_ac_field(electric, model.vesicles[0].charging, 1.0);
  const Discretisation discretisation = discretisation_of(6);
  const Evaluated found = evaluated(model, discretisation, start(model, discretisation, sphere(6), 1.0));
  const double size = std::abs(exact.potential), phase = std::arg(exact.potential) * 180.0 / std::numbers::pi;
  BOOST_TEST(std::abs(found.diagnostics.Vm_max - size) < 1e-9);
  BOOST_TEST(std::abs(found.diagnostics.Vm_north - size) < 1e-9);
  BOOST_TEST(std::abs(found.diagnostics.Vm_pole_plus - size) < 1e-9);
  BOOST_TEST(std::abs(found.diagnostics.Vm_pole_minus - size) < 1e-9);
  BOOST_TEST(std::abs(found.diagnostics.Vm_phase_deg - phase) < 1e-7);
  BOOST_TEST(phase < -10.0);
  BOOST_TEST(std::abs(found.diagnostics.q_north - std::abs(exact.outside - exact.inside)) < 1e-9);
  BOOST_TEST(found.fields.charge.size() == 0);
  BOOST_TEST(found.solution.rate.transmembrane_potential.size() == 0);
}

BOOST_AUTO_TEST_CASE(two_vesicles_far_apart_move_as_each_alone) {
  const Model one = averaged_model(0.3);
  const Matrix position = ellipsoid(6, {1.0, 1.0, 1.3});
  const Model two = with_vesicles(one, 2);
  const std::vector<Matrix> positions{position, translated(position, {0.0, 0.0, 1e4})};
  const Discretisation both = vehd::testing::discretisation_of(positions, solved_to_rounding(6));
  const SolvedFields together = solved(two, both, start(two, both, positions, 0.1));
  const Discretisation single({solved_to_rounding(6)}, {});
  const Evaluated alone = evaluated(one, single, start(one, single, position, 0.1));
  for (const VesicleFields& fields : together.fields.vesicles) {
    const auto shape = [](const Matrix& velocity) { return Matrix(velocity.bottomRows(velocity.rows() - 1)); };
    BOOST_TEST(max_difference(shape(fields.velocity), shape(alone.fields.velocity)) < 1e-7);
    BOOST_TEST(max_difference(fields.potential_amplitude, alone.fields.potential_amplitude) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(a_tolerance_holds_for_shape_and_amplitude) {
  const Model model = averaged_model(0.3);
  const auto at_tolerance = [&](double tolerance) {
    NumericalSettings settings;
    settings.order = 24;
    settings.time_order = 4;
    settings.quadrature_tolerance = 0.1 * tolerance;
    const Matrix position = ellipsoid(24, {1.0, 1.0, 1.4});
    const Symmetry symmetry = find_symmetry(model, at_rest(position));
    Instruments instruments;
    Evolution evolution({model, settings, symmetry, {1.0, 1e-9, tolerance}}, {StartMembrane{position}}, instruments);
    evolution.evaluate_start();
    while (evolution.state().time < 1.0) evolution.step({{}, 1.0});
    const VesicleDiagnostics& d = evolution.evaluation().diagnostics.vesicles[0];
    return Vector{{d.extent_x, d.extent_z, d.Vm_max, d.q_north}};
  };
  const Vector exact = at_tolerance(1e-6), found = at_tolerance(1e-3);
  const double error = (found - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff();
  BOOST_TEST(error < 1e-3, error);
}

BOOST_AUTO_TEST_SUITE_END()
