#include <boost/test/unit_test.hpp>

#include "bie/geometry/surface.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kOrder = 24;

/// The asymmetric shape with its coefficients.
struct TestSurface {
  SphereTransform transform{kOrder, make_grid(2 * kOrder)};
  Matrix position = asymmetric_shape(kOrder);
  Surface surface = make_surface(transform, position);

  [[nodiscard]] double integral(const Vector& values) const { return values.dot(surface.quadrature); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(surface_calculus, TestSurface)

BOOST_AUTO_TEST_CASE(laplacian_of_position_is_twice_mean_curvature_normal) {
  const Matrix laplacian = surface_laplacian(surface, transform.synthesize_hessian(position));
  const Matrix expected = 2.0 * surface.mean_curvature.asDiagonal() * surface.normal;
  BOOST_TEST(relative_difference(laplacian, expected) < 1e-11);
}

BOOST_AUTO_TEST_CASE(gradient_of_an_ambient_function_is_its_tangential_part) {
  // f = a·x + (b·x)² has the spatial gradient a + 2 (b·x) b.
  const Vector3 a(0.3, -1.0, 0.4);
  const Vector3 b(0.8, 0.1, -0.5);
  const Vector along_b = surface.position * b;
  const Vector f = surface.position * a + along_b.cwiseAbs2();
  const Matrix gradient = surface_gradient(surface, transform.synthesize_gradient(transform.analyze(f)));
  const Matrix ambient = a.transpose().replicate(surface.n_points(), 1) + 2.0 * along_b * b.transpose();
  const Matrix expected = ambient - row_dot(ambient, surface.normal).asDiagonal() * surface.normal;
  BOOST_TEST(relative_difference(gradient, expected) < 1e-11);
  BOOST_TEST(row_dot(gradient, surface.normal).cwiseAbs().maxCoeff() < 1e-12);
}

BOOST_AUTO_TEST_CASE(divergence_of_an_ambient_field_is_the_trace_of_its_tangential_gradient) {
  // v = A x: ∇_γ·v = tr A − n·A n; for A = I this is 2.
  Matrix3 a;
  a << 0.3, 1.2, -0.7, 0.5, -0.4, 0.9, -1.1, 0.2, 0.8;
  const Vector divergence = surface_divergence(surface, transform.synthesize_gradient(position * a.transpose()));
  const Vector expected = a.trace() - row_dot(surface.normal, surface.normal * a.transpose()).array();
  BOOST_TEST(max_difference(divergence, expected) < 1e-11);
}

BOOST_AUTO_TEST_CASE(divergence_theorem_holds_for_any_vector_field) {
  const SphereDerivatives v = transform.synthesize_gradient(smooth_coefficients(kOrder, 6, 3, 21));
  const double left = integral(surface_divergence(surface, v));
  const double right = -2.0 * integral(surface.mean_curvature.cwiseProduct(row_dot(v.value, surface.normal)));
  BOOST_TEST(std::abs(left - right) < 1e-12 * std::abs(right));
}

BOOST_AUTO_TEST_CASE(laplacian_is_divergence_of_gradient_in_the_weak_sense) {
  const SphereDerivatives f = transform.synthesize_hessian(smooth_coefficients(kOrder, 5, 1, 22));
  const SphereDerivatives g = transform.synthesize_hessian(smooth_coefficients(kOrder, 6, 1, 23));
  const double f_laplace_g = integral(f.value.col(0).cwiseProduct(surface_laplacian(surface, g).col(0)));
  const double gradients = integral(row_dot(surface_gradient(surface, f), surface_gradient(surface, g)));
  BOOST_TEST(std::abs(f_laplace_g + gradients) < 1e-11 * std::abs(gradients));
}

BOOST_AUTO_TEST_CASE(laplacian_does_not_depend_on_the_poles) {
  const Matrix f = smooth_coefficients(kOrder, 5, 1, 24);
  const auto dirichlet_and_laplacian = [this](const Matrix& x, const Matrix& field) {
    const Surface s = make_surface(transform, x);
    const Vector laplacian = surface_laplacian(s, transform.synthesize_hessian(field)).col(0);
    return laplacian.cwiseAbs2().dot(s.quadrature);
  };
  const Matrix3 rotation = general_rotation();
  const double here = dirichlet_and_laplacian(position, f);
  const double moved = dirichlet_and_laplacian(move_poles(position, rotation), move_poles(f, rotation));
  BOOST_TEST(std::abs(moved / here - 1.0) < 1e-11);
}

BOOST_AUTO_TEST_CASE(dual_basis_is_dual_and_tangential) {
  const auto largest = [](const Matrix& a, const Matrix& b, double expected) {
    return (row_dot(a, b).array() - expected).abs().maxCoeff();
  };
  BOOST_TEST(largest(surface.tangent_1, surface.dual_1, 1.0) < 1e-12);
  BOOST_TEST(largest(surface.tangent_2, surface.dual_2, 1.0) < 1e-12);
  BOOST_TEST(largest(surface.tangent_1, surface.dual_2, 0.0) < 1e-12);
  BOOST_TEST(largest(surface.dual_1, surface.normal, 0.0) < 1e-12);
  BOOST_TEST(largest(surface.dual_2, surface.normal, 0.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(position_without_three_components_is_refused) {
  BOOST_CHECK_THROW(make_surface(transform, position.leftCols(2)), ShapeError);
}

BOOST_AUTO_TEST_SUITE_END()
