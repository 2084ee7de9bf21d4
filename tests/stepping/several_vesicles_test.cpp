#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/stepping/evolution.hpp"
#include "tests/physics/coupled_spheres.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(several_vesicles)

namespace {

State at_rest_charged(const Model& model, const std::vector<Matrix>& shapes) {
  State state = at_rest(shapes);
  for (VesicleState& vesicle : state.vesicles) {
    if (model.electric) vesicle.transmembrane_potential = Vector::Zero(vesicle.position.rows());
  }
  return state;
}

/// Advances vesicles in steps of one size.
class Run {
 public:
  Run(const Model& model, const std::vector<Matrix>& shapes, const NumericalSettings& settings, double dt,
      bool steady = false)
      : evolution_({model, settings, find_symmetry(model, at_rest_charged(model, shapes)), fixed_steps(dt)},
                   starts(shapes, steady), instruments_) {
    evolution_.evaluate_start();
  }

  /// @returns number of steps that had to be repeated
  int advance_to(double time) {
    int rejected = 0;
    while (evolution_.state().time < time) rejected += evolution_.step({{}, time}).rejected;
    return rejected;
  }

  [[nodiscard]] const Evolution& evolution() const { return evolution_; }
  [[nodiscard]] const VesicleDiagnostics& vesicle(std::size_t a) const {
    return evolution_.evaluation().diagnostics.vesicles[a];
  }

 private:
  static std::vector<StartMembrane> starts(const std::vector<Matrix>& shapes, bool steady) {
    std::vector<StartMembrane> result;
    for (const Matrix& shape : shapes) result.push_back({shape, {.steady = steady}});
    return result;
  }

  Instruments instruments_;
  Evolution evolution_;
};

NumericalSettings settings_of(int order, int time_order) {
  NumericalSettings settings;
  settings.order = order;
  settings.time_order = time_order;
  return settings;
}

/// Two prolates one above the other in an axial field.
Model prolates_in_field() {
  Model model = relaxation_model(0.1);
  set_electric(model, {{0.0, 0.0, 1.0}, 2.0, 1.0, 1.0}, {1.0, 1.0});
  return with_vesicles(model, 2);
}

std::vector<Matrix> two_prolates(int order) {
  const Matrix shape = ellipsoid(order, {1.0, 1.0, 1.5});
  return {translated(shape, {0.0, 0.0, -1.75}), translated(shape, {0.0, 0.0, 1.75})};
}

/// Errors of the upper of two prolates at time 1 against an independent axisymmetric code with errors below 1e-7.
struct ProlateErrors {
  double place;  ///< largest error of gap, centroid and pole distance
  double energy, tension, potential;
};

ProlateErrors prolate_errors(const Evolution& evolution) {
  const VesicleDiagnostics& upper = evolution.evaluation().diagnostics.vesicles[1];
  const Matrix& position = evolution.state().vesicles[1].position;
  const double facing_pole = evaluate_harmonics(position, Vector::Constant(1, std::numbers::pi), Vector::Zero(1))(0, 2);
  return {std::max({std::abs(2.0 * facing_pole - 0.50785869), std::abs(upper.centroid_z - 1.74922417),
                    std::abs(upper.extent_z - 2.98702709)}),
          std::abs(upper.bending_energy_scaled - 13.56222737), std::abs(upper.tension_integral - 17.12029330),
          std::max(std::abs(upper.Vm_pole_plus - 0.70509784), std::abs(upper.Vm_pole_minus + 0.71638876))};
}

ProlateErrors prolate_errors(int order, int time_order, double dt) {
  Run run(prolates_in_field(), two_prolates(order), settings_of(order, time_order), dt);
  BOOST_TEST(run.advance_to(1.0) == 0);
  return prolate_errors(run.evolution());
}

}  // namespace

BOOST_AUTO_TEST_CASE(two_prolates_in_a_field_go_where_an_axisymmetric_code_takes_them) {
  const ProlateErrors errors = prolate_errors(14, 3, 0.1);
  BOOST_TEST(errors.place < 2e-5);
  BOOST_TEST(errors.energy < 1e-5);
  BOOST_TEST(errors.tension < 1e-3);
  BOOST_TEST(errors.potential < 1e-4);
}

