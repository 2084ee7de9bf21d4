#include "fem_check/app/sample_values.hpp"

#include <limits>

namespace vehd::fem_check {

Eigen::MatrixXd at_samples(const Discretisation& discretisation, const Vectors& points,
                           const std::function<Eigen::MatrixXd(const VolumePoints&)>& values) {
  std::vector<Eigen::Index> found;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    try {
      static_cast<void>(discretisation.locate(points.col(i)));
      found.push_back(i);
    } catch (const LocationError&) {
      // It counts as unknown.
    }
  }
  if (found.empty()) return {};
  const Eigen::MatrixXd known = values(discretisation.locate(Vectors(points(Eigen::all, found))));
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Constant(known.rows(), points.cols(), std::numeric_limits<double>::quiet_NaN());
  result(Eigen::all, found) = known;
  return result;
}

}  // namespace vehd::fem_check
