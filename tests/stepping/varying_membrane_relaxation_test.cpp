#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "bie/physics/effects/poration.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "tests/stepping/relaxing_sphere.hpp"
#include "tests/stepping/varying_membrane.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(varying_membrane_relaxation)

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Displacement currents around a frozen membrane in an alternating field, with an alternating pump.
Model relaxing_model() {
  Model model = relaxation_model(0.05);
  set_electric(model, {{0.0, 0.0, 0.7}, 0.5, 1.0, 0.3, 0.6, Waveform::alternating(1.0, 0.5, 0.3)}, {0.8, 0.5});
  model.electric->displacement_current = true;
  model.mobile = false;
  model.vesicles[0].has_varying_properties = true;
  model.vesicles[0].pump = Waveform::alternating(1.0, 0.4, 0.3);
  return model;
}

std::shared_ptr<const PorationReaction> pores() {
  return std::make_shared<PoreDensity>(PoreParameters{2.0, 0.5, 1.0, 2.46, 0.3});
}

double difference(const VesicleState& state, const RelaxingSphere::Charges& other) {
  double result = std::max(max_difference(state.transmembrane_potential, other.inner),
                           max_difference(state.free_charge, other.sum));
  if (other.reaction.size() > 0) result = std::max(result, max_difference(state.poration, other.reaction));
  return result;
}

RelaxingSphere::Charges charges_of(const VesicleState& state) {
  return {state.transmembrane_potential, state.free_charge, state.poration};
}

