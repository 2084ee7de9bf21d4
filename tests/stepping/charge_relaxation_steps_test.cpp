#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <tuple>

#include "bie/physics/averaged_field.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/complex_columns.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(charge_relaxation_steps)

using namespace vehd;
using namespace vehd::testing;

namespace {

Model relaxing_model() {
  Model model = relaxation_model(0.05);
  set_electric(model, {{0.0, 0.0, 1.0}, 0.5, 1.0, 0.3, 0.6}, {1.0, 0.2});
  model.electric->displacement_current = true;
  return model;
}

State end_of(const Model& model, const Matrix& position, int time_order, double end, int n_steps) {
  const Discretisation discretisation = symmetric_discretisation(model, position, time_order);
  return run(model, discretisation, start(model, discretisation, position, end / n_steps), end / n_steps, n_steps);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_field_that_jumps_moves_the_potential_and_not_the_charges) {
  Model model = relaxing_model();
  model.mobile = false;
  model.electric->waveform = Waveform::pulse(1.0, 0.0, 0.5);
  const Discretisation discretisation = symmetric_discretisation(model, sphere(6), 3);
  const State end = end_of(model, sphere(6), 3, 0.5, 10);
  Instruments instruments;
  const SolvedFields before = solve_fields(model, discretisation, end, instruments, nullptr, Limit::before);
  const SolvedFields after = solve_fields(model, discretisation, end, instruments, nullptr, Limit::after);
  // Without charges a field E across the sphere gives V_m by the two dielectrics and C_m in series:
  // 3ε_iε_e a E cos θ/((2ε_e + ε_i) a C_m + 2ε_iε_e).
  const double out = 0.3, in = 0.18;
  const double jump = 3.0 * in * out / ((2.0 * out + in) + 2.0 * in * out);
  const Vector cosine = sphere(6).col(2);
  const Vector difference = before.fields.vesicles[0].potential - after.fields.vesicles[0].potential;
  BOOST_TEST(max_difference(difference, jump * cosine) < 1e-9);
  BOOST_TEST(jump > 0.05);
}

BOOST_AUTO_TEST_CASE(alternation_of_a_frozen_sphere_is_followed_at_every_order) {
  Model model = relaxing_model();
  model.mobile = false;
  const double frequency = 0.5;
  Model averaged = model;
  averaged.electric->averaged_frequency = frequency;
  const SphereInAcField exact =
      sphere_in_ac_field(electric_parameters(averaged, averaged.vesicles[0]), averaged.vesicles[0].charging, 1.0);
  model.electric->waveform = Waveform::alternating(1.0, frequency, 0.0);
  // Starts from the charges of the closed form, so that there is no transient.
  const double in = 0.18, out = 0.3;
  const Vector cosine = sphere(4).col(2);
  const double inner = (exact.potential - in * exact.inside).real();
  const double sum = (out * exact.outside - in * exact.inside).real();
  for (int order = 2; order <= 4; ++order) {
    double errors[2];
    for (int level = 0; level < 2; ++level) {
      const int n_steps = 32 << level;
      const Discretisation discretisation = symmetric_discretisation(model, sphere(4), order);
      State state = start(model, discretisation, sphere(4), 2.0 / n_steps);
      state.vesicles[0].transmembrane_potential = inner * cosine;
      state.vesicles[0].free_charge = sum * cosine;
      // After a whole period the field and the state are as at the start.
      state = run(model, discretisation, state, 2.0 / n_steps, n_steps);
      errors[level] = max_difference(state.vesicles[0].transmembrane_potential, inner * cosine) +
                      max_difference(state.vesicles[0].free_charge, sum * cosine);
    }
    BOOST_TEST(std::log2(errors[0] / errors[1]) > order - 0.4, order << ": " << errors[0] << " " << errors[1]);
  }
}

BOOST_AUTO_TEST_CASE(moving_membranes_keep_the_order) {
  const Model model = relaxing_model();
  const Matrix position = ellipsoid(16, {1.0, 1.0, 1.2});
  const auto observed = [&](int time_order, int n_steps) {
    const State end = end_of(model, position, time_order, 0.5, n_steps);
    const Discretisation discretisation = symmetric_discretisation(model, position, time_order);
    const VesicleDiagnostics d = evaluated(model, discretisation, end).diagnostics;
    return Vector{{d.extent_x, d.extent_z, d.Vm_max, d.q_north}};
  };
  const Vector exact = observed(highest_time_order, 64);
  const auto rate = [&](int order, int n_steps) {
    const auto error = [&](int n) { return (observed(order, n) - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff(); };
    const double coarse = error(n_steps), fine = error(2 * n_steps);
    BOOST_TEST_MESSAGE("order " << order << ", " << n_steps << " steps: " << coarse << ", " << fine);
    return std::log2(coarse / fine);
  };
  BOOST_TEST(rate(2, 32) > 1.6);
  BOOST_TEST(rate(4, 2) > 3.0);
  rate(4, 4);
}

BOOST_AUTO_TEST_CASE(symmetry_changes_nothing_of_relaxing_charge) {
  const Model model = relaxing_model();
  const Matrix position = ellipsoid(8, {1.0, 1.0, 1.3});
  BOOST_TEST(find_symmetry(model, at_rest(position)).axisymmetric);
  BOOST_TEST(difference_with_symmetry(model, position, 0.1, 2) < 1e-9);
}

BOOST_AUTO_TEST_CASE(amplitudes_of_the_averaged_field_alternate_as_the_charges_do_on_any_shape) {
  Model model = relaxing_model(), averaged = model;
  model.mobile = averaged.mobile = false;
  const double frequency = 0.5;
  averaged.electric->averaged_frequency = frequency;
  model.electric->waveform = Waveform::alternating(1.0, frequency, 0.0);
  const Matrix position = asymmetric_shape(8);
  const Discretisation discretisation(solved_to_rounding(8));
  const Evaluated amplitude = evaluated(averaged, discretisation, start(averaged, discretisation, position, 1.0));
  // V_m at the start of a period is the real part, a quarter later minus the imaginary part.
  const double omega = 2.0 * std::acos(-1.0) * frequency;
  State state = start(model, discretisation, position, 1.0);
  const double c = 1.0, in = 0.18, out = 0.3, g = 0.2, s_in = 0.5, s_out = 1.0;
  const auto charges = [&](Index part) {
    // K_k E_k = yV, so q_i = C V − ε_i yV/K_i and q_e = ε_e yV/K_e − C V.
    const std::complex<double> y(g, omega * c), of_in = in * y / std::complex<double>(s_in, omega * in),
                                                of_out = out * y / std::complex<double>(s_out, omega * out);
    const Matrix& v = amplitude.fields.potential_amplitude;
    return std::pair(Vector(v.col(part) - times(of_in, v).col(part)),
                     Vector(times(of_out, v).col(part) - times(of_in, v).col(part)));
  };
  std::tie(state.vesicles[0].transmembrane_potential, state.vesicles[0].free_charge) = charges(0);
  const Evaluated now = evaluated(model, discretisation, state);
  BOOST_TEST(max_difference(now.fields.potential, amplitude.fields.potential_amplitude.col(0)) < 2e-3);
  const auto [rate_of_inner, rate_of_sum] = charges(1);
  BOOST_TEST(max_difference(now.solution.rate.transmembrane_potential, -omega * rate_of_inner) < 5e-3);
  BOOST_TEST(max_difference(now.solution.rate.free_charge, -omega * rate_of_sum) < 5e-3);
}

namespace {

/// Two vesicles, one above the other, with different fluids.
struct TwoVesicles {
  Model model = with_vesicles(relaxing_model(), 2);
  std::vector<Matrix> shapes;

  TwoVesicles() {
    model.vesicles[1].inside = {2.0, 1.5};
    const Matrix shape = ellipsoid(8, {1.0, 1.0, 1.2});
    shapes = {translated(shape, {0.0, 0.0, -1.6}), translated(0.9 * shape, {0.0, 0.0, 1.6})};
  }
  [[nodiscard]] State end_of(int time_order, double end, int n_steps) const {
    const Discretisation discretisation = spaces(time_order);
    const double dt = end / n_steps;
    return run(model, discretisation, start(model, discretisation, shapes, dt), dt, n_steps);
  }
  [[nodiscard]] Discretisation spaces(int time_order) const {
    return discretisation_of(shapes, tight_settings(time_order), find_symmetry(model, at_rest(shapes)));
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(two_frozen_vesicles_keep_every_order_in_time, TwoVesicles) {
  model.mobile = false;
  model.electric->waveform = Waveform::alternating(1.0, 0.5, 0.3);
  const State exact = end_of(highest_time_order, 1.0, 32);
  for (int order = 1; order <= highest_time_order; ++order) {
    double errors[2] = {0.0, 0.0};
    for (int level = 0; level < 2; ++level) {
      const State end = end_of(order, 1.0, 8 << level);
      for (const std::size_t a : {0, 1}) {
        const VesicleState &found = end.vesicles[a], &expected = exact.vesicles[a];
        errors[level] += max_difference(found.transmembrane_potential, expected.transmembrane_potential) +
                         max_difference(found.free_charge, expected.free_charge);
      }
    }
    BOOST_TEST(std::log2(errors[0] / errors[1]) > order - 0.4, order << ": " << errors[0] << " " << errors[1]);
  }
}

BOOST_FIXTURE_TEST_CASE(two_moving_vesicles_keep_the_order_in_time, TwoVesicles) {
  const auto observed = [&](int time_order, int n_steps) {
    Instruments instruments;
    const Evaluation evaluation = evaluate(model, spaces(time_order), end_of(time_order, 0.4, n_steps), instruments);
    const VesicleDiagnostics &a = evaluation.diagnostics.vesicles[0], &b = evaluation.diagnostics.vesicles[1];
    return Vector{{a.extent_z, b.extent_z, b.centroid_z - a.centroid_z, a.Vm_max, b.Vm_max, a.q_north, b.q_north}};
  };
  const Vector exact = observed(highest_time_order, 8);
  const auto error = [&](int order, int n_steps) {
    return (observed(order, n_steps) - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff();
  };
  for (const auto& [order, n_steps] : {std::pair(1, 4), std::pair(2, 8)}) {
    const double coarse = error(order, n_steps), fine = error(order, 2 * n_steps);
    BOOST_TEST(std::log2(coarse / fine) > order - 0.4, order << ": " << coarse << ", " << fine);
  }
}

BOOST_AUTO_TEST_CASE(copies_far_apart_move_as_one_vesicle) {
  const Model model = relaxing_model();
  const Matrix shape = asymmetric_shape(8);
  const std::vector<Matrix> shapes{shape, translated(shape, {0.0, 2e4, 1e4}), translated(shape, {3e4, 0.0, 0.0})};
  const Model of_all = with_vesicles(model, 3);
  const double dt = 0.05;
  const Discretisation together = discretisation_of(shapes, tight_settings(2)),
                       alone = discretisation_of({shape}, tight_settings(2));
  const State all = run(of_all, together, start(of_all, together, shapes, dt), dt, 2);
  const VesicleState one = run(model, alone, start(model, alone, shape, dt), dt, 2).vesicles[0];
  for (std::size_t a = 0; a < 3; ++a) {
    const VesicleState& vesicle = all.vesicles[a];
    // With coordinates of 1e4 rounding leaves 1e-12.
    const Matrix moved = vesicle.position - (shapes[a] - shape);
    BOOST_TEST(max_difference(moved, one.position) < 1e-8);
    BOOST_TEST(max_difference(vesicle.transmembrane_potential, one.transmembrane_potential) < 1e-8);
    BOOST_TEST(max_difference(vesicle.free_charge, one.free_charge) < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(steady_charges_of_two_vesicles_do_not_change) {
  Model model = with_vesicles(relaxing_model(), 2);
  model.vesicles[1].inside = {2.0, 1.5};
  model.vesicles[1].charging = {0.7, 0.5};
  const std::vector<Matrix> shapes{ellipsoid(10, {1.0, 1.0, 1.1}),
                                   translated(ellipsoid(10, {0.9, 0.8, 0.9}), {0.4, 0.0, 2.8})};
  const Discretisation discretisation = discretisation_of(shapes, solved_to_rounding(10));
  const SolvedFields found = solved(model, discretisation, start(model, discretisation, shapes, 0.1, true));
  for (std::size_t a = 0; a < 2; ++a) {
    const VesicleFields& fields = found.fields.vesicles[a];
    BOOST_TEST(fields.potential.norm() > 0.5);
    BOOST_TEST(found.vesicles[a].rate.transmembrane_potential.norm() < 1e-4 * fields.potential.norm());
    BOOST_TEST(found.vesicles[a].rate.free_charge.norm() < 1e-4 * fields.potential.norm());
    // K_k E_k = G_m V on both faces.
    const double conductance = model.vesicles[a].charging.conductance;
    BOOST_TEST(max_difference(
                   fields.free_charge_out + fields.free_charge_in,
                   (0.3 - 0.3 * model.vesicles[a].inside.permittivity_ratio / model.vesicles[a].inside.conductivity) *
                       conductance * fields.potential) < 1e-4);
  }
}

BOOST_AUTO_TEST_SUITE_END()
