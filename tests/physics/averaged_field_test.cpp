#include "bie/physics/averaged_field.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/support/complex_columns.hpp"
#include "tests/support/electric.hpp"
#include "tests/support/several.hpp"

BOOST_AUTO_TEST_SUITE(averaged_field)

using namespace vehd;
using namespace vehd::testing;

namespace {

using Complex = std::complex<double>;

constexpr double kTight = 1e-13;
constexpr double kVacuum = 8.8541878128e-12;

/// A giant vesicle in SI units: a = 10 µm, C_m = 1 µF/cm², 80 ε₀ outside, σ_e = 1 mS/m, 0.5 kV/cm.
ElectricParameters giant(double conductivity_ratio, double permittivity_ratio, double frequency) {
  ElectricParameters electric{{0.0, 0.0, 5e4}, conductivity_ratio * 1e-3, 1e-3, 80.0 * kVacuum, permittivity_ratio};
  electric.displacement_current = true;
  electric.averaged_frequency = frequency;
  return electric;
}
constexpr double kRadius = 1e-5;
constexpr ChargingParameters kMembrane{0.01, 0.0};

struct GiantSphere {
  Space space{6};
  Membrane membrane = make_membrane(space, sphere(6, kRadius), kLaplaceLayers);
  Vector cosine = membrane.surface.position.col(2) / kRadius;

