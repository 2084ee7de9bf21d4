#include "bie/physics/effects/undulations.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "bie/stepping/evolution.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr double kRigidity = 1.0;  // κ_c; the sphere of the same volume has radius 1

/// r ∝ 1 + s P₂(cos θ), with the volume of the unit sphere.
Matrix nearly_spherical(int order, double s) {
  const SphereTransform transform(order, make_grid(3 * order));
  const Vector radius =
      1.0 + s * std::sqrt(4.0 * std::numbers::pi / 5.0) * transform.synthesize(harmonic(order, 2, 0)).col(0).array();
  const Matrix position = transform.analyze(radius.asDiagonal() * grid_directions(transform.grid()));
  const double volume = enclosed_volume(make_surface(transform, position));
  return position / std::cbrt(volume / (4.0 * std::numbers::pi / 3.0));
}

/// Δ of a shape with the volume of the unit sphere.
double excess_area(const VesicleDiagnostics& d) {
  return d.area / std::pow(3.0 * d.volume / (4.0 * std::numbers::pi), 2.0 / 3.0) - 4.0 * std::numbers::pi;
}

/// s₂ from Δ = 8πs₂²/5.
double prolate_amplitude(const VesicleDiagnostics& d) {
  return std::sqrt(5.0 * excess_area(d) / (8.0 * std::numbers::pi));
}

/// A lipid membrane that has the area of this shape under this tension.
Model undulating(const Matrix& position, double tension) {
  Model model = relaxation_model(2.0 * kRigidity);
  const int order = order_of(position.rows());
  const double area = surface_area(make_surface({order, make_grid(2 * order)}, position));
  model.vesicles[0].undulations = with_rest_area({0.0411, kRigidity, 2.4e8, 0.0, tension}, area);
  return model;
}

/// Adds a constant field that charges the membrane at once; the stress that deforms it is ¾ εE² P₂.
Model in_field(Model model, double stress) {
  set_electric(model, {{0.0, 0.0, std::sqrt(stress / 0.75)}, 1.0, 1.0, 1.0}, {1e-2, 0.0});
  return model;
}

