#include "bie/potentials/row_rotation.hpp"

#include <algorithm>
#include <cmath>

#include "bie/potentials/target_images.hpp"

namespace vehd {

RowRotation::RowRotation(double angle, const KernelColumns& kernels, const ActiveCoefficients& active)
    : cosine_(std::cos(angle)),
      sine_(std::sin(angle)),
      n_active_(active.count()),
      n_kernels_(kernels.count),
      order_(*std::max_element(active.n.begin(), active.n.end())) {
  for (const int first : {kernels.stokes, kernels.stokes_double}) {
    if (first >= 0) stokes_.push_back(first);
  }
  const int azimuthal_order = *std::max_element(active.m.begin(), active.m.end());
  const Vector multiples = Vector::LinSpaced(azimuthal_order + 1, 0.0, azimuthal_order);
  cosines_ = (angle * multiples).array().cos();
  sines_ = (angle * multiples).array().sin();
}

void RowRotation::apply(Eigen::Ref<Eigen::RowVectorXd> row) const {
  Eigen::Map<RowMatrix> blocks(row.data(), n_kernels_, n_active_);
  Index offset = order_ + 1;
  for (Index m = 1; m < cosines_.size(); ++m) {
    const Index n_degrees = order_ + 1 - m;
    auto cosine = blocks.middleCols(offset, n_degrees);
    auto sine = blocks.middleCols(offset + n_degrees, n_degrees);
    const RowMatrix before = cosine;
    cosine = cosines_[m] * before - sines_[m] * sine;
    sine = sines_[m] * before + cosines_[m] * sine;
    offset += 2 * n_degrees;
  }
  const double c = cosine_, s = sine_;
  for (const int first : stokes_) {
    const RowMatrix k = blocks.middleRows(first, 6);
    const auto xx = k.row(0), xy = k.row(1), xz = k.row(2), yy = k.row(3), yz = k.row(4);
    blocks.row(first) = c * c * xx - 2.0 * c * s * xy + s * s * yy;
    blocks.row(first + 1) = c * s * (xx - yy) + (c * c - s * s) * xy;
    blocks.row(first + 2) = c * xz - s * yz;
    blocks.row(first + 3) = s * s * xx + 2.0 * c * s * xy + c * c * yy;
    blocks.row(first + 4) = s * xz + c * yz;
  }
}

}  // namespace vehd
