#include "bie/stepping/state/composition.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "bie/physics/effects/gravity.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(composition)

namespace {

constexpr int kOrder = 8;

using Counts = std::map<std::string, std::uint64_t>;

std::uint64_t count(const Counts& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

/// Kernel evaluations of n steps that end on the discontinuities of the forcing, and the final state.
struct CountedRun {
  State state;
  std::vector<Counts> after_step;
};

CountedRun counted_run(const Model& model, const Matrix& position, double dt, double end_time) {
  const Discretisation discretisation = discretisation_of(kOrder);
  Instruments instruments;
  CountedRun result;
  result.state = start(model, discretisation, position, dt);
  Evaluation evaluation = evaluate(model, discretisation, result.state, instruments);
  while (result.state.time < end_time - 1e-9) {
    const double target = std::min(end_time, next_discontinuity(model, result.state.time).value_or(end_time));
    const double limit = std::min(dt, target - result.state.time);
    StepAttempt advanced = attempt_step({model, discretisation, result.state, evaluation}, limit, instruments);
    if (!advanced.accepted) throw std::runtime_error(advanced.reason);
    result.state = std::move(advanced.state);
    evaluation = evaluate(model, discretisation, result.state, instruments, &evaluation);
    result.after_step.emplace_back(instruments.kernel_evaluations());
  }
  return result;
}

Model frozen_field_model() {
  Model model = field_model();
  model.mobile = false;
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(absent_effects_evaluate_no_kernels) {
  const Counts shear = counted_run(shear_model(), ellipsoid(kOrder, {1.5, 1.0, 1.0}), 0.1, 0.2).after_step.back();
  BOOST_TEST(count(shear, "stokes_single") > 0);
  for (const char* name : {"laplace_single", "laplace_double", "laplace_adjoint", "stokes_double"}) {
    BOOST_TEST(count(shear, name) == 0, name);
  }
  Model carried;
  carried.vesicles[0].inextensible = false;
  carried.flow = axisymmetric_extension(0.1);
  BOOST_TEST(counted_run(carried, prolate(kOrder), 0.1, 0.2).after_step.back().empty());
}

BOOST_AUTO_TEST_CASE(equal_conductivities_need_no_adjoint_layer) {
  Model model = field_model();
  model.electric->conductivity = model.vesicles[0].inside.conductivity;
  const Counts counts = counted_run(model, prolate(kOrder), 0.1, 0.2).after_step.back();
  BOOST_TEST(count(counts, "laplace_adjoint") == 0);
  BOOST_TEST(count(counts, "laplace_single") > 0);
}

BOOST_AUTO_TEST_CASE(frozen_shape_is_assembled_once) {
  const CountedRun run = counted_run(frozen_field_model(), prolate(kOrder), 0.1, 1.0);
  const Counts once = counted_run(frozen_field_model(), prolate(kOrder), 0.1, 0.0 + 0.1).after_step.front();
  BOOST_TEST(count(run.after_step.back(), "stokes_single") == 0);
  BOOST_TEST(count(run.after_step.back(), "laplace_single") == count(once, "laplace_single"));
  BOOST_TEST(max_difference(run.state.vesicles[0].position, prolate(kOrder)) == 0.0);
  BOOST_TEST(run.state.vesicles[0].transmembrane_potential.norm() > 0.1);
}

// After the pulse V_m decays at a rate of about 6; before it and long after it nothing electric is evaluated.
BOOST_AUTO_TEST_CASE(electric_part_is_inactive_while_field_and_potential_are_zero) {
  Model model = field_model();
  model.electric->waveform = Waveform::pulse_train(1.0, 0.5, 0.5, 8.0);
  const CountedRun run = counted_run(model, prolate(kOrder), 0.25, 9.0);
  const auto at = [&](std::size_t step) { return count(run.after_step[step - 1], "laplace_single"); };
  BOOST_TEST(at(1) == 0);        // t = 0.25
  BOOST_TEST(at(3) > at(2));     // t = 0.75, on
  BOOST_TEST(at(5) > at(4));     // t = 1.25, decaying
  BOOST_TEST(at(30) == at(32));  // t = 7.5 … 8, inactive
  BOOST_TEST(at(35) > at(32));   // t = 8.75, active again
  BOOST_TEST(run.state.vesicles[0].transmembrane_potential.norm() > 1e-3);
}

// On the unit sphere V' = −G V + κ (3E/2 − V) with E = cos ωt ends on V = Re Z e^{iωt}, Z = (3κ/2)/(κ + G + iω).
// Backward Euler has (1 − e^{−iωΔt})/Δt in place of iω, exactly.
BOOST_AUTO_TEST_CASE(sphere_under_alternating_field_follows_its_phasor) {
  using namespace std::complex_literals;
  const double omega = 3.0;
  Model model = frozen_field_model();
  model.electric->waveform = Waveform::alternating(1.0, omega / (2.0 * std::numbers::pi), 0.0);
  const double kappa = 2.0 * 1.0 * 2.0 / (1.0 + 2.0 * 2.0);
  const double rate = kappa + model.vesicles[0].charging.conductance;
  const std::complex<double> exact = 1.5 * kappa / (rate + 1i * omega);
  double last_error = 0.1 * std::abs(exact);
  for (const double dt : {0.04, 0.02, 0.01}) {
    const CountedRun run = counted_run(model, sphere(kOrder), dt, 5.0);
    const std::complex<double> discrete = 1.5 * kappa / (rate + (1.0 - std::exp(-1i * omega * dt)) / dt);
    const double north = run.state.vesicles[0].transmembrane_potential[2] * std::sqrt(3.0 / (4.0 * std::numbers::pi));
    BOOST_TEST(std::abs(north - (discrete * std::exp(1i * omega * run.state.time)).real()) < 1e-8);
    BOOST_TEST(std::abs(discrete - exact) < 0.6 * last_error);
    last_error = std::abs(discrete - exact);
  }
}

// Hadamard and Rybczynski: a drop of equal viscosity sinks with 4/15 Δρ g a²/μ; Stokes: a rigid sphere with 2/9.
BOOST_AUTO_TEST_CASE(sphere_sinks_with_the_speed_of_a_drop_or_of_a_rigid_sphere) {
  Model model;
  model.viscosity = 0.7;
  model.effects.push_back(std::make_shared<GravityEffect>(GravityParameters{1.4, {0.0, 0.0, -2.0}}));
  const Discretisation discretisation = discretisation_of(kOrder);
  const double radius = 1.3;
  const double scale = 1.4 * 2.0 * radius * radius / model.viscosity;
  const auto speed = [&](bool inextensible) {
    model.vesicles[0].inextensible = inextensible;
    const State state = start(model, discretisation, sphere(kOrder, radius), 0.1);
    const SphereTransform& fine = discretisation.vesicle(0).fine_transform();
    const Matrix velocity = fine.synthesize(evaluated(model, discretisation, state).fields.velocity);
    const Surface s = make_surface(fine, state.vesicles[0].position);
    // The surface of a drop also flows tangentially; its normal velocity is U·n.
    const Vector normal_velocity = velocity.cwiseProduct(s.normal).rowwise().sum();
    return 3.0 * normal_velocity.cwiseProduct(s.normal.col(2)).dot(s.quadrature) / s.quadrature.sum();
  };
  BOOST_TEST(std::abs(speed(false) + 4.0 / 15.0 * scale) < 1e-10);
  BOOST_TEST(std::abs(speed(true) + 2.0 / 9.0 * scale) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
