#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/physics/membrane_charging.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "tests/stepping/varying_membrane.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(varying_membrane_charging)

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr double kField = 0.7, kInside = 1.0, kOutside = 2.0;

/// A frozen sphere with an alternating pump.
Model pumped_model() {
  Model model;
  set_electric(model, {{0.0, 0.0, kField}, kInside, kOutside, 1.0}, {0.8, 0.5});
  model.mobile = false;
  model.vesicles[0].has_varying_properties = true;
  model.vesicles[0].pump = Waveform::alternating(1.0, 0.4, 0.3);
  return model;
}

/// V_m over a sphere of radius 1 by harmonics of the potentials on both sides: only the transform is shared with the
/// solver.
class PumpedSphere {
 public:
  PumpedSphere(int order, MembraneMaterial material)
      : transform_(order, make_grid(2 * order)), order_(order), material_(std::move(material)) {}

  /// Current onto the inner face, −σ_i ∂φ_i/∂n: V_l = A_l − B_l + E δ_l1, with equal currents on both sides.
  [[nodiscard]] Vector current(const Vector& potential) const {
    Vector result = potential;
    result[coefficient_index(1, 0)] -= 1.5 * kField * std::sqrt(4.0 * std::numbers::pi / 3.0);
    for (int n = 0; n <= order_; ++n) {
      const double factor = kInside * kOutside * n * (n + 1.0) / (kInside * n + kOutside * (n + 1.0));
      result.segment(coefficient_index(n, -n), 2 * n + 1) *= -factor;
    }
    return result;
  }

  [[nodiscard]] Vector rate(const Vector& potential, double pump) const {
    const Vector leak =
        on_grid(material_.conductance).cwiseProduct(on_grid(potential)) + pump * on_grid(material_.pump_current);
    return transform_.analyze(
        Vector((on_grid(current(potential)) - leak).cwiseQuotient(on_grid(material_.capacitance))));
  }

  /// Steady V_m, at which the rate is zero: one linear system.
  [[nodiscard]] Vector steady(double pump) const {
    const Index n = n_coefficients(order_);
    const auto unweighted = [&](const Vector& potential) -> Vector {
      const Vector leak =
          on_grid(material_.conductance).cwiseProduct(on_grid(potential)) + pump * on_grid(material_.pump_current);
      return current(potential) - Vector(transform_.analyze(leak));
    };
    const Vector at_zero = unweighted(Vector::Zero(n));
    Matrix map(n, n);
    for (Index j = 0; j < n; ++j) map.col(j) = unweighted(Vector::Unit(n, j)) - at_zero;
    return map.partialPivLu().solve(-at_zero);
  }

 private:
  [[nodiscard]] Vector on_grid(const Vector& coefficients) const {
    return transform_.synthesize(resize_order(coefficients, order_));
  }

  SphereTransform transform_;
  int order_;
  MembraneMaterial material_;
};

