#include "fem_check/app/smooth_work.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <memory>

#include "fem_check/app/surface_divergence.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

constexpr Eigen::Index highest_degree = 4, n_harmonics = (highest_degree + 1) * (highest_degree + 1);

/// One column for each harmonic.
Eigen::MatrixXd each_harmonic() { return Eigen::MatrixXd::Identity(n_harmonics, n_harmonics); }

/// L2(γ) projection onto the harmonics, from values at points.
class SmoothPart {
 public:
  explicit SmoothPart(const SurfacePoints& points) {
    values_ = SurfaceSeries(each_harmonic())(points);
    weighted_ = values_ * points.weight.asDiagonal();
    mass_.compute(weighted_ * values_.transpose());
  }
  /// @param field  [components x points]
  [[nodiscard]] Eigen::MatrixXd operator()(const Eigen::MatrixXd& field) const {
    return with_moments(weighted_ * field.transpose());
  }
  /// Combination of the harmonics with given moments.
  /// @param moments  ∫ f_c Y_k dA in row k and column c
  [[nodiscard]] Eigen::MatrixXd with_moments(const Eigen::MatrixXd& moments) const {
    return mass_.solve(moments).transpose() * values_;
  }

 private:
  Eigen::MatrixXd values_, weighted_;  // [harmonics x points]
  Eigen::LLT<Eigen::MatrixXd> mass_;
};

ComparedField projected(ComparedField compared, const SmoothPart& smooth) {
  for (Eigen::MatrixXd* force : {&compared.judged, &compared.bie, &compared.bie_high}) *force = smooth(*force);
  return compared;
}

}  // namespace

ComparedField work_on_smooth(ComparedField compared, const SurfacePoints& points) {
  const auto smooth = std::make_shared<const SmoothPart>(points);
  compared.from_level = [smooth](const Eigen::MatrixXd& force) { return (*smooth)(force); };
  return projected(std::move(compared), *smooth);
}

ComparedField work_of_tension(ComparedField compared, const Eigen::MatrixXd& position, const SurfacePoints& points) {
  const auto smooth = std::make_shared<const SmoothPart>(points);
  std::array<Eigen::MatrixXd, 3> slopes = surface_gradients(position, each_harmonic(), points.direction);
  for (Eigen::MatrixXd& component : slopes) component = component * points.weight.asDiagonal();
  compared.from_level = [smooth, slopes](const Eigen::MatrixXd& tension) {
    Eigen::MatrixXd moments(n_harmonics, 3);
    // The divergence of w = Y e_d is the component d of ∇_γ Y.
    for (int d = 0; d < 3; ++d) moments.col(d) = -slopes[d] * tension.transpose();
    return smooth->with_moments(moments);
  };
  return projected(std::move(compared), *smooth);
}

}  // namespace vehd::fem_check