BOOST_AUTO_TEST_CASE(half_the_step_halves_the_errors_of_first_order) {
  const ProlateErrors coarse = prolate_errors(10, 1, 0.1), fine = prolate_errors(10, 1, 0.05);
  for (const auto error : {&ProlateErrors::place, &ProlateErrors::tension, &ProlateErrors::potential}) {
    const double ratio = coarse.*error / (fine.*error);
    BOOST_TEST(ratio > 1.7);
    BOOST_TEST(ratio < 2.3);
  }
}

BOOST_AUTO_TEST_CASE(a_tolerance_serves_all_vesicles_and_their_snapshots) {
  const Model model = prolates_in_field();
  const std::vector<Matrix> shapes = two_prolates(14);
  const double tolerance = 1e-3, moment = 0.55;
  EvolutionSetup setup{model, settings_of(14, 4), find_symmetry(model, at_rest_charged(model, shapes)), {}};
  setup.control = {1.0, 1e-9, tolerance};
  Instruments instruments;
  Evolution evolution(setup, {StartMembrane{shapes[0]}, StartMembrane{shapes[1]}}, instruments);
  evolution.evaluate_start();
  std::vector<Evolution::DenseOutput> moments;
  while (evolution.state().time < 1.0) {
    evolution.step({{.times = {moment}}, 1.0});
    moments.insert(moments.end(), evolution.dense_output().begin(), evolution.dense_output().end());
  }
  const ProlateErrors errors = prolate_errors(evolution);
  BOOST_TEST(errors.place < tolerance);
  BOOST_TEST(errors.energy < 13.6 * tolerance);
  BOOST_TEST(errors.tension < 17.1 * tolerance);
  BOOST_TEST(errors.potential < tolerance);
  BOOST_TEST_REQUIRE(moments.size() == 1U);
  for (const std::size_t a : {0, 1}) {
    const VesicleDiagnostics& within = moments[0].evaluation.diagnostics.vesicles[a];
    BOOST_TEST(std::abs(within.area_drift) < 1e-8);
    BOOST_TEST(std::abs(within.volume_drift) < 1e-8);
  }
}

// Off axis, with different fluids and sizes, in a shear and a field.
BOOST_AUTO_TEST_CASE(every_vesicle_keeps_its_area_and_its_volume) {
  const int order = 8;
  Model model = field_model();
  model.flow = shear_flow(1.0);
  model = with_vesicles(model, 3);
  model.vesicles[1].viscosity_ratio = 3.0;
  model.vesicles[2].inside.conductivity = 4.0;
  const std::vector<Matrix> shapes{ellipsoid(order, {1.0, 1.2, 0.8}),
                                   translated(ellipsoid(order, {0.7, 0.5, 0.6}), {1.9, 0.1, 0.7}),
                                   translated(ellipsoid(order, {0.8, 1.0, 1.2}), {0.0, 2.4, -0.3})};
  Run run(model, shapes, settings_of(order, 2), 0.05);
  BOOST_TEST(run.advance_to(0.2) == 0);
  for (const std::size_t a : {0, 1, 2}) {
    BOOST_TEST(std::abs(run.vesicle(a).area_drift) < 2e-9);
    BOOST_TEST(std::abs(run.vesicle(a).volume_drift) < 2e-9);
  }
}

