#include "fem_check/bending.hpp"

#include <boost/test/unit_test.hpp>
#include <fstream>
#include <random>
#include <sstream>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(bending)

namespace {

constexpr double kModulus = 0.7;

/// Curvatures of the prolate with axes 1, 1, 2 and the Laplacian of H, in z/2 and g = b² + (a² − b²) (z/2)²: the
/// principal curvatures are ab/g^(3/2) and b/(a g^(1/2)).
struct ProlateCurvature {
  static constexpr double a = 1.0, b = 2.0, e = a * a - b * b;
  double mean, gauss, laplacian;

  explicit ProlateCurvature(double height) {
    const double z = height / b;
    const double g = b * b + e * z * z;
    mean = -0.5 * (a * b * std::pow(g, -1.5) + b / a * std::pow(g, -0.5));
    gauss = b * b / (g * g);
    // Δ_γ H = g^(−1/2) d/dz ((1 − z²) g^(−1/2) dH/dz)
    const double slope = 1.5 * a * b * std::pow(g, -3.0) + 0.5 * b / a * std::pow(g, -2.0);
    const double bend = 2.0 * e * z * (-4.5 * a * b * std::pow(g, -4.0) - b / a * std::pow(g, -3.0));
    laplacian = e * std::pow(g, -0.5) * ((1.0 - 3.0 * z * z) * slope + (z - z * z * z) * bend);
  }

  /// Normal component of the force of κ_B ∫ (H − c)² dA.
  [[nodiscard]] double force(double c) const {
    return -kModulus * (laplacian + 2.0 * mean * (mean * mean - gauss)) - 2.0 * kModulus * c * (gauss - c * mean);
  }
};

/// Displacement x^i y^j z^k e_d of degree up to 2.
struct Displacement {
  int i, j, k, direction;
  Vector3 operator()(const Vector3& x) const {
    return std::pow(x.x(), i) * std::pow(x.y(), j) * std::pow(x.z(), k) * Vector3::Unit(direction);
  }
};

std::vector<Displacement> displacements() {
  std::vector<Displacement> result;
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; i + j <= 2; ++j) {
      for (int k = 0; i + j + k <= 2; ++k) {
        for (int d = 0; d < 3; ++d) result.push_back({i, j, k, d});
      }
    }
  }
  return result;
}

/// −δE_b of the elements for the displacements.
Vector work_of_elements(const meshes::VolumeMesh& mesh, int degree, const BendingEnergy& energy) {
  const BendingElements elements(mesh, degree);
  const Vectors& x = elements.surface().positions();
  const Vectors functional = elements.force_functional(energy, x);
  const std::vector<Displacement> all = displacements();
  Vector result = Vector::Zero(static_cast<Eigen::Index>(all.size()));
  for (std::size_t w = 0; w < all.size(); ++w) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) result[w] += functional.col(i).dot(all[w](x.col(i)));
  }
  return result;
}

/// ∫ f n·w dA on the prolate.
Vector work_on_prolate(double c) {
  const Discretisation space = discretise(shapes::prolate(), {.cells_per_edge = 4, .degree = 6});
  const SurfacePoints points = space.quadrature_points(10);
  const std::vector<Displacement> all = displacements();
  Vector result = Vector::Zero(static_cast<Eigen::Index>(all.size()));
  for (Eigen::Index q = 0; q < points.size(); ++q) {
    const Vector3 x = points.position.col(q);
    const Vector3 n = Vector3(x.x(), x.y(), x.z() / 4.0).normalized();
    const double force = points.weight[q] * ProlateCurvature(x.z()).force(c);
    for (std::size_t w = 0; w < all.size(); ++w) result[w] += force * n.dot(all[w](x));
  }
  return result;
}

/// ∫ f_b·w dA of tests/data/bending_shape_33.csv at κ_B = 1; rows are monomial, component, value.
Vector stored_work() {
  std::ifstream file("tests/data/bending_shape_33.csv");
  BOOST_REQUIRE(file);
  std::vector<double> values;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'x') continue;
    values.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  }
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

BOOST_AUTO_TEST_CASE(functional_is_minus_the_derivative_of_the_discrete_energy) {
  const meshes::HexMesh mesh = membrane_mesh(shapes::prolate(), 1);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const int degree : {2, 4}) {
    const BendingElements elements(mesh, degree);
    Vectors x = elements.surface().positions();
    // Perturbed away from the shape, so that nothing vanishes by symmetry.
    for (double& value : x.reshaped()) value += 0.02 * normal(random);
    for (const double c : {0.0, -0.6}) {
      const BendingEnergy energy{kModulus, c};
      Vectors w(3, x.cols());
      for (double& value : w.reshaped()) value = normal(random);
      const double step = 1e-5;
      const double slope =
          (elements.energy(energy, x + step * w) - elements.energy(energy, x - step * w)) / (2.0 * step);
      const double work = elements.force_functional(energy, x).cwiseProduct(w).sum();
      BOOST_TEST(std::abs(work + slope) < 1e-6 * std::abs(slope),
                 "degree " << degree << ", c = " << c << ": " << work << " and " << -slope);
    }
  }
}

