#include "bie/kernels/no_slip.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "bie/kernels/stokes.hpp"

using namespace vehd;

BOOST_AUTO_TEST_SUITE(no_slip)

namespace {

/// A no-slip wall with the fluid above it: z = 0 unless rotated.
struct Plane {
  Vector3 point = Vector3::Zero(), normal = Vector3::UnitZ();

  [[nodiscard]] double height(const Vector3& x) const { return normal.dot(x - point); }
  [[nodiscard]] Vector3 mirrored(const Vector3& v) const { return v - 2.0 * normal.dot(v) * normal; }
  [[nodiscard]] MirroredTarget target(const Vector3& x) const { return {normal, height(x)}; }
  /// Separation X − y from the mirror image X of x.
  [[nodiscard]] Vector3 separation(const Vector3& x, const Vector3& y) const {
    return x - 2.0 * height(x) * normal - y;
  }

  /// 8π times the flow of a point force with its image.
  [[nodiscard]] Vector3 of_force(const Vector3& x, const Vector3& y, const Vector3& f) const {
    const Vector3 r = x - y, s = separation(x, y);
    const auto free = stokeslet_flow(r[0], r[1], r[2], 1.0 / r.norm(), f[0], f[1], f[2]);
    const auto image = no_slip_flow(target(x), s[0], s[1], s[2], 1.0 / s.norm(), f[0], f[1], f[2]);
    return Vector3(free.data()) + mirrored(Vector3(image.data()));
  }
  /// Kernel of the double layer with its image, times 4π/3.
  [[nodiscard]] Vector3 of_velocity(const Vector3& x, const Vector3& y, const Vector3& area, const Vector3& v) const {
    const Vector3 r = x - y, s = separation(x, y);
    const auto free = stokes_double_flow(r[0], r[1], r[2], r.dot(area), 1.0 / r.norm(), v[0], v[1], v[2]);
    const auto image =
        no_slip_double_flow(target(x), s[0], s[1], s[2], 1.0 / s.norm(), area[0], area[1], area[2], v[0], v[1], v[2]);
    return Vector3(free.data()) + mirrored(Vector3(image.data()));
  }
};

class Points {
 public:
  Vector3 any() { return {number_(generator_), number_(generator_), number_(generator_)}; }
  Vector3 above(const Plane& plane) {
    const Vector3 x = any();
    return x + (std::abs(number_(generator_)) + 0.1 - plane.height(x)) * plane.normal;
  }

 private:
  std::mt19937 generator_{7};
  std::normal_distribution<double> number_;
};

/// Source: Blake 1971, Eq. (8)
Vector3 blake(const Vector3& x, const Vector3& y, const Vector3& f) {
  const double h = y.z();
  const Vector3 r = x - y, big(r.x(), r.y(), x.z() + h);
  const double a = r.norm(), b = big.norm();
  Matrix3 g =
      Matrix3::Identity() * (1.0 / a - 1.0 / b) + r * r.transpose() / (a * a * a) - big * big.transpose() / (b * b * b);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double delta_ij = i == j ? 1.0 : 0.0, delta_i3 = i == 2 ? 1.0 : 0.0;
      const double sign = j == 2 ? -1.0 : 1.0;
      // 2h (δ_jα δ_αk − δ_j3 δ_3k) ∂/∂R_k [h R_i/R³ − (δ_i3/R + R_i R_3/R³)]
      const double of_source = h * (delta_ij / (b * b * b) - 3.0 * big[i] * big[j] / std::pow(b, 5));
      const double of_force = -delta_i3 * big[j] / (b * b * b) +
                              (delta_ij * big[2] + big[i] * (j == 2 ? 1.0 : 0.0)) / (b * b * b) -
                              3.0 * big[i] * big[2] * big[j] / std::pow(b, 5);
      g(i, j) += 2.0 * h * sign * (of_source - of_force);
    }
  }
  return g * f;
}

}  // namespace

BOOST_AUTO_TEST_CASE(point_force_has_the_image_of_blake) {
  Points points;
  for (int k = 0; k < 50; ++k) {
    const Plane plane;
    const Vector3 x = points.above(plane), y = points.above(plane), f = points.any();
    const Vector3 expected = blake(x, y, f);
    BOOST_TEST((plane.of_force(x, y, f) - expected).norm() < 1e-12 * (1.0 + f.norm() / (x - y).norm()));
  }
}

BOOST_AUTO_TEST_CASE(nothing_moves_on_the_plane) {
  Points points;
  for (int k = 0; k < 50; ++k) {
    const Plane plane{points.any(), points.any().normalized()};
    const Vector3 y = points.above(plane), f = points.any(), area = points.any();
    Vector3 x = points.any();
    x -= plane.height(x) * plane.normal;
    BOOST_TEST(plane.of_force(x, y, f).norm() < 1e-12 * f.norm() / (x - y).norm());
    BOOST_TEST(plane.of_velocity(x, y, area, f).norm() < 1e-12 * f.norm() * area.norm() / (x - y).squaredNorm());
  }
}

// Reciprocity: g·u[f] at x equals f·u[g] at y.
BOOST_AUTO_TEST_CASE(forces_are_reciprocal) {
  Points points;
  const Plane plane{points.any(), points.any().normalized()};
  for (int k = 0; k < 50; ++k) {
    const Vector3 x = points.above(plane), y = points.above(plane), f = points.any(), g = points.any();
    const double work = g.dot(plane.of_force(x, y, f));
    BOOST_TEST(std::abs(work - f.dot(plane.of_force(y, x, g))) < 1e-12 * f.norm() * g.norm() / (x - y).norm());
  }
}

// If tr Q = 0, the kernel of the double layer, with prefactor 3/(4π), is twice the force dipole ∂G_ij/∂y_k Q_jk/(8π).
BOOST_AUTO_TEST_CASE(double_layer_is_the_derivative_of_the_single_layer) {
  Points points;
  constexpr double step = 1e-5;
  for (int k = 0; k < 20; ++k) {
    const Plane plane{points.any(), points.any().normalized()};
    const Vector3 x = points.above(plane) + plane.normal, y = points.above(plane);
    const Vector3 area = points.any(), v = area.cross(points.any());
    Vector3 dipole = Vector3::Zero();
    for (const auto& [force, along] : {std::pair(v, area), std::pair(area, v)}) {
      const Vector3 shift = step * along.normalized();
      dipole += 0.5 * along.norm() / (2.0 * step) *
                (plane.of_force(x, y + shift, force) - plane.of_force(x, y - shift, force));
    }
    const Vector3 found = plane.of_velocity(x, y, area, v);
    BOOST_TEST((3.0 * found - dipole).norm() < 1e-6 * (1.0 + dipole.norm()));
  }
}

BOOST_AUTO_TEST_SUITE_END()
