#include "fem_check/app/sample_values.hpp"

#include <limits>

namespace vehd::fem_check {

Eigen::MatrixXd at_samples(const Discretisation& discretisation, const Vectors& points,
                           const std::function<Eigen::MatrixXd(const VolumePoints&)>& values) {
  std::vector<Eigen::Index> found;
  VolumePoints places;
  places.position.resize(3, points.cols());
  places.unit.resize(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    try {
      const VolumePoints place = discretisation.locate(points.col(i));
      const auto last = static_cast<Eigen::Index>(found.size());
      places.position.col(last) = place.position;
      places.unit.col(last) = place.unit;
      places.cell.push_back(place.cell.front());
      places.inside.push_back(place.inside.front());
      found.push_back(i);
    } catch (const LocationError&) {
      // The value remains NaN.
    }
  }
  if (found.empty()) return {};
  places.position.conservativeResize(3, static_cast<Eigen::Index>(found.size()));
  places.unit.conservativeResize(3, static_cast<Eigen::Index>(found.size()));
  const Eigen::MatrixXd known = values(places);
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Constant(known.rows(), points.cols(), std::numeric_limits<double>::quiet_NaN());
  result(Eigen::all, found) = known;
  return result;
}

}  // namespace vehd::fem_check
