#include "bie/potentials/target_images.hpp"

#include <algorithm>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

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

TargetImages::TargetImages(const std::vector<Reflection>& reflections, const KernelColumns& kernels,
                           const ActiveCoefficients& active, int n_phi)
    : image_of_(n_phi, {0, -1}) {
  std::vector<Reflection> azimuthal;
  for (const Reflection& g : reflections) {
    if (g == Reflection{}) continue;
    if (g.z > 0) {
      azimuthal.push_back(g);
      signs_.push_back(signs(g, kernels, active));
    } else if (!flip_) {
      flip_ = g;
      flip_signs_ = signs(g, kernels, active);
    }
  }
  for (int k = 0; k < n_phi; ++k) {
    if (image_of_[k].second >= 0) continue;
    originals_.push_back(k);
    for (std::size_t i = 0; i < azimuthal.size(); ++i) {
      const int image = azimuthal[i].azimuth(k, n_phi);
      if (image > k) image_of_[image] = {k, static_cast<int>(i)};
    }
  }
}

void TargetImages::fill(Eigen::Ref<RowMatrix> rows) const {
  for (std::size_t k = 0; k < image_of_.size(); ++k) {
    const auto [original, g] = image_of_[k];
    if (g >= 0) rows.row(k) = rows.row(original).cwiseProduct(signs_[g]);
  }
}

}  // namespace vehd