BOOST_AUTO_TEST_CASE(sphere_has_the_energy_and_the_force_of_the_formula) {
  // E = 4π κ_B (1 + cR)²: the force vanishes without spontaneous curvature and is radial with it.
  const double radius = 1.2;
  const Vector3 centre(0.4, -1.3, 0.7);
  const BendingElements elements(membrane_mesh(shapes::off_centre_sphere(), 2), 7);
  const Vectors& x = elements.surface().positions();
  const Vectors outwards = (x.colwise() - centre) / radius;
  for (const double c : {0.0, 0.5}) {
    const BendingEnergy energy{kModulus, c};
    const double exact = 4.0 * std::numbers::pi * kModulus * std::pow(1.0 + c * radius, 2);
    BOOST_TEST(std::abs(elements.energy(energy, x) - exact) < 1e-8 * exact);
    const Vectors functional = elements.force_functional(energy, x);
    const double slope = 8.0 * std::numbers::pi * kModulus * c * (1.0 + c * radius);
    BOOST_TEST(std::abs(functional.cwiseProduct(outwards).sum() + slope) < 1e-7 * kModulus);
    BOOST_TEST(functional.rowwise().sum().norm() < 1e-7 * kModulus);
  }
}

BOOST_AUTO_TEST_CASE(prolate_has_the_force_of_the_formula_as_a_functional_and_as_a_field) {
  const auto mesh = std::make_shared<const meshes::HexMesh>(membrane_mesh(shapes::prolate(), 3));
  const Discretisation space(mesh, 6);
  const SurfacePoints points = space.quadrature_points(9);
  for (const double c : {0.0, -0.4}) {
    const BendingEnergy energy{kModulus, c};
    const Vector exact = work_on_prolate(c);
    BOOST_TEST((work_of_elements(*mesh, 8, energy) - exact).norm() < 1e-6 * exact.norm());
    const Vectors force = sampled_vectors(
        points, [&](const Vector3& x, const Vector3& n) { return Vector3(ProlateCurvature(x.z()).force(c) * n); });
    BOOST_TEST(relative_l2(points, bending_force(space, energy, 8)(points), force) < 1e-2);
    const double error = relative_l2(points, BendingForce(space, energy, 12).field(9)(points), force);
    BOOST_TEST_MESSAGE("field " << error);
    BOOST_TEST(error < 1e-3);
  }
}

BOOST_AUTO_TEST_CASE(functional_converges_fast_with_the_mesh) {
  const Vector exact = work_on_prolate(0.3);
  std::vector<double> errors;
  for (const int n : {2, 4, 8}) {
    errors.push_back((work_of_elements(membrane_mesh(shapes::prolate(), n), 3, {kModulus, 0.3}) - exact).norm() /
                     exact.norm());
  }
  BOOST_TEST_MESSAGE("errors " << errors[0] << " " << errors[1] << " " << errors[2]);
  BOOST_TEST(observed_order(errors[0], errors[1], 2.0) > 3.5);
  BOOST_TEST(observed_order(errors[1], errors[2], 2.0) > 3.5);
}

BOOST_AUTO_TEST_CASE(shape_33_has_the_work_that_the_boundary_integrals_find) {
  const Vector exact = stored_work();
  const Vector found = work_of_elements(membrane_mesh(shapes::shape_33(), 3), 9, {1.0, 0.0});
  BOOST_REQUIRE(found.size() == exact.size());
  BOOST_TEST_MESSAGE("difference " << (found - exact).norm() / exact.norm());
  BOOST_TEST((found - exact).norm() < 1e-4 * exact.norm());
}

BOOST_AUTO_TEST_CASE(degrees_that_do_not_fit_are_refused) {
  BOOST_CHECK_THROW(BendingElements(membrane_mesh(unit_sphere(), 1), 1), std::invalid_argument);
  const Discretisation space = discretise(unit_sphere(), {.degree = 4});
  BOOST_CHECK_THROW(bending_force(space, {1.0, 0.0}, 3), std::invalid_argument);
  BOOST_CHECK_THROW(static_cast<void>(BendingForce(space, BendingEnergy{1.0, 0.0}, 5).field(6)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
