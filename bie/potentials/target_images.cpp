#include "bie/potentials/target_images.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"

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

namespace {

Eigen::RowVectorXd signs(const Reflection& g, const KernelColumns& kernels, const ActiveCoefficients& active) {
  constexpr int kFirst[] = {0, 0, 0, 1, 1, 2};
  constexpr int kSecond[] = {0, 1, 2, 1, 2, 2};
  Eigen::RowVectorXd result(kernels.count * active.count());
  for (int c = 0; c < kernels.count; ++c) {
    const int stokes = kernels.stokes_block(c);
    const int factor = stokes >= 0 ? g.sign(kFirst[stokes]) * g.sign(kSecond[stokes]) : 1;
    for (Index i = 0; i < active.count(); ++i) {
      result[c * active.count() + i] = factor * g.parity(active.n[i], active.m[i]);
    }
  }
  return result;
}

}  // namespace

ActiveCoefficients::ActiveCoefficients(int order, int azimuthal_order) {
  for (int degree = 0; degree <= order; ++degree) {
    const int last = std::min(degree, azimuthal_order);
    for (int k = -last; k <= last; ++k) indices.push_back(coefficient_index(degree, k));
  }
  const auto add = [&](int degree, int k) {
    n.push_back(degree);
    m.push_back(k);
    const Index index = coefficient_index(degree, k);
    position.push_back(std::lower_bound(indices.begin(), indices.end(), index) - indices.begin());
  };
  for (int k = 0; k <= azimuthal_order; ++k) {
    for (int degree = k; degree <= order; ++degree) add(degree, k);
    for (int degree = k; degree <= order && k > 0; ++degree) add(degree, -k);
  }
  if (azimuthal_order >= order) indices.clear();
}

TargetImages::TargetImages(const SurfaceMaps& maps, const KernelColumns& kernels, const ActiveCoefficients& active,
                           int n_phi)
    : images_(n_phi) {
  std::vector<Reflection> azimuthal{Reflection{}};
  for (const Reflection& g : maps.reflections) {
    if (g == Reflection{}) continue;
    if (g.z > 0) {
      azimuthal.push_back(g);
    } else if (!flip_) {
      flip_ = g;
      flip_signs_ = signs(g, kernels, active);
    }
  }
  for (const Reflection& g : azimuthal) signs_.push_back(signs(g, kernels, active));
  for (int j = 1; j < maps.fold; ++j) rotations_.emplace_back(2.0 * std::numbers::pi * j / maps.fold, kernels, active);
  for (int k = 0; k < n_phi; ++k) {
    if (images_[k].original >= 0) continue;
    originals_.push_back(k);
    for (int g = 0; g < static_cast<int>(azimuthal.size()); ++g) {
      for (int j = 0; j < maps.fold; ++j) {
        const int image = (azimuthal[g].azimuth(k, n_phi) + j * (n_phi / maps.fold)) % n_phi;
        if (image > k && images_[image].original < 0) images_[image] = {k, g, j};
      }
    }
  }
  const auto& all = maps.reflections;
  in_mirror_ = originals_.size() == 1 && std::find(all.begin(), all.end(), Reflection{1, -1, 1}) != all.end();
}

std::vector<int> TargetImages::multiplicities() const {
  std::vector<int> result;
  for (const int k : originals_) {
    const auto is_image = [&](const Image& image) { return image.original == k; };
    result.push_back(1 + static_cast<int>(std::count_if(images_.begin(), images_.end(), is_image)));
  }
  return result;
}

void TargetImages::fill(Eigen::Ref<RowMatrix> rows) const {
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const Image& image = images_[k];
    if (image.original < 0) continue;
    rows.row(k) = rows.row(image.original).cwiseProduct(signs_[image.reflection]);
    if (image.rotations > 0) rotations_[image.rotations - 1].apply(rows.row(k));
  }
}

}  // namespace vehd
