#include "bie/stepping/evaluation/operator_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Distance of two parts of a membrane, in grid spacings, at which D has lost all but two digits on the finest level.
constexpr double contact_separation = 0.1;

double largest_length(const Matrix& vectors) { return vectors.rowwise().norm().maxCoeff(); }

/// Points whose distances are checked: the nodes followed by the poles.
struct ProbePoints {
  Matrix position, normal;  ///< [n x 3]
  Vector spacing;
};

/// One point as seen from another: squared lengths, times |u|², u the difference of the normals.
struct View {
  double along;    ///< distance along u
  double allowed;  ///< the larger of their spacings
  double excess;   ///< ≤ 0 if they face each other and their distance across u is at most a spacing
};

/// ≤ 0 if the points face each other.
inline double turned(const double* nx, const double* ny, const double* nz, Index i, Index j) {
  constexpr double kFacing = -0.5;
  return nx[i] * nx[j] + ny[i] * ny[j] + nz[i] * nz[j] - kFacing;
}

inline View view(const double* x, const double* y, const double* z, const double* nx, const double* ny,
                 const double* nz, const double* spacing, Index i, Index j) {
  const double ux = nx[i] - nx[j], uy = ny[i] - ny[j], uz = nz[i] - nz[j];
  const double wx = x[j] - x[i], wy = y[j] - y[i], wz = z[j] - z[i];
  const double length2 = ux * ux + uy * uy + uz * uz, along = wx * ux + wy * uy + wz * uz;
  const double wide = spacing[i] > spacing[j] ? spacing[i] : spacing[j], allowed = wide * wide * length2;
  const double beside = (wx * wx + wy * wy + wz * wz) * length2 - along * along - allowed;
  const double away = turned(nx, ny, nz, i, j);
  return {along * along, allowed, away > beside ? away : beside};
}

ProbePoints probe_points(const SphereTransform& nodes, const Matrix& position) {
  const Surface s = make_surface(nodes, position);
  const Index n = s.n_points();
  ProbePoints result{Matrix(n + 2, 3), Matrix(n + 2, 3), Vector(n + 2)};
  result.position.topRows(n) = s.position;
  result.normal.topRows(n) = s.normal;
  result.spacing.head(n) = (s.area_element * (4.0 * std::numbers::pi / static_cast<double>(n))).cwiseSqrt();
  result.spacing[n] = result.spacing[0];
  result.spacing[n + 1] = result.spacing[n - 1];
  // Normals of the poles from differences across them.
  constexpr double kNear = 1e-4;
  constexpr double kPi = std::numbers::pi;
  const Vector theta{{0.0, kNear, kNear, kNear, kNear, kPi, kPi - kNear, kPi - kNear, kPi - kNear, kPi - kNear}};
  const Vector phi{{0.0, 0.0, kPi, 0.5 * kPi, 1.5 * kPi, 0.0, 0.0, kPi, 0.5 * kPi, 1.5 * kPi}};
  const Eigen::Matrix3Xd x = evaluate_harmonics(position, theta, phi, nodes.azimuthal_order()).transpose();
  for (const Index pole : {0, 1}) {
    const auto around = [&](Index i) { return Vector3(x.col(5 * pole + i)); };
    const Vector3 outward = (around(1) - around(2)).cross(around(3) - around(4)).normalized();
    result.position.row(n + pole) = around(0).transpose();
    result.normal.row(n + pole) = (pole == 0 ? outward : Vector3(-outward)).transpose();
  }
  return result;
}

}  // namespace

LayerCheck check_layers(const Membrane& membrane) {
  const SphereTransform& fine = membrane.fine;
  LayerCheck check;
  if (!membrane.layers.stokes_single.empty()) {
    const Matrix density = membrane.surface.area_element.asDiagonal() * membrane.surface.normal;
    const Matrix kept = fine.analyze(density);
    check.error = largest_length(fine.synthesize(membrane.layers.stokes_single.apply(kept))) / membrane.radius;
    // S maps degree n of a weighted density to 1/(2n) of it over the radius.
    const double lost = largest_length(density - fine.synthesize(kept));
    check.truncation = lost / (2.0 * fine.order() * membrane.radius * membrane.radius);
  }
  if (!membrane.layers.laplace_double.empty()) {
    Vector one = Vector::Zero(n_coefficients(fine.order()));
    one[0] = coefficient_of_one;
    const Matrix image = fine.synthesize(membrane.layers.laplace_double.apply(one));
    check.error = std::max(check.error, (image.array() + 0.5).abs().maxCoeff());
  }
  return check;
}

double separation(const SphereTransform& nodes, const Matrix& position, bool one_meridian_suffices) {
  // Points are tested in groups of this size, of which those without any that faces the point are skipped.
  constexpr Index kAtATime = 16;
  const ProbePoints at = probe_points(nodes, position);
  const Index n = at.spacing.size();
  const auto column = [](const Matrix& vectors, Index component) { return vectors.col(component).data(); };
  const double *x = column(at.position, 0), *y = column(at.position, 1), *z = column(at.position, 2);
  const double *nx = column(at.normal, 0), *ny = column(at.normal, 1), *nz = column(at.normal, 2);
  const double* spacing = at.spacing.data();
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double least2 = kNone;
  for (Index i = 0; i < n; ++i) {
    const bool is_pole = i >= n - 2;
    if (one_meridian_suffices && !is_pole && i % nodes.grid().n_phi != 0) continue;
    for (Index first = one_meridian_suffices ? 0 : i + 1; first < n; first += kAtATime) {
      const Index end = std::min(first + kAtATime, n);
      double least_turned = 1.0;
#pragma omp simd reduction(min : least_turned)
      for (Index j = first; j < end; ++j) {
        const double away = turned(nx, ny, nz, i, j);
        least_turned = away < least_turned ? away : least_turned;
      }
      if (least_turned > 0.0) continue;
#pragma omp simd reduction(min : least2)
      for (Index j = first; j < end; ++j) {
        const View seen = view(x, y, z, nx, ny, nz, spacing, i, j);
        const double here2 = seen.excess <= 0.0 ? seen.along / seen.allowed : kNone;
        least2 = here2 < least2 ? here2 : least2;
      }
    }
  }
  return std::sqrt(least2);
}

void require_apart(double separation, double before) {
  if (separation < contact_separation) {
    throw ConvergenceError(fmt::format(
        "two parts of the membrane are {:.2g} grid spacings from each other, too near for any quadrature", separation));
  }
  if (separation < std::min(1.0, thresholds::least_approach * before)) {
    throw ConvergenceError(fmt::format(
        "two parts of the membrane come within {:.2g} grid spacings of each other in one step", separation));
  }
}

}  // namespace vehd