  [[nodiscard]] AveragedField solve(const ElectricParameters& electric,
                                    const ChargingParameters& charging = kMembrane) const {
    AveragedFields solved = solve_averaged_fields({{{electric, membrane}, charging}}, {}, kTight);
    require_converged(solved.report, "amplitudes");
    return std::move(solved.membranes.front());
  }
  /// Grid values of z cos θ.
  [[nodiscard]] Matrix dipole(Complex z) const {
    Matrix values(cosine.size(), 2);
    values << z.real() * cosine, z.imag() * cosine;
    return values;
  }
  /// Grid values of the unit vector e_θ.
  [[nodiscard]] Matrix along_meridian() const {
    const Matrix r = membrane.surface.position / kRadius;
    const Vector sine = (1.0 - cosine.array().square()).sqrt();
    Matrix e(r.rows(), 3);
    e << cosine.cwiseQuotient(sine).asDiagonal() * r.leftCols(2), -sine;
    return e;
  }
  /// Drive Q of a force: 6/E² times the P₂ part of normal plus twice that of tangential stress, outside minus inside.
  [[nodiscard]] double drive(const Matrix& force, double field) const {
    const Vector weights = membrane.surface.quadrature / membrane.surface.quadrature.sum();
    const Vector legendre = 1.5 * cosine.array().square() - 0.5;
    const Vector slope = -3.0 * cosine.array() * (1.0 - cosine.array().square()).sqrt();
    const Vector normal = row_dot(force, membrane.surface.normal);
    const Vector tangential = row_dot(force, along_meridian());
    const double of_normal = 5.0 * weights.dot(normal.cwiseProduct(legendre));
    const double of_tangential = 5.0 / 6.0 * weights.dot(tangential.cwiseProduct(slope));
    return -6.0 * (of_normal + 2.0 * of_tangential) / (field * field);
  }
};

/// Root of f between a and b, by bisection on a logarithmic scale.
template <typename Function>
double root(double a, double b, const Function& f) {
  const bool rising = f(b) > 0.0;
  for (int i = 0; i < 24; ++i) {
    const double middle = std::sqrt(a * b);
    ((f(middle) > 0.0) == rising ? b : a) = middle;
  }
  return std::sqrt(a * b);
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(sphere_has_the_closed_form_from_dc_to_radio_frequency, GiantSphere) {
  const Matrix e_theta = along_meridian();
  const Vector sine = (1.0 - cosine.array().square()).sqrt();
  for (const double conductivity_ratio : {0.1, 0.5, 1.0, 2.0, 10.0}) {
    for (const double permittivity_ratio : {0.5, 1.0, 2.0}) {
      for (const double frequency : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
        const ElectricParameters electric = giant(conductivity_ratio, permittivity_ratio, frequency);
        const ChargingParameters leaky{0.01, 20.0};
        const double field = electric.field.z(), omega = 2.0 * std::numbers::pi * frequency;
        const Complex k_in(electric.conductivity_in, omega * permittivity_ratio * electric.permittivity);
        const Complex k_out(electric.conductivity_out, omega * electric.permittivity);
        const Complex y(leaky.conductance, omega * leaky.capacitance);
        const Complex ratio = k_in / k_out, s = k_out / (kRadius * y);
        const Complex inside = 3.0 / (2.0 + ratio + 2.0 * ratio * s), outside = ratio * inside;
        const Complex potential =
            3.0 * k_in * k_out * kRadius / ((2.0 * k_out + k_in) * kRadius * y + 2.0 * k_in * k_out);
        const AveragedField solved = solve(electric, leaky);
        BOOST_TEST_CONTEXT("R = " << conductivity_ratio << ", S = " << permittivity_ratio << ", " << frequency) {
          const Matrix v = membrane.fine.synthesize(solved.potential);
          BOOST_TEST(max_difference(v, dipole(potential * field)) < 1e-10 * std::abs(potential) * field);
          const Matrix q = membrane.fine.synthesize(solved.charge);
          BOOST_TEST(max_difference(q, dipole((outside - inside) * field)) < 1e-10 * field);
          // Traction ½ε Re(E* E_n) − ¼ε|E|² n with E_n = N cos θ, E_θ = −T sin θ.
          const auto traction = [&](double permittivity, Complex n, Complex t) {
            const Vector normal =
                0.25 * permittivity *
                (std::norm(n) * cosine.array().square() - std::norm(t) * sine.array().square()).matrix();
            const Vector tangential = -0.5 * permittivity * std::real(std::conj(t) * n) * cosine.cwiseProduct(sine);
            return Matrix(normal.asDiagonal() * membrane.surface.normal + tangential.asDiagonal() * e_theta);
          };
          const double unit = electric.permittivity * field * field;
          const Matrix exact =
              unit * (traction(permittivity_ratio, inside, inside) - traction(1.0, outside, 1.5 - 0.5 * outside));
          BOOST_TEST(max_difference(solved.force, exact) < 1e-10 * unit);
          const SphereInAcField closed = sphere_in_ac_field(electric, leaky, kRadius);
          BOOST_TEST(std::abs(closed.potential - potential) < 1e-13 * std::abs(potential));
          BOOST_TEST(std::abs(closed.drive - drive(solved.force, field)) < 1e-9 * electric.permittivity);
        }
      }
    }
  }
}

// The drive of a sphere changes sign at the roots of |1 + κ(1 + s)|² = 4S.
BOOST_FIXTURE_TEST_CASE(a_sphere_is_driven_the_other_way_from_two_frequencies_on, GiantSphere) {
  struct Published {
    double conductivity_ratio, first, second;
  };
  for (const Published& published : {Published{0.1, 95.5, 2.222e6}, Published{0.5, 604.6, 1.755e6}}) {
    const auto of_solve = [&](double frequency) {
      const ElectricParameters electric = giant(published.conductivity_ratio, 1.0, frequency);
      return drive(solve(electric).force, electric.field.z());
    };
    const auto closed = [&](double frequency) {
      return sphere_in_ac_field(giant(published.conductivity_ratio, 1.0, frequency), kMembrane, kRadius).drive;
    };
    const double f_c = root(10.0, 1e4, of_solve), f_2 = root(1e5, 1e7, of_solve);
    BOOST_TEST(std::abs(f_c / root(10.0, 1e4, closed) - 1.0) < 1e-6);
    BOOST_TEST(std::abs(f_2 / root(1e5, 1e7, closed) - 1.0) < 1e-6);
    // Half a unit of the last published digit.
    BOOST_TEST(std::abs(f_c - published.first) < 0.051, f_c);
    BOOST_TEST(std::abs(f_2 - published.second) < 0.51e3, f_2);
  }
}

// V = Re z with field E at the start of a period; V = −Im z with zero field a quarter period later.
BOOST_AUTO_TEST_CASE(amplitude_is_the_steady_alternation_of_the_equations_in_time) {
  const Space space(10);
  const Membrane membrane = make_membrane(space, asymmetric_shape(10), kLaplaceLayers);
  ElectricParameters electric{{0.4, -0.3, 1.1}, 0.6, 1.7, 1.3, 0.7};
  electric.averaged_frequency = 0.35;
  const ChargingParameters charging{0.8, 0.2};
  const double omega = 2.0 * std::numbers::pi * *electric.averaged_frequency;
  const AveragedFields solved = solve_averaged_fields({{{electric, membrane}, charging}}, {}, kTight);
  const AveragedField& field = solved.membranes.front();
  Matrix force = Matrix::Zero(field.force.rows(), 3);
  for (const Index part : {0, 1}) {
    ElectricParameters now = electric;
    if (part == 1) now.field.setZero();
    const Vector potential = (part == 0 ? 1.0 : -1.0) * field.potential.col(part);
    const ElectricTraces traces = solve_traces(now, membrane, potential);
    const Vector rate =
        -(membrane.fine.analyze(electric.conductivity_in * traces.flux_in) + charging.conductance * potential) /
        charging.capacitance;
    const Vector expected = -omega * field.potential.col(1 - part);
    BOOST_TEST(max_difference(rate, expected) < 2e-3 * expected.norm(), max_difference(rate, expected));
    const Vector charge = (part == 0 ? 1.0 : -1.0) * field.charge.col(part);
    BOOST_TEST(max_difference(membrane.fine.analyze(traces.charge), charge) < 1e-3 * charge.norm());
    force += 0.5 * electric_force(now.permittivity, membrane, traces, now.permittivity_ratio);
  }
  BOOST_TEST(max_difference(field.force, force) < 1e-2 * force.norm() / std::sqrt(force.rows()));
}

BOOST_AUTO_TEST_CASE(amplitudes_on_a_shape_without_symmetry_converge_spectrally) {
  ElectricParameters electric{{0.4, -0.3, 1.1}, 0.6, 1.7, 1.3, 0.7};
  electric.displacement_current = true;
  electric.averaged_frequency = 0.2;
  const auto solved = [&](int order) {
    const Space space(order);
    const Membrane membrane = make_membrane(space, asymmetric_shape(order), kLaplaceLayers);
    return Matrix(solve_averaged_fields({{{electric, membrane}, {0.8, 0.2}}}, {}, kTight)
                      .membranes.front()
                      .potential.topRows(n_coefficients(6)));
  };
  const Matrix reference = solved(18);
  const double coarse = max_difference(solved(8), reference), fine = max_difference(solved(12), reference);
  BOOST_TEST(coarse < 1e-2 * reference.norm(), coarse);
  BOOST_TEST(fine < 0.2 * coarse, fine << " after " << coarse);
}

BOOST_AUTO_TEST_CASE(insulating_fluid_takes_the_field_off_the_membrane) {
  const Space space(6);
  const Membrane membrane = make_membrane(space, sphere(6), kLaplaceLayers);
  ElectricParameters electric{{0.0, 0.0, 1.0}, 0.0, 1.0, 1.0};
  electric.averaged_frequency = 1.0;
  const AveragedFields solved = solve_averaged_fields({{{electric, membrane}, {1.0, 0.1}}}, {}, kTight);
  BOOST_TEST(solved.membranes.front().potential.cwiseAbs().maxCoeff() < 1e-12);
  // The field inside is 3/2 E; outside it has no normal component.
  const Matrix q = space.fine.synthesize(solved.membranes.front().charge);
  BOOST_TEST(max_difference(q.col(0), -1.5 * membrane.surface.position.col(2)) < 1e-11);
}

BOOST_AUTO_TEST_CASE(two_membranes_alternate_as_their_equations_in_time_do) {
  const SeveralMembranes two(8, {sphere(8), translated(ellipsoid(8, {0.8, 0.7, 0.9}), {0.5, 0.3, 2.6})}, kLaplaceLayers,
                             kLaplacePairs);
  ElectricParameters electric{{0.4, -0.3, 1.1}, 0.6, 1.7, 1.3, 0.7};
  electric.averaged_frequency = 0.35;
  const ChargingParameters charging{0.8, 0.2};
  const double omega = 2.0 * std::numbers::pi * *electric.averaged_frequency;
  const AveragedFields solved =
      solve_averaged_fields(two.charging(electric, {charging, charging}), two.interaction, kTight);
  require_converged(solved.report, "amplitudes");
  for (const Index part : {0, 1}) {
    ElectricParameters now = electric;
    if (part == 1) now.field.setZero();
    const double sign = part == 0 ? 1.0 : -1.0;
    const auto membranes = two.in_field(now);
    std::vector<Vector> potentials;
    for (const AveragedField& field : solved.membranes) potentials.emplace_back(sign * field.potential.col(part));
    const std::vector<SecondKindSolution> densities =
        solve_second_kind(membranes, two.interaction, weighted_fluxes(membranes, two.interaction, potentials), kTight);
    const std::vector<Vector> others = potentials_of_others(membranes, two.interaction, potentials, densities);
    for (std::size_t a = 0; a < 2; ++a) {
      const Membrane& membrane = two.membranes[a];
      const ElectricTraces traces = electric_traces(now, membrane, potentials[a], densities[a], others[a]);
      const Vector rate =
          -(membrane.fine.analyze(now.conductivity_in * traces.flux_in) + charging.conductance * potentials[a]) /
          charging.capacitance;
      const Vector expected = -omega * solved.membranes[a].potential.col(1 - part);
      BOOST_TEST(max_difference(rate, expected) < 1e-4 * expected.norm(), max_difference(rate, expected));
    }
  }
}

BOOST_AUTO_TEST_CASE(membranes_far_apart_do_not_interact) {
  const SeveralMembranes two(6, {sphere(6), translated(sphere(6), {0.0, 0.0, 1e4})}, kLaplaceLayers, kLaplacePairs);
  ElectricParameters electric{{0.0, 0.0, 1.0}, 0.5, 1.0, 0.3, 2.0};
  electric.displacement_current = true;
  electric.averaged_frequency = 0.5;
  const ChargingParameters charging{0.8, 0.2};
  const AveragedFields solved =
      solve_averaged_fields(two.charging(electric, {charging, charging}), two.interaction, kTight);
  const AveragedFields alone = solve_averaged_fields({{{electric, two.membranes[0]}, charging}}, {}, kTight);
  for (const AveragedField& field : solved.membranes) {
    BOOST_TEST(max_difference(field.potential, alone.membranes[0].potential) < 1e-11);
    BOOST_TEST(max_difference(field.force, alone.membranes[0].force) < 1e-10);
  }
}

BOOST_AUTO_TEST_SUITE_END()