VesicleDiagnostics at_end(const Model& model, const Matrix& position, double end_time, double tolerance) {
  EvolutionSetup setup;
  setup.model = model;
  setup.settings.order = order_of(position.rows());
  setup.settings.time_order = 4;
  setup.symmetry = find_symmetry(model, at_rest(position));
  setup.control = {end_time, 1e-12 * end_time, tolerance};
  Instruments instruments;
  Evolution evolution(setup, {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  while (evolution.state().time < end_time) evolution.step({{}, end_time});
  return evolution.evaluation().diagnostics.vesicles[0];
}

/// s₂ that satisfies 4(6 + Σ) κ_c s₂ = stress and 1 + Δ/4π = A_0 (1 + α(Σ κ_c))/4π.
double stationary_amplitude(const Undulations& undulations, double stress) {
  const AreaLaw law(undulations);
  double low = 0.0, high = 0.5;
  for (int i = 0; i < 100; ++i) {
    const double s = 0.5 * (low + high);
    const double tension = (stress / (4.0 * s) - 6.0 * kRigidity);
    const double area = 4.0 * std::numbers::pi + 8.0 * std::numbers::pi * s * s / 5.0;
    (tension <= law.least_tension() || area > law.area(tension) ? high : low) = s;
  }
  return low;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(undulations)

// The theory neglects terms of second order in s.
BOOST_AUTO_TEST_CASE(stationary_shape_in_a_field_is_that_of_the_quasi_spherical_theory) {
  const Matrix position = nearly_spherical(8, 0.05);
  for (const double stress : {0.3, 3.0, 30.0}) {
    const Model model = in_field(undulating(position, 0.0), stress);
    const double expected = stationary_amplitude(*model.vesicles[0].undulations, stress);
    const double found = prolate_amplitude(at_end(model, position, 40.0, 1e-5));
    BOOST_TEST(std::abs(found / expected - 1.0) < std::max(0.02, 0.5 * expected),
               stress << ": " << found << ", theory " << expected);
  }
}

/// s₂ after a time from ds₂/dt = −(24/55)(6κ_c + σ) s₂, σ from the area, by classical Runge–Kutta steps.
double relaxed_amplitude(const AreaLaw& law, double s, double time) {
  const auto rate = [&](double amplitude) {
    const double tension = law.tension(4.0 * std::numbers::pi + 8.0 * std::numbers::pi * amplitude * amplitude / 5.0);
    return -24.0 / 55.0 * (6.0 * kRigidity + tension) * amplitude;
  };
  constexpr int n = 4000;
  const double dt = time / n;
  for (int i = 0; i < n; ++i) {
    const double k1 = rate(s), k2 = rate(s + 0.5 * dt * k1), k3 = rate(s + 0.5 * dt * k2), k4 = rate(s + dt * k3);
    s += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return s;
}

// At first tension relaxes the shape, then bending. The relative error of the theory in the change of s₂ is O(s).
BOOST_AUTO_TEST_CASE(relaxation_without_a_field_tends_to_the_quasi_spherical_theory) {
  for (const double time : {1e-4, 1e-3, 1e-2, 5e-2}) {
    std::vector<double> errors;
    for (const double s : {0.1, 0.05, 0.025}) {
      const Matrix position = nearly_spherical(8, s);
      const Model model = undulating(position, 200.0);
      const double start = prolate_amplitude(at_end(model, position, 0.0, 1e-5));
      const double expected = relaxed_amplitude(AreaLaw(*model.vesicles[0].undulations), start, time);
      const double found = prolate_amplitude(at_end(model, position, time, 1e-5));
      errors.push_back((start - found) / (start - expected) - 1.0);
    }
    BOOST_TEST(std::abs(errors[2]) < 0.03, time << ": " << errors[2]);
    // The error extrapolated to s = 0 vanishes.
    BOOST_TEST(std::abs(2.0 * errors[2] - errors[1]) < 0.004,
               time << ": " << errors[0] << " " << errors[1] << " " << errors[2]);
  }
}

// Without undulations an exact sphere could not change its shape.
BOOST_AUTO_TEST_CASE(exact_sphere_is_stretched_by_a_flow) {
  const Matrix position = sphere(8);
  Model model = undulating(position, 1.0);
  model.flow = axisymmetric_extension(1.0);
  // ds₂/dt = 60/55 of the rate of strain at the beginning (Seifert 1999).
  for (const double time : {1e-3, 1e-2}) {
    const VesicleDiagnostics d = at_end(model, position, time, 1e-6);
    const double s = (d.extent_z - d.extent_x) / (d.extent_x + 0.5 * d.extent_z);
    BOOST_TEST(std::abs(s / (60.0 / 55.0 * time) - 1.0) < 20.0 * time, s);
  }
}

BOOST_AUTO_TEST_CASE(stiffer_membrane_tends_to_one_of_constant_area) {
  const Matrix position = ellipsoid(12, {1.0, 1.1, 1.5});
  const double area = surface_area(make_surface({12, make_grid(24)}, position));
  const VesicleDiagnostics constant = at_end(shear_model(), position, 1.0, 1e-5);
  for (const double modulus : {1e3, 1e4}) {
    Model model = shear_model();
    model.vesicles[0].undulations = with_rest_area({0.0, 0.05, modulus, 0.0, 0.0}, area);
    const VesicleDiagnostics d = at_end(model, position, 1.0, 1e-5);
    BOOST_TEST(std::abs(d.area / constant.area - 1.0) < 20.0 / modulus);
    BOOST_TEST(std::abs(d.extent_x / constant.extent_x - 1.0) < 50.0 / modulus);
    BOOST_TEST(std::abs(d.tension_integral / constant.tension_integral - 1.0) < 200.0 / modulus);
  }
}

BOOST_AUTO_TEST_SUITE_END()