/// Checks a run of a sphere of degree 4 from zero charge against an independent integrator, and its orders.
void check_sphere(const Model& model) {
  constexpr int kOrder = 4;
  constexpr double kEnd = 0.4;
  const MembraneMaterial material = electric_material(kOrder);
  const auto reached = [&](int order, int n_steps) {
    NumericalSettings settings = solved_to_rounding(kOrder);
    settings.time_order = order;
    const Discretisation discretisation(settings, {});
    const double dt = kEnd / n_steps;
    const State state = varying_start(model, discretisation, sphere(kOrder), dt, material);
    return run(model, discretisation, state, dt, n_steps).vesicles[0];
  };
  const PorationReaction* reaction = model.vesicles[0].reaction.get();
  const RelaxingSphere exact(kOrder, electric_parameters(model, model.vesicles[0]),
                             model.vesicles[0].charging.capacitance, material, reaction);
  const Vector none = Vector::Zero(n_coefficients(kOrder));
  RelaxingSphere::Charges at_start{none, none, {}};
  if (reaction != nullptr) at_start.reaction = reaction->start() * kEverywhere * harmonic(kOrder, 0, 0);
  const RelaxingSphere::Charges expected = exact.after(at_start, kEnd, 800);
  const VesicleState limit = reached(5, 48);
  BOOST_TEST(difference(limit, expected) < 5e-9, difference(limit, expected));
  BOOST_TEST(limit.transmembrane_potential.norm() > 0.05);
  for (int order = 1; order <= 5; ++order) {
    constexpr int n_steps = 12;
    const double coarse = difference(reached(order, n_steps), charges_of(limit));
    const double fine = difference(reached(order, 2 * n_steps), charges_of(limit));
    BOOST_TEST_MESSAGE(order << ": " << coarse << " " << fine);
    BOOST_TEST(std::log2(coarse / fine) > order - 0.6, order << ": " << coarse << " " << fine);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(charges_of_a_sphere_are_followed_at_every_order) { check_sphere(relaxing_model()); }

BOOST_AUTO_TEST_CASE(a_sphere_that_porates_with_displacement_currents_is_followed_at_every_order) {
  Model model = relaxing_model();
  model.vesicles[0].reaction = pores();
  check_sphere(model);
}

BOOST_AUTO_TEST_CASE(steady_charges_do_not_change) {
  Model model = relaxing_model();
  model.electric->waveform = {};
  model.vesicles[0].pump.emplace();
  const Matrix shape = asymmetric_shape(12);
  const Discretisation discretisation(solved_to_rounding(12), {});
  const Evaluated found =
      evaluated(model, discretisation, varying_start(model, discretisation, shape, 1.0, electric_material(12), true));
  BOOST_TEST(found.fields.potential.norm() > 0.5);
  BOOST_TEST(found.solution.rate.transmembrane_potential.norm() < 1e-4 * found.fields.potential.norm());
  BOOST_TEST(found.solution.rate.free_charge.norm() < 1e-4 * found.fields.potential.norm());
}

BOOST_AUTO_TEST_CASE(a_uniform_membrane_relaxes_as_without_variation) {
  Model model = relaxing_model();
  model.mobile = true;
  model.vesicles[0].pump.reset();
  for (const bool porates : {false, true}) {
    if (porates) model.vesicles[0].reaction = pores();
    const UniformAndVarying after(model, 2, prolate(8), 3);
    BOOST_TEST(largest_difference(after.varying, after.uniform) < 1e-8, porates);
    BOOST_TEST(max_difference(after.varying.vesicles[0].free_charge, after.uniform.vesicles[0].free_charge) < 1e-8);
  }
}

// V = Re z and the field at the start of a period: the corresponding charges change by −ω times those of Im z.
BOOST_AUTO_TEST_CASE(amplitudes_of_the_averaged_field_alternate_as_the_charges_do) {
  Model model = relaxing_model();
  model.vesicles[0].pump.reset();
  const double frequency = 0.5, omega = 2.0 * std::numbers::pi * frequency;
  model.electric->waveform = Waveform::alternating(1.0, frequency, 0.0);
  Model averaged = model;
  averaged.electric->waveform = {};
  averaged.electric->averaged_frequency = frequency;
  constexpr int kOrder = 10;
  const Matrix position = asymmetric_shape(kOrder);
  MembraneMaterial material = electric_material(kOrder);
  material.pump_current.resize(0);
  const Discretisation discretisation(solved_to_rounding(kOrder), {});
  const auto started = [&](const Model& of) { return varying_start(of, discretisation, position, 1.0, material); };
  const Matrix amplitude = evaluated(averaged, discretisation, started(averaged)).fields.potential_amplitude;
  // K_k E_k = yV at every point, so q_i = C V − ε_i yV/K_i and q_e = ε_e yV/K_e − C V; divided by C = 0.8.
  const SphereTransform& fine = discretisation.vesicle(0).fine_transform();
  const MembraneMaterial values = material_at(discretisation.vesicle(0), material);
  const Matrix v = fine.synthesize(amplitude);
  Matrix inner(v.rows(), 2), sum(v.rows(), 2);
  for (Index i = 0; i < v.rows(); ++i) {
    const std::complex<double> z(v(i, 0), v(i, 1)), y(values.conductance[i], omega * values.capacitance[i]),
        in = 0.18 * y * z / std::complex<double>(0.5, omega * 0.18),
        out = 0.3 * y * z / std::complex<double>(1.0, omega * 0.3), of_inner = (values.capacitance[i] * z - in) / 0.8,
        of_sum = (out - in) / 0.8;
    inner.row(i) << of_inner.real(), of_inner.imag();
    sum.row(i) << of_sum.real(), of_sum.imag();
  }
  const Matrix of_inner = fine.analyze(inner), of_sum = fine.analyze(sum);
  State state = started(model);
  state.vesicles[0].transmembrane_potential = of_inner.col(0);
  state.vesicles[0].free_charge = of_sum.col(0);
  const Evaluated now = evaluated(model, discretisation, state);
  BOOST_TEST(max_difference(now.fields.potential, amplitude.col(0)) < 2e-3);
  BOOST_TEST(max_difference(now.solution.rate.transmembrane_potential, -omega * of_inner.col(1)) < 5e-3);
  BOOST_TEST(max_difference(now.solution.rate.free_charge, -omega * of_sum.col(1)) < 5e-3);
  BOOST_TEST(amplitude.norm() > 0.3);
}

BOOST_AUTO_TEST_SUITE_END()
