#include "bie/stepping/space/visible_share.hpp"

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/degree_bounds.hpp"

namespace vehd {

namespace {

/// That of the degrees above `middle`.
Matrix upper_part(Matrix coefficients, int middle) {
  coefficients.topRows(n_coefficients(middle)).setZero();
  return coefficients;
}

double share_of(double largest, const Matrix& upper) {
  const double most = degree_bounds(upper).sum();
  return most > 0.0 ? std::min(1.0, largest / most) : 1.0;
}

}  // namespace

VisibleShare visible_share(const SphereTransform& fine, const SurfaceFields& membrane) {
  const int middle = order_of(membrane.position.rows()) / 2;
  const Matrix upper = upper_part(membrane.position, middle);
  const SphereDerivatives x = fine.synthesize_gradient(membrane.position);
  const Matrix moved = fine.synthesize(upper);
  const bool is_charged = membrane.transmembrane_potential.size() > 0;
  SphereDerivatives v;
  Matrix upper_v, charged;
  if (is_charged) {
    v = fine.synthesize_gradient(membrane.transmembrane_potential);
    upper_v = upper_part(membrane.transmembrane_potential, middle);
    charged = fine.synthesize(upper_v);
  }
  double across = 0.0, at_place = 0.0;
  for (Index i = 0; i < moved.rows(); ++i) {
    const Vector3 d1 = x.d1.row(i), d2 = x.d2.row(i), by = moved.row(i);
    const Vector3 normal = d1.cross(d2);
    across = std::max(across, std::abs(normal.dot(by)) / normal.norm());
    if (!is_charged) continue;
    // by = c₁ x_1 + c₂ x_2 along the surface.
    const double c1 = by.cross(d2).dot(normal) / normal.squaredNorm();
    const double c2 = d1.cross(by).dot(normal) / normal.squaredNorm();
    at_place = std::max(at_place, std::abs(charged(i, 0) - c1 * v.d1(i, 0) - c2 * v.d2(i, 0)));
  }
  VisibleShare share;
  share.shape = share_of(across, upper);
  if (is_charged) share.potential = share_of(at_place, upper_v);
  return share;
}

}  // namespace vehd
