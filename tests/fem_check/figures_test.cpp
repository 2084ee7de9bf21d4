#include <boost/test/unit_test.hpp>
#include <complex>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

/// Accuracy required of few unknowns on exact solutions, docs/weak_forms.md: errors relative in L2(γ), radiation
/// condition at R = 8 radii.
namespace {

constexpr long kMostUnknowns = 50000;

/// φ and ∇φ on one side.
struct SideTrace {
  double potential;
  Vector3 gradient;
};

/// A solution known on γ for a steady membrane in a uniform field.
struct ExactMembrane {
  Vector3 field = Vector3::Zero();  ///< E_∞
  double conductivity_in = 1.0, conductivity_out = 1.0, conductance = 0.0;
  std::function<SideTrace(const Vector3&x, const Vector3&n)> inside, outside;

  [[nodiscard]] double jump(const Vector3& x, const Vector3& n) const {
    return inside(x, n).potential - outside(x, n).potential;
  }
  [[nodiscard]] double charge(const Vector3& x, const Vector3& n) const {
    return n.dot(inside(x, n).gradient - outside(x, n).gradient);
  }
  [[nodiscard]] Vector3 force(const Vector3& x, const Vector3& n) const {
    const auto stress = [&](const Vector3& e) { return Vector3(e.dot(n) * e - 0.5 * e.squaredNorm() * n); };
    return stress(inside(x, n).gradient) - stress(outside(x, n).gradient);
  }
  /// The problem without its membrane law.
  [[nodiscard]] PotentialProblem problem() const {
    PotentialProblem result;
    result.field = field;
    result.conductivity_in = conductivity_in;
    result.conductivity_out = conductivity_out;
    result.current_jump = on_surface([*this](const Vector3& x, const Vector3& n) {
      return n.dot(conductivity_in * inside(x, n).gradient - conductivity_out * outside(x, n).gradient);
    });
    return result;
  }
  [[nodiscard]] PotentialProblem prescribed() const {
    PotentialProblem result = problem();
    result.membrane = PrescribedJump{on_surface([*this](const Vector3& x, const Vector3& n) { return jump(x, n); })};
    return result;
  }
  /// Membrane law with a source, so that it holds for any solution: a single step so long that the capacitance is
  /// negligible against the conductance; it ends at the exact jump.
  [[nodiscard]] PotentialProblem membrane_law() const {
    constexpr double kStep = 1e3;
    PotentialProblem result = problem();
    result.membrane = ChargingMembrane{
        1.0, conductance, kStep, 1, on_surface([*this](const Vector3& x, const Vector3& n) {
          return jump(x, n) + kStep * (conductance * jump(x, n) + conductivity_in * n.dot(inside(x, n).gradient));
        })};
    return result;
  }
};

struct Grading {
  int shell_layers;
  double shell_growth;
  int degree;
};
/// For degree 5, and for degree 6 with one shell layer fewer to save unknowns.
constexpr Grading kThreeLayers{3, 3.0, 5}, kTwoLayers{2, 6.0, 6};

Discretisation table_space(const vehd::meshes::FrozenShape& shape, const Grading& grading) {
  vehd::meshes::BlockMeshOptions options;
  options.cells_per_edge = 3;
  options.blend_layers = 1;
  options.shell_layers = grading.shell_layers;
  options.shell_growth = grading.shell_growth;
  options.outer_radius = 8.0 * shape.radius();
  return {std::make_shared<vehd::meshes::HexMesh>(vehd::meshes::make_block_mesh(shape, options)), grading.degree};
}

/// One row of the table: error bounds of V_m from the membrane law, and of q and f_E for prescribed V_m.
struct Row {
  double voltage, charge, force;
};
constexpr Row kSpheroids{3e-6, 1e-4, 3e-4};  ///< sphere, prolate
constexpr Row kBent{5e-5, 1e-3, 2e-3};       ///< shape (33), disc

void check_row(const Discretisation& space, const ExactMembrane& exact, const Row& row) {
  const SurfacePoints points = space.quadrature_points(9);
  const PotentialSolution law = solve_potential(space, exact.membrane_law());
  const PotentialTraces given = solve_potential(space, exact.prescribed()).on_surface(points);
  const Vector voltage = sampled(points, [&](const Vector3& x, const Vector3& n) { return exact.jump(x, n); });
  const Vector charge = sampled(points, [&](const Vector3& x, const Vector3& n) { return exact.charge(x, n); });
  const Vectors force = sampled_vectors(points, [&](const Vector3& x, const Vector3& n) { return exact.force(x, n); });
  const double voltage_error = relative_l2(points, law.on_surface(points).transmembrane_potential, voltage);
  const double charge_error = relative_l2(points, given.charge, charge);
  const double force_error = relative_l2(points, given.force, force);
  BOOST_TEST_MESSAGE(law.cost().n_unknowns << " unknowns: V_m " << voltage_error << ", q " << charge_error << ", f_E "
                                           << force_error);
  BOOST_TEST(law.cost().n_unknowns <= kMostUnknowns);
  BOOST_TEST(voltage_error < row.voltage);
  BOOST_TEST(charge_error < row.charge);
  BOOST_TEST(force_error < row.force);
}

/// A spheroid about z with the depolarisation factor L in the field E along z. Inside φ = −A z. Outside, the
/// disturbance is a z on γ with the slope −a n_z (1 − L)/L; the current is continuous.
ExactMembrane spheroid_in_field(double depolarisation) {
  constexpr double kField = 1.0;
  constexpr double kInside = 0.4;
  ExactMembrane exact;
  exact.field = kField * Vector3::UnitZ();
  exact.conductivity_in = 2.0;
  exact.conductance = 5.0;
  const double slope = (1.0 - depolarisation) / depolarisation;
  const double disturbance = (exact.conductivity_in * kInside / exact.conductivity_out - kField) / slope;
  exact.inside = [](const Vector3& x, const Vector3&) {
    return SideTrace{-kInside * x.z(), -kInside * Vector3::UnitZ()};
  };
  exact.outside = [=](const Vector3& x, const Vector3& n) {
    const double along = disturbance - kField;
    const Vector3 tangential = along * (Vector3::UnitZ() - n.z() * n);
    return SideTrace{along * x.z(), tangential - (kField + disturbance * slope) * n.z() * n};
  };
  return exact;
}

/// For any shape: inside, the field of a source outside γ; outside, a uniform field and `strength` Im 1/ρ, ρ² = (x −
/// ia)·(x − ia), the potential of a source at the imaginary point ia. Far away it is a dipole, and if the disc of
/// radius |a| about 0, normal to a, lies inside γ, it is singular only on the rim of that disc.
ExactMembrane sources_in_field(const Vector3& a, double strength) {
  ExactMembrane exact;
  exact.field = {0.3, 0.5, 1.0};
  exact.conductivity_in = 2.0;
  exact.conductance = 5.0;
  const PointSource inner{{1.5, -1.2, 2.5}, 10.0};
  exact.inside = [=](const Vector3& x, const Vector3&) { return SideTrace{inner.value(x), inner.gradient(x)}; };
  exact.outside = [field = exact.field, a, strength](const Vector3& x, const Vector3&) {
    const Eigen::Vector3cd from = x - std::complex<double>(0.0, 1.0) * a;
    const std::complex<double> distance = std::sqrt(from.x() * from.x() + from.y() * from.y() + from.z() * from.z());
    const Eigen::Vector3cd gradient = -from / (distance * distance * distance);
    return SideTrace{strength * (1.0 / distance).imag() - field.dot(x), strength * gradient.imag() - field};
  };
  return exact;
}

/// Steady membrane in a uniform field on a conducting sphere: checks V_m and q, which the law makes proportional to it.
void check_steady_sphere(const Discretisation& space) {
  const SurfacePoints points = space.quadrature_points(9);
  PotentialProblem problem;
  problem.field = {0.3, 0.5, 1.0};
  problem.conductivity_in = 2.0;
  problem.membrane = SteadyMembrane{5.0, 0.0};
  const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
  const double kappa = 2.0 * 2.0 / (2.0 + 2.0);
  const Vector voltage = 1.5 * kappa / (kappa + 5.0) * (points.position.transpose() * problem.field);
  BOOST_TEST(relative_l2(points, traces.transmembrane_potential, voltage) < kSpheroids.voltage);
  BOOST_TEST(relative_l2(points, traces.charge, (2.0 - 1.0) * 5.0 / 2.0 * voltage) < kSpheroids.voltage);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(figures, *boost::unit_test::label("slow"))

BOOST_AUTO_TEST_CASE(sphere) {
  const Discretisation space = table_space(unit_sphere(), kThreeLayers);
  check_row(space, spheroid_in_field(1.0 / 3.0), kSpheroids);
  check_steady_sphere(space);
}

BOOST_AUTO_TEST_CASE(prolate) {
  check_row(table_space(shapes::prolate(), kThreeLayers), spheroid_in_field(kDepolarisation), kSpheroids);
}

BOOST_AUTO_TEST_CASE(shape_33) {
  check_row(table_space(shapes::shape_33(), kTwoLayers), sources_in_field({0.0, 0.0, 0.8}, 1.0), kBent);
}

BOOST_AUTO_TEST_CASE(disc) {
  // 2|a|²/3π is the strength of the disturbance of a unit field by an insulating disc of radius |a| normal to it.
  const double a = 0.75;
  check_row(table_space(shapes::disc(), kTwoLayers),
            sources_in_field({0.0, 0.0, a}, 2.0 * a * a / (3.0 * std::numbers::pi)), kBent);
}

BOOST_AUTO_TEST_SUITE_END()