// Each multipole of two frozen spheres: A (m(k + 1) + 1) = m(1 − k) L − m k V, B = V + L + A, C_m dV/dt = −m k B − G_m
// V, with L from the field and the other sphere; σ_e = 1.
BOOST_AUTO_TEST_CASE(spheres_charge_in_time_as_their_multipoles_do) {
  constexpr double k = 4.0, capacitance = 0.8, conductance = 0.3, d = 2.5, end = 0.4;
  constexpr int kMultipoles = 40;
  Matrix others(kMultipoles, kMultipoles), system = Matrix::Identity(kMultipoles, kMultipoles);
  Vector of_field = Vector::Zero(kMultipoles), degree(kMultipoles), polarisation(kMultipoles), of_jump(kMultipoles);
  of_field[0] = -1.0;
  for (int m = 1; m <= kMultipoles; ++m) {
    degree[m - 1] = m;
    polarisation[m - 1] = polarisability(m, k);
    of_jump[m - 1] = k * m / (m * (k + 1.0) + 1.0);
    for (int n = 1; n <= kMultipoles; ++n) {
      const double choose = std::exp(std::lgamma(m + n + 1.0) - std::lgamma(m + 1.0) - std::lgamma(n + 1.0));
      others(m - 1, n - 1) = choose * std::pow(d, -(m + n + 1.0));
    }
  }
  system += polarisation.asDiagonal() * others;
  const Eigen::PartialPivLU<Matrix> inverse(system);
  const auto outer = [&](const Vector& v) -> Vector {
    return inverse.solve(polarisation.cwiseProduct(of_field) - of_jump.cwiseProduct(v));
  };
  const auto rate = [&](const Vector& v) -> Vector {
    const Vector a = outer(v), inner = v + of_field - others * a + a;
    return -(k * degree.cwiseProduct(inner) + conductance * v) / capacitance;
  };
  Vector v = Vector::Zero(kMultipoles);
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    const double h = end / kSteps;
    const Vector k1 = rate(v), k2 = rate(v + 0.5 * h * k1), k3 = rate(v + 0.5 * h * k2), k4 = rate(v + h * k3);
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  const Vector a = outer(v), local = of_field - others * a;
  double exact = 0.0;
  for (int n = 1; n < kMultipoles; ++n) exact += -4.0 * std::numbers::pi * (n + 1.0) * local[n] * a[n - 1];

  Model model = relaxation_model(0.1);
  set_electric(model, {{0.0, 0.0, 1.0}, k, 1.0, 1.0}, {capacitance, conductance});
  model.mobile = false;
  model = with_vesicles(model, 2);
  const std::vector<Matrix> shapes{translated(sphere(16), {0.0, 0.0, -d / 2.0}),
                                   translated(sphere(16), {0.0, 0.0, d / 2.0})};
  Run run(model, shapes, settings_of(16, 5), 0.05);
  run.advance_to(end);
  const Evaluation& evaluation = run.evolution().evaluation();
  const Membrane& lower = *evaluation.vesicles[0].membrane;
  // f_E is minus the force on a membrane.
  const double found =
      -lower.fine.synthesize(evaluation.fields.vesicles[0].force_electric).col(2).dot(lower.surface.quadrature);
  BOOST_TEST(std::abs(found / exact - 1.0) < 1e-5, found << " " << exact);
}

// The approach is so slow that the speed is nearly that of the start: 0.00726251441 at a gap of half a radius.
BOOST_AUTO_TEST_CASE(spheres_stay_spheres_while_they_approach_each_other) {
  Model model = relaxation_model(0.1);
  set_electric(model, {{0.0, 0.0, 1.0}, 10.0, 1.0, 1.0}, {1.0, 0.0});
  model = with_vesicles(model, 2);
  const std::vector<Matrix> shapes{translated(sphere(12), {0.0, 0.0, -1.25}), translated(sphere(12), {0.0, 0.0, 1.25})};
  Run run(model, shapes, settings_of(12, 2), 0.1, true);
  BOOST_TEST(run.advance_to(0.2) == 0);
  for (const std::size_t a : {0, 1}) {
    BOOST_TEST(std::abs(run.vesicle(a).extent_z - 2.0) < 1e-9);
    BOOST_TEST(std::abs(run.vesicle(a).extent_x - 2.0) < 1e-9);
  }
  const double moved = 1.25 - run.vesicle(1).centroid_z;
  BOOST_TEST(std::abs(moved / (0.2 * 0.00726251441) - 1.0) < 0.01);
}

BOOST_AUTO_TEST_SUITE_END()