Vector after_runge_kutta(const PumpedSphere& exact, const Waveform& pump, Vector v, double end, int n_steps) {
  const double dt = end / n_steps;
  for (int i = 0; i < n_steps; ++i) {
    const double t = i * dt;
    const Vector a = exact.rate(v, pump.at(t)), b = exact.rate(v + 0.5 * dt * a, pump.at(t + 0.5 * dt)),
                 c = exact.rate(v + 0.5 * dt * b, pump.at(t + 0.5 * dt)), d = exact.rate(v + dt * c, pump.at(t + dt));
    v += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return v;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_sphere_is_followed_at_every_order) {
  constexpr int kOrder = 4;
  constexpr double kEnd = 0.8;
  const Model model = pumped_model();
  const MembraneMaterial material = electric_material(kOrder);
  const auto reached = [&](int order, int n_steps) -> Vector {
    NumericalSettings settings = solved_to_rounding(kOrder);
    settings.time_order = order;
    const Discretisation discretisation(settings, {});
    const double dt = kEnd / n_steps;
    const State state = varying_start(model, discretisation, sphere(kOrder), dt, material);
    return run(model, discretisation, state, dt, n_steps).vesicles[0].transmembrane_potential;
  };
  const Vector exact = after_runge_kutta(PumpedSphere(kOrder, material), *model.vesicles[0].pump,
                                         Vector::Zero(n_coefficients(kOrder)), kEnd, 800);
  // A comparison with the integrator would include the layers' own error of this degree, 5e-10.
  const Vector limit = reached(5, 64);
  BOOST_TEST(max_difference(limit, exact) < 2e-9);
  for (int order = 1; order <= 5; ++order) {
    constexpr int n_steps = 16;
    const double coarse = max_difference(reached(order, n_steps), limit);
    const double fine = max_difference(reached(order, 2 * n_steps), limit);
    BOOST_TEST_MESSAGE(order << ": " << coarse << " " << fine);
    BOOST_TEST(std::log2(coarse / fine) > order - 0.6, order << ": " << coarse << " " << fine);
  }
}

BOOST_AUTO_TEST_CASE(the_steady_potential_is_that_of_a_dense_solve) {
  constexpr int kOrder = 14;
  const Model model = pumped_model();
  const Discretisation discretisation(solved_to_rounding(kOrder), {});
  const State state = varying_start(model, discretisation, sphere(kOrder), 1.0, electric_material(kOrder), true);
  const Vector exact = PumpedSphere(kOrder, electric_material(kOrder)).steady(1.0);
  BOOST_TEST(max_difference(state.vesicles[0].transmembrane_potential, exact) < 1e-9);
  // A solution of another degree shows the truncation error.
  const Vector finer = PumpedSphere(18, electric_material(kOrder)).steady(1.0);
  BOOST_TEST(max_difference(resize_order(finer, kOrder), exact) < 1e-8);
}

BOOST_AUTO_TEST_CASE(no_net_current_crosses_a_membrane_at_rest) {
  constexpr int kOrder = 12;
  const Model model = pumped_model();
  const Discretisation discretisation(solved_to_rounding(kOrder), {});
  const MembraneMaterial coefficients = electric_material(kOrder);
  const State state = varying_start(model, discretisation, asymmetric_shape(kOrder), 1.0, coefficients, true);
  Instruments instruments;
  const Membrane membrane = membrane_at(discretisation.vesicle(0), asymmetric_shape(kOrder), {}, 1.0, instruments);
  const MembraneMaterial material = material_at(discretisation.vesicle(0), coefficients);
  const Vector v = membrane.fine.synthesize(state.vesicles[0].transmembrane_potential);
  const Vector current = material.conductance.cwiseProduct(v) + material.pump_current;
  const Vector& area = membrane.surface.quadrature;
  BOOST_TEST(std::abs(current.dot(area)) < 1e-10 * current.cwiseAbs().dot(area));
  BOOST_TEST(current.cwiseAbs().dot(area) > 0.1);
}

BOOST_AUTO_TEST_CASE(a_uniform_membrane_moves_as_it_does_without_variation) {
  for (const int time_order : {1, 3}) {
    const UniformAndVarying after(field_model(), time_order, prolate(8), 4);
    BOOST_TEST(largest_difference(after.varying, after.uniform) < 1e-8, time_order);
    BOOST_TEST(max_difference(after.varying.vesicles[0].material.conductance, after.material.conductance) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(several_vesicles_have_each_their_own) {
  constexpr int kOrder = 6;
  Model model = with_vesicles(field_model(), 2);
  model.mobile = false;
  const std::vector<Matrix> positions{prolate(kOrder), translated(prolate(kOrder), {3.0, 0.5, 0.0})};
  const NumericalSettings settings = solved_to_rounding(kOrder);
  const Discretisation discretisation = testing::discretisation_of(positions, settings);
  const auto started = [&](const std::vector<MembraneMaterial>& materials) {
    return varying_start(model, discretisation, positions, 0.1, materials);
  };
  const auto potentials = [&](const std::vector<MembraneMaterial>& materials) {
    return run(model, discretisation, started(materials), 0.1, 3);
  };
  const MembraneMaterial same = same_everywhere(model.vesicles[0], kOrder, 0.0);
  const State uniform = potentials({{}, {}}), varying = potentials({same, {}});
  for (std::size_t a = 0; a < 2; ++a) {
    BOOST_TEST(max_difference(varying.vesicles[a].transmembrane_potential,
                              uniform.vesicles[a].transmembrane_potential) < 1e-10);
  }
  // The pump changes the V_m of its own vesicle and, through its field, weakly that of the neighbour.
  MembraneMaterial pumping = same;
  pumping.pump_current = harmonic(kOrder, 1, 0);
  model.vesicles[0].pump.emplace();
  const State pumped = potentials({pumping, {}});
  const double own =
      max_difference(pumped.vesicles[0].transmembrane_potential, uniform.vesicles[0].transmembrane_potential);
  const double of_neighbour =
      max_difference(pumped.vesicles[1].transmembrane_potential, uniform.vesicles[1].transmembrane_potential);
  BOOST_TEST(own > 0.05);
  BOOST_TEST((of_neighbour > 1e-5 && of_neighbour < 0.2 * own), of_neighbour << " " << own);
}

BOOST_AUTO_TEST_CASE(spatially_varying_properties_move_with_the_membrane) {
  // A shear flow turns the membrane by half a radian.
  constexpr int kOrder = 10;
  const Model model = shear_model();
  const Matrix position = ellipsoid(kOrder, {1.0, 1.0, 1.2});
  MembraneMaterial material = same_everywhere(model.vesicles[0], kOrder, 0.0);
  material.bending_modulus += 0.02 * harmonic(kOrder, 2, 1);
  const Discretisation discretisation(solved_to_rounding(kOrder), {});
  const State first = varying_start(model, discretisation, position, 0.05, material);
  const State last = run(model, discretisation, first, 0.05, 10);
  const auto range = [&](const State& state) {
    const Vector values =
        discretisation.vesicle(0).fine_transform().synthesize(state.vesicles[0].material.bending_modulus);
    return std::array{values.minCoeff(), values.maxCoeff()};
  };
  BOOST_TEST(max_difference(last.vesicles[0].material.bending_modulus, material.bending_modulus) > 0.003);
  BOOST_TEST(std::abs(range(last)[0] - range(first)[0]) < 1e-4);
  BOOST_TEST(std::abs(range(last)[1] - range(first)[1]) < 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()
